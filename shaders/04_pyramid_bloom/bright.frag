#version 330 core
// Keeps what is brighter than the threshold, at half the resolution, and weighs it so that one very bright pixel does
// not outshine all its neighbours (Karis 2013, "Tone mapping"; Jimenez 2014, "Next Generation Post Processing in
// Call of Duty: Advanced Warfare").
#include "04_pyramid_bloom/bright_curve.glsl"

in vec2 uv;

uniform sampler2D source;

out vec4 bright_color; // linear

// excerpt: karis_partial
#if KARIS == KARIS_PARTIAL
vec3 tap(float x, float y) { return texture(source, uv + vec2(x, y) / vec2(textureSize(source, 0))).rgb; }

// The 13 taps of the way down are five overlapping boxes. Here each box has its weight, and the sum is divided by the
// weights: a firefly is outweighed by the boxes that it is not in.
vec3 brightColor() {
    vec3 centre = tap(0.0, 0.0);
    vec3 left = tap(-2.0, 0.0), right = tap(2.0, 0.0), below = tap(0.0, -2.0), above = tap(0.0, 2.0);
    vec3 boxes[5];
    boxes[0] = tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0);
    boxes[1] = tap(-2.0, -2.0) + below + left + centre;
    boxes[2] = below + tap(2.0, -2.0) + centre + right;
    boxes[3] = left + centre + tap(-2.0, 2.0) + above;
    boxes[4] = centre + right + above + tap(2.0, 2.0);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 5; ++i) {
        vec3 mean = 0.25 * boxes[i];
        float luma = luminance(mean);
        if (!isLight(luma)) continue;
        float weight = (i == 0 ? 0.5 : 0.125) / (1.0 + luma);
        sum += mean * (weight * brightCurve(luma));
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : vec3(0.0);
}
// end excerpt
// excerpt: karis
#elif KARIS == KARIS_TEXEL
// Each of the four texels under this pixel has its weight before they are averaged, and the sum is divided by the
// weights: one firefly cannot dominate, and a flat field stays as bright as it is. Where the size is odd, a pixel does
// not lie midway between its four: each counts by its bilinear share.
vec3 brightColor() {
    ivec2 last = textureSize(source, 0) - 1;
    vec2 place = uv * vec2(last + 1) - 0.5;
    vec2 share = fract(place);
    ivec2 first = ivec2(floor(place));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec3 texel = texelFetch(source, clamp(first + corner, ivec2(0), last), 0).rgb;
        float luma = luminance(texel);
        if (!isLight(luma)) continue;
        vec2 shares = mix(1.0 - share, share, vec2(corner));
        float weight = shares.x * shares.y / (1.0 + luma);
        sum += texel * (weight * brightCurve(luma));
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : vec3(0.0);
}
#else
// The bilinear fetch averages the four texels first. The weight of the average then presses it below 1.
vec3 brightColor() {
    vec3 average = texture(source, uv).rgb;
    float luma = luminance(average);
    if (!isLight(luma)) return vec3(0.0);
#if KARIS == KARIS_AVERAGE
    return average * (brightCurve(luma) / (1.0 + luma));
#else
    return average * brightCurve(luma);
#endif
}
#endif
// end excerpt

void main() { bright_color = vec4(bounded(brightColor()), 1.0); }
