// Balls and signs, as triangles.
#include "yard.hpp"

#include "solids.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>

namespace gll::gbuffer {
namespace {

// A rectangle that faces +z, its lower left corner at `corner`.
void addRectangle(PlainObject& object, glm::vec3 corner, glm::vec2 size) {
    const auto first = static_cast<std::uint32_t>(object.vertices.size());
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        object.vertices.push_back({corner + glm::vec3(at * size, 0), {0, 0, 1}, {at.x, 1 - at.y}});
    for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U})
        object.indices.push_back(first + index);
}

} // namespace

std::vector<PlainObject> makeYard() {
    std::vector<PlainObject> yard;
    struct Ball {
        glm::vec3 middle;
        float radius, shininess;
        glm::vec3 color;
    };
    // The sharper a highlight, the more it shows of the normals it is made from.
    for (const Ball& ball : {Ball{{-2.35F, 0.6F, 0.9F}, 0.6F, 8192, {0.02F, 0.02F, 0.025F}},
                             Ball{{-1.15F, 0.4F, 2.0F}, 0.4F, 1024, {0.03F, 0.08F, 0.25F}},
                             Ball{{1.2F, 0.4F, 2.1F}, 0.4F, 128, {0.25F, 0.05F, 0.03F}},
                             Ball{{2.3F, 0.6F, 1.0F}, 0.6F, 16, {0.06F, 0.2F, 0.05F}}}) {
        PlainObject object = plain(ball.color);
        addBall(object, ball.middle, ball.radius);
        object.specular = 0.6F;
        object.shininess = ball.shininess;
        yard.push_back(object);
    }
    PlainObject boards = plain({0.05F, 0.05F, 0.06F});
    PlainObject plates = plain({0.8F, 0.35F, 0.05F});
    constexpr float sideways[] = {0.2F,  -0.2F,  0.34F, -0.34F,
                                  0.47F, -0.47F, 0.11F, -0.11F}; // of the distance
    for (std::size_t i = 0; i < std::size(sign_distances); ++i) {
        const float distance = sign_distances[i];
        const glm::vec2 size(0.11F * distance, 0.13F * distance);
        const glm::vec3 corner(sideways[i] * distance - 0.5F * size.x, 0.02F * distance, -distance);
        addRectangle(boards, corner, size);
        addRectangle(plates, corner + glm::vec3(0.2F * size, sign_lift), 0.6F * size);
    }
    yard.push_back(boards);
    yard.push_back(plates);
    return yard;
}

} // namespace gll::gbuffer
