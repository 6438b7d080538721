#version 330 core
// How much of the sun every pixel sees, and nothing else.
#include "06_gbuffer/read_gbuffer.glsl"
#include "07_shadow_map/shadow.glsl"

in vec2 uv;

uniform vec3 to_sun; // world, unit length

out float visible; // [0, 1]; 1 where there is nothing

// excerpt: sun
void main() {
    vec4 position = positionAt(uv);
#if BIAS_BY_GEOMETRY
    vec3 normal = geometricNormalAt(uv, position.xyz);
#else
    vec3 normal = normalAt(uv);
#endif
    visible = position.w == 0.0 ? 1.0 : sunVisible(position.xyz, normal, to_sun);
}
// end excerpt
