// The G-buffer in view space, for occlusion: right-handed, looking down -z.
#include "06_gbuffer/gbuffer.glsl"

uniform mat4 view_from_world;
#if IS_PACKED
uniform sampler2D packed_map;
vec2 gbufferSize() { return vec2(textureSize(packed_map, 0)); }
#else
uniform sampler2D normal_map;
vec2 gbufferSize() { return vec2(textureSize(normal_map, 0)); }
#endif
#if STORES_POSITION
uniform sampler2D position_map;
#else
#if STORES_VIEW_Z
uniform sampler2D view_z_map;
#else
uniform sampler2D depth_map;
uniform vec2 view_z_from_depth; // view z = x / (depth + y)
#endif
uniform vec2 view_from_ndc;     // view xy = ndc * this * -view z
#endif

#if STORES_GEOMETRIC
uniform sampler2D geometric_map;
#endif

const float background_view_z = -1.0e3; // beyond any far plane: what is as far is background

#if STORES_POSITION
float viewZAt(vec2 uv) {
    vec4 stored = textureLod(position_map, uv, 0.0);
    float z = view_from_world[0].z * stored.x + view_from_world[1].z * stored.y + view_from_world[2].z * stored.z +
              view_from_world[3].z;
    return stored.w > 0.0 ? z : 2.0 * background_view_z;
}

vec3 viewPositionAt(vec2 uv) {
    vec4 stored = textureLod(position_map, uv, 0.0);
    vec3 view_position = (view_from_world * vec4(stored.xyz, 1.0)).xyz;
    return stored.w > 0.0 ? view_position : vec3(0.0, 0.0, 2.0 * background_view_z);
}
#else
#if STORES_VIEW_Z
float viewZAt(vec2 uv) {
    float z = textureLod(view_z_map, uv, 0.0).r;
    return z < 0.0 ? z : 2.0 * background_view_z;
}
#else
float viewZAt(vec2 uv) {
    float depth = textureLod(depth_map, uv, 0.0).r;
    return depth < 1.0 ? view_z_from_depth.x / (depth + view_z_from_depth.y) : 2.0 * background_view_z;
}
#endif

vec3 viewPositionAt(vec2 uv) {
    float z = viewZAt(uv);
    return vec3((uv * 2.0 - 1.0) * view_from_ndc * -z, z);
}
#endif

vec3 viewNormalAt(vec2 uv) {
#if IS_PACKED
    return mat3(view_from_world) * packedNormal(wordsOf(textureLod(packed_map, uv, 0.0)));
#else
    return mat3(view_from_world) * unpackNormal(textureLod(normal_map, uv, 0.0));
#endif
}

// The normal of the surface itself, without its normal map, from the positions beside it: see read_gbuffer.glsl.
vec3 viewNormalFromDepth(vec2 uv, vec3 view_position) {
    vec2 texel = 1.0 / gbufferSize();
    vec3 left = view_position - viewPositionAt(uv - vec2(texel.x, 0.0));
    vec3 right = viewPositionAt(uv + vec2(texel.x, 0.0)) - view_position;
    vec3 below = view_position - viewPositionAt(uv - vec2(0.0, texel.y));
    vec3 above = viewPositionAt(uv + vec2(0.0, texel.y)) - view_position;
    vec3 across = abs(left.z) < abs(right.z) ? left : right;
    vec3 up = abs(below.z) < abs(above.z) ? below : above;
    vec3 normal = cross(across, up); // towards the camera, as x, y and it are right-handed
    return normal * inversesqrt(max(dot(normal, normal), 1e-30));
}

// The same where the G-buffer stores it.
vec3 viewGeometricNormalAt(vec2 uv, vec3 view_position) {
#if STORES_GEOMETRIC
    return mat3(view_from_world) * directionFromOctahedral(textureLod(geometric_map, uv, 0.0).rg);
#else
    return viewNormalFromDepth(uv, view_position);
#endif
}
