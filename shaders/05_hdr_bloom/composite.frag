#version 330 core
// Adds the bloom to the scene while both are still linear light, then tone maps and encodes the sum for a display.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

in vec2 uv;

uniform sampler2D hdr;
uniform float exposure; // factor on scene light
#if BLOOM
uniform sampler2D bloom;
uniform float intensity; // factor on the bloom
#endif

out vec4 display_color; // encoded, [0, 1]

// excerpt: composite
void main() {
    vec3 linear_color = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb;
#if BLOOM
    linear_color += texture(bloom, uv).rgb * intensity;
#endif
    display_color = vec4(encode(toneMap(linear_color * exposure)), 1.0);
}
// end excerpt
