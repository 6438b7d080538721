// Every tone map and encoding of the shaders over five decades of light, against double; and what no light
// should be: infinite, negative, not a number.
#include "01_hdr/tone_map.hpp"
#include "gl/pass.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"
#include "rung/settings.hpp"
#include "tone_reference.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace gll::truth {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

class ToneMapTest : public testing::Test {
  protected:
    ToneMapTest() : shaders(shaderRoots()) {}
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("tone map")); }

    static std::vector<std::filesystem::path> shaderRoots() {
        auto roots = Resources().shaderRoots();
        roots.emplace_back(TRUTH_SHADERS);
        return roots;
    }

    // The colours through toneMap(), and encode() where an encoding is named, in 32-bit floats throughout.
    std::vector<glm::vec3> run(const std::vector<glm::vec3>& colors, const std::string& tone_map,
                               const std::string& encoding = "") {
        Settings settings;
        const hdr::ToneMapOptions options(settings, tone_map, encoding.empty() ? "gamma22" : encoding);
        const Defines encoded = {{"ENCODED", encoding.empty() ? "0" : "1"}};
        const glm::ivec2 size(static_cast<int>(colors.size()), 1);
        std::vector<float> values;
        for (const glm::vec3& color : colors)
            values.insert(values.end(), {color.r, color.g, color.b});
        const Texture input({.size = size, .format = Format::rgba32f, .filter = Filter::nearest}, values);
        const Framebuffer target({{"out", Format::rgba32f}}, size);
        const Program& program = shaders.fullScreen("tone_map.frag", options.defines() + encoded);
        drawPass("tone map", target,
                 {.program = program,
                  .inputs = {{"scene_color", input}},
                  .part = {.uniforms = {{"white_point", 4.0F}}}},
                 triangle);
        const Image image = readTexture(target.color());
        const auto& pixels = std::get<std::vector<float>>(image.pixels);
        std::vector<glm::vec3> result;
        for (std::size_t i = 0; i < colors.size(); ++i)
            result.emplace_back(pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]);
        return result;
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    Mesh triangle = Mesh::fullScreenTriangle();
    ShaderLibrary shaders;
};

// Empty, then every encoding.
std::vector<std::string> withoutAndWithEncodings() {
    std::vector<std::string> all(hdr::encodings.begin(), hdr::encodings.end());
    all.insert(all.begin(), "");
    return all;
}

// 0, then 1e-7 to 65504 in even steps of the logarithm.
std::vector<glm::vec3> greyRamp() {
    constexpr int steps = 8000;
    std::vector<glm::vec3> ramp = {glm::vec3(0)};
    for (int i = 0; i <= steps; ++i)
        ramp.emplace_back(static_cast<float>(1e-7 * std::pow(brightest / 1e-7, double(i) / steps)));
    return ramp;
}

std::vector<glm::vec3> colors() {
    std::mt19937 random(1); // its sequence is the standard's, the same everywhere
    const auto channel = [&] {
        return static_cast<float>(std::exp2(double(random()) / 4294967296.0 * 30 - 16)); // 2^-16 to 2^14
    };
    std::vector<glm::vec3> result;
    for (int i = 0; i < 8000; ++i) {
        const float r = channel();
        const float g = channel();
        result.emplace_back(r, g, channel());
    }
    return result;
}

TEST_F(ToneMapTest, everyCurveIsItsFormula) {
    // Display values; a code of 8 bits is 3.9e-3. Measured on llvmpipe: below 5e-7. AgX's polynomial has
    // terms of up to 40 that cancel to 1 (measured: 5.4e-6).
    for (const std::string name : hdr::tone_maps) {
        const double bound = name == "agx" ? 1e-5 : 2e-6;
        for (const auto& input : {greyRamp(), colors()}) {
            const auto output = run(input, name);
            double largest = 0;
            for (std::size_t i = 0; i < input.size(); ++i) {
                const glm::dvec3 expected = toneMapped(name, input[i]);
                for (int c = 0; c < 3; ++c) {
                    const double error = std::abs(output[i][c] - expected[c]);
                    ASSERT_LE(error, bound) << name << " of " << input[i].r << ", " << input[i].g << ", "
                                            << input[i].b << " channel " << c;
                    largest = std::max(largest, error);
                }
            }
            std::printf("%-16s %-7s largest error %.2g\n", name.c_str(),
                        input[0] == glm::vec3(0) ? "greys" : "colours", largest);
        }
    }
}

