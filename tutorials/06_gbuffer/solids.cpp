// The triangles of simple solids.
#include "solids.hpp"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace gll::gbuffer {

PlainObject plain(glm::vec3 color) {
    return {.vertices = {}, .indices = {}, .color = color, .specular = 0, .shininess = 16};
}

void addQuad(PlainObject& object, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const auto first = static_cast<std::uint32_t>(object.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& corner : {a, b, c, d})
        object.vertices.push_back({corner, normal, {0, 0}});
    for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U})
        object.indices.push_back(first + index);
}

void addBox(PlainObject& object, glm::vec3 low, glm::vec3 high) {
    const auto corner = [&](int x, int y, int z) {
        return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    addQuad(object, corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
    addQuad(object, corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
    addQuad(object, corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
    addQuad(object, corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    addQuad(object, corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
    addQuad(object, corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
}

void addBall(PlainObject& object, glm::vec3 middle, float radius) {
    constexpr std::uint32_t columns = 64;
    constexpr std::uint32_t rows = 32;
    constexpr double pi = 3.14159265358979324;
    const auto first = static_cast<std::uint32_t>(object.vertices.size());
    for (std::uint32_t row = 0; row <= rows; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const glm::dvec2 uv(double(column) / columns, double(row) / rows);
            const glm::vec3 normal(std::sin(pi * uv.y) * std::sin(2 * pi * uv.x), std::cos(pi * uv.y),
                                   std::sin(pi * uv.y) * std::cos(2 * pi * uv.x));
            object.vertices.push_back({middle + radius * normal, normal, glm::vec2(uv)});
        }
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = first + row * (columns + 1) + column;
            const std::uint32_t b = a + columns + 1;
            for (const std::uint32_t index : {a, b, b + 1, a, b + 1, a + 1})
                object.indices.push_back(index);
        }
}

} // namespace gll::gbuffer
