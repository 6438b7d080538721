// Numbers for how far a picture is from its reference, and a filter from one that does not care where a light
// is. Every function throws std::invalid_argument where sizes differ or a colour is not finite.
#pragma once

#include "measure/raster.hpp"

#include <glm/vec2.hpp>
#include <vector>

namespace gll::measure {

// Root of the mean squared difference over all pixels and channels, in the pictures' own unit.
double rmse(const ColorImage& image, const ColorImage& reference);

// Peak signal to noise ratio in dB of display values, whose peak is 1: -20 log10(RMSE). Infinite for RMSE 0.
double psnrDb(double display_rmse);

// sqrt(mean((x - r)^2 / (r^2 + e))) over all pixels and channels of linear light: the root of the relMSE of
// Rousselle, Knaus, Zwicker 2011, whose e is 0.01.
double relativeRmse(const ColorImage& image, const ColorImage& reference, double e = 0.01);

// Root mean squared difference of log2(e + luminance), in EV. Luminance below 0 counts as 0; e, which keeps
// black from counting for everything, is that of Reinhard's log-average.
double log2RmseEv(const ColorImage& image, const ColorImage& reference, double e = 1e-4);

// Sum of all channels over that of the reference: what a filter makes of the light. 1 where both are 0,
// infinite where only the reference is.
double energyRatio(const ColorImage& image, const ColorImage& reference);

// exp(mean(log(d + luminance))), Reinhard et al. 2002, equation 1 as it was meant: 1/N stands inside the exp.
// Luminance below 0 counts as 0; d must be positive.
double logAverage(const ColorImage& linear_image, double d = 1e-4);

// log2(measured / truth): how far off an exposure is, in EV. Throws unless both are positive and finite.
double evError(double measured, double truth);

// How much a filter's response to one emitter depends on where the emitter is.
struct ShiftVariance {
    double mean = 0;    // over the responses; 0.0135 is 1.35 %
    double largest = 0; // of a single response
};

// Each response is moved back by its shift; their mean is what a filter that does not care would give
// everywhere; a response's deviation from it is the sum of absolute differences over the sum of the mean's
// absolute values, all channels together. Only pixels that every response has are looked at. The shifts,
// whole pixels, must run once over a whole period (2^levels pixels for a pyramid) in x, in y, or in both, or
// else the mean would favour some places: throws where they do not, where responses and shifts differ in
// number, where the moved pictures share no pixel, and where their mean is black.
ShiftVariance shiftVariance(const std::vector<ColorImage>& responses,
                            const std::vector<glm::ivec2>& shifts_px, int period_px);

} // namespace gll::measure
