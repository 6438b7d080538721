// The G-buffer in view space, for occlusion: right-handed, looking down -z.
#include "06_gbuffer/read_gbuffer.glsl"

uniform mat4 view_from_world;
#if !STORES_POSITION
uniform vec2 view_from_ndc; // view xy = ndc * this * -view z
#endif

const float background_view_z = -1.0e3; // beyond any far plane: what is as far is background

#if STORES_POSITION
float viewZAt(vec2 uv) {
    vec4 stored = positionAt(uv);
    float z = view_from_world[0].z * stored.x + view_from_world[1].z * stored.y + view_from_world[2].z * stored.z +
              view_from_world[3].z;
    return stored.w > 0.0 ? z : 2.0 * background_view_z;
}

vec3 viewPositionAt(vec2 uv) {
    vec4 stored = positionAt(uv);
    vec3 view_position = (view_from_world * vec4(stored.xyz, 1.0)).xyz;
    return stored.w > 0.0 ? view_position : vec3(0.0, 0.0, 2.0 * background_view_z);
}
#else
float viewZAt(vec2 uv) { return viewZAt(uv, 2.0 * background_view_z); }

vec3 viewPositionAt(vec2 uv) {
    float z = viewZAt(uv);
    return vec3((uv * 2.0 - 1.0) * view_from_ndc * -z, z);
}
#endif

vec3 viewNormalAt(vec2 uv) { return mat3(view_from_world) * normalAt(uv); }

// The normal of the surface itself, without its normal map, as geometricNormalAt() finds it where it is not stored; but
// the nearer neighbour is the one whose z is.
vec3 viewNormalFromDepth(vec2 uv, vec3 view_position) {
    vec2 texel = 1.0 / gbufferSize();
    vec3 left = view_position - viewPositionAt(uv - vec2(texel.x, 0.0));
    vec3 right = viewPositionAt(uv + vec2(texel.x, 0.0)) - view_position;
    vec3 below = view_position - viewPositionAt(uv - vec2(0.0, texel.y));
    vec3 above = viewPositionAt(uv + vec2(0.0, texel.y)) - view_position;
    // nothing is known beyond the screen's border
    bool by_left = uv.x > 1.0 - texel.x || (uv.x > texel.x && abs(left.z) < abs(right.z));
    bool by_below = uv.y > 1.0 - texel.y || (uv.y > texel.y && abs(below.z) < abs(above.z));
    return normalOf(by_left ? left : right, by_below ? below : above);
}

// The same where the G-buffer stores it.
vec3 viewGeometricNormalAt(vec2 uv, vec3 view_position) {
#if STORES_GEOMETRIC
    vec3 normal = mat3(view_from_world) * geometricNormalAt(uv, view_position);
    // at the rim of a triangle, derivatives may have been taken from beyond its plane's horizon
    return dot(normal, view_position) > 0.0 ? -normal : normal;
#else
    return viewNormalFromDepth(uv, view_position);
#endif
}
