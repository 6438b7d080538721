#version 330 core
// Puts the scene, which is modelled in world space, before the camera.
// Variants: VERTEX_COLOR, the mesh has colors; SEPARATE_MAPS, every image of the material has its own place.
#include "06_gbuffer/place_uv.glsl"

layout(location = 0) in vec3 vertex_position; // world
layout(location = 1) in vec3 vertex_normal;   // world, unit length
layout(location = 2) in vec2 vertex_uv;       // v = 0 is the top row of an image
#ifdef VERTEX_COLOR
layout(location = 3) in vec4 vertex_color; // linear, alpha: opacity
#endif
#ifdef SEPARATE_MAPS
layout(location = 4) in vec2 vertex_second_uv;
#endif

uniform mat4 clip_from_world;
uniform vec2 v_factor_offset; // turns v over where a model's runs the other way
#ifdef SEPARATE_MAPS
uniform mat3 base_transform; // see placedUv()
uniform mat3 occlusion_transform;
uniform mat3 normal_transform;
uniform mat3 roughness_transform;
uniform int base_uv_set;
uniform int occlusion_uv_set;
uniform int normal_uv_set;
uniform int roughness_uv_set;
#endif

out vec3 world_position;
out vec3 world_normal; // not unit length between vertices
out vec2 uv;           // the normal map's, where maps are separate
#ifdef VERTEX_COLOR
out vec4 color;
#endif
#ifdef SEPARATE_MAPS
out vec2 base_uv;
out vec2 occlusion_uv;
out vec2 roughness_uv;
#endif

vec2 turned(vec2 file_uv) { return vec2(file_uv.x, file_uv.y * v_factor_offset.x + v_factor_offset.y); }

void main() {
    world_position = vertex_position;
    world_normal = vertex_normal;
#ifdef VERTEX_COLOR
    color = vertex_color;
#endif
#ifdef SEPARATE_MAPS
    vec2 first = turned(vertex_uv);
    vec2 second = turned(vertex_second_uv);
    uv = placedUv(first, second, normal_uv_set, normal_transform);
    base_uv = placedUv(first, second, base_uv_set, base_transform);
    occlusion_uv = placedUv(first, second, occlusion_uv_set, occlusion_transform);
    roughness_uv = placedUv(first, second, roughness_uv_set, roughness_transform);
#else
    uv = turned(vertex_uv);
#endif
    gl_Position = clip_from_world * vec4(vertex_position, 1.0);
}
