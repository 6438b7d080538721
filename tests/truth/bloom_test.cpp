// 05_hdr_bloom's passes, as its command line writes them, against the same passes computed in double from the
// floats each of them read: bright pass, every filter down and up, the whole chain, and the presented frame.
#include "01_hdr/tone_map.hpp"
#include "bloom_reference.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>

namespace gll::truth::bloom_frames {
namespace {

namespace fs = std::filesystem;

constexpr double threshold = 1.0; // the rung's defaults
constexpr double knee = 0.6;
constexpr double intensity = 0.7;
constexpr int levels = 5;
constexpr const char* karis_kinds[] = {"average", "texel", "none"};
constexpr const char* down_filters[] = {"5tap", "13tap", "4tap", "box"}; // pyramid_test.cpp has all
constexpr const char* up_filters[] = {"tent", "4tap", "bilinear"};
constexpr const char* sizes[] = {"640x480", "101x77", "7x3"}; // even down to the last level, odd, tiny

// The distance between halfs at a value.
double halfUlp(double value) {
    constexpr int smallest_exponent = -14;
    const int exponent = std::max(value > 0 ? std::ilogb(value) : smallest_exponent, smallest_exponent);
    return std::ldexp(1.0, exponent - 10);
}

struct Error {
    double lowest_ulps = 0; // signed: how far below the truth, and above
    double highest_ulps = 0;
    double largest_relative = 0; // of values that are normal halfs

    double ulps() const { return std::max(-lowest_ulps, highest_ulps); }
};

Error errorOf(const Plane& actual, const Plane& expected) {
    EXPECT_EQ(actual.width, expected.width);
    EXPECT_EQ(actual.height, expected.height);
    Error error;
    for (std::size_t i = 0; i < std::min(actual.pixels.size(), expected.pixels.size()); ++i)
        for (int c = 0; c < 3; ++c) {
            const double truth = expected.pixels[i][c];
            const double difference = actual.pixels[i][c] - truth;
            EXPECT_TRUE(std::isfinite(difference));
            error.lowest_ulps = std::min(error.lowest_ulps, difference / halfUlp(truth));
            error.highest_ulps = std::max(error.highest_ulps, difference / halfUlp(truth));
            if (truth >= 6.2e-5)
                error.largest_relative = std::max(error.largest_relative, std::abs(difference) / truth);
        }
    return error;
}

void print(const std::string& what, const Error& error) {
    std::printf("%-34s %+6.2f to %+6.2f half ulps, relative %.2g\n", what.c_str(), error.lowest_ulps,
                error.highest_ulps, error.largest_relative);
}

// One run of the rung with everything these tests look at.
class Frames {
  public:
    explicit Frames(const fs::path& rung) {
        std::string batch;
        const auto setting = [](std::string_view key, std::string_view value) {
            return std::string("\"").append(key).append("\": \"").append(value).append("\"");
        };
        const auto ask = [&](const std::string& name, const std::string& size, std::string sets,
                             const std::string& target, const char* extension = ".exr") {
            // So few pixels miss every ninth cube: let all of them glow.
            if (size == "7x3") sets += (sets.empty() ? "" : ", ") + setting("glow_every", "1");
            batch += R"({"size": ")" + size + R"(", "set": {)" + sets + R"(}, "out": ")" +
                     (folder_.path() / (name + extension)).string() + R"(")" +
                     (target.empty() ? "" : R"(, "target": ")" + target + "\"") + "}\n";
        };
        const auto number = [](int i) { return std::to_string(i); };
        for (const std::string size : sizes) {
            ask(size + " hdr", size, "", "hdr");
            ask(size + " bloom0", size, "", "bloom0");
            for (const std::string karis : karis_kinds)
                ask(size + " bright " + karis, size, setting("karis", karis), "bright");
            for (const std::string filter : down_filters)
                for (int i = 1; i < levels; ++i)
                    ask(size + " down" + number(i) + " " + filter, size, setting("down_filter", filter),
                        "down" + number(i));
            for (const std::string filter : up_filters)
                for (int i = 0; i < levels - 1; ++i)
                    ask(size + " up" + number(i) + " " + filter, size, setting("up_filter", filter),
                        "up" + number(i));
        }
        ask("hard hdr", "101x77", "", "hdr");
        ask("hard bright", "101x77", R"("knee": 0, "karis": "none")", "bright");
        // So far away that no cube is left before the far plane: a flat field of the clear colour.
        const std::string flat = R"("camera_zoom": 0.1, "threshold": 0, "knee": 0, "karis": "none")";
        ask("flat hdr", "96x64", flat, "hdr");
        for (const std::string filter : down_filters)
            for (int i = 1; i < levels; ++i)
                ask("flat down" + number(i) + " " + filter, "96x64",
                    flat + ", " + setting("down_filter", filter), "down" + number(i));
        for (const std::string filter : up_filters)
            ask("flat up0 " + filter, "96x64", flat + ", " + setting("up_filter", filter), "up0");
        for (const std::string tone_map : hdr::tone_maps)
            for (const std::string encoding : hdr::encodings)
                ask("frame " + tone_map + " " + encoding, "101x77",
                    setting("tone_map", tone_map) + ", " + setting("encode", encoding), "", ".png");

