// The rule that frames are held to, at its boundaries: a comparison that cannot fail checks nothing.
#include "frame_check/rule.hpp"

#include "pictures.hpp"
#include "support/messages.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gll::test {
namespace {

using frame_check::Rule;
using measure::Comparison;
using measure::pixelHash;

constexpr int width = 320;
constexpr int tolerated = 320 * 240 / 200; // 0.5 % of the pixels

Comparison compare(const Image& reference, const Image& image) { return measure::compare(reference, image); }

bool passes(const Image& reference, const Image& image, const Rule& rule = {}) {
    return frame_check::satisfies(rule, frame_check::measure(reference, image, false));
}

TEST(CountRule, acceptsEqualPictures) {
    EXPECT_TRUE(compare(grey(), grey()).identical());
    EXPECT_TRUE(passes(grey(), grey()));
}

TEST(CountRule, toleratesHalfAPercentOfThePixelsByUpToTwoCodesAndNotOneMore) {
    EXPECT_FALSE(compare(grey(), changed(1, 1)).identical());
    EXPECT_TRUE(passes(grey(), changed(tolerated, 2)));
    EXPECT_TRUE(passes(grey(), changed(tolerated, -2)));
    EXPECT_FALSE(passes(grey(), changed(tolerated + 1, 1)));
}

TEST(CountRule, toleratesEightPixelsByMoreThanTwoCodesAndNotNine) {
    EXPECT_TRUE(passes(grey(), changed(8, 3)));
    EXPECT_TRUE(passes(grey(), changed(8, -16)));
    EXPECT_FALSE(passes(grey(), changed(9, 3)));
    EXPECT_FALSE(passes(grey(), changed(9, -3)));
}

TEST(CountRule, toleratesNoPixelByMoreThanSixteenCodes) {
    EXPECT_FALSE(passes(grey(), changed(1, 17)));
    EXPECT_FALSE(passes(grey(), changed(1, -17)));
}

TEST(CountRule, toleratesFewerPixelsByMoreThanTwoCodesInASmallerPicture) {
    const Image small = grey(160, 120);
    EXPECT_TRUE(passes(small, changed(2, 3, small)));
    EXPECT_FALSE(passes(small, changed(3, 3, small)));
    const Image large = grey(640, 480);
    EXPECT_TRUE(passes(large, changed(32, 3, large)));
    EXPECT_FALSE(passes(large, changed(33, 3, large)));
}

TEST(CountRule, toleratesNothingInATinyPicture) {
    const Image tiny{.width = 2,
                     .height = 3,
                     .channels = 3,
                     .color_space = ColorSpace::srgb,
                     .pixels = std::vector<std::uint8_t>(18, 100)};
    EXPECT_FALSE(passes(tiny, changed(1, 1, tiny)));
}

TEST(CountRule, refusesAnotherSizeOrNumberOfChannels) {
    Image turned = grey();
    std::swap(turned.width, turned.height);
    EXPECT_FALSE(passes(grey(), turned));
    EXPECT_FALSE(compare(turned, grey()).identical());
    Image opaque = grey();
    opaque.channels = 1;
    EXPECT_FALSE(passes(grey(), opaque));
}

TEST(CountRule, namesTheWorstPixelsFirst) {
    Image image = changed(3, 1);
    std::get<std::vector<std::uint8_t>>(image.pixels)[3 * (7 * width + 5)] = 60;
    const Comparison comparison = compare(grey(), image);
    EXPECT_EQ(comparison.differing(), 4U);
    EXPECT_EQ(comparison.differingByMoreThan(2), 1U);
    EXPECT_NE(comparison.map().find("worst: (5,7) by 40 (0,0) by 1"), std::string::npos) << comparison.map();
    EXPECT_NE(comparison.map().find('#'), std::string::npos);
}

TEST(PixelHash, changesWithPixelsAndShapeAndWithNothingElse) {
    EXPECT_EQ(pixelHash(grey()), pixelHash(grey()));
    EXPECT_NE(pixelHash(grey()), pixelHash(changed(1, 1)));
    Image turned = grey();
    std::swap(turned.width, turned.height);
    EXPECT_NE(pixelHash(grey()), pixelHash(turned));
}

TEST(PixelHash, isFnv1a) {
    // Of no bytes but the twelve zeros of an empty picture's shape: the published basis and prime give this.
    std::uint64_t expected = 14695981039346656037ULL;
    for (int i = 0; i < 12; ++i)
        expected *= 1099511628211ULL;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(expected));
    EXPECT_EQ(pixelHash(Image{.pixels = std::vector<std::uint8_t>{}}), text);
}

TEST(CountRule, scalesBothOfItsKnobsAndKeepsTheirRatio) {
    const Rule wide = frame_check::ruleFromJson(
        nlohmann::json::parse(R"({"count": {"codes": 40, "pixels": 0.01}, "because": "edges"})"));
    EXPECT_TRUE(passes(grey(), changed(2 * tolerated, 2), wide));
    EXPECT_FALSE(passes(grey(), changed(2 * tolerated + 1, 2), wide));
    EXPECT_TRUE(passes(grey(), changed(16, 40), wide));
    EXPECT_FALSE(passes(grey(), changed(17, 40), wide));
    EXPECT_FALSE(passes(grey(), changed(1, 41), wide));
    const Rule narrow = frame_check::ruleFromJson(nlohmann::json::parse(R"({"count": {"pixels": 0}})"));
    EXPECT_FALSE(passes(grey(), changed(1, 1), narrow)) << "tighter needs no reason";
}

