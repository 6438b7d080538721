// Exact blurs to judge filters by: convolution in double with any point spread function, and Gaussians.
#pragma once

#include "measure/raster.hpp"

#include <vector>

namespace gll::truth {

using measure::ColorImage;
using measure::ScalarImage;

// What lies beyond the picture's edges.
enum class Edge {
    zero,  // nothing: light spreads out of the picture and is lost
    clamp, // the nearest pixel's colour, as GL_CLAMP_TO_EDGE
    mirror // the picture's mirror image, as GL_MIRRORED_REPEAT: no light is lost
};

// The picture convolved with the point spread function, whose centre is pixel (width / 2, height / 2),
// rounded down; same size as the picture. A light of 1 becomes the point spread function as it is, not
// normalised. By FFT (FFTW, double): the rounding error is some 1e-16 of the largest sum, so where the truth
// is 0, tiny values of either sign come out. Throws std::invalid_argument where a value is not finite or a
// picture empty. Not for several threads at once: FFTW plans are made one at a time.
ScalarImage convolved(const ScalarImage& image, const ScalarImage& point_spread, Edge edge);
ColorImage convolved(const ColorImage& image, const ScalarImage& point_spread, Edge edge); // each channel

// Where the light of a response lies: sum, centroid and variances along x and y about it, in pixels and their
// squares. Pixel centres are whole numbers.
struct Moments {
    double sum = 0;
    double mean_x_px = 0;
    double mean_y_px = 0;
    double variance_x_px2 = 0;
    double variance_y_px2 = 0;

    double variance_px2() const { return (variance_x_px2 + variance_y_px2) / 2; } // of one axis
};
// Throws std::invalid_argument where the values' sum is 0.
Moments moments(const ScalarImage& response);

// A round point spread function: shares, which add up to 1, of Gaussians.
struct GaussianMixture {
    struct Part {
        double share = 1;
        double sigma_px = 1;
    };
    std::vector<Part> parts;

    double variance_px2() const; // along one axis: the sum of share * sigma^2
};

// The mixture with all sigmas scaled so that its variance along an axis is that of a filter to compare with:
// bloom's fixed target. For one part this is the Gaussian of that variance. Throws where it is not positive.
GaussianMixture matched(GaussianMixture mixture, double variance_px2);

// The mixture's values at pixel centres, normalised to sum 1; a square of 2 radius + 1 pixels, where radius
// covers the widest part to 6.5 sigma (beyond lies 1e-10 of it), but at least one pixel. Samples of a
// Gaussian narrower than a pixel have another variance: 0.02 % off at a sigma of 0.8 pixels, 14 % at 0.5.
// Throws std::invalid_argument where shares do not add up to 1, a sigma is not positive, or radius is over
// 4096.
ScalarImage pointSpread(const GaussianMixture& mixture);

} // namespace gll::truth
