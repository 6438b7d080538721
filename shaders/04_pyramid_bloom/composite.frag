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
    color = vec4(original.rgb + finite(texture(bloom, uv).rgb) * strength, original.a);
}
// end excerpt
