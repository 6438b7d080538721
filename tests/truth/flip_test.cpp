// FLIP by what its papers promise of it, and against their formulas written out as sums in two dimensions.
#include "measure/color.hpp"
#include "measure/flip.hpp"
#include "support/messages.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace gll::measure {
namespace {

constexpr double pi = std::numbers::pi;

template <class Function>
ColorImage picture(int width, int height, const Function& function) {
    ColorImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = function(x, y);
    return image;
}

ColorImage flat(const glm::dvec3& color, int width = 24, int height = 20) { return {width, height, color}; }

// Values as unrelated as the standard's generator makes them, the same everywhere.
ColorImage noise(unsigned seed, int width = 24, int height = 20, double low = 0, double high = 1) {
    std::mt19937 random(seed);
    const auto value = [&] { return low + (high - low) * (double(random()) / 4294967296.0); };
    return picture(width, height, [&](int, int) {
        const double r = value();
        const double g = value();
        return glm::dvec3(r, g, value());
    });
}

// Coloured blocks of different sizes, sharp edges in both directions.
ColorImage blocks(int width = 96, int height = 64, int shift = 0) {
    return picture(width, height, [shift](int x, int y) {
        const int at = x + shift;
        return glm::dvec3((at / 7) % 2 == 0 ? 0.8 : 0.1, (y / 11) % 2 == 0 ? 0.6 : 0.2,
                          ((at + y) / 13) % 2 == 0 ? 0.7 : 0.05);
    });
}

ColorImage boxBlur(const ColorImage& image, int radius) {
    return picture(image.width, image.height, [&](int x, int y) {
        glm::dvec3 sum(0);
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx)
                sum +=
                    image.at(std::clamp(x + dx, 0, image.width - 1), std::clamp(y + dy, 0, image.height - 1));
        return sum / double((2 * radius + 1) * (2 * radius + 1));
    });
}

double meanFlip(const ColorImage& image, const ColorImage& reference,
                double ppd = default_pixels_per_degree) {
    return summary(flip(image, reference, ppd)).mean;
}

// The paper's filters as weights of (x, y), summed over a square, each neighbour clamped to the picture.
struct Direct {
    double ppd;