        const fs::path file = folder_.write("batch.jsonl", batch);
        const std::string command =
            "'" + rung.string() + "' --headless --batch '" + file.string() + "' > /dev/null";
        if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    }

    Plane read(const std::string& name, const char* extension = ".exr") const {
        return planeOf(loadImage(folder_.path() / (name + extension)));
    }

  private:
    test::TemporaryFolder folder_;
};

class BloomTruth : public testing::Test {
  protected:
    static void SetUpTestSuite() { frames = std::make_unique<Frames>(test::program("05_hdr_bloom")); }
    static void TearDownTestSuite() { frames.reset(); }
    static Plane read(const std::string& name) { return frames->read(name); }

    static std::unique_ptr<Frames> frames;
};
std::unique_ptr<Frames> BloomTruth::frames;

// A pass is float arithmetic and one rounding to half: llvmpipe truncates, so that everything is 0 to 1 ulp
// low; OpenGL allows either way. A place in the texture is a float too: some 640 * 2^-24 texels of it are
// noise, which next to a strong edge is another tenth of an ulp (measured: -1.11 to +0.13). Bilinear weights
// are floats here; weights of 8 bits, which OpenGL allows and GPUs have, would need a wider bound.
constexpr double pass_ulps = 1.25;
// That noise in the mean of four texels is doubled and more at the foot of the bright curve, which is steep
// in proportion there (measured: -3.41 to +3.62).
constexpr double bright_mean_ulps = 5;
// Where each texel has its own curve, the noise is in the shares alone (measured: -1.48 to +0.73).
constexpr double bright_texel_ulps = 2;
// Each of the nine stores of the chain may truncate (measured: -8.9).
constexpr double chain_ulps = 2 * levels;

TEST_F(BloomTruth, theBrightPassIsItsFormulaForEveryKarisWeight) {
    for (const std::string size : sizes)
        for (const std::string karis : karis_kinds) {
            const Plane hdr = read(size + " hdr");
            const Plane actual = read(size + " bright " + karis);
            const Plane expected = bright(hdr, actual.width, actual.height, karis, threshold, knee);
            const Error error = errorOf(actual, expected);
            print(size + " bright " + karis, error);
            EXPECT_LE(error.ulps(), karis == "texel" ? bright_texel_ulps : bright_mean_ulps)
                << size << " " << karis;
        }
}

TEST_F(BloomTruth, withoutAKneeThePixelIsKeptWholeOrNotAtAll) {
    const Plane hdr = read("hard hdr");
    const Plane actual = read("hard bright");
    const Plane expected = bright(hdr, actual.width, actual.height, "none", threshold, 0);
    const Plane mean = bright(hdr, actual.width, actual.height, "none", -1, 0);
    int kept = 0;
    for (std::size_t i = 0; i < actual.pixels.size(); ++i) {
        if (std::abs(luminance(mean.pixels[i]) - threshold) < 1e-3) continue; // either is right
        kept += expected.pixels[i].r > 0 ? 1 : 0;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(actual.pixels[i][c], expected.pixels[i][c],
                        pass_ulps * halfUlp(expected.pixels[i][c]));
    }
    EXPECT_GT(kept, 10);
}

TEST_F(BloomTruth, everyDownFilterIsItsWeights) {
    for (const std::string size : sizes)
        for (const std::string filter : down_filters)
            for (int i = 1; i < levels; ++i) {
                const std::string source =
                    i == 1 ? " bright average" : " down" + std::to_string(i - 1) + " " + filter;
                const std::string name = size + " down" + std::to_string(i) + " " + filter;
                const Plane actual = read(name);
                const Error error =
                    errorOf(actual, filtered(read(size + source), actual.width, actual.height, filter));
                print(name, error);
                EXPECT_LE(error.ulps(), pass_ulps) << name;
            }
}

