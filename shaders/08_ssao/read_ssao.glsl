// What is left of the light from all round, for the pass that lights.

#if SSAO != SSAO_OFF
uniform sampler2D ssao_map; // r: [0, 1]; at half resolution also g: view z
#if SSAO_RESOLUTION == SSAO_RESOLUTION_HALF
#include "08_ssao/same_surface.glsl"
uniform vec4 view_z_from_world; // of a world position, w 1
#endif
#endif

// excerpt: upsample
// uv: of the pixel that is drawn; world_position: there
#if SSAO == SSAO_OFF
float visibilityAt(vec2 uv, vec3 world_position) { return 1.0; }
#elif SSAO_RESOLUTION == SSAO_RESOLUTION_FULL
float visibilityAt(vec2 uv, vec3 world_position) { return textureLod(ssao_map, uv, 0.0).r; }
#else
// Every second pixel has its own; those between take the mean of two neighbours, across, up or along a diagonal, or only
// one where the other shows another surface.
float visibilityAt(vec2 uv, vec3 world_position) {
    float view_z = dot(view_z_from_world, vec4(world_position, 1.0));
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 texel = 1.0 / vec2(textureSize(ssao_map, 0));
    vec2 low = (vec2(pixel >> 1) + 0.5) * texel;
    vec2 one = textureLod(ssao_map, low, 0.0).rg;
    vec2 other = textureLod(ssao_map, low + vec2(pixel & 1) * texel, 0.0).rg;
    float one_weight = sameSurface(view_z, one.g) + 1e-3; // where neither is near, both count alike
    float other_weight = sameSurface(view_z, other.g) + 1e-3;
    return (one_weight * one.r + other_weight * other.r) / (one_weight + other_weight);
}
#endif
// end excerpt

// excerpt: multi_bounce
// What reaches a corner from the surfaces round it, if those have its color: a cubic that Jimenez et al. 2016 fitted to
// path tracing. Bright colors are shaded less, and take their own hue.
vec3 visibilityOfColor(float visibility, vec3 albedo) {
#if SSAO_MULTI_BOUNCE
    vec3 a = 2.0404 * albedo - 0.3324;
    vec3 b = -4.7951 * albedo + 0.6417;
    vec3 c = 2.7552 * albedo + 0.6903;
    return max(vec3(visibility), ((visibility * a + b) * visibility + c) * visibility);
#else
    return vec3(visibility);
#endif
}
// end excerpt