    double filtered(const ColorImage& opponent, int channel, int px, int py, int radius,
                    const std::function<double(int, int)>& weight) const {
        double sum = 0;
        double positive = 0;
        double negative = 0;
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const double w = weight(x, y);
                (w > 0 ? positive : negative) += std::abs(w);
            }
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const double w = weight(x, y);
                sum += w / (w > 0 ? positive : negative) *
                       opponent.at(std::clamp(px + x, 0, opponent.width - 1),
                                   std::clamp(py + y, 0, opponent.height - 1))[channel];
            }
        return sum;
    }
    double csf(double a, double b, int x, int y) const {
        return a * std::sqrt(pi / b) * std::exp(-pi * pi * (x * x + y * y) / (ppd * ppd * b));
    }
    glm::dvec3 blurredHuntLab(const ColorImage& opponent, int x, int y) const {
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
        const glm::dvec3 c(
            filtered(opponent, 0, x, y, radius, [&](int i, int j) { return csf(1, 0.0047, i, j); }),
            filtered(opponent, 1, x, y, radius, [&](int i, int j) { return csf(1, 0.0053, i, j); }),
            filtered(opponent, 2, x, y, radius,
                     [&](int i, int j) { return csf(34.1, 0.04, i, j) + csf(13.5, 0.025, i, j); }));
        const double relative_y = (c.x + 16) / 116;
        const glm::dvec3 white = xyzFromBt709() * glm::dvec3(1);
        const glm::dvec3 xyz = glm::dvec3(relative_y + c.y / 500, relative_y, relative_y - c.z / 200) * white;
        const glm::dvec3 lab = cieLab(glm::clamp(bt709FromXyz() * xyz, 0.0, 1.0));
        return {lab.x, lab.x * lab.y / 100, lab.x * lab.z / 100};
    }
    double feature(const ColorImage& opponent, int x, int y, bool edge) const {
        const double sigma = 0.082 / 2 * ppd;
        const int radius = static_cast<int>(std::ceil(3 * sigma));
        const auto weight = [&](int i, int j) {
            const double g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
            return edge ? -i * g : (i * i / (sigma * sigma) - 1) * g;
        };
        const double across = filtered(opponent, 0, x, y, radius, weight);
        const double down = filtered(opponent, 0, x, y, radius, [&](int i, int j) { return weight(j, i); });
        return std::hypot(across, down) / 116;
    }
    static ColorImage opponentOf(const ColorImage& image) {
        const glm::dvec3 white = xyzFromBt709() * glm::dvec3(1);
        return picture(image.width, image.height, [&](int x, int y) {
            const glm::dvec3 xyz = xyzFromBt709() * image.at(x, y) / white;
            return glm::dvec3(116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z));
        });
    }
    static double hyab(const glm::dvec3& one, const glm::dvec3& other) {
        return std::abs(one.x - other.x) + std::hypot(one.y - other.y, one.z - other.z);
    }
    static double colorError(double distance) {
        const auto hunt = [](const glm::dvec3& lab) {
            return glm::dvec3(lab.x, lab.x * lab.y / 100, lab.x * lab.z / 100);
        };
        const double largest = std::pow(hyab(hunt(cieLab({0, 1, 0})), hunt(cieLab({0, 0, 1}))), 0.7);
        const double d = std::pow(distance, 0.7);
        return d < 0.4 * largest ? 0.95 * d / (0.4 * largest)
                                 : 0.95 + 0.05 * (d - 0.4 * largest) / (0.6 * largest);
    }
    double at(const ColorImage& one, const ColorImage& other, int x, int y) const {
        const double color = colorError(hyab(blurredHuntLab(one, x, y), blurredHuntLab(other, x, y)));
        const double features = std::max(std::abs(feature(one, x, y, true) - feature(other, x, y, true)),
                                         std::abs(feature(one, x, y, false) - feature(other, x, y, false)));
        return std::pow(color, 1 - std::sqrt(features / std::sqrt(2.0)));
    }
};

TEST(Flip, isThePapersFormulaAtEveryPixel) {
    for (const double ppd : {67.0, 25.0}) {
        const ColorImage one = noise(1, 19, 14);
        const ColorImage other = noise(2, 19, 14, 0.2, 0.9);
        const ScalarImage map = flip(one, other, ppd);
        const ColorImage one_opponent = Direct::opponentOf(one);
        const ColorImage other_opponent = Direct::opponentOf(other);
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x)
                ASSERT_NEAR(map.at(x, y), Direct{ppd}.at(one_opponent, other_opponent, x, y), 1e-9)
                    << x << ", " << y << " at " << ppd << " pixels per degree";
    }
}

TEST(Flip, ofAPictureAndItselfIsNone) {
    for (const auto& image : {noise(1), blocks(), flat(glm::dvec3(0.3)), flat({1, 0, 0}, 1, 1)})
        EXPECT_EQ(summary(flip(image, image)).largest, 0);
}

TEST(Flip, isSymmetricAndFromNoneToOne) {
    const ColorImage others[] = {noise(2), flat(glm::dvec3(0)), flat(glm::dvec3(1)), flat({0, 1, 0})};
    for (const ColorImage& other : others) {
        const ScalarImage there = flip(noise(1), other);
        EXPECT_EQ(there.pixels, flip(other, noise(1)).pixels);
        const auto [low, high] = std::minmax_element(there.pixels.begin(), there.pixels.end());
        EXPECT_GE(*low, 0);
        EXPECT_LE(*high, 1);
        EXPECT_GT(*high, 0.1);
    }
}

