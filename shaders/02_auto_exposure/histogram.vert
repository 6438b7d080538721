#version 330 core
// One small triangle a sample, over the texel of the sample's bin: blending then does the counting.
#include "02_auto_exposure/histogram.glsl"
#include "02_auto_exposure/log_luminance.glsl"

uniform sampler2D hdr;
uniform ivec2 grid; // samples along either axis, at most the target's size

flat out float stops; // log2 luminance

// excerpt: scatter
// Where in its cell a sample is taken: anywhere, but always the same. At even steps a fine regular pattern would show
// only one of its sides.
vec2 scattered(int i) {
    uint h = uint(i) * 0x9E3779B1u;
    h = (h ^ (h >> 15)) * 0x85EBCA77u;
    h = (h ^ (h >> 13)) * 0xC2B2AE3Du;
    return vec2(h & 0xFFFFu, h >> 16) / 65536.0; // [0, 1)
}

void main() {
    ivec2 cell = ivec2(gl_InstanceID % grid.x, gl_InstanceID / grid.x);
    ivec2 first = cell * textureSize(hdr, 0) / grid;
    ivec2 next = (cell + 1) * textureSize(hdr, 0) / grid;
    ivec2 texel = first + ivec2(scattered(gl_InstanceID) * vec2(next - first));
    float luma = luminance(texelFetch(hdr, texel, 0).rgb);
    stops = isFinite(luma) ? logLuminance(luma) : 0.0;
    float bin = clamp(floor(binOf(stops)), 0.0, float(bins - 1));
    // At the row's middle the triangle reaches from the bin's left edge 1.2 texels to the right: over one centre.
    vec2 corner = vec2(bin + (gl_VertexID == 1 ? 1.6 : 0.0), gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(corner * vec2(2.0 / float(bins), 2.0) - 1.0, 0.0, 1.0);
    if (!isFinite(luma)) gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // out of sight: left out
}
// end excerpt
