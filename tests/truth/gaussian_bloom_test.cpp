// 03_gaussian_bloom: what it plans for a sigma, its passes on a single bright pixel, and the targets that its
// command line writes, all against float64 Gaussians.
#include "03_gaussian_bloom/gaussian_blur.hpp"
#include "io/image.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace gll::truth::gaussian_bloom_frames {
namespace {

using namespace gaussian_bloom;
namespace fs = std::filesystem;

constexpr const char* methods[] = {"ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap",
                                   "wide_gaussian"};

// ---- plans ----

TEST(BlurPlans, ofEveryMethodAddUpToTheSigmaAskedFor) {
    for (const std::string method : methods)
        for (const double sigma : {1.5, 3.78, 4.0, 8.0, 11.18, 16.0}) {
            const BlurPlan plan = planBlur({.method = method, .sigma = sigma});
            // Half the resolution adds about a pixel squared; what exactly, the passes themselves are asked
            // below.
            const double scale = plan.half_resolution ? 2 : 1;
            const double total = scale * scale * plan.pairs * variance(plan.taps) + (scale - 1);
            EXPECT_NEAR(std::sqrt(total) / sigma, 1, plan.half_resolution ? 0.1 : 1e-3)
                << method << " " << sigma;
            if (method == "ping_pong_9tap") {
                EXPECT_LE(plan.taps.offsets[1], 1.0F) << sigma;
            }
            if (method == "ping_pong_5fetch") {
                EXPECT_EQ(plan.taps.count(), 3) << sigma;
            }
        }
}

TEST(BlurPlans, ofPingPongStayAtTheirWidestBeyondIt) {
    const BlurPlan plan = planBlur({.method = "ping_pong_9tap", .sigma = 32});
    EXPECT_EQ(plan.pairs, most_pairs);
    EXPECT_NEAR(std::sqrt(plan.pairs * variance(plan.taps)), 16.03, 0.01);
}

TEST(BlurPlans, withoutASigmaAreTheTutorialsOwn) {
    EXPECT_EQ(planBlur({.method = "ping_pong_9tap", .iterations = 3}).pairs, 3);
    const BlurPlan half = planBlur({.method = "half_resolution_5tap", .corrected_offsets = false});
    EXPECT_EQ(half.pairs, 5);
    EXPECT_TRUE(half.half_resolution);
    EXPECT_FLOAT_EQ(half.taps.offsets[1], 0.524F * 2.5F);
    EXPECT_FLOAT_EQ(half.taps.offsets[2], 1.282F * 2.5F);
    EXPECT_THROW(planBlur({.method = "box"}), std::invalid_argument);
}

// ---- one bright pixel ----

// The light of one channel, and how far it lies from a pixel along x and y: the mean of the square, pixels^2.
struct Moments {
    double sum = 0;
    glm::dvec2 variance{0};
};

class BlurPasses : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("blur")); }

    // The blur of one pixel of 1, in floats of 32 bits, doubled by linear fetches where it is half as large:
    // what the composite adds to the scene.
    Moments momentsOf(const BlurPlan& plan, glm::ivec2 pixel) {
        constexpr glm::ivec2 size(160, 160);
        std::vector<float> pixels(static_cast<std::size_t>(size.x * size.y) * 3);
        pixels[static_cast<std::size_t>(pixel.y * size.x + pixel.x) * 3] = 1;
        const Texture bright({.size = size, .format = Format::rgba32f}, pixels);
        const Framebuffer presented({{"frame", Format::rgba8}}, size);
        Frame frame(1, presented, triangle, nullptr);
        const Image image = readTexture(blur.draw(frame, shaders, bright, plan));
        const auto& values = std::get<std::vector<float>>(image.pixels);
        const double scale = size.x / image.width;
        // Of a texel that is doubled: its light spreads by a quarter times three quarters of its width
        // squared.
        const double doubling = image.width < size.x ? 0.75 : 0;
        Moments moments;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double light = values[static_cast<std::size_t>((y * image.width + x) * image.channels)];
                const glm::dvec2 away =
                    scale * glm::dvec2(x + 0.5, image.height - y - 0.5) - (glm::dvec2(pixel) + 0.5);
                moments.sum += light;
                moments.variance += light * away * away;
            }
        moments.variance = moments.variance / moments.sum + doubling;
        moments.sum *= scale * scale;
        return moments;
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    ShaderLibrary shaders{Resources().shaderRoots()};
    Mesh triangle = Mesh::fullScreenTriangle();
    GaussianBlur blur;
};

