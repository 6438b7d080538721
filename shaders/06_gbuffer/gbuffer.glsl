// What the geometry pass writes for later passes to read, in each of the layouts that the settings make. The background
// is what was cleared: 0 everywhere, depth 1.
#include "06_gbuffer/octahedral.glsl"

#define STORES_POSITION (POSITIONS == POSITIONS_RGBA32F || POSITIONS == POSITIONS_RGBA16F)
#define STORES_VIEW_Z (POSITIONS == POSITIONS_LINEAR)

#define IS_PACKED (PACKING == PACKING_RGBA16)

#if NORMALS == NORMALS_OCT16
#define OCTAHEDRAL_STEPS 65535.0 // codes of either number, less one
#elif NORMALS == NORMALS_OCT12
#define OCTAHEDRAL_STEPS 4095.0
#elif NORMALS == NORMALS_OCT10
#define OCTAHEDRAL_STEPS 1023.0
#elif NORMALS == NORMALS_OCT8
#define OCTAHEDRAL_STEPS 255.0
#endif

struct Surface {
    vec3 albedo;         // linear, [0, 1]
    float specular;      // intensity of highlights and reflections, [0, max_specular]
    vec3 world_normal;   // unit length
    float shininess;     // exponent of the Blinn highlight, [1, max_shininess]
    vec3 world_position; // world units
};

const float max_specular = 0.6;         // of any material
const float log2_max_shininess = 13.0;  // 8192: a highlight of two degrees

// excerpt: pack_normal
// In the channels of the target for normals; those that are left hold 0.
vec4 packNormal(vec3 normal) {
#if NORMALS == NORMALS_RGBA32F || NORMALS == NORMALS_RGBA16F
    return vec4(normal, 0.0);
#elif NORMALS == NORMALS_RGB10 || NORMALS == NORMALS_RGB8
    return vec4(normal * 0.5 + 0.5, 0.0);
#else
#if PRECISE
    vec2 stored = nearestOctahedral(normal, OCTAHEDRAL_STEPS);
#else
    vec2 stored = octahedralFromDirection(normal);
#if NORMALS == NORMALS_OCT10
    // a driver may round to ten bits by more than half a code
    stored = floor(stored * OCTAHEDRAL_STEPS + 0.5) / OCTAHEDRAL_STEPS;
#endif
#endif
#if NORMALS == NORMALS_OCT12
    // twelve bits each: red and green hold the upper eight, blue the lower four of both
    vec2 code = floor(stored * OCTAHEDRAL_STEPS + 0.5);
    vec2 upper = floor(code / 16.0);
    vec2 lower = code - 16.0 * upper;
    return vec4(upper, 16.0 * lower.x + lower.y, 0.0) / 255.0;
#else
    return vec4(stored, 0.0, 0.0);
#endif
#endif
}

vec3 unpackNormal(vec4 stored) {
#if NORMALS == NORMALS_RGBA32F || NORMALS == NORMALS_RGBA16F
    return normalize(stored.rgb);
#elif NORMALS == NORMALS_RGB10 || NORMALS == NORMALS_RGB8
    return normalize(stored.rgb * 2.0 - 1.0);
#elif NORMALS == NORMALS_OCT12
    vec3 code = floor(stored.rgb * 255.0 + 0.5);
    float lower_x = floor(code.b / 16.0);
    return directionFromOctahedral(vec2(16.0 * code.r + lower_x, 16.0 * code.g + code.b - 16.0 * lower_x) /
                                   OCTAHEDRAL_STEPS);
#else
    return directionFromOctahedral(stored.rg);
#endif
}
// end excerpt

// excerpt: pack_gloss
// How wide a highlight looks goes with the logarithm of its exponent, so that is what few bits hold.
#if GLOSS == GLOSS_8
#define GLOSS_STEPS 255.0
#elif GLOSS == GLOSS_6
#define GLOSS_STEPS 63.0
#elif GLOSS == GLOSS_4
#define GLOSS_STEPS 15.0
#endif

