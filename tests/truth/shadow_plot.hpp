// The plot of 07_shadow_map for rays, and its sun.
#pragma once

#include "07_shadow_map/plot.hpp"
#include "truth/shadow_rays.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <memory>
#include <vector>

namespace gll::truth {

inline constexpr float plot_width = 12; // of the fixed view's square, world units

inline std::unique_ptr<RayScene> plotRays() {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const gbuffer::PlainObject& object : shadow_map::makePlot()) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const gbuffer::Vertex& vertex : object.vertices)
            positions.push_back(vertex.position);
        for (const std::uint32_t index : object.indices)
            indices.push_back(first + index);
    }
    return std::make_unique<RayScene>(positions, indices);
}

// At frame 60, which is 1 s, turned as the rung's setUp() turns it.
inline SunTruth plotSun(int elevation_deg, int map_size, int filter_width) {
    const float azimuth_rad = glm::radians(75.0F) + 0.25F;
    const float elevation_rad = glm::radians(static_cast<float>(elevation_deg));
    return {{std::cos(elevation_rad) * std::cos(azimuth_rad), std::sin(elevation_rad),
             std::cos(elevation_rad) * std::sin(azimuth_rad)},
            plot_width / static_cast<float>(map_size),
            filter_width};
}

} // namespace gll::truth