TEST_F(BlurPasses, spreadAPixelByTheSigmaAskedForInBothDirectionsAndKeepItsLight) {
    for (const std::string method : methods)
        for (const double sigma : {2.0, 4.0, 8.0, 12.0}) {
            const BlurPlan plan = planBlur({.method = method, .sigma = sigma});
            // Half a resolution sees four kinds of pixels: average over them.
            glm::dvec2 mean_variance(0);
            for (const glm::ivec2 pixel : {glm::ivec2(80, 80), {81, 80}, {80, 81}, {81, 81}}) {
                const Moments moments = momentsOf(plan, pixel);
                EXPECT_NEAR(moments.sum, 1, 2e-4) << method << " " << sigma;
                mean_variance += 0.25 * moments.variance;
            }
            const glm::dvec2 reached = glm::sqrt(mean_variance);
            std::printf("%-22s sigma %4.1f: %.4f across, %.4f up, %d pairs\n", method.c_str(), sigma,
                        reached.x, reached.y, plan.pairs);
            // At half the resolution the first pass differs from the others; the plan is right for the mean
            // of both directions.
            const double tolerance = !plan.half_resolution ? 0.002 : sigma < 4 ? 0.04 : 0.015;
            EXPECT_NEAR(reached.x / sigma, 1, tolerance) << method;
            EXPECT_NEAR(reached.y / sigma, 1, tolerance) << method;
        }
}

TEST_F(BlurPasses, asMisprintedSpreadAlongTheRowTwiceAndNeverUp) {
    BlurPlan plan = planBlur({.method = "ping_pong_9tap"});
    plan.vertical_steps_sideways = true;
    const Moments moments = momentsOf(plan, {80, 80});
    EXPECT_NEAR(moments.variance.x, 2 * 5 * variance(nineTaps()), 0.01);
    EXPECT_NEAR(moments.variance.y, 0, 1e-3);
}

TEST_F(BlurPasses, ofTheMipmapAreTheMeanOfFour) {
    const Moments moments = momentsOf(planBlur({.method = "mipmap"}), {80, 80});
    EXPECT_NEAR(moments.sum, 1, 1e-6);
    EXPECT_NEAR(moments.variance.x, 0.25 + 0.75, 1e-6); // half a pixel away, doubled by linear fetches
    EXPECT_NEAR(moments.variance.y, 0.25 + 0.75, 1e-6);
}

// ---- the rung's own frames ----

TEST(BlurPlans, areThereForEveryBlurThatTheRungOffers) {
    test::requireCovered(test::program("03_gaussian_bloom"), "blur", {std::begin(methods), std::end(methods)},
                         {{"mipmap", "has one width, and a test of its own"}});
}

// Linear RGB in double.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> pixels;

    Plane(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    const glm::dvec3& clamped(int x, int y) const {
        return pixels[index(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1))];
    }
};

// Along the rows with clamped edges, out to 6 sigma, turned by a right angle: twice makes the whole blur.
Plane blurredRowsTurned(const Plane& source, double sigma) {
    const int radius = static_cast<int>(std::ceil(6 * sigma));
    std::vector<double> weights;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
        weights.push_back(std::exp(-i * i / (2 * sigma * sigma)));
        sum += weights.back();
    }
    Plane result(source.height, source.width);
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < source.width; ++x) {
            glm::dvec3 color(0);
            for (int i = -radius; i <= radius; ++i)
                color += source.clamped(x + i, y) * weights[static_cast<std::size_t>(i + radius)];
            result.pixels[result.index(y, x)] = color / sum;
        }
    return result;
}
Plane gaussian(const Plane& source, double sigma) {
    return blurredRowsTurned(blurredRowsTurned(source, sigma), sigma);
}

