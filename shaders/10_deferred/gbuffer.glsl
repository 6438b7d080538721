// What the geometry pass writes for later passes to read, in each of the layouts that GBUFFER names. The background
// is what was cleared: position.w 0, depth 1.
#include "10_deferred/octahedral.glsl"

#define STORES_POSITION (GBUFFER == GBUFFER_SEED || GBUFFER == GBUFFER_OCTAHEDRAL)
#define STORES_OCTAHEDRAL (GBUFFER == GBUFFER_OCTAHEDRAL || GBUFFER == GBUFFER_COMPACT)

struct Surface {
    vec3 albedo;         // linear, [0, 1]
    float specular;      // intensity of highlights and reflections, [0, max_specular]
    vec3 world_normal;   // unit length
    float shininess;     // exponent of the Blinn highlight
    vec3 world_position; // world units
    float material;      // 0: mesh, 1: floor
};

const float max_specular = 0.6; // of any material: smooth on the mesh's scale

// excerpt: pack_specular
// COMPACT has no room for the shininess, but only two materials use it: the top bit of albedo's alpha says which, and
// seven bits are left for the intensity.
float packSpecular(float specular, float material) {
    return (floor(specular * (127.0 / max_specular) + 0.5) + 128.0 * material) / 255.0;
}

vec2 unpackSpecular(float packed_specular) {
    float code = floor(packed_specular * 255.0 + 0.5);
    float material = step(127.5, code);
    return vec2((code - 128.0 * material) * (max_specular / 127.0), material);
}
// end excerpt
