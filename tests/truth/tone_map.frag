#version 330 core
// One tone map, and the display's encoding behind it where ENCODED is 1, of every texel: for the truth test.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

uniform sampler2D scene_color; // linear

out vec4 display_color;

void main() {
    vec3 color = toneMap(texelFetch(scene_color, ivec2(gl_FragCoord.xy), 0).rgb);
#if ENCODED
    color = encode(color);
#endif
    display_color = vec4(color, 1.0);
}
