#version 330 core
// The street and its mirror image below the ground.

layout(location = 0) in vec3 position; // world, metres
layout(location = 1) in vec3 normal;   // of the mirrored half as before mirroring
layout(location = 2) in vec3 albedo;
layout(location = 3) in vec3 emission; // linear
layout(location = 4) in float pulses;  // 0 or 1

uniform mat4 clip_from_world;
uniform float pulse; // factor on the light of what pulses

out vec3 world_position;
flat out vec3 world_normal;
flat out vec3 surface_albedo;
out vec3 emitted_color;

void main() {
    world_position = position;
    world_normal = normal;
    surface_albedo = albedo;
    emitted_color = emission * mix(1.0, pulse, pulses);
    gl_Position = clip_from_world * vec4(position, 1.0);
}
