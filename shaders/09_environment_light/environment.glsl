// Light from the environment map: an equirectangular picture in linear light, all round the scene.
#include "09_environment_light/equirectangular.glsl"

#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_RAW || ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_RAW
uniform sampler2D environment_map;
#endif
#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_SH9
uniform vec3 irradiance_sh[9]; // irradiance / pi, see environment.hpp
#endif
#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_PREFILTERED
uniform sampler2D prefiltered_map; // mip level i holds GGX roughness i / prefiltered_levels
uniform float prefiltered_levels;
#endif

// excerpt: environment
// Level 0 is named: u jumps from 1 to 0 behind the sphere, and derivatives taken there would ask for the last level.
vec3 environmentDiffuse(vec3 direction) {
#if ENVIRONMENT_DIFFUSE == ENVIRONMENT_DIFFUSE_RAW
    return textureLod(environment_map, equirectangularUv(direction), 0.0).rgb;
#else
    // Ramamoorthi and Hanrahan 2001: nine coefficients hold all of it that a matt surface can tell
    vec3 n = direction;
    vec3 sum = irradiance_sh[0] + irradiance_sh[1] * n.y + irradiance_sh[2] * n.z + irradiance_sh[3] * n.x;
    sum += irradiance_sh[4] * (n.x * n.y) + irradiance_sh[5] * (n.y * n.z) + irradiance_sh[7] * (n.x * n.z);
    sum += irradiance_sh[6] * (3.0 * n.z * n.z - 1.0) + irradiance_sh[8] * (n.x * n.x - n.y * n.y);
    return max(sum, 0.0);
#endif
}

vec3 environmentSpecular(vec3 direction, float roughness) {
#if ENVIRONMENT_SPECULAR == ENVIRONMENT_SPECULAR_RAW
    return textureLod(environment_map, equirectangularUv(direction), 0.0).rgb;
#else
    return textureLod(prefiltered_map, equirectangularUv(direction), roughness * prefiltered_levels).rgb;
#endif
}
// end excerpt
