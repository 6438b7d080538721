#version 330 core
// The end of every reduction: one number, the log2 of the average luminance.
#include "02_auto_exposure/histogram.glsl"
#include "02_auto_exposure/is_finite.glsl"

uniform sampler2D source; // the luminance mipmap, the last average, or the histogram
uniform float epsilon;    // luminance, > 0
#if REDUCTION == REDUCTION_MIPMAP_R16 || REDUCTION == REDUCTION_MIPMAP_R16F
uniform int last_level;
#endif
#if REDUCTION == REDUCTION_MIPMAP_R16
uniform float white_point; // luminance
#endif
#if REDUCTION == REDUCTION_HISTOGRAM
uniform float low_share; // of the samples, from the dark end, that do not count; [0, 0.5]
uniform float high_share; // where those at the bright end begin that do not count; [0.5, 1]
#endif

out float log_average; // stops

#if REDUCTION == REDUCTION_HISTOGRAM
// excerpt: trimmed_mean
vec2 binAt(int i) {
    vec2 bin = texelFetch(source, ivec2(i, 0), 0).rg;
    return isFinite(bin.r) && isFinite(bin.g) ? bin : vec2(0.0);
}

float metered() {
    float total = 0.0;
    for (int i = 0; i < bins; ++i) total += binAt(i).r;
    float low = low_share * total;
    float high = max(high_share * total, low + 0.001 * total); // both at the median: a sliver about it
    float below = 0.0; // samples in darker bins
    float sum = 0.0;
    float counted = 0.0;
    for (int i = 0; i < bins; ++i) {
        vec2 bin = binAt(i);
        float share = max(min(below + bin.r, high) - max(below, low), 0.0); // of this bin's samples, those that count
        if (share > 0.0) sum += share * bin.g / bin.r;
        counted += share;
        below += bin.r;
    }
    return counted > 0.0 ? sum / counted : log2(epsilon);
}
// end excerpt
#elif REDUCTION == REDUCTION_AREA
// Where every pixel is left out, the frame counts as black. Where the mean is no number, so is what is metered, and the eye
// stays as it was.
float metered() {
    vec2 mean = texelFetch(source, ivec2(0), 0).rg;
    return mean.g == 0.0 ? log2(epsilon) : mean.r / mean.g;
}
#elif REDUCTION == REDUCTION_MIPMAP_R16
float metered() {
    return mix(log2(epsilon), log2(white_point), texelFetch(source, ivec2(0), last_level).r);
}
#else
float metered() { return texelFetch(source, ivec2(0), last_level).r; }
#endif

void main() { log_average = metered(); }
