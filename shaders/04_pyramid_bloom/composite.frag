#version 330 core
// Adds the glow to the picture it came from. Light adds up, so both are still linear here.
#include "lib/finite.glsl"

in vec2 uv;

uniform sampler2D source; // of the target's size
uniform sampler2D bloom;  // of any size
uniform float strength;   // factor on the bloom, >= 0

out vec4 color;

// excerpt: composite
void main() {
    vec4 original = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
    vec3 lit = original.rgb + finite(texture(bloom, uv).rgb) * strength;
#ifndef UNGUARDED
    // Not-a-number is not greater than 0. More than the largest half float would be stored as infinite.
    lit = min(mix(vec3(0.0), lit, greaterThan(lit, vec3(0.0))), 65504.0);
#endif
    color = vec4(lit, original.a);
}
// end excerpt
