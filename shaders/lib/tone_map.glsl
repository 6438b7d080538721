// Tone maps: from linear scene light, [0, infinity), to linear display light, [0, 1]. TONE_MAP chooses one.
#include "lib/luminance.glsl"

// The largest half float: keeps the rational curves finite where a target has overflowed.
const float tone_map_max = 65504.0;

// L. 10 in Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", applied to each channel.
vec3 toneMapReinhard(vec3 x) { return x / (1.0 + x); }

// The same curve for the luminance alone: hues stay, and what is bright in one channel clips.
vec3 toneMapReinhardLuminance(vec3 x) { return min(x / (1.0 + luminance(x)), 1.0); }

// Reinhard et al. 2002, eq. 4, for the luminance: all that reaches the white point burns out.
vec3 toneMapReinhardExtended(vec3 x, float white) {
    float luma = luminance(x);
    return min(x * ((1.0 + luma / (white * white)) / (1.0 + luma)), 1.0);
}

// The response of film or a cone: saturates, never clips.
vec3 toneMapExposure(vec3 x) { return 1.0 - exp(-x); }

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit to the ACES RRT + ODT for 100 nit displays.
vec3 toneMapAcesNarkowicz(vec3 x) {
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// Stephen Hill's fit of the ACES RRT + ODT, in the primaries ACES works in (AP1, desaturated), so that bright
// colours turn white instead of clipping one channel after the other.
vec3 toneMapAcesHill(vec3 x) {
    const mat3 rrt_from_linear = mat3(0.59719, 0.07600, 0.02840, // columns
                                      0.35458, 0.90834, 0.13383, //
                                      0.04823, 0.01566, 0.83777);
    const mat3 linear_from_odt = mat3(1.60475, -0.10208, -0.00327, //
                                      -0.53108, 1.10813, -0.07276, //
                                      -0.07367, -0.00605, 1.07602);
    vec3 v = rrt_from_linear * x;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(linear_from_odt * v, 0.0, 1.0);
}

// Khronos PBR Neutral (2024): one to one below 0.8 but for the Fresnel offset, then compresses the peak and moves
// towards white; hues stay.
vec3 toneMapPbrNeutral(vec3 x) {
    const float f90 = 0.04;
    const float start_compression = 0.8 - f90;
    const float desaturation = 0.15;
    float lowest = min(x.r, min(x.g, x.b));
    x -= lowest < 2.0 * f90 ? lowest - lowest * lowest / (4.0 * f90) : f90;
    float peak = max(x.r, max(x.g, x.b));
    if (peak < start_compression) return x;
    const float d = 1.0 - start_compression;
    float new_peak = 1.0 - d * d / (peak + d - start_compression);
    float whiteness = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(x * (new_peak / peak), vec3(new_peak), whiteness);
}

// AgX (Sobotka 2022) with the sixth-degree fit of its curve by Wrensch 2023, "Minimal AgX Implementation": from 12.5
// stops below 1 to 4 above, in primaries that are drawn together, so that bright colours fade to white.
vec3 toneMapAgx(vec3 x) {
    const mat3 inset_from_linear = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, // columns
                                        0.0784335999999992, 0.878468636469772, 0.0784336,          //
                                        0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 display_from_inset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, //
                                         -0.0980208811401368, 1.15190312990417, -0.0980434501171241, //
                                         -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    const float lowest_stop = -12.47393;
    const float highest_stop = 4.026069;
    vec3 stops = log2(max(inset_from_linear * x, 1e-10));
    vec3 v = clamp((stops - lowest_stop) / (highest_stop - lowest_stop), 0.0, 1.0);
    v = (((((15.5 * v - 40.14) * v + 31.96) * v - 6.868) * v + 0.4298) * v + 0.1191) * v - 0.00232;
    // The curve gives encoded values; this project encodes later.
    return pow(clamp(display_from_inset * v, 0.0, 1.0), vec3(2.2));
}

#if TONE_MAP == TONE_MAP_REINHARD_EXTENDED
uniform float white_point; // luminance, > 0
#endif

vec3 toneMap(vec3 linear_color) {
#ifdef UNGUARDED
    vec3 x = linear_color;
#else
    // Not-a-number is not greater than 0, so it becomes 0; clamp() need not do that.
    vec3 x = min(mix(vec3(0.0), linear_color, greaterThan(linear_color, vec3(0.0))), tone_map_max);
#endif
#if TONE_MAP == TONE_MAP_CLAMP
    return min(x, 1.0);
#elif TONE_MAP == TONE_MAP_REINHARD
    return toneMapReinhard(x);
#elif TONE_MAP == TONE_MAP_REINHARD_LUMINANCE
    return toneMapReinhardLuminance(x);
#elif TONE_MAP == TONE_MAP_REINHARD_EXTENDED
    return toneMapReinhardExtended(x, white_point);
#elif TONE_MAP == TONE_MAP_EXPOSURE
    return toneMapExposure(x);
#elif TONE_MAP == TONE_MAP_ACES_NARKOWICZ
    return toneMapAcesNarkowicz(x);
#elif TONE_MAP == TONE_MAP_ACES_HILL
    return toneMapAcesHill(x);
#elif TONE_MAP == TONE_MAP_PBR_NEUTRAL
    return toneMapPbrNeutral(x);
#elif TONE_MAP == TONE_MAP_AGX
    return toneMapAgx(x);
#else
#error TONE_MAP is none of the curves above
#endif
}
