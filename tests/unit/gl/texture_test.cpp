// Textures: orientation, formats, levels and sampling.
#include "gl_test.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace gll::test {
namespace {

using TextureTest = GlTest;

constexpr const char* sample_fragment = R"(#version 330 core
uniform sampler2D source;
uniform vec2 at;
uniform float lod;
out vec4 color;
void main() { color = textureLod(source, at, lod); }
)";

// What a shader reads there, unrounded.
glm::vec4 sampled(const Texture& texture, glm::vec2 at, float lod, const Mesh& triangle) {
    const Program program = makeProgram(full_screen_vertex, sample_fragment);
    const Framebuffer target({{"out", Format::rgba32f}}, {1, 1});
    drawPass("sample", target,
             {.program = program, .inputs = {{"source", texture}}, .uniforms = {{"at", at}, {"lod", lod}}},
             triangle);
    return pixelOf(target.color(), 0, 0);
}

TEST_F(TextureTest, uploadsTakeTheBottomRowFirstAndReadingGivesTheTopRowFirst) {
    const std::vector<float> pixels = {1, 2, 3, 4, 5, 6}; // two columns, three rows from the bottom
    const Texture texture({.size = {2, 3}, .format = Format::r32f, .filter = Filter::nearest}, pixels);
    EXPECT_EQ(std::get<std::vector<float>>(readTexture(texture).pixels),
              (std::vector<float>{5, 6, 3, 4, 1, 2}));
    EXPECT_EQ(sampled(texture, {0.25F, 0.1F}, 0, triangle).r, 1);
    EXPECT_EQ(sampled(texture, {0.75F, 0.9F}, 0, triangle).r, 6);
}

// Each side's texels hold the direction to their own middles, which a shader then finds there.
TEST_F(TextureTest, aCubeIsReadByDirectionAndAcrossItsEdges) {
    constexpr int size = 4;
    constexpr glm::vec3 middles[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    constexpr glm::vec3 along_s[] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
    constexpr glm::vec3 along_t[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    std::vector<float> pixels;
    for (int side = 0; side < 6; ++side)
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                const glm::vec3 direction =
                    middles[side] + (2 * (static_cast<float>(column) + 0.5F) / size - 1) * along_s[side] +
                    (2 * (static_cast<float>(row) + 0.5F) / size - 1) * along_t[side];
                pixels.insert(pixels.end(), {direction.x, direction.y, direction.z});
            }
    Texture texture({.size = {size, size},
                     .format = Format::rgba32f,
                     .filter = Filter::trilinear,
                     .levels = 2,
                     .is_cube = true},
                    pixels);
    texture.setLevel(1, std::vector<float>(6 * 4 * 3, 7.0F));
    const Program program = makeProgram(full_screen_vertex, R"(#version 330 core
uniform samplerCube source;
uniform vec3 at;
uniform float lod;
out vec4 color;
void main() { color = textureLod(source, at, lod); }
)");
    const Framebuffer target({{"out", Format::rgba32f}}, {1, 1});
    const auto read = [&](const glm::vec3& at, float lod) {
        drawPass(
            "sample", target,
            {.program = program, .inputs = {{"source", texture}}, .uniforms = {{"at", at}, {"lod", lod}}},
            triangle);
        return glm::vec3(pixelOf(target.color(), 0, 0));
    };
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        const glm::vec3 direction(pixels[i], pixels[i + 1], pixels[i + 2]);
        EXPECT_LT(glm::distance(read(direction, 0), direction), 1e-3F) << i / 3;
    }
    // In the middle of an edge: the mean of both sides, whose texels end an eighth of a side before it.
    EXPECT_LT(glm::distance(read({1, 1, 0}, 0), glm::vec3(0.875F, 0.875F, 0)), 1e-3F);
    EXPECT_EQ(read({0.3F, -1, 0.2F}, 1), glm::vec3(7));
    EXPECT_THROW(Texture({.size = {4, 2}, .is_cube = true}), std::invalid_argument);
    EXPECT_THROW(texture.setTexel({0, 0}, 1), std::out_of_range);
}

TEST_F(TextureTest, byteRowsOfAnyLengthAreReadWhole) {
    std::vector<std::uint8_t> pixels(3 * 3 * 3); // rows of 9 bytes, which a 4-byte alignment would tear
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::uint8_t>(i * 9);
    const Texture texture({.size = {3, 3}, .format = Format::rgba8}, pixels);
    EXPECT_EQ(pixelOf(texture, 1, 2), glm::vec4(21 * 9, 22 * 9, 23 * 9, 255) / 255.0F);
    const Texture one_channel({.size = {3, 3}, .format = Format::r8}, std::span(pixels).subspan(0, 9));
    EXPECT_EQ(pixelOf(one_channel, 2, 2).r, 72 / 255.0F);
}

