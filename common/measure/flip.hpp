// FLIP: the difference a person sees when alternating between two pictures, per pixel.
// Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images" (LDR-FLIP), and Andersson et
// al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images" (HDR-FLIP), from their formulas.
#pragma once

#include "measure/raster.hpp"

#include <functional>
#include <limits>

namespace gll::measure {

// The paper's observer: 0.7 m before a monitor 0.7 m wide with 3840 pixels, pi / 180 * 3840 = 67.02.
inline constexpr double default_pixels_per_degree = 67;
inline constexpr double least_pixels_per_degree = 1;
inline constexpr double most_pixels_per_degree = 1000; // filters have radii of up to 136 pixels then

// How many pixels away a pixel's colour still counts: the radius of the widest filter. Throws
// std::invalid_argument where pixels_per_degree is out of range.
int flipReachPx(double pixels_per_degree);

// The rows of a map that are wanted, both included; the others stay 0. What lies around them counts all the
// same.
struct Rows {
    int first = 0;
    int last = std::numeric_limits<int>::max();
};

// LDR-FLIP of two pictures in linear display light (decoded; values outside [0, 1] are clamped, as displays
// do): for each pixel 0 (no difference) to 1. Beyond the edges the nearest pixel's colour goes on. Symmetric.
// Throws std::invalid_argument where sizes differ, a colour is not finite, or pixels_per_degree is out of
// range.
ScalarImage flip(const ColorImage& display_light, const ColorImage& reference_display_light,
                 double pixels_per_degree = default_pixels_per_degree, const Rows& rows = {});

// The exposures that HDR-FLIP looks at, in EV: `count` of them, evenly from start to stop.
struct Exposures {
    double start_ev = 0;
    double stop_ev = 0;
    int count = 1;

    double at(int i) const; // in EV, i from 0
};

// The paper's choice: the first takes the reference's largest luminance to 0.85 behind the tone curve, the
// last its median; one for each EV between, at least two. Light below 0 counts as 0. Where the paper has no
// answer: a median of 0 gives way to that of the pixels with light, and a black reference is looked at once,
// at 0 EV.
Exposures flipExposures(const ColorImage& linear_reference);

struct HdrFlip {
    ScalarImage map; // of each pixel the largest LDR-FLIP of all exposures
    Exposures exposures;
};

// HDR-FLIP of two pictures in linear light: LDR-FLIP behind every exposure and the ACES tone curve (Narkowicz
// 2015). The exposures are the reference's, so it is not symmetric. `progress`, where given, is called before
// each exposure with its number from 0 and how many there are. Throws as flip() does.
HdrFlip hdrFlip(const ColorImage& linear_image, const ColorImage& linear_reference,
                double pixels_per_degree = default_pixels_per_degree,
                const std::function<void(int, int)>& progress = {});

// The map alone, for exposures chosen before: those of a whole picture where only a part of it is given.
ScalarImage hdrFlip(const ColorImage& linear_image, const ColorImage& linear_reference,
                    const Exposures& exposures, double pixels_per_degree, const Rows& rows = {});

// The map of two images of one kind: FLIP of display values (color space srgb), HDR-FLIP of linear light.
// What flip() and hdrFlip() say of their linearColor(), to the bit, but computed only where a difference
// reaches, and large images by several threads. Throws std::invalid_argument as those do, and where the
// images' sizes, channels or color spaces differ.
ScalarImage flipMap(const Image& image, const Image& reference,
                    double pixels_per_degree = default_pixels_per_degree);

// What a map of errors is told by. The weighted median weighs each pixel by its error:
// half of all the error lies in pixels above it; 0 where nothing differs.
struct FlipSummary {
    double mean = 0;
    double weighted_median = 0;
    double largest = 0;
};
FlipSummary summary(const ScalarImage& map);

// Errors in [0, 1] as colours, 8-bit RGB: black, indigo, crimson, amber, pale yellow, straight lines in sRGB
// between them, so that more error is always lighter.
Image heatMap(const ScalarImage& map);

} // namespace gll::measure
