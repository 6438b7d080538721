// Light from all round: what reaches a matt surface, what a glossy one mirrors, and how much of it is reflected.
#include "09_environment_light/environment_terms.glsl"
#include "09_environment_light/equirectangular.glsl"

#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_RAW || ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_RAW
uniform sampler2D environment_map; // equirectangular, radiance
#endif
#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_MIP
uniform sampler2D coarse_map; // equirectangular, a few pixels
#endif
#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_PREFILTERED
// level r (1.7 - 0.7 r) prefiltered_levels holds GGX roughness r
#if ENVIRONMENT_LAYOUT == ENVIRONMENT_LAYOUT_CUBE
uniform samplerCube prefiltered_map;
#else
uniform sampler2D prefiltered_map;
#endif
uniform float prefiltered_levels;  // number of the last
#if ENVIRONMENT_LAYOUT == ENVIRONMENT_LAYOUT_OCTAHEDRAL
#include "06_gbuffer/octahedral.glsl"
uniform float prefiltered_size; // texels along a side of level 0
#endif
#endif
#ifdef ENVIRONMENT_HANDED_ON // by the vertex stage, see hand_on.glsl
#define ENVIRONMENT_INPUT flat in
#define irradiance_sh flat_irradiance_sh
#define to_brightest flat_to_brightest
#define brightest_irradiance flat_brightest_irradiance
#else
#define ENVIRONMENT_INPUT uniform
#endif
#if HAS_SH
ENVIRONMENT_INPUT vec3 irradiance_sh[9]; // irradiance / pi, see radiance_map.hpp
#endif
#if HAS_BRIGHTEST
ENVIRONMENT_INPUT vec3 to_brightest;         // unit length
ENVIRONMENT_INPUT vec3 brightest_irradiance; // over pi, of a surface that faces it
#endif
#if SUN_BY_ITSELF
uniform float brightest_spread; // half of its mean squared angle, radians squared
#endif
#if ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_TABLE
uniform sampler2D brdf_table; // rg: see brdf_table.hpp
uniform float brdf_table_size;
#endif

// excerpt: diffuse
// Irradiance / pi about a normal: what a white matt surface sends out. Level 0 is named where a picture is read: u
// jumps from 1 to 0 behind the sphere, and derivatives taken there would ask for the last level.
vec3 environmentDiffuse(vec3 normal) {
#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_RAW
    return textureLod(environment_map, equirectangularUv(normal), 0.0).rgb;
#elif ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_MIP
    return textureLod(coarse_map, equirectangularUv(normal), 0.0).rgb;
#else
    // Ramamoorthi and Hanrahan 2001: nine coefficients hold all of it that a matt surface can tell
    vec3 n = normal;
    vec3 sum = irradiance_sh[0] + irradiance_sh[1] * n.y + irradiance_sh[2] * n.z + irradiance_sh[3] * n.x;
    sum += irradiance_sh[4] * (n.x * n.y) + irradiance_sh[5] * (n.y * n.z) + irradiance_sh[7] * (n.x * n.z);
    sum += irradiance_sh[6] * (3.0 * n.z * n.z - 1.0) + irradiance_sh[8] * (n.x * n.x - n.y * n.y);
#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_SH9_SUN
    sum += brightest_irradiance * max(dot(n, to_brightest), 0.0);
#endif
    return max(sum, 0.0);
#endif
}
// end excerpt

#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_PREFILTERED
float prefilteredLevel(float roughness) { return roughness * (1.7 - 0.7 * roughness) * prefiltered_levels; }

#endif
#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_PREFILTERED && ENVIRONMENT_LAYOUT == ENVIRONMENT_LAYOUT_OCTAHEDRAL
// excerpt: octahedral
// Texels at the rim stand on the rim itself, where they fall on each other when the octahedron is folded: nothing has
// to be read across it. So each level has a scale of its own, and the two levels are read one by one.
vec3 octahedralLevel(vec2 place, float level) {
    float size = prefiltered_size * exp2(-level);
    return textureLod(prefiltered_map, (place * (size - 1.0) + 0.5) / size, level).rgb;
}

vec3 prefilteredRadiance(vec3 direction, float level) {
    vec2 place = octahedralFromDirection(direction);
    float finer = floor(level);
    float coarser = min(finer + 1.0, prefiltered_levels);
    return mix(octahedralLevel(place, finer), octahedralLevel(place, coarser), level - finer);
}
// end excerpt
#endif

// excerpt: specular
// Radiance from about a mirrored direction, as a lobe of this roughness gathers it.
vec3 environmentSpecular(vec3 direction, float roughness) {
#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_RAW
    return textureLod(environment_map, equirectangularUv(direction), 0.0).rgb;
#else
    float level = prefilteredLevel(roughness);
#if ENVIRONMENT_LAYOUT == ENVIRONMENT_LAYOUT_CUBE
    return textureLod(prefiltered_map, direction, level).rgb;
#elif ENVIRONMENT_LAYOUT == ENVIRONMENT_LAYOUT_OCTAHEDRAL
    return prefilteredRadiance(direction, level);
#else
    return textureLod(prefiltered_map, equirectangularUv(direction), level).rgb;
#endif
#endif
}
// end excerpt

// What environmentReflected() takes of a surface: the share that it reflects along its normal, f0. The original has an
// intensity of highlights in its place, up to 1. Of that it reflects a tenth along the normal, and more at grazing
// angles, which the fourth power stands for.
#if ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_ORIGINAL
vec3 reflectanceOf(vec3 f0) { return min(10.0 * f0, 1.0); }
vec3 reflectanceOfIntensity(float intensity) { return vec3(intensity); }

