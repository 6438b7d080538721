#version 330 core
// The swarm: each cube breathes and spins by its own phase. What is the same over a face is lit here, once a vertex.

layout(location = 0) in vec3 cube_position; // [-0.5, 0.5]
layout(location = 1) in vec3 cube_normal;
layout(location = 2) in vec3 instance_offset; // world units
layout(location = 3) in vec3 instance_color;  // linear, [0, 1]
layout(location = 4) in float instance_phase; // [0, 1)
layout(location = 5) in float instance_glows; // 0 or 1

uniform mat4 clip_from_world;
uniform vec3 camera_position; // world
uniform float time_s;
uniform float emissive_boost; // how many times brighter a glowing cube is

out vec3 to_camera;          // world, not normalised
flat out float facing;       // to_camera along the face's normal: the same all over the face
flat out vec3 lit_color;     // key and ambient light, linear
flat out float boost;        // factor on all light of this cube

const float two_pi = 6.2832;
const vec3 to_key_light = normalize(vec3(0.5, 1.0, 0.3));
const float key_intensity = 0.7;
const float ambient_intensity = 0.25;

// excerpt: scene_vertex
void main() {
    float size = 0.7 + 0.2 * sin(time_s * 1.5 + instance_phase * two_pi);
    float spin_rad = time_s * 0.25 + instance_phase * two_pi;
    float c = cos(spin_rad);
    float s = sin(spin_rad);
    mat3 spin = mat3(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c);

    vec3 world_position = spin * (cube_position * size) + instance_offset;
    vec3 world_normal = spin * cube_normal;
    gl_Position = clip_from_world * vec4(world_position, 1.0);
    to_camera = camera_position - world_position;
    facing = dot(world_normal, to_camera);

    float light = ambient_intensity + key_intensity * max(dot(world_normal, to_key_light), 0.0);
    boost = mix(1.0, emissive_boost, instance_glows);
    lit_color = instance_color * light;
}
// end excerpt
