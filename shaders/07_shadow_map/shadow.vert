#version 330 core
// The scene as the sun sees it: depth alone. Variants: ALPHA_MASK, for materials with holes, and VERTEX_COLOR, where
// the mesh's colors add to them.
#include "06_gbuffer/place_uv.glsl"

layout(location = 0) in vec3 world_position;
#ifdef ALPHA_MASK
layout(location = 2) in vec2 vertex_uv;
#ifdef VERTEX_COLOR
layout(location = 3) in vec4 vertex_color; // alpha: opacity
#endif
layout(location = 4) in vec2 vertex_second_uv;
#endif

uniform mat4 light_clip_from_world;
#ifdef ALPHA_MASK
uniform vec2 v_factor_offset; // as in geometry.vert, of which this is a part
uniform mat3 base_transform;
uniform int base_uv_set;

out vec2 base_uv;
out float vertex_opacity;

vec2 turned(vec2 file_uv) { return vec2(file_uv.x, file_uv.y * v_factor_offset.x + v_factor_offset.y); }
#endif

void main() {
#ifdef ALPHA_MASK
    base_uv = placedUv(turned(vertex_uv), turned(vertex_second_uv), base_uv_set, base_transform);
#ifdef VERTEX_COLOR
    vertex_opacity = vertex_color.a;
#else
    vertex_opacity = 1.0;
#endif
#endif
    gl_Position = light_clip_from_world * vec4(world_position, 1.0);
}
