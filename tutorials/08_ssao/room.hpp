// Rooms that put ambient occlusion to the test.
#pragma once

#include "06_gbuffer/scene.hpp"
#include "rung/camera.hpp"

#include <string_view>
#include <vector>

namespace gll::ssao {

// The corner of a room with what occlusion on the screen gets wrong: a chair on thin legs, a deep shelf,
// balls that touch the floor, and a pole farther from the wall behind it than occlusion reaches.
std::vector<gbuffer::PlainObject> makeRoom();

// Nothing but a floor at y = 0 and a wall at z = 0, both wider than is seen: what is right is known exactly.
std::vector<gbuffer::PlainObject> makeCorner();

// From where a scene, "cat", "room" or "corner", is seen.
Camera cameraOf(std::string_view scene, float time_s);

} // namespace gll::ssao
