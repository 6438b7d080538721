#version 330 core
// The last pass: scene light times the frame's own exposure, tone mapped, encoded.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"
#include "02_auto_exposure/is_finite.glsl"

uniform sampler2D hdr;
uniform sampler2D exposure; // 1x1; r: factor on scene light

out vec4 display_color; // encoded, [0, 1]

// excerpt: composite
void main() {
    vec3 linear_color = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb;
    float factor = texelFetch(exposure, ivec2(0), 0).r;
    if (!isFinite(factor)) factor = 1.0;
    vec3 relative_color = linear_color * factor;
    display_color = vec4(encode(toneMap(relative_color)), 1.0);
}
// end excerpt
