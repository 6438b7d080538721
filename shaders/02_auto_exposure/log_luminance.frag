#version 330 core
// The logarithm of every pixel's luminance, for glGenerateMipmap to average. REDUCTION says into which format.
#include "02_auto_exposure/log_luminance.glsl"

uniform sampler2D hdr;
#if REDUCTION == REDUCTION_MIPMAP_R16
uniform float white_point; // luminance, the upper end of the mapped range
#endif

out float log_luminance; // stops, or mapped to [0, 1]

void main() {
    float luma = luminance(texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb);
    // A mipmap has no way to leave a pixel out: an infinite one counts as the brightest half float, one that is not a
    // number as black.
    if (!isFinite(luma)) luma = luma > 0.0 ? 65504.0 : 0.0;
    log_luminance = logLuminance(luma);
#if REDUCTION == REDUCTION_MIPMAP_R16
    // excerpt: range
    float darkest = log2(epsilon);
    log_luminance = (log_luminance - darkest) / (log2(white_point) - darkest); // above 1, the format clamps
    // end excerpt
#endif
}
