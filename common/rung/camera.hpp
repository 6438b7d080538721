// The camera of a frame: scripted by the rung, turned and zoomed by settings, so that a view found with the
// mouse can be had again on the command line.
#pragma once

#include "rung/settings.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gll {

struct Camera {
    glm::vec3 position{0, 0, 1};
    glm::vec3 target{0, 0, 0};
    float vertical_field_of_view_deg = 60;
    float near = 0.1F;
    float far = 100;

    glm::mat4 viewFromWorld() const;            // right-handed, looking down -z, y up
    glm::mat4 clipFromView(float aspect) const; // the standard perspective matrix, depth in [-1, 1]
};

// Three settings that orbit a scripted camera about its target; at their defaults they change nothing.
struct OrbitSettings {
    explicit OrbitSettings(Settings& settings);

    Number yaw_deg;
    Number pitch_deg;
    Number zoom;

    Camera apply(const Camera& scripted) const;
};

} // namespace gll