TEST(Flip, ofFlatColorsIsTheirDistanceToTheEdges) {
    // Nothing to blur and no feature: HyAB of black and white is 100, and the formula makes 0.9674 of it.
    const double expected = Direct::colorError(100);
    EXPECT_NEAR(expected, 0.9674, 5e-5);
    for (const double error : flip(flat(glm::dvec3(0)), flat(glm::dvec3(1))).pixels)
        ASSERT_NEAR(error, expected, 1e-9);
    for (const double error : flip(flat({0, 1, 0}), flat({0, 0, 1})).pixels)
        ASSERT_NEAR(error, 1, 1e-9) << "green against blue is the most there is";
    for (const double error : flip(flat(glm::dvec3(-3)), flat(glm::dvec3(7))).pixels)
        ASSERT_NEAR(error, expected, 1e-9) << "displays clamp";
}

TEST(Flip, growsWithBlurAndWithShift) {
    double blurred = 0;
    double shifted = 0;
    for (int step = 1; step <= 3; ++step) {
        const double blur = meanFlip(boxBlur(blocks(), step), blocks());
        const double shift = meanFlip(blocks(96, 64, step), blocks());
        EXPECT_GT(blur, blurred) << step;
        EXPECT_GT(shift, shifted) << step;
        blurred = blur;
        shifted = shift;
    }
}

TEST(Flip, seesLessFromAfar) {
    // Stripes of two pixels against their mean, far from the edges, which go on and are no stripes.
    const ColorImage stripes =
        picture(96, 64, [](int x, int) { return glm::dvec3((x / 2) % 2 == 0 ? 0.6 : 0.4); });
    double nearer = 1;
    for (const double ppd : {10.0, 20.0, 40.0, 67.0, 100.0, 250.0}) {
        const double error = flip(stripes, flat(glm::dvec3(0.5), 96, 64), ppd).at(48, 32);
        EXPECT_LT(error, nearer) << ppd;
        nearer = error;
    }
    EXPECT_LT(nearer, 1e-3) << "62 of them in a degree cannot be told from their mean";
}

TEST(Flip, takesPicturesSmallerThanItsFilters) {
    for (const auto& [width, height] : {std::pair(1, 1), {1, 40}, {40, 1}, {7, 3}})
        for (const double ppd : {1.0, 67.0, 1000.0}) {
            const FlipSummary error = summary(flip(noise(1, width, height), noise(2, width, height), ppd));
            EXPECT_GT(error.mean, 0);
            EXPECT_LE(error.largest, 1);
        }
}

TEST(Flip, refusesWhatItCannotMeasure) {
    const auto refusal = [](const ColorImage& one, const ColorImage& other, double ppd) {
        return test::messageOf<std::invalid_argument>([&] { flip(one, other, ppd); });
    };
    EXPECT_CONTAINS(refusal(flat(glm::dvec3(0), 4, 4), flat(glm::dvec3(0), 4, 5), 67), "4x4 and 4x5");
    for (const double ppd : {0.0, -1.0, 0.5, 1001.0, std::nan("")})
        EXPECT_CONTAINS(refusal(noise(1), noise(1), ppd), "pixels per degree");
    ColorImage broken = noise(1);
    broken.at(3, 5).g = std::nan("");
    EXPECT_CONTAINS(refusal(broken, noise(1), 67), "pixel (3, 5) is not finite");
}

