// Integrating GGX over the directions of the light.
#include "brdf_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace gll::environment_light {
namespace {

// Smith's function of a direction of that cosine: masked is 1 / (1 + it).
double smith(double cosine, double alpha) {
    const double tangent_squared = (1 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1 + alpha * alpha * tangent_squared) - 1);
}

// A normal of those that the viewer sees (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
glm::dvec3 visibleNormal(const glm::dvec3& view, double alpha, glm::dvec2 point) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, 0, view.z));
    const glm::dvec3 across(0, 1, 0);
    const glm::dvec3 up = glm::cross(stretched, across);
    const double radius = std::sqrt(point.x);
    const double angle_rad = 2 * std::numbers::pi * point.y;
    const double a = radius * std::cos(angle_rad);
    const double share = 0.5 * (1 + stretched.z);
    const double b = (1 - share) * std::sqrt(1 - a * a) + share * radius * std::sin(angle_rad);
    const glm::dvec3 normal = a * across + b * up + std::sqrt(std::max(1 - a * a - b * b, 0.0)) * stretched;
    return glm::normalize(glm::dvec3(alpha * normal.x, alpha * normal.y, std::max(normal.z, 0.0)));
}

} // namespace

glm::dvec2 brdfScaleAndBias(double cosine, double roughness, int samples) {
    const double alpha = std::max(roughness * roughness, 1e-5);
    cosine = std::clamp(cosine, 1e-4, 1.0);
    const glm::dvec3 view(std::sqrt(1 - cosine * cosine), 0, cosine);
    constexpr double golden_ratio = 0.6180339887498949;
    glm::dvec2 sum(0);
    for (int i = 0; i < samples; ++i) {
        const glm::dvec3 half =
            visibleNormal(view, alpha, {(i + 0.5) / samples, std::fmod(0.5 + i * golden_ratio, 1.0)});
        const double along = glm::dot(view, half);
        const glm::dvec3 light = 2 * along * half - view;
        if (light.z <= 0) continue;
        const double seen = 1 + smith(cosine, alpha);
        const double weight = seen / (seen + smith(light.z, alpha));
        const double fresnel = std::pow(1 - along, 5);
        sum += weight * glm::dvec2(1 - fresnel, fresnel);
    }
    return sum / double(samples);
}

std::vector<float> brdfTable(int size) {
    constexpr int samples = 256;
    std::vector<float> table;
    table.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 2);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const glm::dvec2 both =
                brdfScaleAndBias(double(column) / (size - 1), double(row) / (size - 1), samples);
            table.push_back(static_cast<float>(both.x));
            table.push_back(static_cast<float>(both.y));
        }
    return table;
}

} // namespace gll::environment_light
