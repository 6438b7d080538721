#version 330 core
// Puts the scene, which is modelled in world space, before the camera.

layout(location = 0) in vec3 vertex_position; // world
layout(location = 1) in vec3 vertex_normal;   // world, unit length
layout(location = 2) in vec2 vertex_uv;       // v = 0 is the top row of an image

uniform mat4 clip_from_world;
uniform vec2 v_factor_offset; // turns v over where a model's runs the other way

out vec3 world_position;
out vec3 world_normal; // not unit length between vertices
out vec2 uv;

void main() {
    world_position = vertex_position;
    world_normal = vertex_normal;
    uv = vec2(vertex_uv.x, vertex_uv.y * v_factor_offset.x + v_factor_offset.y);
    gl_Position = clip_from_world * vec4(vertex_position, 1.0);
}
