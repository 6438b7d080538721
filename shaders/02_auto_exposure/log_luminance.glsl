// The logarithm that the average is taken of, and which pixels have none.
#include "02_auto_exposure/is_finite.glsl"
#include "lib/luminance.glsl"

uniform float epsilon; // luminance, > 0: keeps the logarithm of black finite

// excerpt: log_luminance
// Stops relative to luminance 1. What is darker than black counts as black.
float logLuminance(float luma) { return log2(epsilon + max(luma, 0.0)); }
// end excerpt
