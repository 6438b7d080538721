#version 330 core
// One direction of a Gaussian, in TAPS pairs of bilinear fetches about the centre (see blurTaps()).
#include "lib/finite.glsl"

in vec2 uv;

uniform sampler2D source;
uniform vec2 direction;      // one texel of the source in the direction of the blur, in uv
uniform float centre_weight; // with both halves of every pair, the weights add up to 1
uniform float offsets[TAPS]; // of a pair, in times of direction
uniform float weights[TAPS]; // of either half

out vec4 color;

// excerpt: blur
void main() {
    vec3 sum = centre_weight * texture(source, uv).rgb;
    for (int i = 0; i < TAPS; ++i) {
        vec2 offset = offsets[i] * direction;
        sum += weights[i] * (texture(source, uv - offset).rgb + texture(source, uv + offset).rgb);
    }
    color = vec4(finite(sum), 1.0);
}
// end excerpt
