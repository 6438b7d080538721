#version 330 core
// Halves an image, rounded up, under a B-spline whose weights are areas: each texel counts by the part of the spline that
// lies over it. Splines side by side add up to 1 everywhere, so every texel hands on all of its light, at any size; and a
// pixel's weights add up to 1, so a flat field stays flat (the argument is Unser 1999, "Splines: A Perfect Fit for Signal
// and Image Processing"). The bright pass is the same with the linear spline and the bright curve.
#include "lib/finite.glsl"
#if BRIGHT
#include "04_pyramid_bloom/bright_curve.glsl"
#endif

in vec2 uv;

uniform sampler2D source; // mirrored at its edges, bilinear

out vec4 color; // linear

// excerpt: spline
// DEGREE 1: the linear spline; 3: the cubic one. Two texels share a bilinear fetch; EXACT: the source is exactly twice as
// large in either direction, so that the weights are the same for all pixels: [1 3 3 1] / 8 and
// [1 15 61 115 115 61 15 1] / 384.
#if EXACT && DEGREE == 1
const int fetches = 2;
void weigh(float centre, float ratio, out float places[fetches], out float weights[fetches]) {
    places = float[](centre - 0.75, centre + 0.75);
    weights = float[](0.5, 0.5);
}
#elif EXACT
const int fetches = 4;
void weigh(float centre, float ratio, out float places[fetches], out float weights[fetches]) {
    const float near = 1.5 - 115.0 / 176.0;
    const float far = 3.5 - 15.0 / 16.0;
    places = float[](centre - far, centre - near, centre + near, centre + far);
    weights = float[](16.0 / 384.0, 176.0 / 384.0, 176.0 / 384.0, 16.0 / 384.0);
}
#else
const int fetches = DEGREE == 1 ? 3 : 5;

// The part of the spline's area that lies left of x.
float areaBelow(float x) {
    float outer = max(0.5 * float(DEGREE + 1) - abs(x), 0.0);
#if DEGREE == 1
    float tail = 0.5 * outer * outer;
#else
    float inner = max(1.0 - abs(x), 0.0);
    float tail = (outer * outer * outer * outer - 4.0 * inner * inner * inner * inner) / 24.0;
#endif
    return x < 0.0 ? tail : 1.0 - tail;
}

// centre and places in texels of the source; ratio: texels to a pixel, at most 2.
void weigh(float centre, float ratio, out float places[fetches], out float weights[fetches]) {
    float texel = floor(centre - 0.5 * float(DEGREE + 1) * ratio);
    float area = areaBelow((texel - centre) / ratio);
    for (int i = 0; i < fetches; ++i) {
        float middle_area = areaBelow((texel + 1.0 - centre) / ratio);
        float next_area = areaBelow((texel + 2.0 - centre) / ratio);
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
    vec2 ratio = size / floor(0.5 * (size + 1.0));
    vec2 centre = uv * size;
    float places_x[fetches], weights_x[fetches], places_y[fetches], weights_y[fetches];
    weigh(centre.x, ratio.x, places_x, weights_x);
    weigh(centre.y, ratio.y, places_y, weights_y);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < fetches; ++j)
        for (int i = 0; i < fetches; ++i)
            sum += light(texture(source, vec2(places_x[i], places_y[j]) / size).rgb) * (weights_x[i] * weights_y[j]);
#if BRIGHT
    sum = bounded(sum);
#endif
    color = vec4(finite(sum), 1.0);
}
// end excerpt
