#version 330 core
// Boxes along the world's axes.

layout(location = 0) in vec3 corner; // [-1, 1]
layout(location = 1) in vec3 box_normal;
layout(location = 2) in vec3 box_centre;    // world, metres
layout(location = 3) in vec3 box_half_size; // metres
layout(location = 4) in float box_windows;  // seed of its windows; 0: none, -1: floodlit

uniform mat4 clip_from_world;
uniform vec3 camera_position; // world, metres

out vec3 world_position;
out float clear; // share of the wall's own colour; the rest is haze
flat out vec3 world_normal;
flat out float windows;

const float haze_m = 260.0; // where 63 % of a wall's colour are haze

void main() {
    world_position = box_centre + corner * box_half_size;
    world_normal = box_normal;
    windows = box_windows;
    clear = exp(-distance(world_position, camera_position) / haze_m);
    gl_Position = clip_from_world * vec4(world_position, 1.0);
}
