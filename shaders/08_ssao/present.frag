#version 330 core
// The picture, or how much of the sky's light arrives, which is no light to tone map.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

in vec2 uv;

uniform sampler2D lit_map; // linear
uniform float exposure;    // factor on scene light

out vec4 display_color; // encoded, [0, 1]

void main() {
    vec3 lit = textureLod(lit_map, uv, 0.0).rgb;
#if VIEW == VIEW_VISIBILITY
    display_color = vec4(encode(lit), 1.0);
#else
    display_color = vec4(encode(toneMap(lit * exposure)), 1.0);
#endif
}
