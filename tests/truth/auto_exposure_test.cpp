// 02_auto_exposure against double: every reduction, the key and the exposure, adaptation over time, and what
// the rung's command line makes of them.
#include "02_auto_exposure/auto_exposure.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <tuple>

namespace gll::truth {
namespace {

using namespace auto_exposure;

std::filesystem::path rung_program;

constexpr double epsilon = 1e-8; // the rung's defaults
constexpr double white_point = 0.22;
constexpr double lowest_stop = -9;
constexpr double up_s = 0.4;
constexpr double down_s = 1.2;
constexpr double dt_s = 1 / 60.0;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Linear light of a size, row after row.
struct Light {
    glm::ivec2 size{1};
    std::vector<glm::vec3> pixels;
};

double logLuminance(const glm::vec3& pixel) {
    return std::log2(epsilon + std::max(luminanceOf(glm::dvec3(pixel)), 0.0));
}

// log2 of exp(mean(ln(epsilon + Y))) over the pixels whose luminance is a finite number.
double logAverage(const Light& light) {
    double sum = 0;
    double count = 0;
    for (const glm::vec3& pixel : light.pixels) {
        if (!std::isfinite(luminanceOf(glm::dvec3(pixel)))) continue;
        sum += logLuminance(pixel);
        ++count;
    }
    return count > 0 ? sum / count : std::log2(epsilon);
}

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

