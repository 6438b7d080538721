// The rules of others, on pictures of which one can say by hand what they make of them.
#include "mutation/rules.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

Image filled(std::uint8_t code, int width = 20, int height = 10) {
    return {.width = width,
            .height = height,
            .channels = 3,
            .color_space = ColorSpace::srgb,
            .pixels = std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 3, code)};
}

void set(Image& image, int x, int y, std::uint8_t code) {
    for (int c = 0; c < 3; ++c)
        std::get<std::vector<std::uint8_t>>(
            image.pixels)[static_cast<std::size_t>((y * image.width + x) * 3 + c)] = code;
}

double measure(const std::string& name, const Image& reference, const Image& image) {
    for (const NamedRule& rule : namedRules())
        if (rule.name.find(name) != std::string::npos) return rule.measure(Pair(reference, image));
    throw std::invalid_argument(name);
}

TEST(Rules, areAllZeroForTheSame) {
    const Image grey = filled(100);
    for (const NamedRule& rule : namedRules())
        EXPECT_EQ(rule.measure(Pair(grey, grey)), 0) << rule.name;
}

TEST(Rules, failPublishedForAnotherPicture) {
    const Image black = filled(0);
    const Image white = filled(255);
    for (const NamedRule& rule : namedRules())
        EXPECT_GT(rule.measure(Pair(black, white)), rule.setting) << rule.name;
}

TEST(Rules, measureColorsInYiq) {
    const std::uint8_t black[3] = {0, 0, 0};
    const std::uint8_t white[3] = {255, 255, 255};
    const std::uint8_t cyan[3] = {0, 255, 255};
    const std::uint8_t red[3] = {255, 0, 0};
    EXPECT_NEAR(yiqDistance(black, white), 0.5053 * 255 * 255, 1) << "grey has no I and Q";
    EXPECT_NEAR(yiqDistance(cyan, red), 35215, 5000) << "near the most there is";
    EXPECT_LE(yiqDistance(cyan, red), 35215);
    Image one = filled(100);
    set(one, 3, 3, 140);
    EXPECT_NEAR(measure("odiff", filled(100), one), std::sqrt(0.5053 * 40 * 40 / 35215), 1e-4);
}

TEST(Rules, countPixelsOfWhichAShareMayFail) {
    Image two = filled(100); // 200 pixels, of which 1 % are two
    set(two, 1, 1, 150);
    set(two, 2, 1, 140);
    EXPECT_EQ(measure("Blender", filled(100), two), 0);
    set(two, 3, 1, 130);
    EXPECT_NEAR(measure("Blender", filled(100), two), 30 / 255.0, 1e-12) << "the third";
    EXPECT_EQ(measure("diffimg", filled(100), two), 0) << "5 %";
    EXPECT_NEAR(measure("exact", filled(100), two), 50 / 255.0, 1e-12);
}

// A black and a white half whose border is smoothed by one column of grey.
Image smoothed(std::uint8_t border) {
    Image image = filled(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 10; x < image.width; ++x)
            set(image, x, y, x == 10 ? std::uint8_t(border + y) : 255);
    return image;
}

TEST(Rules, leaveOutWhatLooksAntialiased) {
    const Image reference = smoothed(60);
    const Image image = smoothed(160);
    EXPECT_TRUE(looksAntialiased(Pair(reference, image), true, 10, 5));
    EXPECT_FALSE(looksAntialiased(Pair(reference, image), true, 4, 5)) << "within an area";
    EXPECT_EQ(measure("pixelmatch", reference, image), 0);
    EXPECT_GT(measure("odiff", reference, image), 0.1);
}

TEST(Rules, allowAShiftOfOnePixelOnlyWhereTheyAreMeantTo) {
    Image reference = filled(0);
    Image image = filled(0);
    for (int y = 0; y < 10; ++y)
        for (int x = 10; x < 20; ++x) {
            set(reference, x, y, 200);
            if (x > 10) set(image, x, y, 200);
        }
    EXPECT_LE(measure("imagediff", reference, image), 1);
    EXPECT_GT(measure("exact", reference, image), 0.5);
}

TEST(Rules, weighPercentilesByTheirValues) {
    EXPECT_EQ(weightedPercentile({0, 0, 0, 0.1, 0.1, 0.8}, 0.15), 0.1);
    EXPECT_EQ(weightedPercentile({0, 0, 0, 0.1, 0.1, 0.8}, 0.99), 0.8);
    EXPECT_EQ(weightedPercentile({0, 0}, 0.99), 0);
}

TEST(Rules, refuseWhatTheyDoNotTake) {
    EXPECT_THROW(Pair(filled(1), filled(1, 21)), std::invalid_argument);
    Image grey = filled(1);
    grey.channels = 1;
    EXPECT_THROW(Pair(grey, grey), std::invalid_argument);
}

} // namespace
} // namespace gll::test
