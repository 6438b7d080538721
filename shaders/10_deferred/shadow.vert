#version 330 core
// The scene as the sun sees it: depth alone.

layout(location = 0) in vec3 world_position;

uniform mat4 light_clip_from_world;

void main() { gl_Position = light_clip_from_world * vec4(world_position, 1.0); }
