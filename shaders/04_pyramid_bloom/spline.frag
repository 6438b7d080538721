#version 330 core
// Halves an image, rounded up, under a B-spline: each texel counts by the part of the spline that lies over it. Splines
// side by side add up to 1 everywhere, so every texel hands on all of its light, at any size; and a pixel's weights add up
// to 1, so a flat field stays flat (the argument is Unser 1999, "Splines: A Perfect Fit for Signal and Image Processing").
// The bright pass is the same with the linear spline and the bright curve. In a large image, which a pixel more or less
// hardly changes, the linear spline's heights do for its areas, in four fetches instead of nine.
#include "lib/finite.glsl"
#if BRIGHT
#include "04_pyramid_bloom/bright_curve.glsl"
#endif

in vec2 uv;

uniform sampler2D source; // mirrored at its edges, bilinear

out vec4 color; // linear

// excerpt: spline
// DEGREE 1: the linear spline; 3: the cubic one. centre: of the pixel, in texels of the source; ratio: texels to a pixel, at
// most 2. A fetch for two texels, the two directions side by side.
#if WEIGHTS == WEIGHTS_EVEN
// Twice as large in either direction: [1 15 61 115 115 61 15 1] / 384 for all pixels.
const int fetches = 4;
void weigh(vec2 centre, vec2 ratio, out vec2 places[fetches], out vec2 weights[fetches]) {
    const float near = 1.5 - 115.0 / 176.0;
    const float far = 3.5 - 15.0 / 16.0;
    places = vec2[](centre - far, centre - near, centre + near, centre + far);
    weights = vec2[](vec2(16.0 / 384.0), vec2(176.0 / 384.0), vec2(176.0 / 384.0), vec2(16.0 / 384.0));
}
#elif WEIGHTS == WEIGHTS_HEIGHT
// The linear spline's height at the middles of four texels, the second of them f before the pixel. Every texel still hands
// on all of its light. Twice as large, they are [1 3 3 1] / 8, as areas are; nearly so, they add up to 1 +- 1 / size.
const int fetches = 2;
void weigh(vec2 centre, vec2 ratio, out vec2 places[fetches], out vec2 weights[fetches]) {
    vec2 f = fract(centre - 0.5);
    vec2 first = max(ratio - 1.0 - f, 0.0);
    vec2 last = max(ratio - 2.0 + f, 0.0);
    vec2 left = first + ratio - f;
    vec2 right = last + ratio - 1.0 + f;
    weights = vec2[](left / (ratio * ratio), right / (ratio * ratio));
    places = vec2[](centre - f - first / left, centre - f + 1.0 + last / right);
}
#else
const int fetches = DEGREE == 1 ? 3 : 5;

// The part of the spline's area that lies left of x.
vec2 areaBelow(vec2 x) {
    vec2 outer = max(0.5 * float(DEGREE + 1) - abs(x), 0.0);
#if DEGREE == 1
    vec2 tail = 0.5 * outer * outer;
#else
    vec2 inner = max(1.0 - abs(x), 0.0);
    vec2 tail = (outer * outer * outer * outer - 4.0 * inner * inner * inner * inner) / 24.0;
#endif
    return mix(1.0 - tail, tail, lessThan(x, vec2(0.0)));
}

void weigh(vec2 centre, vec2 ratio, out vec2 places[fetches], out vec2 weights[fetches]) {
    vec2 texel = floor(centre - 0.5 * float(DEGREE + 1) * ratio);
    vec2 area = areaBelow((texel - centre) / ratio);
    for (int i = 0; i < fetches; ++i) {
        vec2 middle_area = areaBelow((texel + 1.0 - centre) / ratio);
        vec2 next_area = areaBelow((texel + 2.0 - centre) / ratio);
        weights[i] = next_area - area;
        places[i] = texel + 0.5 + (next_area - middle_area) / max(weights[i], 1e-9);
        texel += 2.0;
        area = next_area;
    }
}
#endif

vec3 light(vec3 linear_color) {
#if BRIGHT
    float luma = luminance(linear_color);
    if (!isLight(luma)) return vec3(0.0);
    linear_color *= brightCurve(luma);
#if KARIS == KARIS_AVERAGE
    linear_color /= 1.0 + luma;
#endif
#endif
    return linear_color;
}

void main() {
    vec2 size = vec2(textureSize(source, 0));
    vec2 places[fetches], weights[fetches];
    weigh(uv * size, size / floor(0.5 * (size + 1.0)), places, weights);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < fetches; ++j)
        for (int i = 0; i < fetches; ++i)
            sum += light(texture(source, vec2(places[i].x, places[j].y) / size).rgb) * (weights[i].x * weights[j].y);
#if BRIGHT
    sum = bounded(sum);
#endif
    color = vec4(finite(sum), 1.0);
}
// end excerpt
