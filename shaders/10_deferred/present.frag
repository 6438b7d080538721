#version 330 core
// Turns light into what a display is sent, over a gradient where there is nothing to light.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

uniform sampler2D lit_map; // linear; alpha 0: background
uniform float exposure;    // factor on scene light

in vec2 uv;
out vec4 display_color; // encoded, [0, 1]

// excerpt: present
void main() {
    const vec3 background_bottom = vec3(0.10, 0.10, 0.16); // encoded
    const vec3 background_top = vec3(0.34, 0.24, 0.26);
    vec4 lit = textureLod(lit_map, uv, 0.0);
    vec3 color = lit.a > 0.0 ? encode(toneMap(lit.rgb * exposure)) : mix(background_bottom, background_top, uv.y);
    display_color = vec4(color, 1.0);
}
// end excerpt
