// Boxes as triangles, counter-clockwise seen from outside.
#include "01_hdr/boxes.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <stdexcept>
#include <vector>

namespace gll {
inline namespace hdr {
namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 color;
    float glow;
};

} // namespace

Mesh makeBoxes(std::span<const Box> boxes) {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const Box& box : boxes) {
        const glm::vec3 extent = box.high - box.low;
        if (!(extent.x > 0 && extent.y > 0 && extent.z > 0))
            throw std::invalid_argument("makeBoxes: a box without volume");
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                const auto first = static_cast<std::uint32_t>(vertices.size());
                const int u = (axis + 1) % 3;
                const int v = (axis + 2) % 3;
                glm::vec3 normal(0);
                normal[axis] = side == 0 ? -1.0F : 1.0F;
                for (const glm::ivec2 corner :
                     {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(1, 1), glm::ivec2(0, 1)}) {
                    glm::vec3 position = side == 0 ? box.low : box.high;
                    position[u] = corner.x == 0 ? box.low[u] : box.high[u];
                    position[v] = corner.y == 0 ? box.low[v] : box.high[v];
                    vertices.push_back({position, normal, box.color, box.glow});
                }
                const bool turned = side == 0; // seen from outside, u and v then run clockwise
                for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U})
                    indices.push_back(first + (turned ? (4 - i) % 4 : i));
            }
    }
    if (vertices.empty()) throw std::invalid_argument("makeBoxes: no box");
    return Mesh({.vertices = std::as_bytes(std::span(vertices)),
                 .vertex_stride_bytes = sizeof(Vertex),
                 .attributes = {{0, 3, offsetof(Vertex, position)},
                                {1, 3, offsetof(Vertex, normal)},
                                {2, 3, offsetof(Vertex, color)},
                                {3, 1, offsetof(Vertex, glow)}},
                 .indices = indices});
}

} // namespace hdr
} // namespace gll
