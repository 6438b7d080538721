// Bump maps: heights as the normals that shading needs, and normal maps that are named as if they were
// heights.
#pragma once

#include "io/mesh.hpp"

#include <cstdint>
#include <vector>

namespace gll::gbuffer {

// Whether 8-bit colors are directions rather than heights: nine tenths of them decode, as 2 c - 1, to vectors
// within 0.2 of unit length that point out of the surface and are blue. No grey does: where its three
// channels agree, a vector of unit length is (0.58, 0.58, 0.58), code 201, or points inwards.
bool looksLikeNormalMap(const Image& image);

// A tangent-space normal map, three bytes a pixel, green up the image, by central differences. channel: which
// of the image's is the height; scale: what white is higher than black by, in texels. Slopes at the edges are
// those of an image that repeats.
std::vector<std::uint8_t> normalsFromHeights(const Image& image, int channel, float scale);

} // namespace gll::gbuffer
