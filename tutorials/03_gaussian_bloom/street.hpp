// The scene of 03_gaussian_bloom: a street at night, with lamps, signs, windows and a string of lanterns.
#pragma once

#include "gl/mesh.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace gll::gaussian_bloom {

// What shines on walls and ground. Positions in metres, y up; colours are linear radiant intensity.
struct StreetLights {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> colors;
};

inline constexpr int street_light_count = 8;

// The street along -z between houses, and once more mirrored in the ground (y = 0): what wet asphalt shows.
// Locations 0: position, 1: normal, of the mirrored half as before mirroring, 2: albedo, 3: emitted light,
// linear, 4: 1 where that light swells and fades with pulseAt(), else 0.
Mesh makeStreet();

// Factor on the light of the sign at the street's end: it crosses the threshold of 1 twice in five seconds.
float pulseAt(float time_s);

StreetLights streetLightsAt(float time_s);

} // namespace gll::gaussian_bloom
