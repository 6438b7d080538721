#version 330 core
// The environment itself, behind everything.
#include "09_environment_light/equirectangular.glsl"

in vec2 uv;

uniform sampler2D environment_map;
uniform mat4 world_from_clip;
uniform vec3 camera_position; // world

out vec4 hdr_color; // linear, [0, infinity)

void main() {
    vec4 far = world_from_clip * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 direction = normalize(far.xyz / far.w - camera_position);
    hdr_color = vec4(textureLod(environment_map, equirectangularUv(direction), 0.0).rgb, 1.0);
}
