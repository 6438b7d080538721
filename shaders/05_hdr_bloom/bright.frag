#version 330 core
// Keeps what is brighter than the threshold, at half the resolution, and weighs it so that one very bright pixel does
// not outshine all its neighbours (Karis 2013, "Tone mapping"; Jimenez 2014, "Next Generation Post Processing in
// Call of Duty: Advanced Warfare").
#include "lib/luminance.glsl"

in vec2 uv;

uniform sampler2D hdr;
uniform float threshold; // luminance
uniform float knee;      // half the width of the soft step about the threshold, luminance, >= 0

out vec4 bright_color; // linear

// excerpt: bright_curve
// 0 well below the threshold, 1 well above, a Hermite step between; a hard step where there is no knee.
float brightCurve(float luma) {
    if (knee <= 0.0) return luma > threshold ? 1.0 : 0.0;
    float t = clamp((luma - threshold + knee) / (2.0 * knee), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
// end excerpt

// excerpt: karis
#if KARIS == KARIS_TEXEL
// Each of the four texels under this pixel has its weight before they are averaged, and the sum is divided by the
// weights: one firefly cannot dominate, and a flat field stays as bright as it is. Where the size is odd, a pixel does
// not lie midway between its four: each counts by its bilinear share.
vec3 brightColor() {
    ivec2 last = textureSize(hdr, 0) - 1;
    vec2 place = uv * vec2(last + 1) - 0.5;
    vec2 share = fract(place);
    ivec2 first = ivec2(floor(place));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec3 texel = texelFetch(hdr, clamp(first + corner, ivec2(0), last), 0).rgb;
        float luma = luminance(texel);
        vec2 shares = mix(1.0 - share, share, vec2(corner));
        float weight = shares.x * shares.y / (1.0 + luma);
        sum += texel * (weight * brightCurve(luma));
        weights += weight;
    }
    return sum / weights;
}
#else
// The bilinear fetch averages the four texels first. The seed's weight then presses the average below 1.
vec3 brightColor() {
    vec3 average = texture(hdr, uv).rgb;
    float luma = luminance(average);
#if KARIS == KARIS_SEED
    return average * (brightCurve(luma) / (1.0 + luma));
#else
    return average * brightCurve(luma);
#endif
}
#endif
// end excerpt

void main() { bright_color = vec4(brightColor(), 1.0); }
