#version 330 core
// The last pass of most rungs: scene light, with bloom added where there is some, exposed, tone mapped, encoded.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"
#if BLOOM
#include "lib/finite.glsl"
#endif

in vec2 uv;

uniform sampler2D hdr;
uniform float exposure; // factor on scene light
#if BLOOM
uniform sampler2D bloom; // of any size
uniform float intensity; // factor on the bloom
#endif

out vec4 display_color; // encoded, [0, 1]

// excerpt: present
void main() {
    vec3 linear_color = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb;
#if BLOOM
    linear_color += finite(texture(bloom, uv).rgb) * intensity;
#endif
    display_color = vec4(encode(toneMap(linear_color * exposure)), 1.0);
}
// end excerpt
