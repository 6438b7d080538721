// From which sizes on splines are drawn otherwise: for the pyramid, and for who looks for its result.
#pragma once

namespace gll::pyramid_bloom {

// Below this, a bilinear fetch of level 0 at an odd size gives one texel up to 1 % more light than the next.
// Where splines draw a frame whose shorter side is less, its bloom is a target of its own, "bloom", of the
// frame's size; else it is "bloom0", of half that.
inline constexpr int smallest_large_px = 64;

// From here on, the linear spline's heights do for its areas where a side is odd: the weights of the pixels
// in the middle add up to 1 + 1 / side at most.
inline constexpr int smallest_with_heights_px = 128;

} // namespace gll::pyramid_bloom