float originalFresnel(float cosine) {
    float grazing = 1.0 - cosine;
    return 0.10 + 0.7 * (grazing * grazing) * (grazing * grazing);
}
vec3 fresnel(vec3 reflectance, float cosine) { return reflectance * originalFresnel(cosine); }
#else
vec3 reflectanceOf(vec3 f0) { return f0; }
vec3 reflectanceOfIntensity(float intensity) { return vec3(0.10 * intensity); }
vec3 fresnel(vec3 f0, float cosine) {
    float grazing = 1.0 - cosine;
    float squared = grazing * grazing;
    return f0 + (1.0 - f0) * (squared * squared * grazing); // Schlick 1994
}

// excerpt: brdf
// Of light 1 from all round, a surface seen at this cosine reflects f0 * x + y.
vec2 environmentBrdf(float cosine, float roughness) {
#if ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_TABLE
    vec2 place = vec2(cosine, roughness) * (brdf_table_size - 1.0) + 0.5; // its ends are texels' middles
    return textureLod(brdf_table, place / brdf_table_size, 0.0).rg;
#elif ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_KARIS
    // Karis 2014, "Physically Based Shading on Mobile"
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float grazing = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    return vec2(-1.04, 1.04) * grazing + r.zw;
#elif ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_LAZAROV
    // Lazarov 2013, "Getting More Physical in Call of Duty: Black Ops II": for Blinn's highlights of exponent
    // 8192^gloss, which are as wide as GGX's where alpha^2 = 2 / (exponent + 2)
    float alpha = max(roughness * roughness, 0.001);
    float gloss = clamp(log2(max(2.0 / (alpha * alpha) - 2.0, 1.0)) / 13.0, 0.0, 1.0);
    float at_4_percent = (min(0.475 * gloss, exp2(-9.28 * cosine)) + 0.0275) * gloss + 0.015;
    float at_1 = 0.75 + 0.25 * gloss;
    float at_0 = (at_4_percent - 0.04 * at_1) / 0.96;
    return vec2(at_1 - at_0, at_0);
#endif
}
// end excerpt
#endif

#if SUN_BY_ITSELF
// excerpt: sun
// The sun as a light of its own: no split sum, GGX as it is. Its highlight is never sharper than the sun is small: a
// lobe that much wider has, seen along the normal, the peak that the sun has in a mirror. Towards a mirror level 0 takes
// over, where the sun still is.
vec3 sunReflected(vec3 normal, vec3 to_camera, vec3 reflectance, float roughness) {
    float lit = dot(normal, to_brightest);
    vec3 sum = to_brightest + to_camera;
    if (lit <= 0.0 || dot(sum, sum) == 0.0) return vec3(0.0);
    vec3 halfway = normalize(sum);
    float seen = max(dot(normal, to_camera), 1e-3);
    float alpha = roughness * roughness;
    float alpha_squared = clamp(alpha * alpha + brightest_spread, 1e-6, 1.0);
    float along = dot(normal, halfway);
    vec3 apart = cross(normal, halfway); // 1 - along^2 would leave nothing but rounding where a lobe is sharp
    float spread = dot(apart, apart) + alpha_squared * along * along;
    float masked = lit * sqrt(alpha_squared + seen * seen * (1.0 - alpha_squared)) +
                   seen * sqrt(alpha_squared + lit * lit * (1.0 - alpha_squared)); // Heitz 2014: Smith, by height
    float lobe = alpha_squared / (spread * spread) * 0.5 / max(masked, 1e-6); // times pi, which irradiance lacks
    float share = min(prefilteredLevel(roughness), 1.0);
    return brightest_irradiance * fresnel(reflectance, max(dot(halfway, to_camera), 0.0)) * (lobe * lit * share);
}
// end excerpt
#endif

// excerpt: reflected
// What a surface sends back. irradiance: over pi, at its normal. left: how much of its matt color is left.
vec3 environmentReflected(vec3 normal, vec3 to_camera, vec3 irradiance, vec3 reflectance, float roughness,
                          out vec3 left) {
    vec3 radiance = environmentSpecular(reflect(-to_camera, normal), roughness);
    float cosine = max(dot(normal, to_camera), 0.0);
    left = vec3(1.0);
#if SUN_BY_ITSELF
    vec3 sun = sunReflected(normal, to_camera, reflectance, roughness);
#else
    const vec3 sun = vec3(0.0);
#endif
#if ENVIRONMENT_BRDF == ENVIRONMENT_BRDF_ORIGINAL
    return radiance * fresnel(reflectance, cosine) + sun;
#else
    vec2 brdf = environmentBrdf(cosine, roughness);
    vec3 once = reflectance * brdf.x + brdf.y;
    // Of a surface that absorbs nothing: less than 1 is what leaves on a second bounce. Half floats may add up to more.
    float all = min(brdf.x + brdf.y, 1.0);
#if ENVIRONMENT_ENERGY == ENVIRONMENT_ENERGY_NONE
    return radiance * once + sun;
#elif ENVIRONMENT_ENERGY == ENVIRONMENT_ENERGY_FDEZ_AGUERA
    // Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting": the rest comes
    // from all round, and takes the surface's color each time that it is reflected
    vec3 mean_fresnel = reflectance + (1.0 - reflectance) / 21.0;
    vec3 again = once * mean_fresnel / (1.0 - (1.0 - all) * mean_fresnel) * (1.0 - all);
    left = 1.0 - once - again;
    return radiance * once + sun + irradiance * again;
#elif ENVIRONMENT_ENERGY == ENVIRONMENT_ENERGY_TURQUIN
    // Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet Models": the same lobe, brighter
    vec3 brighter = 1.0 + reflectance * (1.0 / all - 1.0);
    left = 1.0 - once * brighter;
    return (radiance * once + sun) * brighter;
#endif
#endif
}
// end excerpt
