#version 330 core
// How far two pictures are apart, of the values that a display is sent, times a factor.

uniform sampler2D one;
uniform sampler2D other;
uniform float factor;

out vec4 display_color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    display_color = vec4(abs(texelFetch(one, pixel, 0).rgb - texelFetch(other, pixel, 0).rgb) * factor, 1.0);
}
