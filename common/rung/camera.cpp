// Camera matrices and orbiting.
#include "rung/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace gll {

glm::mat4 Camera::viewFromWorld() const { return glm::lookAt(position, target, glm::vec3(0, 1, 0)); }

glm::mat4 Camera::clipFromView(float aspect) const {
    return glm::perspective(glm::radians(vertical_field_of_view_deg), aspect, near, far);
}

OrbitSettings::OrbitSettings(Settings& settings)
    : yaw_deg(settings.number("camera_yaw_deg", 0, -360, 360, "turns the camera about its target, degrees")),
      pitch_deg(
          settings.number("camera_pitch_deg", 0, -180, 180, "raises the camera about its target, degrees")),
      zoom(settings.number("camera_zoom", 1, 0.1, 10, "divides the camera's distance to its target")) {
    settings.role(Setting::Role::orbit_yaw, {"camera_yaw_deg"});
    settings.role(Setting::Role::orbit_pitch, {"camera_pitch_deg"});
    settings.role(Setting::Role::orbit_zoom, {"camera_zoom"});
    settings.group(Setting::Group::camera, {"camera_yaw_deg", "camera_pitch_deg", "camera_zoom"});
}

Camera OrbitSettings::apply(const Camera& scripted) const {
    if (yaw_deg == 0.0F && pitch_deg == 0.0F && zoom == 1.0F) return scripted; // bit for bit the rung's own
    constexpr float highest_rad = 1.55F; // just short of the pole, where "up" would have no direction
    const glm::vec3 arm = scripted.position - scripted.target;
    const float distance = std::max(glm::length(arm), 1e-3F);
    const float yaw_rad = std::atan2(arm.z, arm.x) + glm::radians(float(yaw_deg));
    const float pitch_rad =
        std::clamp(std::asin(arm.y / distance) + glm::radians(float(pitch_deg)), -highest_rad, highest_rad);
    Camera camera = scripted;
    camera.position =
        scripted.target + distance / float(zoom) *
                              glm::vec3(std::cos(pitch_rad) * std::cos(yaw_rad), std::sin(pitch_rad),
                                        std::cos(pitch_rad) * std::sin(yaw_rad));
    return camera;
}

} // namespace gll
