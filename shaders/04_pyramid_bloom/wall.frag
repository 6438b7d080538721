#version 330 core
// Dark walls in the haze of the town, with windows, some of them lit; and the mirror image of it all below the water.
#include "04_pyramid_bloom/sky.glsl"

in vec3 world_position; // metres
in float clear; // share of the wall's own colour; the rest is haze
flat in vec3 world_normal;
flat in float windows;

uniform float time_s;

out vec4 hdr_color; // linear

const vec2 window_grid = vec2(1.7, 2.1); // metres
const vec2 window_size = vec2(0.45, 0.5); // of the grid

// [0, 1), from integers, so that every driver lights the same windows (the permutation is PCG's, O'Neill 2014).
float random(uvec3 v) {
    uint n = v.x * 1664525u + v.y * 22695477u + v.z * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28) + 4u)) ^ n) * 277803737u;
    return float(((n >> 22) ^ n) >> 8) / 16777216.0;
}

// The part of this pixel that lies in [-half_width, half_width], both in grid cells.
vec2 covered(vec2 place, vec2 half_width, vec2 pixel) {
    pixel = max(pixel, 1e-4);
    return clamp((half_width - abs(place)) / pixel + 0.5, 0.0, 1.0) * min(2.0 * half_width / pixel, 1.0);
}

// Both in grid cells; pixel is how wide one is there, or how far ripples spread it.
vec3 windowLight(vec2 grid, vec2 pixel) {
    vec2 part = covered(fract(grid) - 0.5, 0.5 * window_size, pixel);
    uvec3 cell = uvec3(ivec3(floor(grid), windows) + 4096);
    float lit = random(cell);
    if (lit > 0.33) return vec3(0.0);
    float warm = random(cell.yzx);
    vec3 color = warm < 0.75 ? vec3(1.0, 0.62, 0.28) : vec3(0.7, 0.85, 1.0);
    return color * (part.x * part.y * (0.08 + 7.0 * lit * lit));
}

// From lamps at the foot of a tower, and from the streets.
vec3 floodColor(float height) { return vec3(0.10, 0.16, 0.30) * (0.1 + 1.0 / (1.0 + 0.03 * height * height)); }
vec3 streetColor(float height) { return vec3(0.012, 0.006, 0.0024) / (1.0 + 0.2 * height * height); }

void main() {
    bool mirrored = world_position.y < 0.0;
    vec3 place = world_position;
    if (mirrored) place.x += 0.45 * sin(1.9 * place.y + 1.2 * time_s); // ripples shift what is mirrored sideways
    float height = abs(place.y);
    vec3 color = vec3(0.010, 0.011, 0.016) * (world_normal.z > 0.5 ? 1.0 : 1.7) + streetColor(height);
    vec2 grid = vec2(world_normal.z != 0.0 ? place.x : place.z, height) / window_grid;
    vec2 pixel = fwidth(grid) + (mirrored ? 0.6 : 0.0);
    if (windows > 0.0 && world_normal.y == 0.0 && height > 3.0) color += windowLight(grid, pixel);
    if (windows < 0.0)
        color += floodColor(height) * ((world_normal.z > 0.5 ? 1.0 : 0.4) / (mirrored ? 1.0 + 0.2 * height : 1.0));
    hdr_color = vec4(mix(horizon_color, color, clear) * (mirrored ? 0.55 : 1.0), 1.0);
}
