#version 330 core
// Boxes in world space.

layout(location = 0) in vec3 box_position; // world
layout(location = 1) in vec3 box_normal;
layout(location = 2) in vec3 box_color; // linear
layout(location = 3) in float box_glow;

uniform mat4 clip_from_world;

out vec3 world_position;
flat out vec3 world_normal;
flat out vec3 color;
flat out float glow;

void main() {
    gl_Position = clip_from_world * vec4(box_position, 1.0);
    world_position = box_position;
    world_normal = box_normal;
    color = box_color;
    glow = box_glow;
}
