// The error measures and colour spaces against values worked out by hand or published.
#include "measure/color.hpp"
#include "measure/errors.hpp"
#include "support/messages.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace gll::measure {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

ColorImage flat(double grey, int width = 3, int height = 2) { return {width, height, glm::dvec3(grey)}; }

std::string refusalOf(const std::function<void()>& call) {
    return test::messageOf<std::invalid_argument>(call);
}

TEST(Errors, ofDisplayValuesAreRmseAndPsnr) {
    EXPECT_EQ(rmse(flat(0.3), flat(0.3)), 0);
    EXPECT_NEAR(rmse(flat(0.6), flat(0.5)), 0.1, 1e-15);
    ColorImage one_channel = flat(0); // one of 18 samples off by 0.3: sqrt(0.09 / 18)
    one_channel.at(2, 1).g = 0.3;
    EXPECT_NEAR(rmse(one_channel, flat(0)), std::sqrt(0.005), 1e-15);
    EXPECT_NEAR(psnrDb(0.1), 20, 1e-12);
    EXPECT_EQ(psnrDb(0), infinity);
}

TEST(Errors, ofLinearLightAreRelativeAndInEv) {
    EXPECT_NEAR(relativeRmse(flat(1.1), flat(1)), 0.1 / std::sqrt(1.01), 1e-15);
    EXPECT_NEAR(relativeRmse(flat(1100), flat(1000)), 0.1, 1e-8); // e no longer matters
    EXPECT_NEAR(log2RmseEv(flat(8), flat(2), 1e-12), 2, 1e-9);
    EXPECT_NEAR(log2RmseEv(flat(2), flat(8), 1e-12), 2, 1e-9);
    EXPECT_NEAR(log2RmseEv(flat(-5), flat(1e-4)), 1, 1e-12) << "below 0 counts as 0";
    EXPECT_NEAR(evError(0.36, 0.18), 1, 1e-12);
    EXPECT_NEAR(evError(0.09, 0.18), -1, 1e-12);
}

TEST(Errors, ofEnergyAreTheRatioOfSums) {
    ColorImage moved = flat(0);
    moved.at(0, 0) = {1, 2, 3};
    ColorImage reference = flat(0);
    reference.at(2, 1) = {4, 4, 4};
    EXPECT_NEAR(energyRatio(moved, reference), 0.5, 1e-15);
    EXPECT_EQ(energyRatio(flat(0), flat(0)), 1);
    EXPECT_EQ(energyRatio(flat(1), flat(0)), infinity);
}

TEST(LogAverage, isTheGeometricMean) {
    EXPECT_NEAR(logAverage(flat(0.18), 1e-12), 0.18, 1e-9);
    ColorImage board(4, 2); // half 1, half 16: the geometric mean is 4
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            board.at(x, y) = glm::dvec3((x + y) % 2 == 0 ? 1 : 16);
    EXPECT_NEAR(logAverage(board, 1e-12), 4, 1e-9);
    EXPECT_NEAR(logAverage(flat(0)), 1e-4, 1e-16) << "black frames have d";
}

TEST(Errors, refuseWhatHasNone) {
    EXPECT_CONTAINS(refusalOf([] { rmse(flat(0, 3, 2), flat(0, 2, 3)); }), "rmse: 3x2 and 2x3 pixels");
    EXPECT_CONTAINS(refusalOf([] { rmse(ColorImage(), ColorImage()); }), "0x0");
    EXPECT_CONTAINS(refusalOf([] { evError(1, 0); }), "truth is 0");
    EXPECT_CONTAINS(refusalOf([] { logAverage(flat(1), 0); }), "d is 0");
    for (const double bad : {not_a_number, infinity, -infinity}) {
        ColorImage broken = flat(1);
        broken.at(1, 1).b = bad;
        for (const auto& measure : {rmse, energyRatio}) {
            EXPECT_CONTAINS(refusalOf([&] { measure(broken, flat(1)); }), "pixel (1, 1) is not finite");
            EXPECT_CONTAINS(refusalOf([&] { measure(flat(1), broken); }), "pixel (1, 1) is not finite");
        }
        EXPECT_CONTAINS(refusalOf([&] { log2RmseEv(broken, flat(1)); }), "pixel (1, 1)");
        EXPECT_CONTAINS(refusalOf([&] { relativeRmse(broken, flat(1)); }), "pixel (1, 1)");
        EXPECT_CONTAINS(refusalOf([&] { logAverage(broken); }), "pixel (1, 1)");
    }
}

// The light at (x, y) averaged over its cell of size x size pixels, as the coarsest pyramid does.
ColorImage cellAverage(int x, int y, int size, int width, int height) {
    ColorImage image(width, height);
    for (int dy = 0; dy < size; ++dy)
        for (int dx = 0; dx < size; ++dx)
            image.at(x / size * size + dx, y / size * size + dy) = glm::dvec3(1.0 / (size * size));
    return image;
}