TEST_F(BloomTruth, everyUpFilterIsItsWeightsAddedToWhatWasThere) {
    for (const std::string size : sizes)
        for (const std::string filter : up_filters)
            for (int i = levels - 2; i >= 0; --i) {
                const std::string number = std::to_string(i);
                const Plane below =
                    read(i == levels - 2 ? size + " down" + std::to_string(levels - 1) + " 5tap"
                                         : size + " up" + std::to_string(i + 1) + " " + filter);
                const Plane before =
                    read(i == 0 ? size + " bright average" : size + " down" + number + " 5tap");
                const std::string name = size + " up" + number + " " + filter;
                const Plane actual = read(name);
                const Plane lifted = filtered(below, actual.width, actual.height, upName(filter));
                const Error error = errorOf(actual, added(before, lifted));
                print(name, error);
                EXPECT_LE(error.ulps(), pass_ulps) << name;
            }
}

// From the scene alone, without any rounding in between: what nine stores as half cost.
TEST_F(BloomTruth, theWholeChainIsTheDoubleChainButForItsRoundings) {
    for (const std::string size : sizes) {
        const Plane actual = read(size + " bloom0");
        Plane level = bright(read(size + " hdr"), actual.width, actual.height, "average", threshold, knee);
        std::vector<Plane> pyramid = {level};
        for (int i = 1; i < levels; ++i) {
            const Plane like = read(size + " down" + std::to_string(i) + " 5tap");
            pyramid.push_back(filtered(pyramid.back(), like.width, like.height, "5tap"));
        }
        Plane sum = pyramid.back();
        for (int i = levels - 2; i >= 0; --i) {
            const Plane& finer = pyramid[static_cast<std::size_t>(i)];
            sum = added(finer, filtered(sum, finer.width, finer.height, "tent"));
        }
        const Error error = errorOf(actual, sum);
        double energy = 0;
        double true_energy = 0;
        double brightest_pixel = 0;
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
            energy += luminance(actual.pixels[i]);
            true_energy += luminance(sum.pixels[i]);
            brightest_pixel = std::max(brightest_pixel, sum.pixels[i].g);
        }
        print(size + " whole chain", error);
        std::printf("%-34s energy %.6f of the truth, brightest green %.3f\n", size.c_str(),
                    energy / true_energy, brightest_pixel);
        EXPECT_GT(brightest_pixel, 0.5) << "a dark picture would prove nothing";
        EXPECT_LE(error.ulps(), chain_ulps) << size;
        EXPECT_NEAR(energy / true_energy, 1, 0.003) << size; // measured: 0.998, from truncation alone
    }
}

TEST_F(BloomTruth, aFlatFieldStaysFlatDownAndAddsUpByLevels) {
    const Plane hdr = read("flat hdr");
    const glm::dvec3 color = hdr.pixels[0];
    EXPECT_NEAR(color.r, 0.01, 1e-5);
    EXPECT_EQ(errorOf(hdr, filtered(hdr, hdr.width, hdr.height, "box")).ulps(), 0) << "the field is not flat";
    const auto check = [&](const std::string& name, double gain, double ulps) {
        const Plane actual = read(name);
        Plane flat(actual.width, actual.height);
        for (glm::dvec3& pixel : flat.pixels)
            pixel = color * gain;
        const Error error = errorOf(actual, flat);
        print(name, error);
        EXPECT_LE(error.ulps(), ulps) << name;
    };
    for (const std::string filter : down_filters)
        for (int i = 1; i < levels; ++i) // every store may round once more
            check("flat down" + std::to_string(i) + " " + filter, 1, i + 0.1);
    for (const std::string filter : up_filters)
        check("flat up0 " + filter, levels, levels + 0.1);
}

TEST_F(BloomTruth, thePresentedFrameIsSceneAndBloomToneMappedAndEncoded) {
    const Plane hdr = read("101x77 hdr");
    const Plane bloom = read("101x77 bloom0");
    const Plane light = added(hdr, resampled(bloom, hdr.width, hdr.height, [&](double x, double y) {
                                  return bloom.sample(x, y) * intensity;
                              }));
    for (const std::string tone_map : hdr::tone_maps)
        for (const std::string encoding : hdr::encodings) {
            const Plane actual = frames->read("frame " + tone_map + " " + encoding, ".png");
            double largest = 0;
            for (std::size_t i = 0; i < light.pixels.size(); ++i) {
                const glm::dvec3 expected = encoded(encoding, toneMapped(tone_map, light.pixels[i])) * 255.0;
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(actual.pixels[i][c] - expected[c]));
            }
            std::printf("%-34s largest error %.3f of a code\n", (tone_map + " " + encoding).c_str(), largest);
            EXPECT_LE(largest, 0.51) << tone_map << " " << encoding; // half a code is the rounding to 8 bits
        }
}

} // namespace
} // namespace gll::truth::bloom_frames
