#version 330 core
// Doubles an image, smoothing it; blending adds the result to the level above. Offsets are in texels of the source.
#include "lib/finite.glsl"

in vec2 uv;

uniform sampler2D source;

out vec4 color;

// excerpt: up
#if UP_FILTER == UP_FILTER_SPLINE
// The cubic B-spline with the source's texels as coefficients: smooth, nearly round, and each texel gives the same
// light to however many pixels. Its four weights a direction in two bilinear fetches (Sigg, Hadwiger 2005, "Fast
// Third-Order Texture Filtering").
vec3 up() {
    vec2 size = vec2(textureSize(source, 0));
    vec2 texel = uv * size - 0.5;
    vec2 f = fract(texel);
    vec2 g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0;
    vec2 w3 = f * f * f / 6.0;
    vec2 w1 = 2.0 / 3.0 - f * f + 3.0 * w3;
    vec2 first_weight = w0 + w1;
    vec2 last_weight = 1.0 - first_weight;
    vec2 middle = texel - f + 0.5; // the centre of the texel before the pixel
    vec2 first = (middle - 1.0 + w1 / first_weight) / size;
    vec2 last = (middle + 1.0 + w3 / last_weight) / size;
    return first_weight.y * (first_weight.x * texture(source, first).rgb +
                             last_weight.x * texture(source, vec2(last.x, first.y)).rgb) +
           last_weight.y * (first_weight.x * texture(source, vec2(first.x, last.y)).rgb +
                            last_weight.x * texture(source, last).rgb);
}
#elif UP_FILTER == UP_FILTER_TENT
// [1 2 1] / 4 in either direction over bilinear fetches: nine of them as usually written. Together they weigh four
// texels a direction, by how far (f) the pixel lies between the middle two:
//     (1 - f) / 4,  (2 - f) / 4,  (1 + f) / 4,  f / 4
// and a bilinear fetch placed between the first two, and one between the last two, weigh them just so. Four fetches
// then do for nine, and the sum is the same.
vec3 up() {
    vec2 size = vec2(textureSize(source, 0));
    vec2 texel = uv * size - 0.5;
    vec2 f = fract(texel);
    vec2 middle = texel - f + 0.5; // the centre of the texel before the pixel
    vec2 first = (middle - 1.0 + (2.0 - f) / (3.0 - 2.0 * f)) / size;
    vec2 last = (middle + 1.0 + f / (1.0 + 2.0 * f)) / size;
    vec2 first_weight = 0.75 - 0.5 * f;
    vec2 last_weight = 0.25 + 0.5 * f;
    return first_weight.y * (first_weight.x * texture(source, first).rgb +
                             last_weight.x * texture(source, vec2(last.x, first.y)).rgb) +
           last_weight.y * (first_weight.x * texture(source, vec2(first.x, last.y)).rgb +
                            last_weight.x * texture(source, last).rgb);
}
#else
vec3 tap(float x, float y) { return texture(source, uv + vec2(x, y) / vec2(textureSize(source, 0))).rgb; }

vec3 up() {
#if UP_FILTER == UP_FILTER_4TAP
    return 0.25 * (tap(-0.5, -0.5) + tap(0.5, -0.5) + tap(-0.5, 0.5) + tap(0.5, 0.5));
#elif UP_FILTER == UP_FILTER_DUAL
    // Bjorge 2015, the way up of the dual filter.
    vec3 inner = tap(-0.5, -0.5) + tap(0.5, -0.5) + tap(-0.5, 0.5) + tap(0.5, 0.5);
    vec3 outer = tap(-1.0, 0.0) + tap(1.0, 0.0) + tap(0.0, -1.0) + tap(0.0, 1.0);
    return (2.0 * inner + outer) / 12.0;
#elif UP_FILTER == UP_FILTER_BILINEAR
    return tap(0.0, 0.0);
#endif
}
#endif
// end excerpt

void main() { color = vec4(finite(up()), 1.0); }
