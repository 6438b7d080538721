#version 330 core
// A square through each ball's middle, facing the camera, a little larger than the ball is seen.

layout(location = 0) in vec2 corner; // [-1, 1]
layout(location = 1) in vec3 ball_middle;
layout(location = 2) in float ball_roughness;
layout(location = 3) in vec3 ball_f0;
layout(location = 4) in vec3 ball_albedo;

uniform mat4 clip_from_world;
uniform vec3 camera_position; // world

out vec3 world_position;
flat out vec3 middle; // world
flat out float roughness;
flat out vec3 f0;
flat out vec3 albedo;

void main() {
    const float half_width = 0.52; // the radius, and what perspective adds from four units on
    vec3 to_camera = normalize(camera_position - ball_middle);
    vec3 across = normalize(cross(vec3(0.0, 1.0, 0.0), to_camera));
    vec3 up = cross(to_camera, across);
    world_position = ball_middle + half_width * (corner.x * across + corner.y * up);
    gl_Position = clip_from_world * vec4(world_position, 1.0);
    middle = ball_middle;
    roughness = ball_roughness;
    f0 = ball_f0;
    albedo = ball_albedo;
}
