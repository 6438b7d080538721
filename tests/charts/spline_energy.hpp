// What the splines of 04_pyramid_bloom make of the light of one pixel, in exact arithmetic: quick enough for
// every size of a frame.
#pragma once

#include <vector>

namespace gll::charts {

// Of a light at each place along one side of a frame, what arrives on the whole side by way of each level
// that adds its light: 1 where none is lost or made. The filters are separable, so that of a level in two
// dimensions arrives the product of both sides' shares.
using SplineShares = std::vector<std::vector<double>>; // [level][place]

// shorter_side_px: the frame's, which decides how its levels are weighed.
SplineShares splineShares(int side_px, int shorter_side_px, int levels);

// The light that arrives of a light of 1, divided by the number of levels.
double splineLight(const SplineShares& across, const SplineShares& down, int x, int y);

// How far at most that is from 1, for any place in any frame with sides from 2 to largest_side_px.
double largestSplineEnergyError(int levels, int largest_side_px);

} // namespace gll::charts
