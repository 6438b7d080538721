// What 02_auto_exposure should measure, in double, and the settings it has by default.
#pragma once

#include "tone_reference.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace gll::truth {

inline constexpr double epsilon = 1e-8; // the rung's defaults
inline constexpr double white_point = 0.22;
inline constexpr double lowest_stop = -9;
inline constexpr double up_s = 0.4;
inline constexpr double down_s = 1.2;
inline constexpr double dt_s = 1 / 60.0;
inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Linear light of a size, row after row.
struct Light {
    glm::ivec2 size{1};
    std::vector<glm::vec3> pixels;
};

inline double logLuminance(const glm::vec3& pixel) {
    return std::log2(epsilon + std::max(luminanceOf(glm::dvec3(pixel)), 0.0));
}

// log2 of exp(mean(ln(epsilon + Y))) over the pixels whose luminance is a finite number.
inline double logAverage(const Light& light) {
    double sum = 0;
    double count = 0;
    for (const glm::vec3& pixel : light.pixels) {
        if (!std::isfinite(luminanceOf(glm::dvec3(pixel)))) continue;
        sum += logLuminance(pixel);
        ++count;
    }
    return count > 0 ? sum / count : std::log2(epsilon);
}

} // namespace gll::truth
