// The rule that golden frames are held to, at its boundaries: a comparison that cannot fail checks nothing.
#include "support/comparison.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <utility>

namespace gll::test {
namespace {

constexpr int width = 320;
constexpr int height = 240;
constexpr int tolerated = width * height / 200; // 0.5 % of the pixels

Image grey(int w = width, int h = height) {
    return {.width = w,
            .height = h,
            .channels = 3,
            .color_space = ColorSpace::srgb,
            .pixels = std::vector<std::uint8_t>(std::size_t(w) * std::size_t(h) * 3, 100)};
}

// The first `count` pixels changed by `codes`, in their last channel.
Image changed(int count, int codes, Image image = grey()) {
    auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        bytes[3 * i + 2] = static_cast<std::uint8_t>(100 + codes);
    return image;
}

TEST(GoldenRule, acceptsEqualPictures) {
    EXPECT_TRUE(compare(grey(), grey()).identical());
    EXPECT_TRUE(compare(grey(), grey()).tolerable());
}

TEST(GoldenRule, toleratesHalfAPercentOfThePixelsByUpToTwoCodesAndNotOneMore) {
    EXPECT_FALSE(compare(grey(), changed(1, 1)).identical());
    EXPECT_TRUE(compare(grey(), changed(tolerated, 2)).tolerable());
    EXPECT_TRUE(compare(grey(), changed(tolerated, -2)).tolerable());
    EXPECT_FALSE(compare(grey(), changed(tolerated + 1, 1)).tolerable());
}

TEST(GoldenRule, toleratesEightPixelsByMoreThanTwoCodesAndNotNine) {
    EXPECT_TRUE(compare(grey(), changed(8, 3)).tolerable());
    EXPECT_TRUE(compare(grey(), changed(8, -16)).tolerable());
    EXPECT_FALSE(compare(grey(), changed(9, 3)).tolerable());
    EXPECT_FALSE(compare(grey(), changed(9, -3)).tolerable());
}

TEST(GoldenRule, toleratesNoPixelByMoreThanSixteenCodes) {
    EXPECT_FALSE(compare(grey(), changed(1, 17)).tolerable());
    EXPECT_FALSE(compare(grey(), changed(1, -17)).tolerable());
}

TEST(GoldenRule, toleratesFewerPixelsByMoreThanTwoCodesInASmallerPicture) {
    const Image small = grey(160, 120);
    EXPECT_TRUE(compare(small, changed(2, 3, small)).tolerable());
    EXPECT_FALSE(compare(small, changed(3, 3, small)).tolerable());
    const Image large = grey(640, 480);
    EXPECT_TRUE(compare(large, changed(32, 3, large)).tolerable());
    EXPECT_FALSE(compare(large, changed(33, 3, large)).tolerable());
}

TEST(GoldenRule, toleratesNothingInATinyPicture) {
    const Image tiny{.width = 2,
                     .height = 3,
                     .channels = 3,
                     .color_space = ColorSpace::srgb,
                     .pixels = std::vector<std::uint8_t>(18, 100)};
    EXPECT_FALSE(compare(tiny, changed(1, 1, tiny)).tolerable());
}

TEST(GoldenRule, refusesAnotherSizeOrNumberOfChannels) {
    Image turned = grey();
    std::swap(turned.width, turned.height);
    EXPECT_FALSE(compare(grey(), turned).tolerable());
    EXPECT_FALSE(compare(turned, grey()).identical());
    Image opaque = grey();
    opaque.channels = 1;
    EXPECT_FALSE(compare(grey(), opaque).tolerable());
}

TEST(GoldenRule, namesTheWorstPixelsFirst) {
    Image image = changed(3, 1);
    std::get<std::vector<std::uint8_t>>(image.pixels)[3 * (7 * width + 5)] = 60;
    const Comparison comparison = compare(grey(), image);
    ASSERT_EQ(comparison.differing.size(), 4U);
    EXPECT_EQ(comparison.exceeding, 1U);
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

} // namespace
} // namespace gll::test
