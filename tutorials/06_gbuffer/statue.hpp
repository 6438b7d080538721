// Where a model stands in the scene of the deferred rungs.
#pragma once

#include "io/mesh.hpp"

#include <filesystem>
#include <glm/vec3.hpp>

namespace gll::gbuffer {

// From the model to the world: on the floor with its middle on the y axis, as high as a statue and no wider
// than the circle in which the camera sees all of it, looking along +x, to where the camera is at first.
class StatuePlace {
  public:
    // Throws std::runtime_error naming the file of a model that has no extent.
    StatuePlace(const MeshData& data, const std::filesystem::path& path);

    glm::vec3 position(glm::vec3 of_model) const { return direction((of_model - base_) * scale_) + lift_; }
    glm::vec3 direction(glm::vec3 of_model) const {
        return is_turned_ ? glm::vec3(of_model.z, of_model.y, -of_model.x) : of_model;
    }

  private:
    glm::vec3 base_;
    float scale_;
    glm::vec3 lift_;
    bool is_turned_;
};

} // namespace gll::gbuffer
