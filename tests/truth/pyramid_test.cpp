// The passes of 04_pyramid_bloom on given texels, in 32-bit floats throughout, against the same passes in
// double: bright pass, every filter down and up, the blur, the composite, and what the printed forms do to
// light.
#include "04_pyramid_bloom/pyramid_bloom.hpp"
#include "bloom_reference.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"

#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>

namespace gll::truth {
namespace {

using namespace pyramid_bloom;

// What PyramidFilters offers, but for splines, which have a test of their own.
std::vector<std::string> offered(const char* setting) {
    Settings settings;
    const PyramidFilters filters(settings, "none", "box");
    std::vector<std::string> choices = settings.at(setting).choices;
    std::erase(choices, "spline");
    return choices;
}
const std::vector<std::string> karis_kinds = offered("karis");
const std::vector<std::string> down_filters = offered("down_filter");
const std::vector<std::string> up_filters = offered("up_filter");
const glm::ivec2 sizes[] = {{96, 64}, {101, 77}, {7, 3}, {1, 1}}; // even down to the last level, odd, tiny
constexpr int levels = 5;

// Of the largest value of a picture: 2^-24 of arithmetic, and a place in the texture that is a float too,
// some 100 * 2^-24 texels off, where neighbours differ by everything there is. Measured on llvmpipe: up
// to 1.4e-5.
constexpr double pass_error = 4e-5;

// Keeps every pass's target as it was when the pass had ended.
class Recorder final : public PassObserver {
  public:
    std::map<std::string, Plane> planes;
    std::vector<std::string> order;

    void after(const DrawnPass& pass) override {
        planes[pass.name] = planeOf(readTexture(pass.target->color()));
        order.push_back(pass.name);
    }
};

struct Filters {
    std::string karis = "none";
    std::string down = "13tap";
    std::string up = "tent";
};

class PyramidTruth : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("pyramid")); }

    // Light from dark to sixteen times white, noise from texel to texel; its sequence is the standard's.
    static std::vector<float> light(glm::ivec2 size) {
        std::mt19937 random(7);
        std::vector<float> texels(static_cast<std::size_t>(size.x * size.y) * 4);
        for (float& value : texels)
            value = static_cast<float>(std::exp2(double(random()) / 4294967296.0 * 10 - 6));
        return texels;
    }
    static std::vector<float> flat(glm::ivec2 size, float value) {
        return std::vector<float>(static_cast<std::size_t>(size.x * size.y) * 4, value);
    }

    // Draws bloom and composite and remembers every pass.
    Recorder draw(glm::ivec2 size, const std::vector<float>& texels, const Filters& filters = {},
                  const std::function<void(PyramidBloomParameters&)>& change = {}, float strength = 1) {
        Settings settings;
        const PyramidFilters choices(settings, filters.karis, filters.down);
        settings.set("up_filter", filters.up);
        PyramidBloomParameters parameters{
            .filters = choices, .levels = levels, .blur_radius = 0, .format = Format::rgba32f};
        if (change) change(parameters);
        const Texture source({.size = size, .format = Format::rgba32f}, texels);
        const Framebuffer target({{"out", Format::rgba32f}}, size);
        Recorder recorder;
        Frame frame(1, target, triangle, &recorder);
        PyramidBloom bloom(shaders);
        bloom.draw(frame, source, parameters);
        bloom.composite(frame, source, strength, target);
        recorder.planes["source"] = planeOf(readTexture(source));
        return recorder;
    }

    // The largest difference, of the expected plane's largest value.
    static double errorOf(const Plane& actual, const Plane& expected) {
        EXPECT_EQ(actual.width, expected.width);
        EXPECT_EQ(actual.height, expected.height);
        double largest = 0;
        double scale = 1e-30;
        for (std::size_t i = 0; i < std::min(actual.pixels.size(), expected.pixels.size()); ++i)
            for (int c = 0; c < 3; ++c) {
                const double difference = std::abs(actual.pixels[i][c] - expected.pixels[i][c]);
                EXPECT_TRUE(std::isfinite(difference));
                largest = std::max(largest, difference);
                scale = std::max(scale, expected.pixels[i][c]);
            }
        return largest / scale;
    }
    static void expectEqual(const std::string& what, const Plane& actual, const Plane& expected,
                            double bound = pass_error) {
        const double error = errorOf(actual, expected);
        std::printf("%-44s %.2g\n", what.c_str(), error);
        EXPECT_LE(error, bound) << what;
    }
    static std::string name(glm::ivec2 size) {
        return std::to_string(size.x) + "x" + std::to_string(size.y) + " ";
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    Mesh triangle = Mesh::fullScreenTriangle();
    ShaderLibrary shaders{Resources().shaderRoots()};
};

