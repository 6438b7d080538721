// The meter of 02_auto_exposure against double: every reduction, and the key and the exposure made of it.
#include "02_auto_exposure/auto_exposure.hpp"
#include "auto_exposure_reference.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"

#include <gtest/gtest.h>
#include <random>

namespace gll::truth {
namespace {

using namespace auto_exposure;

// The mean of the sorted logarithms between two shares of them; the ends count in part.
double trimmedMean(const Light& light, double low_share, double high_share) {
    std::vector<double> stops;
    for (const glm::vec3& pixel : light.pixels)
        stops.push_back(logLuminance(pixel));
    std::sort(stops.begin(), stops.end());
    const double low = low_share * double(stops.size());
    const double high = high_share * double(stops.size());
    double sum = 0;
    for (std::size_t i = 0; i < stops.size(); ++i)
        sum += stops[i] * std::max(std::min(double(i + 1), high) - std::max(double(i), low), 0.0);
    return sum / (high - low);
}

// From dark on the left to light on the right, by about 12 stops, each pixel with a luminance of its own:
// what weighs one side more, or loses a column, is found out.
Light uneven(glm::ivec2 size, unsigned seed = 1) {
    std::mt19937 random(seed); // its sequence is the standard's, the same everywhere
    Light light{size, {}};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const double noise = double(random()) / 4294967296.0;
            const double stops = 9.0 * (x + 0.5) / size.x + 3.0 * (y + 0.5) / size.y - 9 + 2 * noise;
            light.pixels.push_back(static_cast<float>(std::exp2(stops)) * glm::vec3(1, 0.7F, 0.3F));
        }
    return light;
}

class MeterTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("auto exposure")); }

    static float onlyValue(const Texture& texture) {
        return std::get<std::vector<float>>(readTexture(texture).pixels).at(0);
    }

    static Texture textureOf(const Light& light) {
        std::vector<float> values;
        for (const glm::vec3& pixel : light.pixels)
            values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
        return Texture({.size = light.size, .format = Format::rgba32f, .filter = Filter::nearest}, values);
    }

    // log2 of the average luminance that the reduction measures.
    double measured(const Light& light, const std::string& reduction, double white = white_point) {
        settings.set("reduction", reduction);
        const Texture hdr = textureOf(light);
        Frame frame(1, presented, triangle, nullptr);
        return onlyValue(meter.measure(frame, hdr, static_cast<float>(white)));
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    Settings settings;
    AutoExposureOptions options{settings};
    ShaderLibrary shaders{Resources().shaderRoots()};
    Mesh triangle = Mesh::fullScreenTriangle();
    Framebuffer presented{{{.name = "frame", .format = Format::rgba8}}, {1, 1}};
    LuminanceMeter meter{shaders, options};
    AutoExposure exposure{shaders, options};
};

TEST_F(MeterTest, theAreaReductionIsTheLogAverageAtEverySize) {
    std::vector<glm::ivec2> sizes = {{641, 479}, {500, 500}, {1000, 3}, {2, 4097}, {16384, 1}, {1, 16384}};
    for (int x = 1; x <= 70; x += 3)
        for (int y = 1; y <= 70; y += 5)
            sizes.emplace_back(x, y);
    double largest = 0;
    for (const glm::ivec2 size : sizes) {
        const Light light = uneven(size);
        const double error = std::abs(measured(light, "area") - logAverage(light));
        // Measured on llvmpipe: below 3e-6. The aim is 0.01.
        ASSERT_LE(error, 1e-5) << size.x << "x" << size.y;
        largest = std::max(largest, error);
    }
    std::printf("area, %zu sizes: largest error %.2g EV\n", sizes.size(), largest);
}

TEST_F(MeterTest, mipmapsAreTheLogAverageWhereSizesArePowersOfTwo) {
    constexpr double white = 1000; // above all light here: nothing is clamped
    for (const glm::ivec2 size : {glm::ivec2(1), {64, 64}, {512, 256}, {8, 1}, {1024, 1}}) {
        const Light light = uneven(size);
        const double r16 = std::abs(measured(light, "mipmap_r16", white) - logAverage(light));
        const double r16f = std::abs(measured(light, "mipmap_r16f", white) - logAverage(light));
        std::printf("%dx%d: mipmap_r16 %.2g EV, mipmap_r16f %.2g EV off\n", size.x, size.y, r16, r16f);
        // Each of up to ten levels is rounded (or cut) by up to a step: R16 has 65535 of them over 37 stops,
        // R16F steps of 1/128 stop from 8 to 16.
        EXPECT_LE(r16, 10 * 37.0 / 65535) << size.x << "x" << size.y;
        EXPECT_LE(r16f, 10 / 128.0) << size.x << "x" << size.y;
    }
}

