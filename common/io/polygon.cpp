// Cutting polygons by their ears.
#include "io/polygon.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gll {

glm::dvec3 areaNormal(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    return normal;
}

std::vector<std::array<std::size_t, 3>> cutPolygon(const std::vector<glm::dvec3>& corners) {
    std::vector<std::array<std::size_t, 3>> triangles;
    const glm::dvec3 normal = areaNormal(corners);
    // Twice the signed area of three corners as the polygon's front sees them.
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        return glm::dot(normal, glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };

    std::vector<std::size_t> rest(corners.size());
    std::iota(rest.begin(), rest.end(), std::size_t(0));
    while (rest.size() > 3) {
        std::size_t ear = 0;
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const std::size_t a = rest[(i + rest.size() - 1) % rest.size()];
            const std::size_t b = rest[i];
            const std::size_t c = rest[(i + 1) % rest.size()];
            // Of all ears the one whose cut is shortest: for quads that is the usual choice of diagonal.
            const double cut = glm::dot(corners[c] - corners[a], corners[c] - corners[a]);
            if (!(turn(a, b, c) > 0.0) || !(cut < shortest)) continue;
            const bool free = std::none_of(rest.begin(), rest.end(), [&](std::size_t p) {
                return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
                       turn(c, a, p) >= 0.0;
            });
            if (!free) continue;
            ear = i;
            shortest = cut;
        }
        triangles.push_back(
            {rest[(ear + rest.size() - 1) % rest.size()], rest[ear], rest[(ear + 1) % rest.size()]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({rest[0], rest[1], rest[2]});
    return triangles;
}

} // namespace gll
