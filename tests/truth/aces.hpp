// The Academy's own picture rendering, to judge tone curves by that claim to fit it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace gll::truth {

// ACES 1.0's RRT and its ODT for a video display of 100 cd/m^2 in dim surround, as OpenColorIO ships them
// ("SDR-VIDEO_1.0"): from linear scene light with BT.709 primaries (0.18 is mid grey) to linear display light
// with BT.709 primaries in [0, 1], adapted from ACES white to D65 (Bradford), clamped to the display's
// colours. Scene light is clamped to +-65504, the range of ACES colours. OpenColorIO computes in float32, its
// curve as a table: errors of up to 1e-4 are its own. Throws std::invalid_argument for colours that are not
// finite, std::runtime_error where OpenColorIO lacks the transform.
std::vector<glm::dvec3> acesDisplayLight(const std::vector<glm::dvec3>& linear_colors);

} // namespace gll::truth
