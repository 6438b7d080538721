// The scene of 02_auto_exposure: a sunlit court, an arcade, and the dark hall behind it, all boxes and
// arches.
#pragma once

#include "gl/mesh.hpp"
#include "rung/camera.hpp"

namespace gll::auto_exposure {

// After as many frames the walk begins anew, to the bit.
inline constexpr int walk_frames = 960;

// Metres; y is up, the arcade's outer face is the plane z = 0, the court lies at z > 0. Locations 0:
// position, 1: normal, 2: albedo (or emitted radiance), 3: surface, one of the SURFACE_ numbers in
// scene.frag.
Mesh makeCourtAndHall();

// From the court through the middle arch into the hall, round, and out again: a closed, smooth path.
Camera walk(int frame_number);

} // namespace gll::auto_exposure
