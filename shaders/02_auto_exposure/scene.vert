#version 330 core
// Court and hall: already in world space.

layout(location = 0) in vec3 position; // world, metres
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo; // linear, or what a light emits
layout(location = 3) in float surface;

uniform mat4 clip_from_world;

out vec3 world_position;
out vec3 world_normal;
flat out vec3 base_color;
flat out int surface_kind;

void main() {
    world_position = position;
    world_normal = normal;
    base_color = albedo;
    surface_kind = int(surface);
    gl_Position = clip_from_world * vec4(position, 1.0);
}
