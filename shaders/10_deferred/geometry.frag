#version 330 core
// Evaluates the material once for each pixel and writes what lighting will need of it, for no light yet.
#include "10_deferred/gbuffer.glsl"

in vec3 world_position;
in vec3 world_normal;
in vec2 uv;

uniform sampler2D base_map;     // rgb: albedo (see albedoFrom), a: occlusion, 1 is open
uniform sampler2D surface_map;  // rgb: tangent-space normal in [0, 1], green up the image, a: roughness
uniform vec3 base_color;        // linear, multiplies the albedo
uniform float occluded_albedo;  // factor on the albedo where occlusion is 0, [0, 1]
uniform float specular_scale;   // specular intensity of a perfectly smooth surface, [0, max_specular]
uniform float shininess;        // exponent of the Blinn highlight
uniform float normal_strength;  // factor on the normal map's x and y
uniform float material;         // 0: mesh, 1: floor

layout(location = 0) out vec4 albedo_out;
layout(location = 1) out vec4 normal_out;
#if STORES_POSITION
layout(location = 2) out vec4 position_out;
#endif

// Images are sRGB. Without mip levels the seed's power does; where levels are averaged it must be done in linear
// light, so the texture is an sRGB one and has been decoded.
vec3 albedoFrom(vec3 texel) {
#if TEXTURE_FILTER == TEXTURE_FILTER_BILINEAR
    return pow(texel, vec3(2.2));
#else
    return texel;
#endif
}

// excerpt: cotangent_frame
// Schueler 2013, "Normal Mapping Without Precomputed Tangents" (GPU Pro; first ShaderX5, 2006): how position and uv
// change from pixel to pixel gives the frame, so that no vertex needs a tangent. Where uv does not change there is no
// frame: the geometric normal stays.
vec3 perturbedNormal(vec3 normal, vec3 tangent_normal) {
    vec3 position_dx = dFdx(world_position);
    vec3 position_dy = dFdy(world_position);
    vec2 uv_dx = dFdx(uv);
    vec2 uv_dy = dFdy(uv);
    vec3 across_y = cross(position_dy, normal);
    vec3 across_x = cross(normal, position_dx);
    vec3 along_u = across_y * uv_dx.x + across_x * uv_dy.x;
    vec3 along_v = across_y * uv_dx.y + across_x * uv_dy.y;
    float longest_squared = max(dot(along_u, along_u), dot(along_v, along_v));
    const float smallest_normal_float = 1.2e-38;
    if (!(longest_squared > smallest_normal_float)) return normal;
    // v grows down the image, green up it
    vec3 sideways = (along_u * tangent_normal.x - along_v * tangent_normal.y) * inversesqrt(longest_squared);
    return normalize(sideways + normal * tangent_normal.z);
}
// end excerpt

vec3 tangentNormal(vec3 texel) {
    vec3 n = texel * 2.0 - 1.0;
    n.xy *= normal_strength;
    return n * inversesqrt(max(dot(n, n), 1e-8));
}

// excerpt: geometry
void main() {
    vec4 base = texture(base_map, uv);
    vec4 surface = texture(surface_map, uv);
    vec3 albedo = albedoFrom(base.rgb) * base_color * mix(occluded_albedo, 1.0, base.a);
    float specular = (1.0 - surface.a) * specular_scale;
    vec3 normal = perturbedNormal(normalize(world_normal), tangentNormal(surface.rgb));

#if GBUFFER == GBUFFER_COMPACT
    albedo_out = vec4(albedo, packSpecular(specular, material));
#else
    albedo_out = vec4(albedo, specular);
#endif
#if STORES_OCTAHEDRAL
    normal_out = vec4(octahedralFromDirection(normal), 0.0, 0.0);
#else
    normal_out = vec4(normal, shininess);
#endif
#if GBUFFER == GBUFFER_SEED
    position_out = vec4(world_position, 1.0 + material);
#elif GBUFFER == GBUFFER_OCTAHEDRAL
    position_out = vec4(world_position, shininess);
#endif
}
// end excerpt
