#version 330 core
// A picture from a file in place of a rung's scene.
#include "lib/image.glsl"

out vec4 hdr_color; // linear

void main() { hdr_color = vec4(pictureColor(), 1.0); }
