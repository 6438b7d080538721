// Where the samples of a pixel's occlusion begin.
#include "lib/noise.glsl"

// excerpt: noise
// By which part of a full turn the samples of this pixel are turned.
float turnOf(ivec2 pixel) {
#if SSAO == SSAO_SEED
    return hashedUnit(pixel);
#else
    // Sixteen turns in a 4 x 4 pattern, so that the blur, 4 pixels wide, meets each of them once. Neighbours differ by
    // much: the digits of x and x ^ y are taken in reverse order, as in a Bayer matrix.
    int x = pixel.x & 3;
    int y = (pixel.x ^ pixel.y) & 3;
    int rank = ((y & 1) << 3) | ((x & 1) << 2) | (y & 2) | (x >> 1);
    return (float(rank) + 0.5) * (1.0 / 16.0);
#endif
}
// end excerpt