TEST_F(TextureTest, everyFormatKeepsWhatItsBitsCanHold) {
    struct Case {
        Format format;
        double relative; // half a step, or 1 / 2^mantissa bits
        double absolute;
    };
    const Case cases[] = {
        {Format::r8, 0, 0.5 / 255},
        {Format::rg8, 0, 0.5 / 255},
        {Format::rgba8, 0, 0.5 / 255},
        {Format::rgb10_a2, 0, 0.5 / 3},
        {Format::r16, 0, 0.5 / 65535},
        {Format::rg16, 0, 0.5 / 65535},
        {Format::r11f_g11f_b10f, 1.0 / 32, 1e-5},
        {Format::r16f, 1.0 / 1024, 1e-7},
        {Format::rg16f, 1.0 / 1024, 1e-7},
        {Format::rgb16f, 1.0 / 1024, 1e-7},
        {Format::rgba16f, 1.0 / 1024, 1e-7},
        {Format::r32f, 0, 0},
        {Format::rg32f, 0, 0},
        {Format::rgba32f, 0, 0},
    };
    for (const Case& c : cases) {
        const FormatInfo info = formatInfo(c.format);
        const float scale = info.is_float ? 100.0F : 1.0F;
        const auto channels = static_cast<std::size_t>(info.channels);
        std::vector<float> pixels(5 * 3 * channels);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = scale * static_cast<float>(i) / static_cast<float>(pixels.size() - 1);
        const Texture texture({.size = {5, 3}, .format = c.format}, pixels);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x)
                for (std::size_t k = 0; k < channels; ++k) {
                    const float expected = pixels[static_cast<std::size_t>(y * 5 + x) * channels + k];
                    // Two bits for the alpha of rgb10_a2 only.
                    const double step = c.format == Format::rgb10_a2 && k < 3 ? 0.5 / 1023 : c.absolute;
                    EXPECT_NEAR(pixelOf(texture, x, y)[static_cast<int>(k)], expected,
                                c.relative * expected + step * 1.001)
                        << info.name << " " << x << "," << y << " channel " << k;
                }
    }
}

TEST_F(TextureTest, floatFormatsKeepInfinityAndNotANumberForWhoeverChecksThem) {
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> pixels = {infinity, std::nanf(""), -1, 65504};
    const Texture texture({.format = Format::rgba16f}, pixels);
    const glm::vec4 value = pixelOf(texture, 0, 0);
    EXPECT_EQ(value.r, infinity);
    EXPECT_TRUE(std::isnan(value.g));
    EXPECT_EQ(value.b, -1);
    EXPECT_EQ(value.a, 65504);
}

TEST_F(TextureTest, oneTexelIsOverwrittenAndNoOther) {
    const std::vector<float> pixels(3 * 2, 0.25F);
    const Texture texture({.size = {3, 2}, .format = Format::r16f}, pixels);
    texture.setTexel({2, 1}, std::nanf(""));
    EXPECT_TRUE(std::isnan(pixelOf(texture, 2, 1).r));
    EXPECT_EQ(pixelOf(texture, 1, 1).r, 0.25F);
    EXPECT_EQ(pixelOf(texture, 2, 0).r, 0.25F);
    EXPECT_THROW(texture.setTexel({3, 0}, 0), std::out_of_range);
    EXPECT_THROW(texture.setTexel({0, -1}, 0), std::out_of_range);
}

TEST_F(TextureTest, srgbIsDecodedForTheShaderAndReadBackAsStored) {
    constexpr std::uint8_t stored[] = {188, 0, 255, 188};
    const Texture texture({.format = Format::srgb8_alpha8}, stored);
    const glm::vec4 seen = sampled(texture, {0.5F, 0.5F}, 0, triangle);
    EXPECT_NEAR(seen.r, std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-3);
    EXPECT_NEAR(seen.a, 188 / 255.0, 1e-6); // alpha is never encoded
    const Image image = readTexture(texture);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(image.pixels),
              (std::vector<std::uint8_t>{188, 0, 255, 188}));
    EXPECT_EQ(image.color_space, ColorSpace::srgb);
}