// As the composite reads it: linear fetches at the frame's pixels.
Plane enlarged(const Plane& source, int width, int height) {
    Plane result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) * source.width / width - 0.5;
            const double v = (y + 0.5) * source.height / height - 0.5;
            const int i = static_cast<int>(std::floor(u));
            const int j = static_cast<int>(std::floor(v));
            const double fu = u - i;
            const double fv = v - j;
            result.pixels[result.index(x, y)] =
                (source.clamped(i, j) * (1 - fu) + source.clamped(i + 1, j) * fu) * (1 - fv) +
                (source.clamped(i, j + 1) * (1 - fu) + source.clamped(i + 1, j + 1) * fu) * fv;
        }
    return result;
}

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

struct Difference {
    double rmse_of_peak = 0; // root mean square over all pixels and channels, over the truth's largest value
    double worst_of_peak = 0;
    double energy = 0; // all light over the truth's
};

Difference differenceOf(const Plane& actual, const Plane& truth) {
    EXPECT_EQ(actual.pixels.size(), truth.pixels.size());
    Difference difference;
    double peak = 0;
    double light = 0;
    double true_light = 0;
    double squares = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double error = actual.pixels[i][c] - truth.pixels[i][c];
            EXPECT_TRUE(std::isfinite(error));
            squares += error * error;
            difference.worst_of_peak = std::max(difference.worst_of_peak, std::abs(error));
            peak = std::max(peak, truth.pixels[i][c]);
            light += actual.pixels[i][c];
            true_light += truth.pixels[i][c];
        }
    difference.rmse_of_peak = std::sqrt(squares / (3 * static_cast<double>(truth.pixels.size()))) / peak;
    difference.worst_of_peak /= peak;
    difference.energy = light / true_light;
    return difference;
}

// Everything these tests look at, from one run.
class GaussianBloomFrames : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<test::TemporaryFolder>();
        std::string batch;
        const auto ask = [&](const std::string& name, const std::string& rest) {
            batch += R"({"size": "320x240", "out": ")" + (folder->path() / name).string() + "\"" +
                     (rest.empty() ? "" : ", ") + rest + "}\n";
        };
        ask("hdr.exr", R"("target": "hdr")");
        ask("bright.exr", R"("target": "bright")");
        for (const std::string method : methods)
            for (const char* sigma : {"0", "4", "8"})
                ask(method + sigma + ".exr",
                    R"("target": "blurred", "set": {"blur": ")" + method + R"(", "sigma": )" + sigma + "}");
        ask("as_printed.exr",
            R"("target": "blurred", "set": {"blur": "half_resolution_5tap", "offsets": "as_printed"})");
        ask("white_point.exr",
            R"("target": "bright", "set": {"bright_pass": "white_point", "white_point": 2})");
        ask("swizzled.exr", R"("target": "bright", "set": {"swizzle": "as_printed"})");
        ask("small.exr", R"("target": "bright", "set": {"bright_format": "r11f_g11f_b10f"})");
        ask("small_blurred.exr", R"("target": "blurred", "set": {"bright_format": "r11f_g11f_b10f"})");
        ask("frame.png", "");
        ask("frame_half.png", R"("set": {"blur": "half_resolution_5tap", "sigma": 8, "strength": 0.5})");
        for (const std::string value : {"nan", "inf"})
            ask(value + ".png", R"("set": {"guard": "off"}, "inject": "bright:160,120:)" + value + "\"");
        const fs::path file = folder->write("batch.jsonl", batch);
        const std::string command = "'" + test::program("03_gaussian_bloom").string() +
                                    "' --headless --batch '" + file.string() + "' > /dev/null";
        if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    }
    static void TearDownTestSuite() { folder.reset(); }

    static Plane read(const std::string& name) {
        const Image image = loadImage(folder->path() / name);
        Plane plane(image.width, image.height);
        std::visit(
            [&](const auto& values) {
                for (std::size_t i = 0; i < plane.pixels.size(); ++i)
                    for (std::size_t c = 0; c < 3; ++c)
                        plane.pixels[i][static_cast<int>(c)] =
                            values.at(i * static_cast<std::size_t>(image.channels) + c);
            },
            image.pixels);
        return plane;
    }

    static Difference measured(const std::string& what, const std::string& file, const Plane& truth) {
        const Difference difference = differenceOf(enlarged(read(file), truth.width, truth.height), truth);
        std::printf("%-34s RMSE %.5f and at worst %.4f of the peak, energy %.4f\n", what.c_str(),
                    difference.rmse_of_peak, difference.worst_of_peak, difference.energy);
        return difference;
    }

    static std::unique_ptr<test::TemporaryFolder> folder;
};
std::unique_ptr<test::TemporaryFolder> GaussianBloomFrames::folder;