TEST(ShiftVariance, isNoneForAFilterThatDoesNotCare) {
    std::vector<ColorImage> responses;
    std::vector<glm::ivec2> shifts;
    for (int shift = 0; shift < 4; ++shift) {
        ColorImage image(16, 8);
        image.at(5 + shift, 3) = glm::dvec3(1, 2, 0.5);
        image.at(6 + shift, 4) = glm::dvec3(0.25);
        responses.push_back(image);
        shifts.emplace_back(shift, 0);
    }
    EXPECT_EQ(shiftVariance(responses, shifts, 4).mean, 0);
}

TEST(ShiftVariance, ofPairsIsAHalf) {
    // Moved back, the responses are (0, 1/2, 1/2) and (1/2, 1/2, 0); the mean is (1/4, 1/2, 1/4), and each
    // deviates by 1/4 + 1/4 of the sum 1.
    const ShiftVariance along =
        shiftVariance({cellAverage(4, 4, 2, 12, 12), cellAverage(5, 4, 2, 12, 12)}, {{0, 0}, {1, 0}}, 2);
    EXPECT_NEAR(along.mean, 0.5, 1e-15);
    EXPECT_NEAR(along.largest, 0.5, 1e-15);
    // Over both directions the mean is the product of two such, and of each response's four pixels of 1/4 the
    // mean has 1/4, 1/8, 1/8 and 1/16: 3/16 + 2/8 are missing there, as much is beside.
    std::vector<ColorImage> responses;
    std::vector<glm::ivec2> shifts;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            responses.push_back(cellAverage(4 + x, 4 + y, 2, 12, 12));
            shifts.emplace_back(x, y);
        }
    EXPECT_NEAR(shiftVariance(responses, shifts, 2).mean, 0.875, 1e-15);
}

TEST(ShiftVariance, refusesShiftsThatFavourSomePlaces) {
    const ColorImage image = cellAverage(4, 4, 2, 12, 12);
    const auto refusal = [&](const std::vector<glm::ivec2>& shifts, int period) {
        return refusalOf([&] { shiftVariance(std::vector(shifts.size(), image), shifts, period); });
    };
    EXPECT_EQ(refusal({{0, 0}, {-1, 0}}, 2), "") << "any representative of a place will do";
    EXPECT_CONTAINS(refusal({{0, 0}, {1, 0}, {2, 0}}, 4), "period of 4");
    EXPECT_CONTAINS(refusal({{0, 0}, {1, 0}, {2, 0}}, 2), "period of 2") << "one place twice";
    EXPECT_CONTAINS(refusal({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}}, 3), "period of 3")
        << "whole in y, two of three in x";
    EXPECT_CONTAINS(refusal({{0, 0}, {1, 0}, {0, 1}}, 2), "period of 2") << "one corner is missing";
    EXPECT_CONTAINS(refusal({{0, 0}, {13, 0}}, 2), "share no pixel");
    EXPECT_CONTAINS(refusal({}, 2), "0 responses");
    EXPECT_CONTAINS(refusalOf([] { shiftVariance({flat(0)}, {{0, 0}}, 1); }), "black");
}

