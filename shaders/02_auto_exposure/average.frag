#version 330 core
// One step down to the average: every texel is the mean over the part of the source that it covers, whatever the sizes.
#include "02_auto_exposure/is_finite.glsl"
#if FROM_LIGHT
#include "02_auto_exposure/log_luminance.glsl"
#endif

uniform sampler2D source;   // the HDR target where FROM_LIGHT is 1, else the step before
uniform ivec2 target_size;  // texels, at most the source's

out vec2 mean; // r: of the logarithms, counting those left out as 0; g: the share of pixels not left out

#if FROM_LIGHT
vec2 sourceAt(ivec2 texel) {
    float luma = luminance(texelFetch(source, texel, 0).rgb);
    return isFinite(luma) ? vec2(logLuminance(luma), 1.0) : vec2(0.0);
}
#else
vec2 sourceAt(ivec2 texel) {
    vec2 mean = texelFetch(source, texel, 0).rg;
    return isFinite(mean.r) && isFinite(mean.g) ? mean : vec2(0.0); // left out
}
#endif

// excerpt: average
// Along either axis, with lengths in whole numbers: a source texel is target_size long, a target texel source_size, so
// that both rows are equally long and overlaps are exact.
void main() {
    ivec2 source_size = textureSize(source, 0);
    ivec2 begin = ivec2(gl_FragCoord.xy) * source_size;
    ivec2 end = begin + source_size;
    ivec2 first = begin / target_size;
    ivec2 last = (end - 1) / target_size;
    mean = vec2(0.0);
    for (int y = first.y; y <= last.y; ++y) {
        int height = min(end.y, (y + 1) * target_size.y) - max(begin.y, y * target_size.y);
        vec2 row = vec2(0.0);
        for (int x = first.x; x <= last.x; ++x) {
            int width = min(end.x, (x + 1) * target_size.x) - max(begin.x, x * target_size.x);
            row += float(width) * sourceAt(ivec2(x, y));
        }
        mean += float(height) / float(source_size.y) * (row / float(source_size.x));
    }
}
// end excerpt