TEST_F(PyramidTruth, theBrightPassIsItsFormulaForEveryKarisWeightAndKnee) {
    for (const glm::ivec2 size : sizes)
        for (const std::string& karis : karis_kinds)
            for (const auto& [threshold, knee] :
                 {std::pair(0.8F, 0.4F), {0.8F, 0.8F}, {0.8F, 0.0F}, {0.0F, 0.0F}}) {
                const Recorder passes =
                    draw(size, light(size), {.karis = karis}, [&](PyramidBloomParameters& parameters) {
                        parameters.threshold = threshold;
                        parameters.knee = knee;
                    });
                const Plane& actual = passes.planes.at("bright");
                expectEqual(
                    name(size) + karis + " " + std::to_string(threshold) + " " + std::to_string(knee), actual,
                    bright(passes.planes.at("source"), actual.width, actual.height, karis, threshold, knee));
            }
}

TEST_F(PyramidTruth, everyDownFilterIsItsWeights) {
    for (const glm::ivec2 size : sizes)
        for (const std::string& filter : down_filters) {
            const Recorder passes = draw(size, light(size), {.down = filter});
            for (int i = 1; i < levels; ++i) {
                const Plane& source = passes.planes.at(i == 1 ? "bright" : "down" + std::to_string(i - 1));
                const Plane& actual = passes.planes.at("down" + std::to_string(i));
                expectEqual(name(size) + filter + " " + std::to_string(i), actual,
                            filtered(source, actual.width, actual.height, filter));
            }
        }
}

TEST_F(PyramidTruth, everyUpFilterIsItsWeightsAddedToWhatWasThere) {
    for (const glm::ivec2 size : sizes)
        for (const std::string& filter : up_filters) {
            const Recorder passes = draw(size, light(size), {.up = filter});
            for (int i = levels - 2; i >= 0; --i) {
                const Plane& below = passes.planes.at(i == levels - 2 ? "down" + std::to_string(levels - 1)
                                                                      : "up" + std::to_string(i + 1));
                const Plane& before = passes.planes.at(i == 0 ? "bright" : "down" + std::to_string(i));
                expectEqual(name(size) + filter + " " + std::to_string(i),
                            passes.planes.at("up" + std::to_string(i)),
                            added(before, filtered(below, before.width, before.height, upName(filter))));
            }
        }
}

TEST_F(PyramidTruth, splinesWeighByTheirAreaOnTheWayDownAndByTheirHeightInLargeBrightPassesAndOnTheWayUp) {
    std::vector<glm::ivec2> all(std::begin(sizes), std::end(sizes));
    all.insert(all.end(), {{128, 140}, {259, 131}}); // large
    for (const glm::ivec2 size : all) {
        // Without a threshold the bright pass is the linear spline alone.
        const Recorder passes = draw(size, light(size), {.down = "spline", .up = "spline"},
                                     [](PyramidBloomParameters& p) { p.threshold = p.knee = 0; });
        const auto& planes = passes.planes;
        for (int i = 0; i < levels; ++i) {
            const std::string pass = i == 0 ? "bright" : "down" + std::to_string(i);
            const Plane& source = planes.at(i == 0   ? "source"
                                            : i == 1 ? "bright"
                                                     : "down" + std::to_string(i - 1));
            const Plane& actual = planes.at(pass);
            EXPECT_EQ(glm::ivec2(actual.width, actual.height),
                      (glm::ivec2(source.width, source.height) + 1) / 2);
            expectEqual(name(size) + pass, actual,
                        splineDown(source, actual.width, actual.height, i == 0 ? 1 : 3));
        }
        for (int i = levels - 2; i >= 0; --i) {
            const Plane& below = planes.at(i == levels - 2 ? "down" + std::to_string(levels - 1)
                                                           : "up" + std::to_string(i + 1));
            const Plane& before = planes.at(i == 0 ? "bright" : "down" + std::to_string(i));
            expectEqual(name(size) + "up" + std::to_string(i), planes.at("up" + std::to_string(i)),
                        added(before, splineUp(below, before.width, before.height)));
        }
        if (planes.contains("up")) // a small frame, whose glow has its own size
            expectEqual(name(size) + "up", planes.at("up"), splineUp(planes.at("up0"), size.x, size.y));
    }
}

TEST_F(PyramidTruth, theBlurIsNineTapsAtEveryRadius) {
    for (const glm::ivec2 size : sizes)
        for (const float radius : {0.1F, 0.5F, 0.8F, 1.0F, 1.3F, 4.0F}) {
            const Recorder passes = draw(size, light(size), {}, [&](PyramidBloomParameters& parameters) {
                parameters.blur_radius = radius;
            });
            for (int i = 0; i < levels; ++i) {
                const std::string number = std::to_string(i);
                const Plane& across = passes.planes.at("blur_x" + number);
                expectEqual(name(size) + "x, radius " + std::to_string(radius), across,
                            blurred(passes.planes.at(i == 0 ? "bright" : "down" + number), radius, true));
                expectEqual(name(size) + "y, radius " + std::to_string(radius),
                            passes.planes.at("blur_y" + number), blurred(across, radius, false));
            }
        }
}

