// What is lit: three rows of balls from mirror to chalk, and skies that put methods to the test.
#pragma once

#include "gl/mesh.hpp"
#include "radiance_map.hpp"
#include "rung/camera.hpp"

#include <vector>

namespace gll::environment_light {

inline constexpr float ball_radius = 0.5F; // world units

struct Ball {
    glm::vec3 middle; // world
    float roughness;
    glm::vec3 f0;     // reflectance along the normal
    glm::vec3 albedo; // of the matt part, linear
};

// From the top: metal that absorbs nothing, gold, glazed clay; from the left: rougher.
inline constexpr float ball_roughnesses[] = {0, 0.05F, 0.1F, 0.25F, 0.5F, 0.75F, 1};
std::vector<Ball> balls();
Camera ballsCamera(float time_s);

// A square for each ball, to be turned to the camera. Attribute 0: corner; of each ball 1: middle, 2:
// roughness, 3: f0, 4: albedo.
Mesh makeBalls(const std::vector<Ball>& balls);

RadianceMap furnace();  // 1 from everywhere: what absorbs nothing is not seen before it
RadianceMap smallSun(); // 21 stops brighter than the dim sky about it, one degree wide

} // namespace gll::environment_light
