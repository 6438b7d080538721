#version 330 core
// A picture from a file in place of the street, and what of it is bright enough to bloom.
#include "lib/image.glsl"
#include "03_gaussian_bloom/bright_pass.glsl"

void main() { writeTargets(pictureColor()); }
