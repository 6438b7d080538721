// 05_hdr_bloom's passes, as its command line writes them, against the same passes computed in double from the
// floats each of them read: bright pass, every filter down and up, the whole chain, and the presented frame.
#include "01_hdr/tone_map.hpp"
#include "io/image.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <cstdio>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>

namespace gll::truth {
namespace {

namespace fs = std::filesystem;

constexpr double threshold = 1.0; // the rung's defaults
constexpr double knee = 0.6;
constexpr double intensity = 0.7;
constexpr int levels = 5;
constexpr const char* karis_kinds[] = {"average", "texel", "none"};
constexpr const char* down_filters[] = {"5tap", "13tap", "4tap", "box"};
constexpr const char* up_filters[] = {"tent", "4tap", "bilinear"};
constexpr const char* sizes[] = {"640x480", "101x77", "7x3"}; // even down to the last level, odd, tiny

// Linear RGB in double; the rows' order does not matter, for every filter is symmetric.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> pixels;

    Plane() = default;
    Plane(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    glm::dvec3& at(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
    const glm::dvec3& at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
    // The nearest texel inside.
    const glm::dvec3& clamped(int x, int y) const {
        return at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    }
    // GL_LINEAR with GL_CLAMP_TO_EDGE at a place in texels; the first texel's centre is (0.5, 0.5).
    glm::dvec3 sample(double x, double y) const {
        const double left = std::floor(x - 0.5);
        const double top = std::floor(y - 0.5);
        const double fx = x - 0.5 - left;
        const double fy = y - 0.5 - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        return (clamped(i, j) * (1 - fx) + clamped(i + 1, j) * fx) * (1 - fy) +
               (clamped(i, j + 1) * (1 - fx) + clamped(i + 1, j + 1) * fx) * fy;
    }
};

// A plane of the size from a function of the place in the source, in texels of the source.
template <class Function>
Plane resampled(const Plane& source, int width, int height, const Function& function) {
    Plane result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.at(x, y) = function((x + 0.5) * source.width / width, (y + 0.5) * source.height / height);
    return result;
}

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// smoothstep over threshold +- knee
double brightCurve(double luma, double at, double half_width) {
    if (half_width <= 0) return luma > at ? 1 : 0;
    const double t = std::clamp((luma - (at - half_width)) / (2 * half_width), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Plane bright(const Plane& hdr, int width, int height, const std::string& karis, double at = threshold,
             double half_width = knee) {
    return resampled(hdr, width, height, [&](double x, double y) {
        if (karis != "texel") {
            const glm::dvec3 mean = hdr.sample(x, y);
            const double luma = luminance(mean);
            return mean * brightCurve(luma, at, half_width) / (karis == "average" ? 1 + luma : 1);
        }
        const int i = static_cast<int>(std::floor(x - 0.5));
        const int j = static_cast<int>(std::floor(y - 0.5));
        glm::dvec3 sum(0);
        double weights = 0;
        for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const glm::dvec3 texel = hdr.clamped(i + dx, j + dy);
            const double luma = luminance(texel);
            const double share_x = 1 - std::abs(x - 0.5 - i - dx);
            const double share_y = 1 - std::abs(y - 0.5 - j - dy);
            sum += texel * share_x * share_y * brightCurve(luma, at, half_width) / (1 + luma);
            weights += share_x * share_y / (1 + luma);
        }
        return sum / weights;
    });
}

// A filter as a list of bilinear taps: offsets in texels, weight.
struct Tap {
    double x, y, weight;
};

std::vector<Tap> tapsOf(const std::string& filter) {
    std::vector<Tap> taps;
    const auto square = [&](double distance, double weight) { // the four corners of a square
        for (const double y : {-distance, distance})
            for (const double x : {-distance, distance})
                taps.push_back({x, y, weight});
    };
    const auto cross = [&](double distance, double weight) {
        for (const double d : {-distance, distance}) {
            taps.push_back({d, 0, weight});
            taps.push_back({0, d, weight});
        }
    };
    if (filter == "5tap") {
        taps = {{0, 0, 1 / 2.0}};
        square(1, 1 / 8.0);
    } else if (filter == "13tap") { // methods of Jimenez 2014: sums of five boxes
        taps = {{0, 0, 1 / 8.0}};
        square(1, 1 / 8.0);
        cross(2, 1 / 16.0);
        square(2, 1 / 32.0);
    } else if (filter == "4tap") {
        square(0.75, 1 / 4.0);
    } else if (filter == "tent") {
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                taps.push_back({double(x), double(y), (2 - std::abs(x)) * (2 - std::abs(y)) / 16.0});
    } else if (filter == "4tap up") {
        square(0.5, 1 / 4.0);
    } else { // box, bilinear
        taps = {{0, 0, 1}};
    }
    return taps;
}

Plane filtered(const Plane& source, int width, int height, const std::string& filter) {
    const std::vector<Tap> taps = tapsOf(filter);
    return resampled(source, width, height, [&](double x, double y) {
        glm::dvec3 sum(0);
        for (const Tap& tap : taps)
            sum += source.sample(x + tap.x, y + tap.y) * tap.weight;
        return sum;
    });
}

Plane added(Plane left, const Plane& right) {
    for (std::size_t i = 0; i < left.pixels.size(); ++i)
        left.pixels[i] += right.pixels[i];
    return left;
}

std::string upName(const std::string& filter) { return filter == "4tap" ? "4tap up" : filter; }

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
        for (const std::string tone_map : tone_maps)
            for (const std::string encoding : encodings)
                ask("frame " + tone_map + " " + encoding, "101x77",
                    setting("tone_map", tone_map) + ", " + setting("encode", encoding), "", ".png");

        const fs::path file = folder_.write("batch.jsonl", batch);
        const std::string command =
            "'" + rung.string() + "' --headless --batch '" + file.string() + "' > /dev/null";
        if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
    }

    Plane read(const std::string& name, const char* extension = ".exr") const {
        const Image image = loadImage(folder_.path() / (name + extension));
        Plane plane(image.width, image.height);
        const auto channels = static_cast<std::size_t>(image.channels);
        std::visit(
            [&](const auto& values) {
                for (std::size_t i = 0; i < plane.pixels.size(); ++i)
                    for (std::size_t c = 0; c < 3; ++c)
                        plane.pixels[i][static_cast<int>(c)] = values.at(i * channels + c);
            },
            image.pixels);
        return plane;
    }

  private:
    test::TemporaryFolder folder_;
};

fs::path rung_program;

class BloomTruth : public testing::Test {
  protected:
    static void SetUpTestSuite() { frames = std::make_unique<Frames>(rung_program); }
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
            const Plane expected = bright(hdr, actual.width, actual.height, karis);
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
                const Plane before = read(i == 0 ? size + " bright average" : size + " down" + number + " 5tap");
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
        Plane level = bright(read(size + " hdr"), actual.width, actual.height, "average");
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
    for (const std::string tone_map : tone_maps)
        for (const std::string encoding : encodings) {
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
} // namespace gll::truth

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2) {
        std::fprintf(stderr, "truth_bloom: error: name the program of 05_hdr_bloom\n");
        return 2;
    }
    gll::truth::rung_program = argv[1];
    return RUN_ALL_TESTS();
}
