#version 330 core
// Halves an image. All offsets are in texels of the source; the pixel's centre lies on the corner of four of them, so
// that every whole-texel step is again the average of four.
#include "lib/finite.glsl"

in vec2 uv;

uniform sampler2D source;

out vec4 color;

// excerpt: down
vec3 tap(float x, float y) { return texture(source, uv + vec2(x, y) / vec2(textureSize(source, 0))).rgb; }

vec3 down() {
#if DOWN_FILTER == DOWN_FILTER_5TAP
    // Bjorge 2015, the way down of the dual filter.
    return 0.5 * tap(0.0, 0.0) +
           0.125 * (tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0));
#elif DOWN_FILTER == DOWN_FILTER_13TAP
    // Jimenez 2014: five overlapping boxes, the middle one weighing half.
    vec3 inner = tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0);
    vec3 edges = tap(-2.0, 0.0) + tap(2.0, 0.0) + tap(0.0, -2.0) + tap(0.0, 2.0);
    vec3 corners = tap(-2.0, -2.0) + tap(2.0, -2.0) + tap(-2.0, 2.0) + tap(2.0, 2.0);
    return 0.125 * (tap(0.0, 0.0) + inner) + 0.0625 * edges + 0.03125 * corners;
#elif DOWN_FILTER == DOWN_FILTER_13TAP_AS_PRINTED
    // Where two boxes share a tap, it counts twice: 1.375 in all. And the taps are half as far out as they should be.
    vec3 inner = tap(-0.5, -0.5) + tap(0.5, -0.5) + tap(-0.5, 0.5) + tap(0.5, 0.5);
    vec3 edges = tap(-1.0, 0.0) + tap(1.0, 0.0) + tap(0.0, -1.0) + tap(0.0, 1.0);
    vec3 corners = tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0);
    return 0.125 * (tap(0.0, 0.0) + inner + edges) + 0.0625 * corners;
#elif DOWN_FILTER == DOWN_FILTER_4TAP
    // A bilinear fetch three quarters of a texel out weighs its two texels 3 : 1, so the four make [1 3 3 1] / 8 in
    // either direction.
    return 0.25 * (tap(-0.75, -0.75) + tap(0.75, -0.75) + tap(-0.75, 0.75) + tap(0.75, 0.75));
#elif DOWN_FILTER == DOWN_FILTER_BOX
    return tap(0.0, 0.0);
#endif
}
// end excerpt

void main() { color = vec4(finite(down()), 1.0); }
