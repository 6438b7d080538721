// Two targets from one pass: the scene's light, and what of it is bright enough to bloom. BRIGHT_CHANNELS: rgb, or as
// printed rbg.
#include "lib/luminance.glsl"

uniform float threshold; // luminance
layout(location = 0) out vec4 hdr_color;    // linear, [0, 65504]
layout(location = 1) out vec4 bright_color; // the same where it is bright, else black

// excerpt: bright_pass
bool isBright(float luma) {
#if BRIGHT_PASS == BRIGHT_PASS_FIXED
    return luma > threshold;
#elif BRIGHT_PASS == BRIGHT_PASS_WHITE_POINT
    return luma >= threshold;
#endif
}

void writeTargets(vec3 color) {
    hdr_color = vec4(min(color, 65504.0), 1.0);
    bright_color = vec4(isBright(luminance(color)) ? hdr_color.BRIGHT_CHANNELS : vec3(0.0), 1.0);
}
// end excerpt
