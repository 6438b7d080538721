#version 330 core
// Evaluates the material once for each pixel and writes what lighting will need of it, for no light yet.
// Variants, beside the layouts': VERTEX_COLOR, the mesh has colors; SEPARATE_MAPS, images are not packed in two;
// ALPHA_MASK, which comes with SEPARATE_MAPS, the material has holes.
#include "06_gbuffer/gbuffer.glsl"

in vec3 world_position;
in vec3 world_normal;
in vec2 uv; // the normal map's, where maps are separate
#ifdef VERTEX_COLOR
in vec4 color; // linear, alpha: opacity
#endif
#ifdef SEPARATE_MAPS
in vec2 base_uv;
in vec2 occlusion_uv;
in vec2 roughness_uv;
#endif

uniform sampler2D base_map;     // rgb: albedo (see albedoFrom), a: occlusion, 1 is open; separate: opacity
uniform sampler2D surface_map;  // rgb: tangent-space normal in [0, 1], green up the image, a: roughness
#ifdef SEPARATE_MAPS
uniform sampler2D occlusion_map; // a: occlusion
uniform sampler2D roughness_map; // a: roughness
#endif
#ifdef ALPHA_MASK
uniform float opacity;      // of the whole material
uniform float alpha_cutoff; // what has less is a hole
#endif
uniform vec3 base_color;        // linear, multiplies the albedo
uniform float occluded_albedo;  // factor on the albedo where occlusion is 0, [0, 1]
uniform float specular_scale;   // specular intensity of a perfectly smooth surface, [0, max_specular]
uniform float shininess;        // exponent of the Blinn highlight
uniform float normal_strength;  // factor on the normal map's x and y
uniform float material;         // 0: mesh, 1: floor

#if IS_PACKED
layout(location = LOCATION_PACKED) out vec4 packed_out;
#else
layout(location = LOCATION_ALBEDO) out vec4 albedo_out;
layout(location = LOCATION_NORMAL) out vec4 normal_out;
#endif
#if STORES_SPECULAR
layout(location = LOCATION_SPECULAR) out float specular_out;
#endif
#if STORES_POSITION
layout(location = LOCATION_POSITION) out vec4 position_out;
#elif STORES_VIEW_Z
uniform vec4 view_z_from_world; // of a world position, w 1
layout(location = LOCATION_VIEW_Z) out float view_z_out;
#endif
#if GLOSS_IN == GLOSS_IN_TARGET
layout(location = LOCATION_GLOSS) out float gloss_out;
#endif
#if STORES_GEOMETRIC
layout(location = LOCATION_GEOMETRIC) out vec2 geometric_out;
#endif

// Images are sRGB. Without mip levels the original's power does; where levels are averaged it must be done in linear
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

// What has no inside is lit on the side that is seen. The order of its corners does not say alone which one that is,
// as files wind their faces either way: its normal must lean away from the camera, too.
vec3 seenNormal(vec3 normal) {
#ifdef SHEET
    vec3 towards_camera = cross(dFdx(world_position), dFdy(world_position));
    if (!gl_FrontFacing && dot(towards_camera, normal) < 0.0) return -normal;
#endif
    return normal;
}

#if SPECULAR_AA
// excerpt: specular_aa
// Where normals turn within a pixel, its highlight is a wider one. Kaplanyan et al. 2016, "Filtering Distributions of
// Normals for Shading Antialiasing", as Tokuyoshi and Kaplanyan 2019 simplified it; with 2 / (n + 2) for the squared
// roughness of Blinn's exponent n (Walter et al. 2007).
float widenedShininess(vec3 normal) {
    const float pixel_variance = 0.15; // of a Gaussian as wide as a pixel
    const float most = 0.2;            // what is added at most, so that curved silhouettes stay glossy
    vec3 normal_dx = dFdx(normal);
    vec3 normal_dy = dFdy(normal);
    float added = min(2.0 * pixel_variance * (dot(normal_dx, normal_dx) + dot(normal_dy, normal_dy)), most);
    float squared_roughness = min(2.0 / (shininess + 2.0) + added, 1.0);
    return max(2.0 / squared_roughness - 2.0, 1.0);
}
// end excerpt
#else
float widenedShininess(vec3 normal) { return shininess; }
#endif

