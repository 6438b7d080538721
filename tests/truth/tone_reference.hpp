// The tone maps and display encodings in double, written from their sources and not from the shaders.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

namespace gll::truth {

inline constexpr double brightest = 65504; // what the ladder clamps scene light to: the largest half float

template <class Function>
glm::dvec3 eachChannel(const glm::dvec3& color, const Function& function) {
    return {function(color.r), function(color.g), function(color.b)};
}

inline double saturated(double value) { return std::clamp(value, 0.0, 1.0); }

// Narkowicz 2015: (x (a x + b)) / (x (c x + d) + e).
inline double acesNarkowicz(double x) {
    constexpr double a = 2.51;
    constexpr double b = 0.03;
    constexpr double c = 2.43;
    constexpr double d = 0.59;
    constexpr double e = 0.14;
    return saturated((a * x * x + b * x) / (c * x * x + d * x + e));
}

// Hill's matrices by rows, as published in BakingLab's ACES.hlsl.
inline glm::dvec3 acesHill(const glm::dvec3& x) {
    constexpr double in[3][3] = {
        {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
    constexpr double out[3][3] = {
        {1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602}};
    double fitted[3] = {};
    for (int row = 0; row < 3; ++row) {
        const double v = in[row][0] * x.r + in[row][1] * x.g + in[row][2] * x.b;
        fitted[row] = (v * v + 0.0245786 * v - 0.000090537) / (0.983729 * v * v + 0.4329510 * v + 0.238081);
    }
    glm::dvec3 result(0);
    for (int row = 0; row < 3; ++row)
        result[row] = saturated(out[row][0] * fitted[0] + out[row][1] * fitted[1] + out[row][2] * fitted[2]);
    return result;
}

// Khronos PBR Neutral Tone Mapper, specification of 2024.
inline glm::dvec3 pbrNeutral(glm::dvec3 color) {
    constexpr double f90 = 0.04;
    constexpr double k_s = 0.8 - f90;
    constexpr double k_d = 0.15;
    const double x = std::min({color.r, color.g, color.b});
    const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
    color -= glm::dvec3(f);
    const double p = std::max({color.r, color.g, color.b});
    if (p <= k_s) return color;
    const double p_n = 1 - (1 - k_s) * (1 - k_s) / (p + 1 - 2 * k_s);
    const double g = 1 / (k_d * (p - p_n) + 1);
    return color * (p_n / p) * g + glm::dvec3(p_n) * (1 - g);
}

inline double luminanceOf(const glm::dvec3& x) { return 0.2126 * x.r + 0.7152 * x.g + 0.0722 * x.b; }

// Wrensch 2023: AgX's matrices by rows, the fit of its curve by powers, and display light with gamma 2.2.
inline glm::dvec3 agx(const glm::dvec3& x) {
    constexpr double in[3][3] = {{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                 {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                 {0.0423756549057051, 0.0784336, 0.879142973793104}};
    constexpr double out[3][3] = {{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                  {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                  {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}};
    constexpr double power[7] = {-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5};
    double curve[3] = {};
    for (int row = 0; row < 3; ++row) {
        const double light = in[row][0] * x.r + in[row][1] * x.g + in[row][2] * x.b;
        const double v = light > 0 ? saturated((std::log2(light) + 12.47393) / (4.026069 + 12.47393)) : 0;
        for (int i = 0; i < 7; ++i)
            curve[row] += power[i] * std::pow(v, i);
    }
    glm::dvec3 result(0);
    for (int row = 0; row < 3; ++row)
        result[row] = std::pow(
            saturated(out[row][0] * curve[0] + out[row][1] * curve[1] + out[row][2] * curve[2]), 2.2);
    return result;
}

// A curve by its setting's name; throws std::invalid_argument for one that is not here. Light outside [0,
// brightest] is clamped; not-a-number counts as none.
inline glm::dvec3 toneMapped(const std::string& name, const glm::dvec3& scene, double white_point = 4) {
    const glm::dvec3 x = eachChannel(scene, [](double v) { return v > 0 ? std::min(v, brightest) : 0.0; });
    if (name == "clamp") return eachChannel(x, saturated);
    if (name == "reinhard") return eachChannel(x, [](double v) { return v / (1 + v); });
    if (name == "exposure") return eachChannel(x, [](double v) { return -std::expm1(-v); });
    if (name == "aces_narkowicz") return eachChannel(x, acesNarkowicz);
    if (name == "aces_hill") return acesHill(x);
    if (name == "pbr_neutral") return pbrNeutral(x);
    if (name == "agx") return agx(x);
    if (name != "reinhard_luminance" && name != "reinhard_extended")
        throw std::invalid_argument("there is no reference for the tone map " + name);
    const double luminance = luminanceOf(x);
    const double lift = name == "reinhard_extended" ? luminance / (white_point * white_point) : 0;
    return eachChannel(x * ((1 + lift) / (1 + luminance)), saturated); // Reinhard et al. 2002, eq. 3 and 4
}

// A transfer function by its setting's name: gamma22, or srgb (IEC 61966-2-1). Throws std::invalid_argument
// for another.
inline glm::dvec3 encoded(const std::string& name, const glm::dvec3& linear) {
    if (name == "gamma22") return eachChannel(linear, [](double v) { return std::pow(v, 1 / 2.2); });
    if (name != "srgb") throw std::invalid_argument("there is no reference for the encoding " + name);
    return eachChannel(
        linear, [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; });
}

} // namespace gll::truth
