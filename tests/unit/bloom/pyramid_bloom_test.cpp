// PyramidBloom from and into any format, at any size, resized at will, moved and destroyed.
#include "04_pyramid_bloom/pyramid_bloom.hpp"
#include "gl_test.hpp"
#include "rung/resources.hpp"

#include <algorithm>
#include <cmath>

namespace gll::test {
namespace {

using namespace pyramid_bloom;

class PyramidBloomTest : public GlTest {
  protected:
    // A grey disc of that brightness in the middle of black, alpha one half where the format has it.
    static Texture disc(glm::ivec2 size, Format format = Format::rgba16f, float brightness = 3) {
        const int channels = formatInfo(format).channels;
        std::vector<float> texels;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::vec2 from_middle = glm::vec2(x, y) + 0.5F - glm::vec2(size) * 0.5F;
                const bool inside = std::hypot(from_middle.x, from_middle.y) <
                                    0.15F * static_cast<float>(std::min(size.x, size.y)) + 0.5F;
                const float value = inside ? brightness : 0.0F;
                for (int channel = 0; channel < channels; ++channel)
                    texels.push_back(channel < 3 ? value : 0.5F);
            }
        return Texture({.size = size, .format = format}, texels);
    }
    static Framebuffer targetOf(glm::ivec2 size, Format format = Format::rgba8) {
        return Framebuffer({{"out", format}}, size);
    }

    void render(PyramidBloom& bloom, const Texture& source, const Framebuffer& target,
                const PyramidBloomParameters& parameters) {
        Frame frame(1, target, triangle, nullptr);
        bloom.draw(frame, source, parameters);
        bloom.composite(frame, source, 1, target);
    }

    void useSplines() {
        settings.set("down_filter=spline");
        settings.set("up_filter=spline");
    }

    // Textures there are; names are given in order.
    static int livingTextures() {
        GLuint next_name = 0;
        glGenTextures(1, &next_name);
        glDeleteTextures(1, &next_name);
        int living = 0;
        for (GLuint name = 1; name < next_name; ++name)
            living += glIsTexture(name) ? 1 : 0;
        return living;
    }

    ShaderLibrary shaders{Resources().shaderRoots()};
    Settings settings;
    PyramidFilters filters{settings, "none", "13tap"};
    PyramidBloomParameters original{.filters = filters};
};

TEST_F(PyramidBloomTest, addsAGlowToWhatEightBitsHoldAndKeepsTheirAlpha) {
    const glm::ivec2 size(64, 48);
    const Texture source = disc(size, Format::rgba8);
    for (const Format target_format : {Format::rgba8, Format::rgba16f, Format::r11f_g11f_b10f})
        for (const Format level_format : {Format::rgba16f, Format::rgba8, Format::r11f_g11f_b10f}) {
            const Framebuffer target = targetOf(size, target_format);
            PyramidBloom bloom(shaders);
            original.format = level_format;
            render(bloom, source, target, original);
            const glm::vec4 middle = pixelOf(target.color(), 32, 24);
            const glm::vec4 beside = pixelOf(target.color(), 32, 24 + 14);
            const glm::vec4 corner = pixelOf(target.color(), 0, 0);
            const float expected = level_format == Format::rgba8 ? 1.5F : 2.0F;
            EXPECT_GE(middle.r, target_format == Format::rgba8 ? 1.0F : expected);
            EXPECT_GT(beside.r, 0.1F) << "outside the disc there is glow alone";
            EXPECT_LT(corner.r, beside.r);
            if (target_format != Format::r11f_g11f_b10f) {
                EXPECT_NEAR(corner.a, 0.5F, 0.003F);
            }
        }
}

TEST_F(PyramidBloomTest, takesEveryFormatThatHoldsColorAndFillsEveryOneThatCanBeDrawnTo) {
    const glm::ivec2 size(64, 48);
    PyramidBloom bloom(shaders);
    for (const Format source_format :
         {Format::rgba8, Format::srgb8_alpha8, Format::rgb10_a2, Format::r11f_g11f_b10f, Format::rgb16f,
          Format::rgba16f, Format::rgba32f}) {
        const Texture source = disc(size, source_format, 0.9F);
        const Framebuffer in_floats = targetOf(size, Format::rgba32f);
        render(bloom, source, in_floats, original);
        const float glow = pixelOf(in_floats.color(), 32, 24 + 14).r;
        EXPECT_GT(glow, 0.05F) << formatInfo(source_format).name;
        for (const Format target_format :
             {Format::r8, Format::rg8, Format::rgba8, Format::rgb10_a2, Format::r16, Format::rg16,
              Format::r16f, Format::rg16f, Format::r11f_g11f_b10f, Format::rgba16f, Format::r32f,
              Format::rg32f}) {
            const Framebuffer target = targetOf(size, target_format);
            render(bloom, source, target, original);
            // The coarsest step here is that of eleven bits, 1/64 of the value, and half a code of eight.
            EXPECT_NEAR(pixelOf(target.color(), 32, 24 + 14).r, glow, glow / 64 + 0.5F / 255)
                << formatInfo(source_format).name << " to " << formatInfo(target_format).name;
            context->debugLog().check("a format");
        }
    }
}

TEST_F(PyramidBloomTest, theEightBitPictureIsTheFloatOneRounded) {
    const glm::ivec2 size(50, 34);
    const Texture source = disc(size, Format::rgba8, 0.9F);
    const Framebuffer in_bits = targetOf(size);
    const Framebuffer in_floats = targetOf(size, Format::rgba32f);
    PyramidBloom bloom(shaders);
    render(bloom, source, in_bits, original);
    render(bloom, source, in_floats, original);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            ASSERT_NEAR(pixelOf(in_bits.color(), x, y).g, std::min(pixelOf(in_floats.color(), x, y).g, 1.0F),
                        0.51F / 255)
                << x << " " << y;
}

TEST_F(PyramidBloomTest, drawsAtEverySizeDownToOnePixel) {
    PyramidBloom bloom(shaders);
    original.levels = max_bloom_levels;
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 7}, {9, 1}, {2, 3}, {31, 17}, {500, 2}, {255, 257}}) {
        const Texture source = disc(size);
        const Framebuffer target = targetOf(size, Format::rgba32f);
        render(bloom, source, target, original);
        const glm::vec4 middle = pixelOf(target.color(), size.x / 2, size.y / 2);
        EXPECT_TRUE(std::isfinite(middle.r)) << size.x << "x" << size.y;
        EXPECT_GE(middle.r, 0) << size.x << "x" << size.y;
        EXPECT_EQ(bloom.level(0).size(), glm::max(size / 2, 1));
        EXPECT_EQ(bloom.level(7).size(), glm::max(size / 256, 1));
        context->debugLog().check("a size");
    }
    useSplines();
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 7}, {2, 3}, {31, 17}, {500, 2}, {255, 257}}) {
        const Texture source = disc(size);
        const Framebuffer target = targetOf(size, Format::rgba32f);
        render(bloom, source, target, original);
        EXPECT_TRUE(std::isfinite(pixelOf(target.color(), 0, 0).r)) << size.x << "x" << size.y;
        EXPECT_EQ(bloom.level(0).size(), (size + 1) / 2);
        context->debugLog().check("a size");
    }
}

