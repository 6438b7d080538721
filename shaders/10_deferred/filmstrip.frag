#version 330 core
// The buffers behind the picture, unencoded: albedo, normal, position, occlusion.
#include "10_deferred/show.glsl"

in vec2 uv;
flat in int tile;

out vec4 display_color;

// excerpt: filmstrip
void main() {
    vec3 color = tile == 0 ? showAlbedo(uv) : tile == 1 ? showNormal(uv) : tile == 2 ? showPosition(uv) : showVisibility(uv);
    display_color = vec4(color, 1.0);
}
// end excerpt
