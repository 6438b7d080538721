// The kernels and taps of 03_gaussian_bloom against the formulas.
#include "03_gaussian_bloom/gaussian_blur.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace gll::truth {
namespace {

using namespace gaussian_bloom;

constexpr double nine[] = {0.227027, 0.1945946, 0.1216216, 0.054054, 0.016216}; // as printed

double sumOf(const std::vector<double>& kernel) {
    double sum = -kernel[0];
    for (const double weight : kernel)
        sum += 2 * weight;
    return sum;
}

// Of the taps as points, without what linear fetches add.
double pointVariance(const BlurTaps& taps) {
    double sum = 0;
    for (std::size_t i = 1; i < taps.offsets.size(); ++i)
        sum += 2.0 * taps.weights[i] * taps.offsets[i] * taps.offsets[i];
    return sum;
}

TEST(GaussianKernels, weighOneInAllAndHaveTheVarianceTheyAreAskedFor) {
    for (const double sigma : {0.7, 1.0, 2.5, 3.78, 11.18, 32.0}) {
        const std::vector<double> kernel = gaussianKernel(sigma);
        EXPECT_NEAR(sumOf(kernel), 1, 1e-12) << sigma;
        // Beyond 4 sigma lies 0.11 % of it; a bell narrower than a texel lies oddly on the grid.
        EXPECT_NEAR(variance(kernel) / (sigma * sigma), 1, sigma < 1 ? 0.003 : 0.0012) << sigma;
        for (std::size_t i = 0; i < kernel.size(); ++i) { // the area under a bell of that width
            const double x = static_cast<double>(i) / sigma;
            const double expected = std::exp(-x * x / 2) / (sigma * std::sqrt(2 * std::numbers::pi));
            EXPECT_NEAR(kernel[i], expected, 3e-4 * kernel[0]) << sigma << " at " << i;
        }
    }
    EXPECT_EQ(gaussianKernel(0), std::vector<double>{1});
}

TEST(GaussianKernels, ofTheNineTapsAreThePrintedWeights) {
    const std::vector<double> kernel = kernelOf(nineTaps());
    double nine_variance = 0;
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(kernel[i], nine[i], 1e-7);
        nine_variance += 2 * nine[i] * static_cast<double>(i * i);
    }
    EXPECT_NEAR(sumOf(kernel), 1, 1e-6);
    EXPECT_NEAR(variance(nineTaps()), nine_variance, 1e-6);
    EXPECT_NEAR(std::sqrt(5 * variance(nineTaps())), 3.78, 0.005); // what the page says of five pairs
}

TEST(GaussianKernels, betweenTexelsAreWhatLinearFetchesReach) {
    const BlurTaps taps = {.offsets = {0, 0.25F, 1.75F}, .weights = {0.4F, 0.2F, 0.1F}};
    const std::vector<double> kernel = kernelOf(taps);
    EXPECT_NEAR(kernel[0], 0.4 + 2 * 0.2 * 0.75, 1e-7); // from both sides
    EXPECT_NEAR(kernel[1], 0.2 * 0.25 + 0.1 * 0.25, 1e-7);
    EXPECT_NEAR(kernel[2], 0.1 * 0.75, 1e-7);
    EXPECT_NEAR(sumOf(kernel), 1, 1e-6);
}

TEST(GaussianKernels, mergedInPairsWeighEveryTexelAsBefore) {
    std::vector<std::vector<double>> kernels = {
        {1}, {0.5, 0.25}, kernelOf(nineTaps()), kernelOf(nineTaps(0.83))};
    for (const double sigma : {0.1, 1.0, 4.0, 11.18, 32.0})
        kernels.push_back(gaussianKernel(sigma));
    for (const std::vector<double>& kernel : kernels) {
        const BlurTaps merged = mergedTaps(kernel);
        EXPECT_LE(merged.count(), 1 + static_cast<int>(kernel.size()) / 2);
        std::vector<double> again = kernelOf(merged);
        again.resize(std::max(again.size(), kernel.size()));
        for (std::size_t i = 0; i < again.size(); ++i)
            EXPECT_NEAR(again[i], i < kernel.size() ? kernel[i] : 0, 1e-6) << i << " of " << kernel.size();
    }
    EXPECT_EQ(mergedTaps(kernelOf(nineTaps())).count(), 3); // five fetches
}

TEST(ImportanceTaps, lieInTheMiddleOfFiveEqualPartsAndAreNarrowAsPrinted) {
    const BlurTaps printed = importanceTaps(1, false);
    const auto area = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
    EXPECT_NEAR(area(printed.offsets[1]), 0.7, 2e-4);
    EXPECT_NEAR(area(printed.offsets[2]), 0.9, 2e-4);
    EXPECT_NEAR(pointVariance(printed), 0.767, 5e-4);
    EXPECT_NEAR(pointVariance(importanceTaps(2.5, true)), 2.5 * 2.5, 1e-5);
    EXPECT_NEAR(importanceTaps(1, true).offsets[2] / printed.offsets[2], 1.1417, 5e-5);
}

} // namespace
} // namespace gll::truth
