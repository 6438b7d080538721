// The scene of 05_hdr_bloom: a cube, many times, along a closed curve in space.
#pragma once

#include "gl/mesh.hpp"

namespace gll::hdr_bloom {

// A faceted unit cube (locations 0: position, 1: normal) with one instance for each of count cubes (2:
// offset, 3: colour, 4: phase, 5: glows). Cube i glows where i % glow_every == glow_first; none does where
// glow_every is 0.
Mesh makeSwarm(int count, int glow_every, int glow_first);

} // namespace gll::hdr_bloom