TEST_F(PyramidBloomTest, allocatesOnlyWhereSizeLevelsFormatOrBlurChange) {
    PyramidBloom bloom(shaders);
    const Texture source = disc({64, 48});
    const Framebuffer target = targetOf({64, 48});
    const auto drawn = [&] {
        render(bloom, source, target, original);
        return bloom.level(1).id();
    };
    const GLuint first = drawn();
    original.threshold = 0.1F;
    original.knee = 0;
    original.blur_radius = 2;
    EXPECT_EQ(drawn(), first);
    original.levels = 3;
    EXPECT_EQ(drawn(), first) << "the levels that stay are kept";
    EXPECT_THROW(bloom.level(3), std::out_of_range);
    original.levels = 5;
    EXPECT_EQ(drawn(), first);
    original.format = Format::rgba8;
    drawn();
    EXPECT_EQ(bloom.level(1).format(), Format::rgba8);
    original.blur_radius = 0;
    const GLuint unblurred = drawn();
    EXPECT_EQ(drawn(), unblurred);
}

TEST_F(PyramidBloomTest, drawsTheSameFrameAfterTwoHundredResizesAndLeavesNothing) {
    PyramidBloom bloom(shaders);
    const auto at = [&](glm::ivec2 size) {
        const Texture source = disc(size);
        const Framebuffer target = targetOf(size);
        render(bloom, source, target, original);
        return readTexture(target.color()).pixels;
    };
    const auto storm = [&] {
        const auto before = at({64, 48});
        const int living = livingTextures();
        for (int i = 0; i < 200; ++i)
            at({1 + i * 37 % 190, 1 + i * 53 % 170});
        EXPECT_EQ(at({64, 48}), before);
        EXPECT_EQ(livingTextures(), living);
    };
    storm();
    useSplines(); // which round sizes up, and have one target more where the frame is small
    storm();
}

TEST_F(PyramidBloomTest, movesAndTakesItsTexturesWithIt) {
    const Texture source = disc({64, 48});
    const Framebuffer target = targetOf({64, 48});
    const int living = livingTextures();
    GLuint level = 0;
    {
        PyramidBloom first(shaders);
        render(first, source, target, original);
        level = first.level(0).id();
        PyramidBloom second = std::move(first);
        EXPECT_EQ(second.level(0).id(), level);
        render(second, source, target, original);
        EXPECT_EQ(livingTextures(), living + 2 * original.levels);
    }
    EXPECT_FALSE(glIsTexture(level));
    EXPECT_EQ(livingTextures(), living);
}

TEST_F(PyramidBloomTest, refusesALevelCountThatItCannotHave) {
    PyramidBloom bloom(shaders);
    const Texture source = disc({8, 8});
    const Framebuffer target = targetOf({8, 8});
    for (const int levels : {0, -1, 9}) {
        original.levels = levels;
        EXPECT_CONTAINS(messageOf<std::invalid_argument>([&] { render(bloom, source, target, original); }),
                        "levels; 1 to 8 are possible");
    }
}

} // namespace
} // namespace gll::test