// Code 128 is zero: of 256 codes none is in the middle, and 127.5 for zero would tilt flat maps by a third of a degree.
vec3 tangentNormal(vec3 texel) {
    vec3 n = (texel * 255.0 - 128.0) / 127.0;
    n.xy *= normal_strength;
    return n * inversesqrt(max(dot(n, n), 1e-8));
}

// rgb: albedo as the image has it, a: occlusion
vec4 baseTexel() {
#ifdef SEPARATE_MAPS
    return vec4(texture(base_map, base_uv).rgb, texture(occlusion_map, occlusion_uv).a);
#else
    return texture(base_map, uv);
#endif
}

// rgb: normal, a: roughness
vec4 surfaceTexel() {
#ifdef SEPARATE_MAPS
    return vec4(texture(surface_map, uv).rgb, texture(roughness_map, roughness_uv).a);
#else
    return texture(surface_map, uv);
#endif
}

vec3 tint() {
#ifdef VERTEX_COLOR
    return base_color * color.rgb;
#else
    return base_color;
#endif
}

// Last of all: derivatives need the neighbours that this may end.
void cutHoles() {
#ifdef ALPHA_MASK
    float alpha = texture(base_map, base_uv).a * opacity;
#ifdef VERTEX_COLOR
    alpha *= color.a;
#endif
    if (alpha < alpha_cutoff) discard;
#endif
}

// excerpt: geometry
void main() {
    vec4 base = baseTexel();
    vec4 surface = surfaceTexel();
    vec3 albedo = albedoFrom(base.rgb) * tint() * mix(occluded_albedo, 1.0, base.a);
    float specular = (1.0 - surface.a) * specular_scale;
    vec3 normal = perturbedNormal(seenNormal(normalize(world_normal)), tangentNormal(surface.rgb));
    float width = widenedShininess(normal);
#if STORES_GEOMETRIC
    // the triangle's own plane, whatever normals were smoothed over its corners
    geometric_out = octahedralFromDirection(normalize(cross(dFdx(world_position), dFdy(world_position))));
#endif
    cutHoles();

#if IS_PACKED
    packed_out = packSurface(albedo, specular, normal, width);
#else
    float gloss = packGloss(width);
    normal_out = packNormal(normal);
#if GLOSS_IN == GLOSS_WITH_SPECULAR && GLOSS == GLOSS_PALETTE
    specular = packSpecular(specular, material);
#elif GLOSS_IN == GLOSS_WITH_SPECULAR
    specular = packSpecular(specular, gloss * 15.0);
#endif
#if STORES_SPECULAR
    // a driver may round to ten bits by more than half a code
    albedo_out = vec4(floor(sqrt(albedo) * 1023.0 + 0.5) / 1023.0, 0.0);
    specular_out = specular;
#else
    albedo_out = vec4(albedo, specular);
#endif
#endif
#if STORES_POSITION
    position_out = vec4(world_position, 1.0 + material);
#elif STORES_VIEW_Z
    view_z_out = dot(view_z_from_world, vec4(world_position, 1.0));
#endif
#if GLOSS_IN == GLOSS_IN_NORMAL_ALPHA
    normal_out.a = gloss;
#elif GLOSS_IN == GLOSS_IN_NORMAL_BLUE
    normal_out.b = gloss;
#elif GLOSS_IN == GLOSS_IN_POSITION_ALPHA
    position_out.a = GLOSS == GLOSS_FLOAT ? gloss : 1.0 + gloss; // 0 is the background's
#elif GLOSS_IN == GLOSS_IN_TARGET
    gloss_out = gloss;
#endif
}
// end excerpt