TEST_F(PyramidTruth, mergedTapsAreFewerAndAddUpToOne) {
    const auto pairs = [](float radius) { return blurTaps(radius).offsets.size(); };
    EXPECT_EQ(pairs(0.5F), 1U); // three fetches for nine
    EXPECT_EQ(pairs(1.0F), 2U);
    EXPECT_EQ(pairs(1.5F), 4U);
    for (float radius = 0; radius < 4; radius += 0.01F) {
        const BlurTaps taps = blurTaps(radius);
        float sum = taps.centre_weight;
        for (const float weight : taps.weights)
            sum += 2 * weight;
        EXPECT_NEAR(sum, 1, 1e-6F) << radius;
    }
}

TEST_F(PyramidTruth, theCompositeIsTheSourceAndStrengthTimesTheGlow) {
    for (const glm::ivec2 size : sizes)
        for (const float strength : {0.0F, 1.0F, 2.5F}) {
            const Recorder passes = draw(size, light(size), {}, {}, strength);
            const Plane& glow = passes.planes.at(std::string("up0"));
            expectEqual(
                name(size) + "composite", passes.planes.at("composite"),
                added(passes.planes.at("source"), resampled(glow, size.x, size.y, [&](double x, double y) {
                          return glow.sample(x, y) * double(strength);
                      })));
        }
}

// From the source alone, without anything read back in between: the order of the passes, too.
TEST_F(PyramidTruth, theWholeChainIsTheChainInDouble) {
    for (const glm::ivec2 size : sizes) {
        const Recorder passes = draw(
            size, light(size), {}, [](PyramidBloomParameters& parameters) { parameters.blur_radius = 0.5F; });
        std::vector<Plane> pyramid = {bright(passes.planes.at("source"), std::max(size.x / 2, 1),
                                             std::max(size.y / 2, 1), "none", 0.8F, 0.4F)};
        for (int i = 1; i < levels; ++i)
            pyramid.push_back(filtered(pyramid.back(), std::max(size.x >> (i + 1), 1),
                                       std::max(size.y >> (i + 1), 1), "13tap"));
        for (Plane& plane : pyramid)
            plane = blurred(blurred(plane, 0.5, true), 0.5, false);
        Plane sum = pyramid.back();
        for (std::size_t i = levels - 1; i-- > 0;)
            sum = added(pyramid[i], filtered(sum, pyramid[i].width, pyramid[i].height, "tent"));
        expectEqual(name(size) + "whole chain", passes.planes.at("up0"), sum);
    }
}

TEST_F(PyramidTruth, thePrintedThirteenTapsGain375PerMilleALevel) {
    const glm::ivec2 size(96, 64);
    for (const auto& [filter, gain] : {std::pair("13tap", 1.0), {"13tap_as_printed", 1.375}}) {
        const Recorder passes = draw(size, flat(size, 2), {.down = filter});
        for (int i = 1; i < levels; ++i)
            for (const glm::dvec3& pixel : passes.planes.at("down" + std::to_string(i)).pixels)
                ASSERT_NEAR(pixel.g, 2 * std::pow(gain, i), 1e-4) << filter << " " << i;
    }
}

TEST_F(PyramidTruth, asPrintedNoLevelBelowTheSecondReachesThePicture) {
    const glm::ivec2 size(96, 64);
    const auto glow = [&](int count, bool accumulate) {
        return draw(size, light(size), {},
                    [&](PyramidBloomParameters& parameters) {
                        parameters.levels = count;
                        parameters.accumulate = accumulate;
                    })
            .planes.at("composite");
    };
    EXPECT_EQ(errorOf(glow(5, false), glow(2, false)), 0);
    EXPECT_EQ(errorOf(glow(2, false), glow(2, true)), 0) << "two levels have nothing to lose";
    EXPECT_GT(errorOf(glow(5, true), glow(2, true)), 0.05);
}

TEST_F(PyramidTruth, aFlatFieldStaysFlatUnderEveryWeightThatIsDividedOutAgain) {
    const glm::ivec2 size(33, 20);
    for (const std::string karis : {"none", "texel", "partial"}) {
        const Recorder passes = draw(size, flat(size, 40), {.karis = karis});
        for (const glm::dvec3& pixel : passes.planes.at("bright").pixels)
            ASSERT_NEAR(pixel.r, 40, 1e-3) << karis;
    }
}