TEST_F(TextureTest, levelCountIsTheFloorOfTheBinaryLogarithmPlusOne) {
    EXPECT_EQ(levelCount({1, 1}), 1);
    EXPECT_EQ(levelCount({2, 1}), 2);
    EXPECT_EQ(levelCount({3, 3}), 2);
    EXPECT_EQ(levelCount({4, 4}), 3);
    EXPECT_EQ(levelCount({1, 640}), 10);
    EXPECT_EQ(levelCount({1023, 1}), 10);
    EXPECT_EQ(levelCount({1024, 1}), 11);
    EXPECT_EQ(levelCount({16384, 16384}), 15);
}

TEST_F(TextureTest, mipLevelsReachDownToTheMeanOfAPowerOfTwo) {
    std::vector<float> pixels(8 * 8);
    double sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        sum += pixels[i] = static_cast<float>(i % 7);
    const Texture texture(
        {.size = {8, 8}, .format = Format::r32f, .filter = Filter::trilinear, .levels = levelCount({8, 8})},
        pixels);
    EXPECT_NEAR(sampled(texture, {0.5F, 0.5F}, 3, triangle).r, sum / 64, 1e-5);
    EXPECT_NEAR(sampled(texture, {0.5F, 0.5F}, 99, triangle).r, sum / 64, 1e-5);
    EXPECT_EQ(sampled(texture, {0.0625F, 0.0625F}, 0, triangle).r, pixels[0]);
}

TEST_F(TextureTest, sampledOutsideItsEdgesATextureDoesAsItsWrapSays) {
    const std::vector<float> pixels = {10, 20};
    const auto outside = [&](Wrap wrap) {
        const Texture texture({.size = {2, 1},
                               .format = Format::r32f,
                               .filter = Filter::nearest,
                               .wrap_x = wrap,
                               .wrap_y = wrap},
                              pixels);
        return sampled(texture, {1.25F, 0.5F}, 0, triangle).r;
    };
    EXPECT_EQ(outside(Wrap::clamp_to_edge), 20);
    EXPECT_EQ(outside(Wrap::repeat), 10);
    EXPECT_EQ(outside(Wrap::border_one), 1);
}

TEST_F(TextureTest, linearFiltersBetweenTexelsAndNearestDoesNot) {
    const std::vector<float> pixels = {0, 1};
    const auto between = [&](Filter filter) {
        const Texture texture({.size = {2, 1}, .format = Format::r32f, .filter = filter}, pixels);
        return sampled(texture, {0.4F, 0.5F}, 0, triangle).r;
    };
    EXPECT_NEAR(between(Filter::linear), 0.3F, 1.0F / 256);
    EXPECT_EQ(between(Filter::nearest), 0);
}

TEST_F(TextureTest, pixelsThatDoNotFillTheTextureAreAnError) {
    const std::vector<float> pixels(7);
    EXPECT_EQ(messageOf<std::invalid_argument>([&] {
                  Texture({.size = {2, 2}}, pixels);
              }),
              "texture: 7 values do not fill 4 texels of 1 to 4 channels");
    EXPECT_THROW(Texture({.size = {1, 1}}, pixels), std::invalid_argument);
    EXPECT_THROW(Texture({.size = {2, 2}}, std::span<const float>()), std::invalid_argument);
    EXPECT_THROW(Texture({.size = {0, 2}}, pixels), std::invalid_argument);
    EXPECT_THROW(Texture({.size = {-1, -1}}, std::span(pixels).subspan(0, 1)), std::runtime_error);
}

TEST_F(TextureTest, sizesThatNoTextureHasAreAnError) {
    for (const glm::ivec2 size :
         {glm::ivec2(0, 4), glm::ivec2(4, 0), glm::ivec2(-1, 1), glm::ivec2(1 << 20, 1)})
        EXPECT_CONTAINS(messageOf<std::runtime_error>([&] { Texture({.size = size}); }),
                        "is outside 1x1 to ");
}

TEST_F(TextureTest, aMovedTextureIsOwnedOnceAndDeletedOnce) {
    const std::vector<float> pixels = {7};
    Texture first({.format = Format::r32f}, pixels);
    const GLuint id = first.id();
    Texture second = std::move(first);
    EXPECT_EQ(second.id(), id);
    EXPECT_EQ(glIsTexture(id), GL_TRUE);
    Texture third;
    EXPECT_EQ(third.id(), 0U);
    third = std::move(second);
    EXPECT_EQ(pixelOf(third, 0, 0).r, 7);
    third = Texture();
    EXPECT_EQ(glIsTexture(id), GL_FALSE);
}

} // namespace
} // namespace gll::test
