// What the inspector reads of a target: values, bits, and what is no number.
#include "../gl/gl_test.hpp"
#include "window/target_copy.hpp"

#include <limits>
#include <stdexcept>

namespace gll::test {
namespace {

using TargetCopyTest = GlTest;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

TEST_F(TargetCopyTest, aTexelIsReadWithItsBits) {
    const std::vector<float> pixels = {1, 0.5F, -2, 1, 0, 0, 0, 0};
    const Texture half({.size = {2, 1}, .format = Format::rgba16f}, pixels);
    const Texel texel = readTexel(half, {0, 0});
    EXPECT_EQ(texel.value, (std::array<float, 4>{1, 0.5F, -2, 1}));
    EXPECT_EQ(texel.bits, "3c00 3800 c000 3c00");
    EXPECT_EQ(readTexel(half, {1, 0}).bits, "0000 0000 0000 0000");
    EXPECT_THROW((void)readTexel(half, {2, 0}), std::out_of_range);
    EXPECT_THROW((void)readTexel(half, {0, -1}), std::out_of_range);

    const Texture whole({.size = {1, 1}, .format = Format::r32f}, std::vector<float>{1});
    EXPECT_EQ(readTexel(whole, {0, 0}).bits, "3f800000");
    const Texture bytes({.size = {1, 1}, .format = Format::rgba8}, std::vector<std::uint8_t>{255, 128, 1, 0});
    EXPECT_EQ(readTexel(bytes, {0, 0}).bits, "ff 80 01 00");
    // Three floats of 11, 11 and 10 bits: 1 is 0x3c0 and, of 10 bits, 0x1e0.
    const Texture packed({.size = {1, 1}, .format = Format::r11f_g11f_b10f}, std::vector<float>{1, 1, 1});
    EXPECT_EQ(readTexel(packed, {0, 0}).bits, "781e03c0");
    const Framebuffer depth({{"depth", Format::depth16}}, {1, 1});
    glBindFramebuffer(GL_FRAMEBUFFER, depth.id());
    glClearDepth(0.5);
    glClear(GL_DEPTH_BUFFER_BIT);
    glClearDepth(1);
    EXPECT_NEAR(readTexel(depth.depth(), {0, 0}).value[0], 0.5F, 1e-4F);
}

TEST_F(TargetCopyTest, aCopyIsTheLevelAskedForToTheBit) {
    std::vector<float> pixels(4 * 4 * 4, 0.25F);
    Texture texture({.size = {4, 4}, .format = Format::rgba16f, .levels = 3}, pixels);
    texture.setLevel(1, std::vector<float>(2 * 2 * 4, 3.5F));
    TargetCopy copy;
    EXPECT_FALSE(copy.isTaken());
    copy.take(texture, 0);
    EXPECT_EQ(copy.size(), glm::ivec2(4));
    EXPECT_EQ(readTexel(copy.texture(), {3, 3}).value[1], 0.25F);
    copy.take(texture, 1);
    EXPECT_EQ(copy.size(), glm::ivec2(2));
    EXPECT_EQ(readTexel(copy.texture(), {1, 1}).value[1], 3.5F);
    const Texture sampled_only({.size = {1, 1}, .format = Format::rgb16f}, std::vector<float>{1, 2, 3});
    copy.take(sampled_only, 0);
    EXPECT_EQ(readTexel(copy.texture(), {0, 0}).value[2], 3);
}

TEST_F(TargetCopyTest, whatIsNoLightIsCountedByTexels) {
    std::vector<float> pixels(3 * 3 * 4, 1);
    pixels[0] = not_a_number;
    pixels[1] = infinity; // of the same texel
    pixels[7] = -infinity;
    pixels[11] = infinity;
    TargetCopy copy;
    copy.take(Texture({.size = {3, 3}, .format = Format::rgba32f}, pixels), 0);
    EXPECT_EQ(copy.contents().no_number, 1);
    EXPECT_EQ(copy.contents().infinite, 2);
}

TEST_F(TargetCopyTest, whatWasDrawnSpansTheDepthsBelowOne) {
    const Framebuffer target({{"depth", Format::depth32f}}, {2, 1});
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glClear(GL_DEPTH_BUFFER_BIT);
    TargetCopy copy;
    copy.take(target.depth(), 0);
    EXPECT_LT(copy.contents().farthest, 1); // nothing was drawn
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 1, 1);
    glClearDepth(0.75);
    glClear(GL_DEPTH_BUFFER_BIT);
    glClearDepth(1);
    glDisable(GL_SCISSOR_TEST);
    copy.take(target.depth(), 0);
    EXPECT_EQ(copy.contents().nearest, 0.75F);
    EXPECT_EQ(copy.contents().farthest, 0.75F);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

TEST(ProbeTest, lightIsSaidInStopsAndCodes) {
    const Texel gray{.value = {0.18F, 0.18F, 0.18F, 1}, .channels = 4, .bits = "x"};
    EXPECT_EQ(describe(gray, true, false), "0.18  0.18  0.18  1   +0.00 stops   code 118 118 118   0x x");
    const Texel white{.value = {1, 1, 1, 1}, .channels = 3, .bits = "ff"};
    EXPECT_EQ(describe(white, false, true), "1  1  1   +2.47 stops   code 255 255 255   0x ff");
    const Texel depth{.value = {0.5F}, .channels = 1, .bits = "3f000000"};
    EXPECT_EQ(describe(depth, true, false), "0.5   0x 3f000000");
    const Texel bad{.value = {not_a_number, -1, infinity, 1}, .channels = 3, .bits = "x"};
    EXPECT_EQ(describe(bad, true, false).find("stops"), std::string::npos);
    EXPECT_NE(describe(bad, true, false).find("code 0 0 255"), std::string::npos);
}

} // namespace
} // namespace gll::test