TEST(OtherRules, holdTheirLimitAndNoMore) {
    EXPECT_FALSE(passes(grey(), changed(1, 1), frame_check::ruleFromText("exact")));
    EXPECT_TRUE(passes(grey(), grey(), frame_check::ruleFromText("exact")));
    const Image other = changed(76800, 3); // RMSE: 3 codes in one channel of three
    EXPECT_TRUE(passes(grey(), other, frame_check::ruleFromText("rmse=0.0068")));
    EXPECT_FALSE(passes(grey(), other, frame_check::ruleFromText("rmse=0.0067")));
    const double flip_mean = *frame_check::measure(grey(), other, false).flip_mean;
    EXPECT_GT(flip_mean, 0);
    EXPECT_TRUE(passes(grey(), other, frame_check::ruleFromText("flip=" + std::to_string(flip_mean * 1.01))));
    EXPECT_FALSE(
        passes(grey(), other, frame_check::ruleFromText("flip=" + std::to_string(flip_mean * 0.99))));
}

std::string refusal(const std::string& json) {
    return messageOf<std::runtime_error>([&] { frame_check::ruleFromJson(nlohmann::json::parse(json)); });
}

TEST(LooserRules, needAReasonAndHaveACap) {
    EXPECT_CONTAINS(refusal(R"({"count": {"codes": 17}})"), "looser than count, say why");
    EXPECT_CONTAINS(refusal(R"({"count": {"pixels": 0.006}, "because": " "})"), "say why");
    EXPECT_CONTAINS(refusal(R"("flip=0.01")"), "say why");
    EXPECT_CONTAINS(refusal(R"({"rmse": 0.01})"), "say why");
    EXPECT_CONTAINS(refusal(R"({"count": {"codes": 65}, "because": "x"})"), "give 0 to 64");
    EXPECT_CONTAINS(refusal(R"({"count": {"pixels": 0.051}, "because": "x"})"), "give 0 to 0.05");
    EXPECT_CONTAINS(refusal(R"({"flip": 0.11, "because": "x"})"), "give 0 to 0.1");
    EXPECT_CONTAINS(refusal(R"({"rmse": -1, "because": "x"})"), "give 0 to 0.05");
    EXPECT_EQ(refusal(R"({"flip": 0.01, "because": "each run scatters its rays anew"})"), "");
    EXPECT_EQ(refusal(R"("exact")"), "");
}

TEST(Rules, thatAreNoneAreNamed) {
    EXPECT_CONTAINS(refusal(R"("ssim=0.9")"), "\"ssim=0.9\" is no rule");
    EXPECT_CONTAINS(refusal(R"("flip=")"), "is no rule");
    EXPECT_CONTAINS(refusal(R"("flip=0.01x")"), "is no rule");
    EXPECT_CONTAINS(refusal(R"("flip=nan")"), "give 0 to");
    EXPECT_CONTAINS(refusal(R"({"count": {"code": 1}})"), "\"code\" is no knob");
    EXPECT_CONTAINS(refusal(R"({"flip": 0.01, "rmse": 0.01, "because": "x"})"), "one of count");
    EXPECT_CONTAINS(refusal(R"({"flip": "0.01", "because": "x"})"), "no number");
    EXPECT_CONTAINS(refusal("3"), "wants a text or an object");
}

Image light(std::vector<float> samples) {
    return {.width = static_cast<int>(samples.size()),
            .height = 1,
            .channels = 1,
            .color_space = ColorSpace::linear,
            .pixels = std::move(samples)};
}

TEST(LinearLight, isMeasuredInTheCodesOfADisplayAndByItsLogarithmBeyondWhite) {
    const auto codes = [](float a, float b) { return compare(light({a}), light({b})).largest(); };
    EXPECT_EQ(codes(0, 1), 255);
    EXPECT_EQ(codes(0.5F, 0.5F), 0);
    EXPECT_EQ(codes(0.5F, std::nextafter(0.5F, 1.0F)), 1) << "what differs at all differs by one code";
    EXPECT_EQ(codes(0.2140411F, 0.2100000F), 2) << "1.1 codes below sRGB 0.5";
    EXPECT_EQ(codes(1, std::exp(1.0F / 255 * 2.4F / 1.055F) * 0.9999F), 1);
    EXPECT_EQ(codes(1000, 1000 * std::exp(1.0F / 255 * 2.4F / 1.055F) * 0.9999F), 1);
    EXPECT_EQ(codes(1000, 2000), 78) << "255 * 1.055 / 2.4 * ln 2, rounded up";
    EXPECT_EQ(codes(-1, 1), 255);
}

TEST(LinearLight, neverPassesWhereOneSideIsNoNumber) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinite = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(passes(light({nan, infinite}), light({nan, infinite})));
    for (const char* rule : {"count", "flip=0.05", "rmse=0.05", "exact"})
        for (const float bad : {nan, infinite, -infinite}) {
            EXPECT_FALSE(passes(light({0.5F}), light({bad}), frame_check::ruleFromText(rule))) << rule << bad;
            EXPECT_FALSE(passes(light({bad}), light({0.5F}), frame_check::ruleFromText(rule))) << rule << bad;
        }
}

TEST(PixelHash, isOfFloatsToo) {
    EXPECT_EQ(pixelHash(light({1, 2})), pixelHash(light({1, 2})));
    EXPECT_NE(pixelHash(light({1, 2})), pixelHash(light({1, 2.0000002F})));
}

} // namespace
} // namespace gll::test
