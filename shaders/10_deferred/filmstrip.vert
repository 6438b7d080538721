#version 330 core
// Four small pictures along the bottom of the screen.

layout(location = 0) in vec2 screen_uv; // [0, 1] over the screen
layout(location = 1) in vec2 tile_uv;   // [0, 1] over the tile
layout(location = 2) in float tile_number;

out vec2 uv;
flat out int tile;

// So that no pixel reads right between two texels, as every ninth does where a tile is 0.18 of the screen: there the
// last bit decides which. Less than half a pixel of a tile 480 pixels wide.
const float aside = 0.001;

void main() {
    uv = tile_uv + aside;
    tile = int(tile_number);
    gl_Position = vec4(screen_uv * 2.0 - 1.0, 0.0, 1.0);
}
