#version 330 core
// One small triangle a sample, over the texel of the sample's bin: blending then does the counting.
#include "02_auto_exposure/histogram.glsl"
#include "02_auto_exposure/log_luminance.glsl"

uniform sampler2D hdr;
uniform ivec2 grid; // samples along either axis, at most the target's size

flat out float stops; // log2 luminance

// excerpt: scatter
void main() {
    ivec2 cell = ivec2(gl_InstanceID % grid.x, gl_InstanceID / grid.x);
    ivec2 texel = (2 * cell + 1) * textureSize(hdr, 0) / (2 * grid); // the middle of the cell
    float luma = luminance(texelFetch(hdr, texel, 0).rgb);
    stops = isFinite(luma) ? logLuminance(luma) : 0.0;
    float bin = clamp(floor(binOf(stops)), 0.0, float(bins - 1));
    // At the row's middle the triangle reaches from the bin's left edge 1.2 texels to the right: over one centre.
    vec2 corner = vec2(bin + (gl_VertexID == 1 ? 1.6 : 0.0), gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(corner * vec2(2.0 / float(bins), 2.0) - 1.0, 0.0, 1.0);
    if (!isFinite(luma)) gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // out of sight: left out
}
// end excerpt