// Light that each pass may lose: stores into half floats may truncate, as llvmpipe's do (measured: 0.0004),
// and what runs over the frame's edge is not quite what comes back from its clamped texels.
constexpr double stores_lose = 6e-4;

TEST_F(GaussianBloomFrames, ofEveryMethodAreTheGaussianOfTheSigmaAskedFor) {
    const Plane bright = read("bright.exr");
    for (const double sigma : {4.0, 8.0}) {
        const Plane truth = gaussian(bright, sigma);
        for (const std::string method : methods) {
            const std::string number = sigma == 4 ? "4" : "8";
            const Difference difference =
                measured(method + " sigma " + number, method + number + ".exr", truth);
            const bool exact = method == "wide_gaussian";
            const BlurPlan plan = planBlur({.method = method, .sigma = sigma});
            EXPECT_LE(difference.rmse_of_peak, exact ? 1e-4 : 1.5e-3) << method;
            EXPECT_LE(difference.worst_of_peak, exact ? 2e-3 : 0.03) << method;
            EXPECT_NEAR(difference.energy, 1, 2 * plan.pairs * stores_lose) << method;
        }
    }
}

TEST_F(GaussianBloomFrames, ofFiveFetchesAreThoseOfNineTapsButForRounding) {
    for (const char* sigma : {"0", "4", "8"}) {
        const Plane nine_taps = read(std::string("ping_pong_9tap").append(sigma) + ".exr");
        const Plane five_fetches = read(std::string("ping_pong_5fetch").append(sigma) + ".exr");
        double largest = 0;
        for (std::size_t i = 0; i < nine_taps.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double truth = nine_taps.pixels[i][c];
                const double ulp = std::ldexp(1.0, std::max(truth > 0 ? std::ilogb(truth) : -14, -14) - 10);
                largest = std::max(largest, std::abs(five_fetches.pixels[i][c] - truth) / ulp);
            }
        std::printf("five fetches against nine taps, sigma %s: %.1f half ulps\n", sigma, largest);
        EXPECT_LE(largest, 4) << sigma; // measured: 2
    }
}

TEST_F(GaussianBloomFrames, withTheOriginalsOffsetsAsPrintedAreTwelvePercentNarrow) {
    const Plane bright = read("bright.exr");
    const double own_sigma = 2 * 2.5 * std::sqrt(5.0);
    const Difference corrected =
        measured("half_resolution_5tap own width", "half_resolution_5tap0.exr", gaussian(bright, own_sigma));
    const Difference printed = measured("the same as printed", "as_printed.exr", gaussian(bright, own_sigma));
    measured("the same, against 0.876 sigma", "as_printed.exr", gaussian(bright, 0.876 * own_sigma));
    EXPECT_GT(printed.rmse_of_peak, 2 * corrected.rmse_of_peak);
}

