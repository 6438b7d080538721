// The logarithm that the average is taken of, and which pixels have none.
#include "lib/luminance.glsl"

uniform float epsilon; // luminance, > 0: keeps the logarithm of black finite

// Nothing compares with not-a-number, so that this is false for it, as for the infinities.
bool isFinite(float x) { return x > -3.0e38 && x < 3.0e38; }

// excerpt: log_luminance
// Stops relative to luminance 1. What is darker than black counts as black.
float logLuminance(float luma) { return log2(epsilon + max(luma, 0.0)); }
// end excerpt
