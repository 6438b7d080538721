#version 330 core
// In place of the scene: frames whose average is known.

uniform int pattern; // PATTERN_*
uniform float light; // factor
uniform ivec2 size;  // of the frame

out vec4 hdr_color;

const int PATTERN_BLACK = 1;
const int PATTERN_FLAT = 2;
const int PATTERN_CHECKERBOARD = 3;
const int PATTERN_ONE_HOT = 4;
const int PATTERN_RAMP = 5;

float brightness(ivec2 pixel) {
    if (pattern == PATTERN_FLAT) return 0.18;
    if (pattern == PATTERN_CHECKERBOARD) return float((pixel.x + pixel.y) & 1);
    if (pattern == PATTERN_ONE_HOT) return pixel == size / 2 ? 1000.0 : 0.0;
    if (pattern == PATTERN_RAMP) return exp2(-12.0 + 16.0 * (float(pixel.x) + 0.5) / float(size.x));
    return 0.0;
}

void main() { hdr_color = vec4(vec3(light * brightness(ivec2(gl_FragCoord.xy))), 1.0); }