// Narkowicz's curve without its exposure, as HDR-FLIP uses it.
double tone(double x) {
    x *= 0.6;
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

TEST(HdrFlip, exposesLargestAndMedianLuminanceAlike) {
    ColorImage image = flat(glm::dvec3(0.02)); // the median
    image.at(4, 4) = glm::dvec3(40);
    const Exposures exposures = flipExposures(image);
    EXPECT_NEAR(tone(40 * std::exp2(exposures.start_ev)), 0.85, 1e-9);
    EXPECT_NEAR(tone(0.02 * std::exp2(exposures.stop_ev)), 0.85, 1e-9);
    EXPECT_EQ(exposures.count, 11); // log2(2000) = 10.97 EV between them
    EXPECT_EQ(exposures.at(0), exposures.start_ev);
    EXPECT_NEAR(exposures.at(10), exposures.stop_ev, 1e-12);
    EXPECT_EQ(flipExposures(flat(glm::dvec3(0.5))).count, 2) << "never fewer";
    EXPECT_EQ(flipExposures(flat(glm::dvec3(0))).count, 1) << "black";
    ColorImage dark = flat(glm::dvec3(0)); // the median is 0: that of the two lights counts
    dark.at(0, 0) = glm::dvec3(1);
    dark.at(1, 0) = glm::dvec3(4);
    EXPECT_NEAR(tone(2.5 * std::exp2(flipExposures(dark).stop_ev)), 0.85, 1e-9);
}

TEST(HdrFlip, isTheLargestFlipOfAllExposures) {
    const ColorImage reference = noise(1, 24, 20, 0, 60);
    const ColorImage image = noise(2, 24, 20, 0, 60);
    int calls = 0;
    const HdrFlip result = hdrFlip(image, reference, 67, [&](int i, int count) {
        EXPECT_EQ(i, calls++);
        EXPECT_EQ(count, flipExposures(reference).count);
    });
    EXPECT_EQ(calls, result.exposures.count);
    ScalarImage expected(24, 20);
    for (int i = 0; i < result.exposures.count; ++i) {
        const auto shown = [&](const ColorImage& linear) {
            return picture(24, 20, [&](int x, int y) {
                const glm::dvec3 light = linear.at(x, y) * std::exp2(result.exposures.at(i));
                return glm::dvec3(tone(light.r), tone(light.g), tone(light.b));
            });
        };
        const ScalarImage map = flip(shown(image), shown(reference));
        for (std::size_t p = 0; p < map.pixels.size(); ++p)
            expected.pixels[p] = std::max(expected.pixels[p], map.pixels[p]);
    }
    for (std::size_t p = 0; p < expected.pixels.size(); ++p)
        ASSERT_NEAR(result.map.pixels[p], expected.pixels[p], 1e-9);
}

TEST(HdrFlip, seesWhatADisplayClamps) {
    const auto lamps = [](double brightness) {
        return picture(48, 32, [=](int x, int) { return glm::dvec3(x < 24 ? 0.2 : brightness); });
    };
    EXPECT_EQ(meanFlip(lamps(40), lamps(80)), 0);
    EXPECT_GT(summary(hdrFlip(lamps(40), lamps(80)).map).mean, 0.05);
}

TEST(HdrFlip, doesNotCareForTheUnitOfLight) {
    const auto scaled = [](ColorImage image, double factor) {
        for (glm::dvec3& color : image.pixels)
            color *= factor;
        return image;
    };
    const HdrFlip plain = hdrFlip(noise(1), noise(2));
    for (const double factor : {0x1p-20, 0x1p30}) {
        const HdrFlip other = hdrFlip(scaled(noise(1), factor), scaled(noise(2), factor));
        EXPECT_NEAR(other.exposures.start_ev, plain.exposures.start_ev - std::log2(factor), 1e-9);
        for (std::size_t p = 0; p < plain.map.pixels.size(); ++p)
            ASSERT_NEAR(other.map.pixels[p], plain.map.pixels[p], 1e-7);
    }
}

TEST(HdrFlip, staysInRangeAtTheEndsOfFloats) {
    ColorImage extremes = flat(glm::dvec3(1e-45));
    extremes.at(3, 3) = glm::dvec3(3e38);
    extremes.at(9, 9) = glm::dvec3(-3e38);
    for (const ColorImage& other : {flat(glm::dvec3(3e38)), flat(glm::dvec3(0)), extremes}) {
        for (const HdrFlip& result : {hdrFlip(other, extremes), hdrFlip(extremes, other)}) {
            for (const double error : result.map.pixels)
                ASSERT_TRUE(error >= 0 && error <= 1) << error;
        }
    }
    EXPECT_EQ(summary(hdrFlip(extremes, extremes).map).largest, 0);
}

TEST(FlipSummary, weighsTheMedianByError) {
    ScalarImage map(10, 1, 0.1);
    map.at(9, 0) = 0.95; // more than all others together
    EXPECT_NEAR(summary(map).mean, 0.185, 1e-15);
    EXPECT_EQ(summary(map).weighted_median, 0.95);
    EXPECT_EQ(summary(map).largest, 0.95);
    map.at(9, 0) = 0.85;
    EXPECT_EQ(summary(map).weighted_median, 0.1);
    EXPECT_EQ(summary(ScalarImage(2, 2)).weighted_median, 0);
}

TEST(HeatMap, isLighterWhereThereIsMoreError) {
    ScalarImage ramp(256, 1);
    for (int x = 0; x < 256; ++x)
        ramp.at(x, 0) = x / 255.0;
    const ColorImage colors = linearColor(heatMap(ramp));
    EXPECT_EQ(colors.at(0, 0), glm::dvec3(0));
    EXPECT_GT(luminance709(colors.at(255, 0)), 0.9);
    for (int x = 8; x < 256; ++x)
        EXPECT_GT(luminance709(colors.at(x, 0)), luminance709(colors.at(x - 8, 0))) << x;
}

// Noise of one kind, and the same with other noise in some places.
template <class Sample>
std::pair<Image, Image> imagesDifferingInPlaces(ColorSpace space, double scale) {
    Image one{.width = 150, .height = 300, .channels = 3, .color_space = space, .pixels = {}};
    std::mt19937 random(1);
    std::vector<Sample> samples(std::size_t(3) * 150 * 300);
    for (Sample& sample : samples)
        sample = static_cast<Sample>(scale * double(random()) / 4294967296.0);
    Image other = one;
    one.pixels = samples;
    const auto change = [&](int from_x, int from_y, int size) {
        for (int y = from_y; y < std::min(from_y + size, 300); ++y)
            for (int x = from_x; x < std::min(from_x + size, 150); ++x)
                samples[static_cast<std::size_t>(3 * (y * 150 + x))] = static_cast<Sample>(scale / 2);
    };
    change(0, 0, 1);     // a corner
    change(70, 127, 2);  // over the seam of two bands, whose differences reach into both
    change(140, 290, 9); // near the other corner
    other.pixels = std::move(samples);
    return {one, other};
}

TEST(FlipMap, IsFlipToTheBitWhereverTheImagesDiffer) {
    const auto [one, other] = imagesDifferingInPlaces<std::uint8_t>(ColorSpace::srgb, 255);
    EXPECT_EQ(flipMap(one, other).pixels, flip(linearColor(one), linearColor(other)).pixels);
    EXPECT_EQ(flipMap(one, other, 20).pixels, flip(linearColor(one), linearColor(other), 20).pixels);
    EXPECT_EQ(summary(flipMap(one, one)).largest, 0);
}

TEST(FlipMap, IsHdrFlipToTheBitOfLinearLight) {
    const auto [one, other] = imagesDifferingInPlaces<float>(ColorSpace::linear, 9);
    EXPECT_EQ(flipMap(one, other).pixels, hdrFlip(linearColor(one), linearColor(other)).map.pixels);
}

TEST(FlipMap, RefusesImagesOfTwoKinds) {
    const auto [one, other] = imagesDifferingInPlaces<float>(ColorSpace::linear, 9);
    const auto [bytes, more_bytes] = imagesDifferingInPlaces<std::uint8_t>(ColorSpace::srgb, 255);
    EXPECT_THROW(flipMap(one, bytes), std::invalid_argument);
    Image thin = one;
    thin.width = 75;
    EXPECT_THROW(flipMap(one, thin), std::invalid_argument);
}

} // namespace
} // namespace gll::measure
