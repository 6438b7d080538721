// Scenes of axis-aligned boxes: all the geometry that the small rungs need.
#pragma once

#include "gl/mesh.hpp"

#include <glm/vec3.hpp>
#include <span>

namespace gll {
inline namespace hdr {

struct Box {
    glm::vec3 low{0};
    glm::vec3 high{1};  // above low in every direction
    glm::vec3 color{1}; // linear: what it reflects, or what it gives off where it glows
    float glow = 0;     // 0: reflects; above: gives off color times this much light
};

// One mesh of all the boxes. Vertices have locations 0: position (world), 1: normal, 2: colour, 3: glow.
// Throws std::invalid_argument where there is no box, or one without volume.
Mesh makeBoxes(std::span<const Box> boxes);

} // namespace hdr
} // namespace gll
