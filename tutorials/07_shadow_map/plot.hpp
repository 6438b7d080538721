// A plot where shadow maps are put to the test: surfaces of every slope, a thin wall, a pole, two plates one
// above the other, boxes side by side, and a plate high above, behind what the sun's view holds.
#pragma once

#include "06_gbuffer/scene.hpp"

#include <vector>

namespace gll::shadow_map {

// World space, on the plane y = 0, at most 6 from the origin; the high plate is 12 up.
std::vector<gbuffer::PlainObject> makePlot();

} // namespace gll::shadow_map