// As on the page: at other sizes the driver's mipmaps weigh pixels unevenly. No bound: drivers may do better.
TEST_F(MeterTest, mipmapsOfOtherSizesGiveANumber) {
    for (const glm::ivec2 size : {glm::ivec2(640, 480), {641, 479}, {7, 1}}) {
        const Light light = uneven(size);
        for (const char* reduction : {"mipmap_r16", "mipmap_r16f", "area"}) {
            const double error = measured(light, reduction, 1000) - logAverage(light);
            EXPECT_TRUE(std::isfinite(error));
            std::printf("%4dx%-4d %-12s %+.5f EV\n", size.x, size.y, reduction, error);
        }
    }
}

TEST_F(MeterTest, theMappedRangeEndsAtTheWhitePoint) {
    const Light light = uneven({64, 64});
    Light clipped = light;
    for (glm::vec3& pixel : clipped.pixels) {
        const double luminance = luminanceOf(glm::dvec3(pixel));
        if (luminance > white_point) pixel *= static_cast<float>(white_point / luminance);
    }
    EXPECT_GT(logAverage(light) - logAverage(clipped), 0.1) << "nothing was there to clip";
    EXPECT_NEAR(measured(light, "mipmap_r16"), logAverage(clipped), 10 * 25.0 / 65535);
}

TEST_F(MeterTest, theHistogramIsTheTrimmedMeanWhereItCountsEveryPixel) {
    for (const glm::ivec2 size : {glm::ivec2(1), {7, 1}, {33, 61}, {64, 64}}) {
        const Light light = uneven(size);
        settings.set("low_percent", "0");
        settings.set("high_percent", "100");
        EXPECT_NEAR(measured(light, "histogram"), logAverage(light), 1e-4) << size.x << "x" << size.y;
        settings.set("low_percent", "10");
        settings.set("high_percent", "95");
        // Within a bin, a quarter of a stop wide, the trimmed part counts with the bin's mean.
        EXPECT_NEAR(measured(light, "histogram"), trimmedMean(light, 0.1, 0.95), 0.02)
            << size.x << "x" << size.y;
    }
    settings.set("low_percent", "50");
    settings.set("high_percent", "50");
    const Light light = uneven({64, 64});
    EXPECT_NEAR(measured(light, "histogram"), trimmedMean(light, 0.4999, 0.5001), 0.13);
}

TEST_F(MeterTest, everyPixelFallsIntoTheBinOfItsLuminance) {
    Light light = uneven({64, 64});
    light.pixels[0] = glm::vec3(0);            // below the first bin
    light.pixels[1] = glm::vec3(1e9F);         // beyond the last
    light.pixels[2] = glm::vec3(not_a_number); // in none
    std::array<double, 128> expected = {};
    for (const glm::vec3& pixel : light.pixels)
        if (std::isfinite(pixel.r))
            ++expected[static_cast<std::size_t>(std::clamp((logLuminance(pixel) + 16) * 4, 0.0, 127.5))];
    const Texture hdr = textureOf(light);
    Frame frame(1, presented, triangle, nullptr);
    const Image image = readTexture(meter.drawHistogram(frame, hdr));
    const auto& bins = std::get<std::vector<float>>(image.pixels); // number, sum of stops
    double moved = 0;                                              // by rounding at a bin's edge
    double total = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        moved += std::abs(bins[2 * i] - expected[i]);
        total += bins[2 * i];
    }
    EXPECT_EQ(total, 64 * 64 - 1);
    EXPECT_LE(moved, 2);
}

TEST_F(MeterTest, aSampledHistogramIsCloseToTheLogAverage) {
    settings.set("low_percent", "0");
    settings.set("high_percent", "100");
    for (const glm::ivec2 size : {glm::ivec2(640, 480), {641, 479}, {1000, 3}}) {
        const Light light = uneven(size);
        EXPECT_NEAR(measured(light, "histogram"), logAverage(light), 0.1) << size.x << "x" << size.y;
    }
}

