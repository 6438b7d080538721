// What differs from pixel to pixel, so that few samples show noise and no bands.
#include "lib/noise.glsl"

#if SSAO_NOISE == SSAO_NOISE_HILBERT
uniform sampler2D ssao_noise_map; // two numbers in [0, 1) for each cell of a square, see ssao.cpp
#endif

// excerpt: noise
// x: by which part of a full turn the samples of this pixel are turned; y: at which part of a step they begin.
vec2 noiseOf(ivec2 pixel) {
#if SSAO_NOISE == SSAO_NOISE_HASH
    float turn = hashedUnit(pixel);
    return vec2(turn, fract(turn * 4096.0)); // 24 bits are enough for both
#elif SSAO_NOISE == SSAO_NOISE_INTERLEAVED
    // Sixteen turns in a 4 x 4 pattern, so that a blur that is 4 pixels wide meets each of them once. Neighbours differ
    // by much: the digits of x and x ^ y are taken in reverse order, as in a Bayer matrix.
    int x = pixel.x & 3;
    int y = (pixel.x ^ pixel.y) & 3;
    int rank = ((y & 1) << 3) | ((x & 1) << 2) | (y & 2) | (x >> 1);
    float turn = (float(rank) + 0.5) * (1.0 / 16.0);
    return vec2(turn, fract(turn * 7.0 + 0.5));
#elif SSAO_NOISE == SSAO_NOISE_HILBERT
    return texelFetch(ssao_noise_map, pixel & (textureSize(ssao_noise_map, 0) - 1), 0).rg;
#else
#error
#endif
}
// end excerpt