float packGloss(float shininess) {
#if GLOSS == GLOSS_FLOAT
    return shininess;
#elif GLOSS == GLOSS_PALETTE
    return 0.0;
#else
    return floor(clamp(log2(shininess) / log2_max_shininess, 0.0, 1.0) * GLOSS_STEPS + 0.5) / GLOSS_STEPS;
#endif
}

float unpackGloss(float stored) {
#if GLOSS == GLOSS_FLOAT
    return stored;
#elif GLOSS == GLOSS_PALETTE
    return 1.0;
#else
    return exp2(floor(stored * GLOSS_STEPS + 0.5) * (log2_max_shininess / GLOSS_STEPS));
#endif
}
// end excerpt

// excerpt: pack_specular
// Where alpha of the albedo has to hold more than the specular intensity: a palette needs its top bit, for which of two
// materials it is; four bits of gloss take half of it.
#if GLOSS == GLOSS_PALETTE
const float specular_steps = 127.0;
#else
const float specular_steps = 15.0;
#endif

float packSpecular(float specular, float upper) {
    return (floor(specular * (specular_steps / max_specular) + 0.5) + (specular_steps + 1.0) * upper) / 255.0;
}

// x: specular intensity, y: what is above it
vec2 unpackSpecular(float packed_specular) {
    float code = floor(packed_specular * 255.0 + 0.5);
    float upper = floor(code / (specular_steps + 1.0));
    return vec2((code - (specular_steps + 1.0) * upper) * (max_specular / specular_steps), upper);
}
// end excerpt

#if IS_PACKED
// excerpt: pack_surface
// All but the position in four channels of 16 bits, as two words of 32:
//   albedo, the square root of red and green: 362 codes each in 17 bits; logarithm of gloss: 8;
//   square root of the specular intensity: 7                                                     bits 0 to 31
//   normal, octahedral: 2896 codes each in 23 bits; albedo, the square root of blue: 9           bits 0 to 31
// Eight bits of albedo show bands where the sun is bright. Two numbers that share an odd number of bits have half a bit
// each of the odd one: 362 * 362 codes fill 17 bits, and 2896 * 2896 fill 23.
uint codeOf(float value, float codes) { return uint(clamp(value, 0.0, 1.0) * (codes - 1.0) + 0.5); }
float valueOf(uint code, float codes) { return float(code) / (codes - 1.0); }
uint pairOf(vec2 values, float codes) { return codeOf(values.x, codes) + uint(codes) * codeOf(values.y, codes); }
vec2 valuesOf(uint pair, float codes) {
    uint upper = pair / uint(codes);
    return vec2(valueOf(pair - upper * uint(codes), codes), valueOf(upper, codes));
}

vec4 packSurface(vec3 albedo, float specular, vec3 normal, float shininess) {
    vec3 root = sqrt(albedo);
    uint first = pairOf(root.rg, 362.0) | codeOf(log2(shininess) / log2_max_shininess, 256.0) << 17 |
                 codeOf(sqrt(specular / max_specular), 128.0) << 25;
    uint second = pairOf(nearestOctahedral(normal, 2895.0), 2896.0) | codeOf(root.b, 512.0) << 23;
    return vec4(first & 65535u, first >> 16, second & 65535u, second >> 16) / 65535.0;
}

uvec2 wordsOf(vec4 stored) {
    uvec4 codes = uvec4(stored * 65535.0 + 0.5);
    return uvec2(codes.r | codes.g << 16, codes.b | codes.a << 16);
}

vec3 packedAlbedo(uvec2 words) {
    vec3 root = vec3(valuesOf(words.x & 131071u, 362.0), valueOf(words.y >> 23, 512.0));
    return root * root;
}
vec3 packedNormal(uvec2 words) { return directionFromOctahedral(valuesOf(words.y & 8388607u, 2896.0)); }
float packedSpecular(uvec2 words) {
    float root = valueOf(words.x >> 25, 128.0);
    return root * root * max_specular;
}
float packedShininess(uvec2 words) { return exp2(valueOf(words.x >> 17 & 255u, 256.0) * log2_max_shininess); }
// end excerpt
#endif
