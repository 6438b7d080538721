// A number in [0, 1) for each pixel, the same on every machine: integers, where the sine of a large number is not.

// excerpt: hash
// The permuted congruential generator as a hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
uint hashed(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float hashedUnit(ivec2 pixel) {
    return float(hashed(uint(pixel.x) + (uint(pixel.y) << 16u)) >> 8u) * (1.0 / 16777216.0);
}
// end excerpt