TEST_F(MeterTest, aSampledHistogramSeesBothSidesOfAFinePattern) {
    settings.set("low_percent", "0");
    settings.set("high_percent", "100");
    Light light{{512, 512}, {}};
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            light.pixels.emplace_back((x + y) % 2 == 0 ? 0.25F : 4.0F);
    // Half of 4096 samples at 4 stops from the other: their mean is uncertain by 0.03.
    EXPECT_NEAR(measured(light, "histogram"), 0, 0.1);
}

TEST_F(MeterTest, whatIsNoFiniteNumberIsLeftOutOrBounded) {
    for (const float bad : {not_a_number, infinity, -infinity}) {
        Light light = uneven({13, 11});
        light.pixels[20] = glm::vec3(bad);
        light.pixels[21].g = bad;
        EXPECT_NEAR(measured(light, "area"), logAverage(light), 1e-5) << bad;
        settings.set("low_percent", "0");
        settings.set("high_percent", "100");
        EXPECT_NEAR(measured(light, "histogram"), logAverage(light), 1e-4) << bad;
        for (const char* reduction : {"mipmap_r16", "mipmap_r16f"}) {
            light = uneven({16, 16}); // two pixels of 256 by at most 43 stops
            const double without = measured(light, reduction);
            light.pixels[20] = light.pixels[21] = glm::vec3(bad);
            EXPECT_NEAR(measured(light, reduction), without, 43 * 2 / 256.0) << bad << " " << reduction;
        }
        light.pixels.assign(light.pixels.size(), glm::vec3(not_a_number)); // nothing is left: black
        for (const std::string& reduction : settings.at("reduction").choices)
            EXPECT_NEAR(measured(light, reduction), std::log2(epsilon), 1 / 64.0) << reduction;
    }
}

TEST_F(MeterTest, whatIsDarkerThanBlackCountsAsBlack) {
    for (const std::string& reduction : settings.at("reduction").choices) {
        EXPECT_NEAR(measured({{2, 1}, {glm::vec3(-1), glm::vec3(-1e-9F)}}, reduction), std::log2(epsilon),
                    1 / 64.0) // R16F has steps of 1/64 there
            << reduction;
        EXPECT_NEAR(measured({{1, 1}, {glm::vec3(0)}}, reduction), std::log2(epsilon), 1 / 64.0) << reduction;
    }
}

// Stops of average luminance through exposure.frag: factor, luminance adapted to, key, metered.
TEST_F(MeterTest, exposureIsKeyOverAverageWithinTheLimits) {
    const auto exposed = [&](double stop, double previous_stop) {
        const std::vector<float> value = {static_cast<float>(stop)};
        const Texture metered({.format = Format::r32f, .filter = Filter::nearest}, value);
        Frame frame(1, presented, triangle, nullptr);
        const Image image = readTexture(exposure.draw(frame, metered, previous_stop, 0.5F));
        return std::get<std::vector<float>>(image.pixels);
    };
    for (double stop = -30; stop <= 20; stop += 0.37)
        for (const double previous : {-9.0, -2.0, 5.5}) {
            settings.set("key", "0");
            auto state = exposed(stop, previous);
            const double goal = std::clamp(stop, -9.0, 9.0);
            const double share = 1 - std::exp(-dt_s / (goal > previous ? up_s : down_s));
            const double average = std::exp2(previous + (goal - previous) * share);
            const double key = 1.03 - 2 / (2 + std::log10(average + 1));
            EXPECT_NEAR(state[1] / average, 1, 2e-5) << stop;
            EXPECT_NEAR(state[2] / key, 1, 2e-5) << stop;
            EXPECT_NEAR(state[0] / (key / average * std::exp2(0.5)), 1, 4e-5) << stop;
            EXPECT_NEAR(state[3], stop, 1e-5);
            settings.set("key", "0.18");
            state = exposed(stop, previous);
            EXPECT_NEAR(state[0] / (0.18 / average * std::exp2(0.5)), 1, 4e-5) << stop;
        }
}

} // namespace
} // namespace gll::truth