    std::unique_ptr<Context> context = makeOsmesaContext();
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

TEST(Adaptation, toAConstantSceneIsAnExponential) {
    for (const auto& [start, goal, tau_s] : {std::tuple(-8.0, 1.0, up_s), std::tuple(2.0, -6.0, down_s)}) {
        double stop = start;
        for (int n = 1; n <= 300; ++n) {
            stop = adapted(stop, goal, {up_s, down_s}, dt_s);
            ASSERT_NEAR(stop, goal + (start - goal) * std::exp(-n * dt_s / tau_s), 1e-9) << n;
        }
    }
    EXPECT_EQ(adapted(-3, 4, {0, 1}, dt_s), 4) << "a time constant of 0 is at once";
    EXPECT_EQ(adapted(4, -3, {0, 1}, 0), 4) << "no time, no change";
}

TEST(Adaptation, halvingTheStepLeavesTheCurve) {
    double coarse = -8;
    double fine = -8;
    for (int n = 0; n < 100; ++n) {
        coarse = adapted(coarse, 1, {up_s, down_s}, dt_s);
        fine = adapted(adapted(fine, 1, {up_s, down_s}, dt_s / 2), 1, {up_s, down_s}, dt_s / 2);
    }
    EXPECT_NEAR(coarse, fine, 1e-9);
}

TEST(Adaptation, olderFramesThanThoseThatMatterChangeLessThanTheBound) {
    for (const AdaptationSpeed speed : {AdaptationSpeed{up_s, down_s}, {2, 0.1}, {0, 0}, {0, 3}}) {
        std::mt19937 random(3);
        double low = -9; // the two furthest apart that an eye can begin
        double high = 9;
        const int frames = framesThatMatter(speed, dt_s, 18);
        for (int n = 0; n < frames; ++n) {
            const double seen = -9 + 18 * (double(random()) / 4294967296.0);
            low = adapted(low, seen, speed, dt_s);
            high = adapted(high, seen, speed, dt_s);
        }
        EXPECT_LE(std::abs(high - low), frames == 0 ? 18 : 0.001) << speed.up_s << " " << speed.down_s;
        if (speed.up_s == up_s) {
            EXPECT_EQ(frames, 706); // ceil(1.2 * 60 * ln(18000))
        }
    }
}

class HistoryTest : public testing::Test {
  protected:
    static constexpr int period = 240;
    // A scene that goes from -7 to 1 and back, with a step.
    double scene(int number) {
        ++meterings;
        const int n = (number - 1) % period;
        return -3 + 4 * std::sin(n * 0.0261799) + (n > 100 ? 1 : 0);
    }
    double before(AdaptationHistory& history, int number, const std::string& made_with = "a") {
        return history.before(number, options, made_with, [&](int n) { return scene(n); }).value();
    }
    // From frame 1, whatever the number.
    double reference(int number) {
        double stop = scene(1);
        for (int n = 2; n < number; ++n) {
            const double goal = scene(n);
            const double tau_s = goal > stop ? up_s : down_s;
            stop = goal + (stop - goal) * std::exp(-dt_s / tau_s);
        }
        return stop;
    }
    Settings settings;
    AutoExposureOptions options{settings};
    int meterings = 0;
};

TEST_F(HistoryTest, isTheRecursionFromTheFirstFrame) {
    AdaptationHistory history(period);
    EXPECT_FALSE(history.before(1, options, "a", [&](int n) { return scene(n); }).has_value());
    for (const int number : {2, 3, 60, 180, 700, 707, 708, 1000, 5000})
        EXPECT_NEAR(before(history, number), reference(number), number <= 707 ? 1e-6 : 0.001) << number;
}

TEST_F(HistoryTest, dependsOnTheFrameAlone) {
    AdaptationHistory history(period);
    std::map<int, double> alone;
    for (const int number : {2, 60, 180, 999, 10'000'000}) {
        AdaptationHistory fresh(period);
        alone[number] = before(fresh, number);
    }
    for (const int number : {180, 2, 10'000'000, 60, 999, 60, 180})
        EXPECT_EQ(before(history, number), alone[number]) << number;
    EXPECT_EQ(alone[10'000'000], before(history, 10'000'000 - 10 * period)) << "the scene repeats";
}

TEST_F(HistoryTest, metersEveryFrameOfTheSceneOnceUntilWhatItDependsOnChanges) {
    AdaptationHistory history(period);
    for (const int number : {60, 10, 60, 60})
        before(history, number);
    EXPECT_EQ(meterings, 59);
    before(history, 100'000);
    EXPECT_EQ(meterings, period);
    settings.set("adapt_up_s", "0.1");
    before(history, 60);
    EXPECT_EQ(meterings, period) << "speeds change what is made of the readings, not the readings";
    before(history, 60, "b");
    EXPECT_EQ(meterings, period + 59);
}

// The rung's own frames and readings, all from one batch.
class RungTest : public testing::Test {
  protected:
    struct Request {
        std::string name;
        int frame = 60;
        std::string size = "64x48";
        std::map<std::string, std::string> set = {};
        std::string target = {};
    };

    static std::vector<Request> requests() {
        std::vector<Request> all;
        for (int frame = 1; frame <= 60; ++frame)
            all.push_back({"metered " + std::to_string(frame), frame, "64x48", {{"adapt", "off"}}});
        for (const int frame : {60, 180, 2, 961, 1140, 999'999, 999'999 - 960, 60, 1, 180})
            all.push_back({"again " + std::to_string(all.size()) + " " + std::to_string(frame), frame});
        for (const char* size : {"101x77", "64x48"})
            for (const std::string& reduction : test::choicesOf(rung_program, "reduction"))
                all.push_back({std::string(size) + " " + reduction, 60, size, {{"reduction", reduction}}});
        all.push_back({"hdr", 60, "101x77", {}, "hdr"});
        for (const char* pattern : {"black", "flat", "checkerboard", "one_hot", "ramp"})
            all.push_back({pattern, 60, "100x60", {{"test_pattern", pattern}}});
        for (const char* tone_map : {"reinhard_extended", "aces_hill", "clamp"})
            all.push_back({std::string("shown ") + tone_map,
                           60,
                           "101x77",
                           {{"tone_map", tone_map}, {"overlay", "off"}}});
        return all;
    }

    static void SetUpTestSuite() {
        folder = std::make_unique<test::TemporaryFolder>();
        std::string lines;
        for (const Request& request : requests()) {
            nlohmann::json line{{"out", file(request.name).string()},
                                {"frame", request.frame},
                                {"size", request.size},
                                {"set", request.set},
                                {"readings", true}};
            if (request.name == "hdr") line["target"] = "hdr";
            lines += line.dump() + "\n";
        }
        const auto result = test::runToSuccess(
            {rung_program,
             {"--context", "osmesa", "--json", "--batch", folder->write("batch.jsonl", lines).string()}});
        std::istringstream out(result.out);
        std::string line;
        for (const Request& request : requests()) {
            std::getline(out, line);
            readings[request.name] = nlohmann::json::parse(line).at("readings");
        }
    }
    static void TearDownTestSuite() { folder.reset(); }

    static std::filesystem::path file(std::string name) {
        std::replace(name.begin(), name.end(), ' ', '_');
        return *folder / (name + (name == "hdr" ? ".exr" : ".png"));
    }
    // Throws where the reading is null: not a finite number.
    static double reading(const std::string& name, const char* key) {
        return readings.at(name).at(key).get<double>();
    }

    static Light hdr() {
        const Image image = loadImage(file("hdr"));
        const auto& values = std::get<std::vector<float>>(image.pixels);
        Light light{{image.width, image.height}, {}};
        for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels))
            light.pixels.emplace_back(values[i], values[i + 1], values[i + 2]);
        return light;
    }