TEST_F(ToneMapTest, everyEncodingIsItsFormulaBehindEveryCurve) {
    // Measured on llvmpipe, whose pow() is made of polynomials for exp2 and log2: below 3e-7.
    constexpr double bound = 2e-6;
    for (const std::string encoding : hdr::encodings)
        for (const std::string name : hdr::tone_maps) {
            const auto input = greyRamp();
            const auto linear = run(input, name);
            const auto output = run(input, name, encoding);
            double largest = 0;
            for (std::size_t i = 0; i < input.size(); ++i) {
                const double error = std::abs(output[i].r - encoded(encoding, linear[i]).r);
                ASSERT_LE(error, bound) << name << " then " << encoding << " of " << input[i].r;
                largest = std::max(largest, error);
            }
            std::printf("%-16s %-7s largest error %.2g\n", name.c_str(), encoding.c_str(), largest);
        }
}

TEST_F(ToneMapTest, moreLightIsNeverDarkerAndDisplayLightStaysInRange) {
    // Half a step of a float below 1 is 6e-8; subtracting an offset from light of 0.08 costs PBR Neutral a
    // few.
    constexpr float rounding = 3e-7F;
    for (const std::string name : hdr::tone_maps)
        for (const std::string& encoding : withoutAndWithEncodings()) {
            const auto output = run(greyRamp(), name, encoding);
            // Where encoded, the slope of the curve near black magnifies what rounding there is.
            const float allowed = !encoding.empty() ? 1e-4F : name == "agx" ? 1e-5F : rounding;
            for (std::size_t i = 0; i < output.size(); ++i) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_GE(output[i][c], 0.0F) << name << " " << encoding << " step " << i;
                    ASSERT_LE(output[i][c], 1.0F) << name << " " << encoding << " step " << i;
                    if (i > 0) {
                        ASSERT_GE(output[i][c], output[i - 1][c] - allowed)
                            << name << " " << encoding << " " << i;
                    }
                }
            }
            EXPECT_LT(output.front().r, 1e-6F) << name;
            EXPECT_GT(output.back().r, 0.99F) << name;
        }
}

// 1 - exp(-1e-7) is a fifth off in floats, and so dark that encoding makes 5e-5 of it: 0.014 of an 8-bit
// code.
TEST_F(ToneMapTest, noInputIsTooMuchOrNoNumber) {
    const float extremes[] = {0,       -0.0F, 1e-7F,    1e-40F,   65504,     65536,        1e20F,
                              3.4e38F, -1,    -3.4e38F, infinity, -infinity, not_a_number, -not_a_number};
    std::vector<glm::vec3> input;
    for (const float extreme : extremes) {
        input.emplace_back(extreme);
        for (int c = 0; c < 3; ++c) { // alone, beside ordinary light
            input.emplace_back(0.5F, 0.25F, 0.75F);
            input.back()[c] = extreme;
        }
    }
    for (const std::string name : hdr::tone_maps)
        for (const std::string& encoding : withoutAndWithEncodings()) {
            const auto output = run(input, name, encoding);
            for (std::size_t i = 0; i < input.size(); ++i) {
                glm::dvec3 expected = toneMapped(name, input[i]);
                if (!encoding.empty()) expected = encoded(encoding, expected);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(output[i][c], expected[c], encoding.empty() ? 2e-6 : 1e-4)
                        << name << " " << encoding << " of " << input[i].r << ", " << input[i].g << ", "
                        << input[i].b << " channel " << c;
            }
        }
}

} // namespace
} // namespace gll::truth
