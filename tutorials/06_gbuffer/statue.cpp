// Fitting a model between the floor and the camera's view.
#include "statue.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace gll::gbuffer {
namespace {

constexpr float statue_height = 2.2F;
constexpr float statue_radius = 1.35F; // of the sphere round a model; the cat's is a little smaller
constexpr float least_height = 0.005F;

} // namespace

StatuePlace::StatuePlace(const MeshData& data, const std::filesystem::path& path)
    : is_turned_(data.front_is_positive_z) {
    glm::vec3 lowest = data.positions.front();
    glm::vec3 highest = lowest;
    for (const glm::vec3& position : data.positions) {
        lowest = glm::min(lowest, position);
        highest = glm::max(highest, position);
    }
    const glm::dvec3 middle = 0.5 * (glm::dvec3(lowest) + glm::dvec3(highest));
    double radius = 0;
    for (const glm::vec3& position : data.positions)
        radius = std::max(radius, glm::distance(glm::dvec3(position), middle));
    const float height = highest.y - lowest.y;
    scale_ = std::min(statue_height / height, static_cast<float>(statue_radius / radius));
    if (!std::isfinite(scale_))
        throw std::runtime_error(path.string() + ": all of its vertices lie at one place; export it again");
    base_ = glm::vec3(0.5F * (lowest.x + highest.x), lowest.y, 0.5F * (lowest.z + highest.z));
    // What lies flat would fight with the floor for each pixel.
    lift_ = glm::vec3(0, height * scale_ < least_height ? least_height : 0.0F, 0);
}

} // namespace gll::gbuffer