    static inline std::unique_ptr<test::TemporaryFolder> folder;
    static inline std::map<std::string, nlohmann::json> readings;
};

TEST_F(RungTest, metersTheTargetItDrew) {
    EXPECT_NEAR(reading("101x77 area", "metered_ev"), logAverage(hdr()), 1e-4);
    for (const char* reduction : {"mipmap_r16", "mipmap_r16f", "histogram"})
        std::printf("101x77 %-12s %+.4f EV\n", reduction,
                    reading(std::string("101x77 ") + reduction, "metered_ev") - logAverage(hdr()));
}

// The past is metered in small square frames, and here in 64x48: both see the same walk.
TEST_F(RungTest, adaptsAlongTheWalkAsTheRecursionInDoubleDoes) {
    double stop = reading("metered 1", "metered_ev");
    for (int frame = 2; frame <= 60; ++frame) {
        const double goal = reading("metered " + std::to_string(frame), "metered_ev");
        stop = goal + (stop - goal) * std::exp(-dt_s / (goal > stop ? up_s : down_s));
    }
    const double actual = std::log2(reading("64x48 area", "adapted_luminance"));
    std::printf("frame 60: adapted to %.4f, in double from the readings %.4f\n", actual, stop);
    EXPECT_NEAR(actual, stop, 0.03);
    EXPECT_GT(std::abs(actual - reading("64x48 area", "metered_ev")), 0.3)
        << "nothing to adapt to proves nothing";
}

TEST_F(RungTest, aFrameIsTheSameHoweverOneComesToIt) {
    const auto same = [](const std::string& a, const std::string& b) {
        EXPECT_EQ(readings.at(a), readings.at(b)) << a << " and " << b;
        EXPECT_EQ(loadImage(file(a)).pixels, loadImage(file(b)).pixels) << a << " and " << b;
    };
    same("again 60 60", "again 67 60");
    same("again 60 60", "64x48 area");
    same("again 61 180", "again 69 180");
    same("again 65 999999", "again 66 999039"); // a round of the walk apart, both with a full history
    EXPECT_NE(readings.at("again 60 60"), readings.at("again 61 180"));
    const auto alone = test::runToSuccess(
        {rung_program, {"--context", "osmesa", "--json", "--readings", "--size", "64x48", "--frame", "180"}});
    EXPECT_EQ(nlohmann::json::parse(alone.out).at("readings"), readings.at("again 61 180"));
}

TEST_F(RungTest, exposureIsKeyOverTheLuminanceAdaptedTo) {
    for (const auto& [name, values] : readings) {
        const double average = values.at("adapted_luminance");
        const double key = 1.03 - 2 / (2 + std::log10(average + 1));
        EXPECT_NEAR(values.at("key"), key, 1e-6) << name;
        EXPECT_NEAR(values.at("exposure_ev"), std::log2(key / average), 1e-4) << name;
    }
}

TEST_F(RungTest, aFrameOfAKnownAverageIsMeteredAsThat) {
    EXPECT_NEAR(reading("black", "metered_ev"), std::log2(epsilon), 1e-4);
    EXPECT_NEAR(reading("flat", "metered_ev"), std::log2(0.18), 1e-3); // 0.18 as a half float
    EXPECT_NEAR(reading("checkerboard", "metered_ev"), std::log2(epsilon) / 2, 1e-4);
    EXPECT_NEAR(reading("one_hot", "metered_ev"), (5999 * std::log2(epsilon) + std::log2(1000)) / 6000, 1e-4);
    EXPECT_NEAR(reading("ramp", "metered_ev"), -4, 1e-3);
    // What is adapted to stays within the limits, so that even black has an exposure a person can live with.
    for (const char* dark : {"black", "checkerboard", "one_hot"})
        EXPECT_NEAR(std::log2(reading(dark, "adapted_luminance")), lowest_stop, 1e-4) << dark;
}

TEST_F(RungTest, thePresentedFrameIsTheSceneExposedToneMappedAndEncoded) {
    const Light light = hdr();
    for (const std::string tone_map : {"reinhard_extended", "aces_hill", "clamp"}) {
        const Image image = loadImage(file("shown " + tone_map));
        const auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
        const double exposure = std::exp2(reading("shown " + tone_map, "exposure_ev"));
        double largest = 0;
        for (std::size_t i = 0; i < light.pixels.size(); ++i) {
            const glm::dvec3 expected =
                encoded("srgb", toneMapped(tone_map, glm::dvec3(light.pixels[i]) * exposure, white_point)) *
                255.0;
            for (int c = 0; c < 3; ++c)
                largest = std::max(
                    largest,
                    std::abs(
                        bytes[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(c)] -
                        expected[c]));
        }
        std::printf("%-18s largest error %.3f of a code\n", tone_map.c_str(), largest);
        EXPECT_LE(largest, 0.52) << tone_map; // half a code is the rounding to 8 bits
    }
}

} // namespace
} // namespace gll::truth

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2) {
        std::fprintf(stderr, "truth_auto_exposure: error: name the program of 02_auto_exposure\n");
        return 2;
    }
    gll::truth::rung_program = argv[1];
    return RUN_ALL_TESTS();
}
