// Balls, and two skies that are formulas.
#include "balls.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <iterator>

namespace gll::environment_light {

std::vector<Ball> balls() {
    struct Row {
        glm::vec3 f0, albedo;
    };
    const Row rows[] = {{glm::vec3(1), glm::vec3(0)},
                        {{1.0F, 0.77F, 0.34F}, glm::vec3(0)},
                        {glm::vec3(0.04F), {0.03F, 0.24F, 0.28F}}};
    std::vector<Ball> balls;
    for (std::size_t row = 0; row < std::size(rows); ++row)
        for (std::size_t column = 0; column < std::size(ball_roughnesses); ++column)
            balls.push_back(
                {.middle = {1.1F * (static_cast<float>(column) - 3), 1.1F * (1 - static_cast<float>(row)), 0},
                 .roughness = ball_roughnesses[column],
                 .f0 = rows[row].f0,
                 .albedo = rows[row].albedo});
    return balls;
}

Camera ballsCamera(float time_s) {
    const float sway_rad = 0.2F * std::sin(0.5F * time_s);
    return {.position = {12 * std::sin(sway_rad), 1.2F, 12 * std::cos(sway_rad)},
            .target = {0, 0, 0},
            .vertical_field_of_view_deg = 30,
            .near = 1,
            .far = 40};
}

Mesh makeBalls(const std::vector<Ball>& balls) {
    const glm::vec2 corners[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    return Mesh({.vertices = std::as_bytes(std::span(corners)),
                 .vertex_stride_bytes = sizeof(glm::vec2),
                 .attributes = {{0, 2, 0}},
                 .instances = std::as_bytes(std::span(balls)),
                 .instance_stride_bytes = sizeof(Ball),
                 .instance_attributes = {{1, 3, offsetof(Ball, middle)},
                                         {2, 1, offsetof(Ball, roughness)},
                                         {3, 3, offsetof(Ball, f0)},
                                         {4, 3, offsetof(Ball, albedo)}}});
}

RadianceMap furnace() {
    return {.width = 64, .height = 32, .pixels = std::vector<glm::vec3>(64 * 32, glm::vec3(1))};
}

RadianceMap smallSun() {
    RadianceMap map{.width = 1024, .height = 512, .pixels = {}};
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.4, 0.8, 0.5));
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const glm::dvec3 direction = directionOf((column + 0.5) / map.width, (row + 0.5) / map.height);
            const bool is_sun = glm::dot(direction, to_sun) > std::cos(0.5 * 0.01745329);
            const glm::vec3 sky =
                glm::vec3(0.008F, 0.01F, 0.014F) * static_cast<float>(0.6 + 0.4 * direction.y);
            map.pixels.push_back(is_sun ? glm::vec3(0.01F * 0x1p21F) : sky);
        }
    return map;
}

} // namespace gll::environment_light
