// OpenColorIO's ACES rendering against what the Academy's transforms are specified to do.
#include "measure/color.hpp"
#include "support/messages.hpp"
#include "truth/aces.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace gll::truth {
namespace {

double grey(double scene_light) { return acesDisplayLight({glm::dvec3(scene_light)}).front().g; }

TEST(Aces, takesMidGreyToATenthOfWhite) {
    // The RRT and the 48-nit ODT both hold 0.18 at 4.8 cd/m^2, between a black of 0.02 and a white of 48;
    // video takes the power 0.9811 of that for its dim surround (ACESlib.ODT_Common).
    const double expected = std::pow((4.8 - 0.02) / (48 - 0.02), 0.9811);
    EXPECT_NEAR(expected, 0.1041, 5e-5);
    EXPECT_NEAR(grey(0.18), expected, 1e-4);
    // A perfect diffuser is no white: 0.812 as an sRGB code (acescentral.com, "Understanding the sRGB
    // RRT/ODT").
    EXPECT_NEAR(measure::srgbEncoded(grey(1)), 0.812, 5e-4);
}

TEST(Aces, rollsOffToWhiteSixAndAHalfStopsAboveGrey) {
    // The curve's last knot: 0.18 * 2^6.5 = 16.29.
    EXPECT_LT(grey(0.18 * std::exp2(6.0)), 0.99);
    EXPECT_NEAR(grey(0.18 * std::exp2(6.5)), 1, 1e-4);
    EXPECT_EQ(grey(100), 1);
    double slope = grey(1) - grey(0.5); // of one EV
    for (int ev = 1; ev <= 4; ++ev) {
        const double next = grey(std::exp2(ev)) - grey(std::exp2(ev - 1));
        EXPECT_LT(next, slope) << ev;
        slope = next;
    }
}

TEST(Aces, ofGreysIsGreyAndMonotonic) {
    std::vector<glm::dvec3> ramp = {glm::dvec3(0)};
    for (int i = 0; i <= 400; ++i)
        ramp.emplace_back(std::exp2(-12 + i * 0.05)); // to 2^8
    const auto display = acesDisplayLight(ramp);
    EXPECT_NEAR(display.front().g, 0, 1e-9);
    for (std::size_t i = 0; i < display.size(); ++i) {
        // 1e-5: rounding to float32, and matrices given to ten places
        ASSERT_NEAR(display[i].r, display[i].g, 1e-5) << ramp[i].g;
        ASSERT_NEAR(display[i].b, display[i].g, 1e-5) << ramp[i].g;
        if (i > 0) {
            ASSERT_GE(display[i].g, display[i - 1].g - 1e-6) << ramp[i].g;
        }
    }
}

TEST(Aces, desaturatesBrightColors) {
    // (8, 1, 0.2) is so bright that red reaches the display's end while green and blue follow.
    const glm::dvec3 orange = acesDisplayLight({{8, 1, 0.2}}).front();
    EXPECT_EQ(orange.r, 1);
    EXPECT_GT(orange.g, 0.6);
    EXPECT_GT(orange.b, 0.2);
    EXPECT_LT(orange.b, orange.g);
}

TEST(Aces, staysOnTheDisplay) {
    std::vector<glm::dvec3> hard;
    for (const double value : {0.0, -1.0, -65504.0, 65504.0, 1e30, -1e30, 1e-30})
        for (int c = 0; c < 3; ++c) {
            hard.emplace_back(0.5, 0.25, 0.75);
            hard.back()[c] = value;
        }
    for (const glm::dvec3& color : acesDisplayLight(hard))
        for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(color[c] >= 0 && color[c] <= 1) << color[c];
    EXPECT_EQ(acesDisplayLight({{1e30, 0.1, 0.1}}), acesDisplayLight({{65504, 0.1, 0.1}}));
    EXPECT_TRUE(acesDisplayLight({}).empty());
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_CONTAINS(test::messageOf<std::invalid_argument>([bad] {
                            acesDisplayLight({{1, 1, 1}, {0, bad, 0}});
                        }),
                        "colour 1 is not finite");
}

} // namespace
} // namespace gll::truth
