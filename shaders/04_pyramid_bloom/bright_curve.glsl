// What counts as bright, for every bright pass.
#include "lib/luminance.glsl"

uniform float threshold; // luminance
uniform float knee;      // half the width of the soft step about the threshold, luminance, >= 0

// So many levels of this may be added before a half float overflows: 65504 / 8.
const float brightest_level = 8188.0;
const float largest_float = 3.402823e38;

// One infinite value, or one that is no number, would spread over the whole pyramid. Such count as dark, and so do
// negative ones.
bool isLight(float luma) {
#ifdef UNGUARDED
    return true;
#else
    return luma >= 0.0 && luma <= largest_float;
#endif
}

// What a level may hold.
vec3 bounded(vec3 linear_color) {
#ifdef UNGUARDED
    return linear_color;
#else
    return min(linear_color, brightest_level);
#endif
}

// excerpt: bright_curve
// 0 well below the threshold, 1 well above, a Hermite step between; a hard step where there is no knee.
float brightCurve(float luma) {
    if (knee <= 0.0) return luma > threshold ? 1.0 : 0.0;
    float t = clamp((luma - threshold + knee) / (2.0 * knee), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
// end excerpt
