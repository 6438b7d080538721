// Planar polygons: which way they face, and cutting them into triangles. Private to common/io.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gll {

// Newell's normal: along the polygon's front, twice its area long.
glm::dvec3 areaNormal(const std::vector<glm::dvec3>& corners);

// Cuts a polygon without holes into corners.size() - 2 triangles of corner numbers, in its own winding, by
// clipping ears in the plane of its Newell normal. Where no ear is left (corners that coincide or edges that
// cross) it cuts anyway: a face never vanishes, and nothing loops.
std::vector<std::array<std::size_t, 3>> cutPolygon(const std::vector<glm::dvec3>& corners);

} // namespace gll