TEST_F(GaussianBloomFrames, ofTheBrightTargetHoldWhatIsAboveTheThresholdAndNothingElse) {
    const Plane hdr = read("hdr.exr");
    const Plane bright = read("bright.exr");
    const Plane white_point = read("white_point.exr"); // from 2.95 * 2
    const Plane swizzled = read("swizzled.exr");
    const Plane small = read("small.exr");
    int kept = 0;
    for (std::size_t i = 0; i < hdr.pixels.size(); ++i) {
        const glm::dvec3 color = hdr.pixels[i];
        const double luma = luminance(color);
        const auto above = [&](double threshold) { return luma > threshold ? color : glm::dvec3(0); };
        if (std::abs(luma - 1) > 0.002) { // the rest is rounding to half floats
            ASSERT_EQ(bright.pixels[i], above(1)) << i;
            ASSERT_EQ(swizzled.pixels[i], glm::dvec3(above(1).r, above(1).b, above(1).g)) << i;
            for (int c = 0; c < 3; ++c) // five to six bits
                ASSERT_NEAR(small.pixels[i][c], above(1)[c], above(1)[c] / 32 + 1e-6) << i;
            kept += luma > 1 ? 1 : 0;
        }
        if (std::abs(luma - 5.9) > 0.01) {
            ASSERT_EQ(white_point.pixels[i], above(5.9)) << i;
        }
    }
    EXPECT_GT(kept, 1000);
    EXPECT_LT(kept, 10000);
}

TEST_F(GaussianBloomFrames, inElevenBitsLoseLightWithEveryPassAndMostOfItInBlue) {
    const Plane wide = read("ping_pong_9tap0.exr");
    const Plane small = read("small_blurred.exr");
    glm::dvec3 wide_sum(0);
    glm::dvec3 small_sum(0);
    for (std::size_t i = 0; i < wide.pixels.size(); ++i) {
        wide_sum += wide.pixels[i];
        small_sum += small.pixels[i];
    }
    const glm::dvec3 kept = small_sum / wide_sum;
    std::printf("r11f_g11f_b10f after ten passes: %.4f of red, %.4f of green, %.4f of blue\n", kept.r, kept.g,
                kept.b);
    EXPECT_NEAR(kept.r, 1, 0.2);
    EXPECT_NEAR(kept.g, 1, 0.2);
    EXPECT_NEAR(kept.b, 1, 0.3);
    EXPECT_GE(std::abs(1 - kept.b), std::abs(1 - kept.r)); // five bits of mantissa against six
}

TEST_F(GaussianBloomFrames, areSceneAndBlurredLightAddedToneMappedAndEncoded) {
    const Plane hdr = read("hdr.exr");
    const auto check = [&](const std::string& frame, const std::string& blurred, double strength) {
        const Plane light = enlarged(read(blurred), hdr.width, hdr.height);
        const Plane actual = read(frame);
        double largest = 0;
        for (std::size_t i = 0; i < hdr.pixels.size(); ++i) {
            const glm::dvec3 linear = hdr.pixels[i] + strength * light.pixels[i];
            const glm::dvec3 expected = 255.0 * encoded("gamma22", toneMapped("exposure", linear));
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(actual.pixels[i][c] - expected[c]));
        }
        EXPECT_LE(largest, 0.51) << frame; // codes of 8 bits
    };
    check("frame.png", "ping_pong_9tap0.exr", 0.98);
    check("frame_half.png", "half_resolution_5tap8.exr", 0.5);
}

// Without guards, a bad value spreads as far as the taps of the passes that follow reach, four texels each,
// and no further. What guards make of it: tests/stability.
TEST_F(GaussianBloomFrames, withABadPixelInTheBlurAreWrongNoFurtherThanItsTapsReach) {
    const Plane frame = read("frame.png");
    for (const char* file : {"nan.png", "inf.png"}) {
        const Plane bad = read(file);
        int changed = 0;
        for (int y = 0; y < frame.height; ++y)
            for (int x = 0; x < frame.width; ++x) {
                if (bad.clamped(x, y) == frame.clamped(x, y)) continue;
                ++changed;
                // Five passes a direction; a linear fetch at a texel's centre still reads the one beside it,
                // with a weight of 0, and 0 times a bad value is bad.
                ASSERT_LE(std::abs(x - 160), 5 * (4 + 1) + 5 + 1) << file;
                ASSERT_LE(std::abs(y - 120), 5 * (4 + 1) + 5 + 1) << file;
            }
        EXPECT_GT(changed, 1000) << file;
    }
}

} // namespace
} // namespace gll::truth::gaussian_bloom_frames
