#version 330 core
// Adds one sample to its bin.

flat in float stops;

out vec2 sample_sum; // r: number of samples; g: the sum of their log2 luminances

void main() { sample_sum = vec2(1.0, stops); }