TEST_F(PyramidTruth, aFireflyIsOutweighedByWhatIsAroundIt) {
    const glm::ivec2 size(32, 32);
    std::vector<float> texels = flat(size, 1.5F);
    for (std::size_t c = 0; c < 3; ++c)
        texels[(16 * 32 + 16) * 4 + c] = 1000;
    const auto added_light = [&](const std::string& karis) {
        const Recorder passes = draw(size, texels, {.karis = karis});
        double sum = 0;
        for (const glm::dvec3& pixel : passes.planes.at("bright").pixels)
            sum += pixel.g - 1.5;
        std::printf("%-44s %.4g\n", ("light of a firefly, " + karis).c_str(), sum);
        return sum;
    };
    EXPECT_NEAR(added_light("none"), 998.5 / 4, 0.1);
    EXPECT_LT(added_light("texel"), 1);
    // The firefly is in all five boxes of the pixel above it; only the pixels around outweigh it.
    EXPECT_LT(added_light("partial"), 998.5 / 4 / 3);
}

// A lamp of one pixel goes a pixel a step over a whole texel of the last level. Its glow, seen from where it
// is, should not know where that lies on the grid: how far the shapes are from their mean, as a share of all
// their light.
TEST_F(PyramidTruth, aLampThatMovesKeepsTheShapeOfItsGlow) {
    const glm::ivec2 size(192, 96);
    constexpr int steps = 1 << levels;
    constexpr int reach = 64;
    const auto unsteadiness = [&](const Filters& filters, float blur_radius) {
        std::vector<std::vector<double>> shapes;
        for (int x = 80; x < 80 + steps; ++x) {
            std::vector<float> texels = flat(size, 0);
            for (std::size_t c = 0; c < 3; ++c)
                texels[static_cast<std::size_t>(48 * size.x + x) * 4 + c] = 100;
            const Recorder passes = draw(size, texels, filters, [&](PyramidBloomParameters& parameters) {
                parameters.blur_radius = blur_radius;
            });
            const Plane& lit = passes.planes.at("composite");
            const Plane& source = passes.planes.at("source");
            shapes.emplace_back();
            for (int row = 0; row < size.y; ++row)
                for (int column = x - reach; column <= x + reach; ++column)
                    shapes.back().push_back(lit.at(column, row).g - source.at(column, row).g);
        }
        double deviation = 0;
        double light = 0;
        for (std::size_t i = 0; i < shapes[0].size(); ++i) {
            double mean = 0;
            for (const auto& shape : shapes)
                mean += shape[i] / steps;
            for (const auto& shape : shapes)
                deviation += std::abs(shape[i] - mean);
            light += mean * steps;
        }
        const double share = deviation / light;
        std::printf(
            "%-44s %.2f %%\n",
            ("unsteady, " + filters.down + " " + filters.up + (blur_radius > 0 ? " blurred" : "")).c_str(),
            100 * share);
        return share;
    };
    const double gaussian = unsteadiness({.down = "13tap", .up = "tent"}, 0.5F); // the default
    const double tent = unsteadiness({.down = "13tap", .up = "tent"}, 0);
    EXPECT_LT(gaussian, 0.7 * tent) << "level 0 comes from single fetches, and is what jumps most";
    for (const auto& [down, up] : {std::pair("5tap", "tent"),
                                   {"4tap", "tent"},
                                   {"5tap", "dual"},
                                   {"13tap", "4tap"},
                                   {"13tap", "bilinear"}})
        EXPECT_GT(unsteadiness({.down = down, .up = up}, 0), tent) << down << " " << up;
    EXPECT_GT(unsteadiness({.down = "box", .up = "bilinear"}, 0), 2 * tent);
}

TEST_F(PyramidTruth, whatIsNoLightDoesNotSpread) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const glm::ivec2 size(37, 21);
    for (const std::string& karis : karis_kinds)
        for (const float value : {infinity, -infinity, not_a_number, 3e38F, -5.0F}) {
            std::vector<float> texels = flat(size, 2);
            for (const std::size_t pixel : {std::size_t(0), std::size_t(400), texels.size() / 4 - 1})
                texels[pixel * 4 + 1] = value;
            const Recorder passes =
                draw(size, texels, {.karis = karis},
                     [](PyramidBloomParameters& parameters) { parameters.blur_radius = 0.5F; });
            // What is no light is dark; what is too much is cut, so that eight levels of it fit into a half.
            const double most = value == 3e38F ? 65504 / 8 : 2;
            for (const glm::dvec3& pixel : passes.planes.at("bright").pixels)
                for (int c = 0; c < 3; ++c) {
                    ASSERT_GE(pixel[c], 0) << karis << " " << value;
                    ASSERT_LE(pixel[c], most) << karis << " " << value;
                }
            const Plane& glow = passes.planes.at("up0");
            EXPECT_GT(glow.at(glow.width / 2, glow.height / 4).r, 1) << karis << " " << value;
        }
}

} // namespace
} // namespace gll::truth
