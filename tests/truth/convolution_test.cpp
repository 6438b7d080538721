// Convolution by FFT against sums written out, and Gaussians by their moments.
#include "support/messages.hpp"
#include "truth/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>
#include <utility>

namespace gll::truth {
namespace {

ScalarImage noise(unsigned seed, int width, int height) {
    std::mt19937 random(seed);
    ScalarImage image(width, height);
    for (double& value : image.pixels)
        value = double(random()) / 4294967296.0 - 0.25;
    return image;
}

double direct(const ScalarImage& image, const ScalarImage& spread, Edge edge, int x, int y) {
    double sum = 0;
    for (int j = 0; j < spread.height; ++j)
        for (int i = 0; i < spread.width; ++i) {
            const int from_x = x - (i - spread.width / 2);
            const int from_y = y - (j - spread.height / 2);
            const auto inside = [&](int at, int size) {
                if (edge != Edge::mirror) return std::clamp(at, 0, size - 1);
                while (at < 0 || at >= size)
                    at = at < 0 ? -1 - at : 2 * size - 1 - at;
                return at;
            };
            const int near_x = inside(from_x, image.width);
            const int near_y = inside(from_y, image.height);
            if (edge != Edge::zero || (near_x == from_x && near_y == from_y))
                sum += spread.at(i, j) * image.at(near_x, near_y);
        }
    return sum;
}

TEST(Convolution, isTheSumItStandsFor) {
    const std::pair<int, int> sizes[] = {{1, 1}, {2, 5}, {7, 3}, {16, 16}, {23, 1}};
    const std::pair<int, int> spreads[] = {{1, 1}, {3, 3},  {5, 2},
                                           {4, 4}, {1, 31}, {21, 13}}; // even ones too
    for (const auto& [width, height] : sizes)
        for (const auto& [spread_width, spread_height] : spreads)
            for (const Edge edge : {Edge::zero, Edge::clamp, Edge::mirror}) {
                const ScalarImage image = noise(1, width, height);
                const ScalarImage spread = noise(2, spread_width, spread_height);
                const ScalarImage result = convolved(image, spread, edge);
                ASSERT_EQ(result.width, width);
                ASSERT_EQ(result.height, height);
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x)
                        ASSERT_NEAR(result.at(x, y), direct(image, spread, edge, x, y), 1e-12)
                            << width << "x" << height << " with " << spread_width << "x" << spread_height
                            << " at " << x << ", " << y << " edge rule " << static_cast<int>(edge);
            }
}

TEST(Convolution, ofAPointIsThePointSpreadFunction) {
    ScalarImage point(32, 24);
    point.at(15, 11) = 1;
    const ScalarImage spread = noise(3, 9, 7);
    const ScalarImage result = convolved(point, spread, Edge::zero);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x)
            ASSERT_NEAR(result.at(15 - 4 + x, 11 - 3 + y), spread.at(x, y), 1e-14);
}

TEST(Convolution, keepsEnergyAndFlatFields) {
    ScalarImage inside(64, 48); // light that stays in the picture
    inside.at(30, 20) = 1000;
    inside.at(33, 25) = 2;
    const ScalarImage spread = pointSpread({{{1, 2.0}}});
    EXPECT_NEAR(moments(convolved(inside, spread, Edge::zero)).sum, 1002, 1e-9);
    for (const double value : convolved(ScalarImage(20, 10, 3), spread, Edge::clamp).pixels)
        ASSERT_NEAR(value, 3, 1e-12) << "with clamped edges a flat field stays flat";
    const ScalarImage dimmed = convolved(ScalarImage(64, 64, 3), spread, Edge::zero);
    EXPECT_NEAR(dimmed.at(32, 32), 3, 1e-9);
    EXPECT_LT(dimmed.at(0, 0), 1.2) << "of a corner, little more than a quarter is left";
}

