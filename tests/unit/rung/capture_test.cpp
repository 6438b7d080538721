// Captured targets as files hold them: encoding, ranges, channels; and finding a target by name.
#include "rung/capture.hpp"
#include "rung/context.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace gll::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

Image imageOf(int channels, ColorSpace space, std::variant<Bytes, Floats> pixels) {
    const std::size_t count = std::visit([](const auto& p) { return p.size(); }, pixels);
    return {static_cast<int>(count) / channels, 1, channels, space, std::move(pixels)};
}

Bytes png(const Image& image) { return std::get<Bytes>(forFile(image, ".png").pixels); }
Floats exr(const Image& image) { return std::get<Floats>(forFile(image, ".exr").pixels); }

// IEC 61966-2-1 in double.
double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST(CaptureTest, linearColoursAreSrgbEncodedOnceForPng) {
    Floats ramp(1001);
    for (std::size_t i = 0; i < ramp.size(); ++i)
        ramp[i] = static_cast<float>(i) / 1000;
    const Image image = imageOf(1, ColorSpace::linear, ramp);
    const Bytes bytes = png(image);
    for (std::size_t i = 0; i < ramp.size(); ++i)
        EXPECT_NEAR(bytes[i], 255 * encoded(ramp[i]), 0.501) << ramp[i];
    EXPECT_EQ(forFile(image, ".png").color_space, ColorSpace::srgb);
    EXPECT_EQ(bytes[0], 0);
    EXPECT_EQ(bytes[1000], 255);
}

TEST(CaptureTest, encodedFloatsAreNotEncodedAgainAndDataNeither) {
    for (const ColorSpace space : {ColorSpace::srgb, ColorSpace::data}) {
        const Image image = imageOf(1, space, Floats{0, 0.25F, 0.5F, 1});
        EXPECT_EQ(png(image), (Bytes{0, 64, 128, 255}));
        EXPECT_EQ(forFile(image, ".png").color_space, space);
    }
}

TEST(CaptureTest, whatPngCannotHoldIsClampedAndNotANumberIsBlack) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb, ColorSpace::data})
        EXPECT_EQ(
            png(imageOf(1, space, Floats{std::nanf(""), -std::nanf(""), -1, -infinity, 1.5F, infinity})),
            (Bytes{0, 0, 0, 0, 255, 255}));
}

TEST(CaptureTest, everyByteSurvivesDecodingToFloatAndEncodingAgain) {
    Bytes all(256);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<std::uint8_t>(i);
    const Image decoded = forFile(imageOf(1, ColorSpace::srgb, all), ".exr");
    EXPECT_EQ(decoded.color_space, ColorSpace::linear);
    EXPECT_EQ(png(decoded), all);
    EXPECT_NEAR(std::get<Floats>(decoded.pixels)[188], std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
    EXPECT_FLOAT_EQ(std::get<Floats>(decoded.pixels)[5], 5 / 255.0F / 12.92F);
}

TEST(CaptureTest, floatFilesKeepTheirRangeAndBytesBecomeFractions) {
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(exr(imageOf(1, ColorSpace::linear, Floats{-3, 1e30F, infinity})),
              (Floats{-3, 1e30F, infinity}));
    EXPECT_TRUE(std::isnan(exr(imageOf(1, ColorSpace::linear, Floats{std::nanf("")}))[0]));
    const Image data = imageOf(2, ColorSpace::data, Bytes{0, 51});
    EXPECT_EQ(exr(data), (Floats{0, 0.2F}));
    EXPECT_EQ(forFile(data, ".exr").color_space, ColorSpace::data);
}

TEST(CaptureTest, alphaIsNeverDecodedAsAColour) {
    const Floats linear = exr(imageOf(4, ColorSpace::srgb, Bytes{188, 188, 188, 188}));
    EXPECT_LT(linear[2], 0.51F);
    EXPECT_FLOAT_EQ(linear[3], 188 / 255.0F);
}

TEST(CaptureTest, eachKindOfFileHasTheChannelsItCanHold) {
    const Image grey = imageOf(1, ColorSpace::data, Floats{0.2F});
    const Image two = imageOf(2, ColorSpace::data, Floats{0.2F, 0.4F});
    const Image rgba = imageOf(4, ColorSpace::data, Floats{0.2F, 0.4F, 0.6F, 0.8F});
    EXPECT_EQ(png(grey), (Bytes{51}));
    EXPECT_EQ(png(two), (Bytes{51, 102, 0}));
    EXPECT_EQ(png(rgba), (Bytes{51, 102, 153}));
    EXPECT_EQ(exr(grey), (Floats{0.2F}));
    EXPECT_EQ(exr(rgba), (Floats{0.2F, 0.4F, 0.6F, 0.8F}));
    EXPECT_EQ(std::get<Floats>(forFile(grey, ".hdr").pixels), (Floats{0.2F, 0.2F, 0.2F}));
    EXPECT_EQ(std::get<Floats>(forFile(two, ".hdr").pixels), (Floats{0.2F, 0.4F, 0}));
    EXPECT_EQ(std::get<Floats>(forFile(rgba, ".hdr").pixels), (Floats{0.2F, 0.4F, 0.6F}));
    EXPECT_EQ(forFile(rgba, ".hdr").channels, 3);
}

TEST(CaptureTest, writableNamesAreThoseOfThreeFormats) {
    for (const char* name : {"a.png", "x/a.exr", "a.b.hdr"})
        EXPECT_TRUE(isWritableImage(name)) << name;
    for (const char* name : {"", "a", ".png", "png", "a.jpg", "a.PNG", "a.png.bak"})
        EXPECT_FALSE(isWritableImage(name)) << name;
}

TEST(CaptureTest, targetsAreListedOnceInTheOrderDrawnAndFoundByName) {
    const auto context = makeHeadlessContext();
    const Framebuffer scene({{"hdr"}, {"depth", Format::depth24}}, {2, 2});
    const Framebuffer bloom({{"bloom0"}}, {1, 1});
    const std::vector<DrawnPass> passes = {{"scene", &scene}, {"bright", &bloom}, {"up0", &bloom}};
    EXPECT_EQ(targetNames(passes), (std::vector<std::string>{"hdr", "depth", "bloom0"}));
    EXPECT_EQ(findTarget(passes, "depth"), &scene.depth());
    EXPECT_EQ(findTarget(passes, "bloom0"), &bloom.color());
    EXPECT_EQ(findTarget(passes, "bright"), nullptr) << "a pass's name is not a target's";
    EXPECT_EQ(targetNames({}), std::vector<std::string>());
}

TEST(CaptureTest, aTextureIsReadWithItsOwnChannelsRangeAndMeaning) {
    const auto context = makeHeadlessContext();
    const Floats pixels = {0.5F, 0.25F, 8, 1};
    const Image linear = readTexture(Texture({.format = Format::rgba16f}, pixels));
    EXPECT_EQ(std::get<Floats>(linear.pixels), pixels);
    EXPECT_EQ(linear.color_space, ColorSpace::linear);
    const Image bytes = readTexture(Texture({.format = Format::rg8}, pixels));
    EXPECT_EQ(bytes.channels, 2);
    EXPECT_EQ(bytes.color_space, ColorSpace::data);
    EXPECT_TRUE(std::holds_alternative<Bytes>(bytes.pixels));
    const Image depth = readTexture(Texture({.size = {3, 2}, .format = Format::depth24}));
    EXPECT_EQ(depth.channels, 1);
    EXPECT_EQ(std::get<Floats>(depth.pixels).size(), 6U);
}

} // namespace
} // namespace gll::test
