// A number in [0, 1) for each pixel, the same on every machine: integers, where the sine of a large number is not.

// excerpt: noise
// The permuted congruential generator as a hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
uint hashed(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// By which part of a full turn the samples of this pixel are turned.
float turnOf(ivec2 pixel) {
#if SSAO == SSAO_SEED
    return float(hashed(uint(pixel.x) + (uint(pixel.y) << 16u)) >> 8u) * (1.0 / 16777216.0);
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