TEST(Convolution, addsVariances) {
    ScalarImage point(96, 96);
    point.at(40, 50) = 7;
    ScalarImage image = convolved(point, pointSpread({{{1, 3.0}}}), Edge::zero);
    image = convolved(image, pointSpread({{{1, 4.0}}}), Edge::zero);
    const Moments result = moments(image);
    EXPECT_NEAR(result.sum, 7, 1e-9);
    EXPECT_NEAR(result.mean_x_px, 40, 1e-9);
    EXPECT_NEAR(result.mean_y_px, 50, 1e-9);
    EXPECT_NEAR(result.variance_x_px2, 25, 1e-5); // 3^2 + 4^2, less what lies beyond 6.5 sigma
    EXPECT_NEAR(result.variance_y_px2, 25, 1e-5);
}

TEST(Convolution, ofColorsIsThatOfEachChannel) {
    const ScalarImage channels[] = {noise(1, 11, 9), noise(2, 11, 9), noise(3, 11, 9)};
    ColorImage image(11, 9);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {channels[0].pixels[i], channels[1].pixels[i], channels[2].pixels[i]};
    const ScalarImage spread = noise(4, 5, 5);
    const ColorImage result = convolved(image, spread, Edge::clamp);
    for (int c = 0; c < 3; ++c) {
        const ScalarImage expected = convolved(channels[c], spread, Edge::clamp);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_NEAR(result.pixels[i][c], expected.pixels[i], 1e-13);
    }
}

TEST(Gaussians, haveSumOneAndTheirOwnVariance) {
    for (const double sigma_px : {0.8, 1.0, 3.8, 20.0}) {
        const Moments result = moments(pointSpread({{{1, sigma_px}}}));
        EXPECT_NEAR(result.sum, 1, 1e-12) << sigma_px;
        EXPECT_NEAR(result.variance_px2() / (sigma_px * sigma_px), 1, 1e-3) << sigma_px;
    }
    const GaussianMixture mixture{{{0.5, 1}, {0.3, 4}, {0.2, 12}}}; // 0.5 + 4.8 + 28.8
    EXPECT_NEAR(mixture.variance_px2(), 34.1, 1e-12);
    EXPECT_NEAR(moments(pointSpread(mixture)).sum, 1, 1e-12);
    EXPECT_NEAR(moments(pointSpread(mixture)).variance_px2(), 34.1, 1e-5);
}

TEST(Gaussians, matchTheVarianceOfAFilter) {
    ScalarImage box(9, 9, 1); // nine pixels: variance (81 - 1) / 12
    EXPECT_NEAR(moments(box).variance_x_px2, 80 / 12.0, 1e-12);
    for (const GaussianMixture& mixture :
         {GaussianMixture{{{1, 1}}}, GaussianMixture{{{0.5, 1}, {0.3, 4}, {0.2, 12}}}}) {
        const GaussianMixture result = matched(mixture, moments(box).variance_px2());
        EXPECT_NEAR(result.variance_px2(), 80 / 12.0, 1e-12);
        EXPECT_NEAR(result.parts.back().sigma_px / result.parts.front().sigma_px,
                    mixture.parts.back().sigma_px / mixture.parts.front().sigma_px, 1e-12);
    }
}

TEST(Convolution, refusesWhatHasNone) {
    const auto refusal = [](const auto& call) { return test::messageOf<std::invalid_argument>(call); };
    const ScalarImage fine(3, 3, 1);
    ScalarImage broken(3, 3, 1);
    broken.at(1, 1) = std::nan("");
    EXPECT_CONTAINS(refusal([&] { convolved(broken, fine, Edge::zero); }),
                    "picture has values that are not finite");
    EXPECT_CONTAINS(refusal([&] { convolved(fine, broken, Edge::zero); }), "point spread function");
    EXPECT_CONTAINS(refusal([&] { convolved(ScalarImage(), fine, Edge::zero); }), "empty");
    EXPECT_CONTAINS(refusal([] { moments(ScalarImage(3, 3)); }), "no centre");
    EXPECT_CONTAINS(refusal([] { pointSpread({{{0.5, 1}}}); }), "shares");
    EXPECT_CONTAINS(refusal([] { pointSpread({{{1, 0}}}); }), "sigma");
    EXPECT_CONTAINS(refusal([] { pointSpread({{{1, 1e9}}}); }), "too wide");
    EXPECT_CONTAINS(refusal([] { matched({{{1, 1}}}, 0); }), "variance");
}

} // namespace
} // namespace gll::truth
