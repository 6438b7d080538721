#version 330 core
// One direction of a blur: a few fetches on both sides of the pixel, weighed and added. Every method of the rung is
// this shader with other taps.
#include "lib/finite.glsl"

in vec2 uv;

uniform sampler2D source;
uniform vec2 uv_step;         // one texel of the target, along the direction
uniform float offsets[TAPS];  // in such steps; the first is 0
uniform float weights[TAPS];  // the first once and the others twice make 1

out vec4 color;

// excerpt: blur
void main() {
    vec3 sum = texture(source, uv).rgb * weights[0];
    for (int i = 1; i < TAPS; ++i) {
        vec2 away = uv_step * offsets[i];
        sum += (texture(source, uv + away).rgb + texture(source, uv - away).rgb) * weights[i];
    }
    color = vec4(finite(sum), 1.0);
}
// end excerpt
