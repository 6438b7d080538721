// What 06_gbuffer adds to the cat on its floor: polished balls, and a row of signs out to the horizon.
#pragma once

#include "scene.hpp"

#include <vector>

namespace gll::gbuffer {

// Distances of the signs from the origin, down the negative z axis, world units. Each carries a plate that
// stands out by sign_lift: what a depth buffer cannot tell apart fights for the pixels.
inline constexpr float sign_distances[] = {10, 20, 40, 80, 160, 320, 640, 900};
inline constexpr float sign_lift = 0.02F;

std::vector<PlainObject> makeYard();

} // namespace gll::gbuffer