// IEC 61966-2-1 states it to four places.
TEST(Color, fromBt709ToXyzIsThePublishedMatrix) {
    const double published[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(xyzFromBt709()[column][row], published[row][column], 5e-5) << row << " " << column;
}

TEST(Color, ofWhiteIsNeutralEverywhere) {
    const glm::dvec3 lab = cieLab(glm::dvec3(1));
    EXPECT_NEAR(lab.x, 100, 1e-12);
    EXPECT_NEAR(lab.y, 0, 1e-12);
    EXPECT_NEAR(lab.z, 0, 1e-12);
    EXPECT_NEAR(cieLab(glm::dvec3(0.184187)).x, 50, 1e-4); // ((50 + 16) / 116)^3 = 0.184187
    const glm::dvec3 itp = ictcp(glm::dvec3(1), 10000);
    EXPECT_NEAR(itp.x, 1, 1e-12) << "PQ's peak";
    EXPECT_NEAR(itp.y, 0, 1e-12);
    EXPECT_NEAR(itp.z, 0, 1e-12);
}

TEST(Color, srgbGoesThereAndBack) {
    for (int code = 0; code <= 255; ++code)
        EXPECT_NEAR(srgbEncoded(srgbDecoded(code / 255.0)), code / 255.0, 1e-7) << code;
    EXPECT_NEAR(srgbDecoded(0.5), 0.214041, 1e-6); // (0.555 / 1.055)^2.4
}

// The example in the documentation of colour-science's RGB_to_ICtCp, BT.2020 light in cd/m^2.
TEST(Color, inIctcpIsThePublishedExample) {
    const glm::dvec3 bt2020(0.45620519, 0.03081071, 0.04091952);
    const glm::dvec3 itp = ictcp(bt709FromXyz() * (xyzFromBt2020() * bt2020), 1);
    EXPECT_NEAR(itp.x, 0.07351364, 1e-8);
    EXPECT_NEAR(itp.y, 0.00475253, 1e-8);
    EXPECT_NEAR(itp.z, 0.09351596, 1e-8);
    EXPECT_TRUE(std::isfinite(ictcp({-1, 0, 0}).x)) << "no PQ of negative light";
}

// The example in the documentation of colour-science's delta_E_ITP.
TEST(Color, deltaEItpIsThePublishedExample) {
    EXPECT_NEAR(deltaEItp({0.4885468072, -0.04739350675, 0.07475401302},
                          {0.4899203231, -0.04567508203, 0.07361341775}),
                1.42657228, 1e-7);
}

// Sharma, Wu, Dalal 2005, table 1: the pairs that sit on the formula's jumps, and ordinary ones.
TEST(Color, ciede2000IsItsTestData) {
    const struct {
        glm::dvec3 one, other;
        double delta_e;
    } pairs[] = {
        {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
        {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
        {{50, 0, 0}, {50, -1, 2}, 2.3669},
        {{50, 2.49, -0.001}, {50, -2.49, 0.001}, 7.1792},
        {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
        {{50, -0.001, 2.49}, {50, 0.001, -2.49}, 4.8045},
        {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
        {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
        {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
        {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
        {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
        {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    for (const auto& pair : pairs) {
        EXPECT_NEAR(deltaE2000(pair.one, pair.other), pair.delta_e, 5e-5);
        EXPECT_NEAR(deltaE2000(pair.other, pair.one), pair.delta_e, 5e-5);
    }
}

TEST(ColorDifference, knowsHueFromLightness) {
    const glm::dvec3 orange(8, 1, 0.2);
    const ColorDifference none = colorDifference(orange, orange);
    EXPECT_EQ(none.delta_e_itp, 0);
    EXPECT_EQ(none.delta_e_2000, 0);
    EXPECT_NEAR(none.ictcp_hue_deg.value(), 0, 1e-12);

    const ColorDifference darker = colorDifference(orange * 0.5, orange);
    EXPECT_LT(darker.ictcp_intensity, 0);
    EXPECT_LT(darker.lab_lightness, 0);
    EXPECT_NEAR(darker.lab_hue_deg.value(), 0, 1e-9) << "above the foot, CIELAB scales with the cube root";

    // Reinhard's curve on each channel turns it towards yellow; on the luminance it would not.
    const ColorDifference turned = colorDifference(orange / (glm::dvec3(1) + orange), orange);
    EXPECT_GT(turned.lab_hue_deg.value(), 10);
    EXPECT_GT(turned.ictcp_hue_deg.value(), 10);
    EXPECT_FALSE(colorDifference(orange, glm::dvec3(0.5)).lab_hue_deg.has_value()) << "grey has no hue";
    EXPECT_FALSE(colorDifference(orange, glm::dvec3(0)).ictcp_hue_deg.has_value());
}

TEST(ColorDifference, takesTheShortWayRound) {
    // Two greens-to-cyans on either side of a* < 0, b* = 0, where the angle jumps from 180 to -180 degrees.
    const glm::dvec3 above(0.1, 0.5, 0.36);
    const glm::dvec3 below(0.1, 0.5, 0.42);
    ASSERT_GT(cieLab(above).z, 0);
    ASSERT_LT(cieLab(below).z, 0);
    EXPECT_LT(colorDifference(above, below).lab_hue_deg.value(), 20);
}

TEST(Raster, fromAnImageIsDecodedOrEncodedOnce) {
    Image bytes;
    bytes.width = 2;
    bytes.height = 1;
    bytes.channels = 4;
    bytes.color_space = ColorSpace::srgb;
    bytes.pixels = std::vector<std::uint8_t>{0, 128, 255, 51, 255, 0, 0, 255};
    EXPECT_NEAR(displayColor(bytes).at(0, 0).g, 128 / 255.0, 1e-15);
    EXPECT_NEAR(linearColor(bytes).at(0, 0).g, 0.215861, 1e-6); // ((128 / 255 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(alpha(bytes).at(0, 0), 0.2, 1e-15);
    Image grey;
    grey.width = 1;
    grey.height = 2;
    grey.channels = 1;
    grey.pixels = std::vector<float>{0.25F, 4};
    EXPECT_EQ(linearColor(grey).at(0, 1), glm::dvec3(4));
    EXPECT_NEAR(displayColor(grey).at(0, 1).r, 1, 1e-15);
    EXPECT_NEAR(displayColor(grey).at(0, 0).b, 0.537099, 1e-6); // 1.055 * 0.25^(1 / 2.4) - 0.055
    EXPECT_EQ(alpha(grey).at(0, 0), 1);
}

} // namespace
} // namespace gll::measure
