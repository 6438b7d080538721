// Where metering breaks, in 02: frames at the extremes of a log-average, bad values in every pass, light of
// any strength. Mean errors over a thousand sizes are in the charts.
#include "charts/frames.hpp"
#include "page_table.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* meter_rung = "02_auto_exposure";
constexpr glm::ivec2 meter_size(64);        // a power of two: every pixel counts, in mipmaps too
const double black_stops = std::log2(1e-8); // of the rung's epsilon

struct Reduction {
    std::string name;
    Set set;
    std::vector<std::string> passes; // from the scene to the exposure, in a frame of 64x64
};

const std::vector<Reduction> reductions = {
    {"area (recommended)", {{"reduction", "area"}}, {"scene", "average0", "average1", "metered"}},
    {"mipmap_r16 (the original of 02)", {{"reduction", "mipmap_r16"}}, {"scene", "log_luminance", "metered"}},
    {"mipmap_r16f", {{"reduction", "mipmap_r16f"}}, {"scene", "log_luminance", "metered"}},
    {"histogram, all samples",
     {{"reduction", "histogram"}, {"low_percent", "0"}, {"high_percent", "100"}},
     {"scene", "histogram", "metered"}}};

// What the rung reads in frames, all from one process.
class Readings {
  public:
    std::size_t ask(Set set, glm::ivec2 frame_size, const nlohmann::json& inject = nullptr) {
        set.insert({{"overlay", "off"}, {"adapt", "off"}});
        nlohmann::json line{{"readings", true},
                            {"set", set},
                            {"size", std::to_string(frame_size.x) + "x" + std::to_string(frame_size.y)}};
        if (!inject.is_null()) line["inject"] = inject;
        lines_ += line.dump() + "\n";
        return count_++;
    }
    void run() {
        const test::TemporaryFolder folder;
        const test::Result result = test::runToSuccess(
            {folders.programs / meter_rung,
             {"--headless", "--json", "--batch", folder.write("batch.jsonl", lines_).string()}});
        std::istringstream stream(result.out);
        for (std::string line; std::getline(stream, line);)
            readings_.push_back(nlohmann::json::parse(line).at("readings"));
        ASSERT_EQ(readings_.size(), count_);
    }
    // Valid after run(). Not a number where the rung has no finite one.
    double of(std::size_t number, const char* name) const {
        const nlohmann::json& value = readings_.at(number).at(name);
        return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }

  private:
    std::string lines_;
    std::size_t count_ = 0;
    std::vector<nlohmann::json> readings_;
};

class ExposureStability : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        test::requireCovered(folders.programs / meter_rung, "reduction",
                             test::valuesOf(reductions, "reduction"));
    }
    static void TearDownTestSuite() { table.check(); }

    static void tell(const Reduction& reduction, const std::string& failure, const std::string& number) {
        std::printf("%s: %s %s\n", reduction.name.c_str(), failure.c_str(), number.c_str());
        table.set(reduction.name, failure, number);
    }

    static inline PageTable table{meter_rung};
};

// log2 of the log-average of a pattern, by its definition.
double exact(const std::string& pattern, glm::ivec2 frame_size) {
    const double pixels = double(frame_size.x) * frame_size.y;
    const double lit = pattern == "black" ? 0 : pattern == "one_hot" ? 1 : std::floor(pixels / 2);
    return (lit * std::log2(1e-8 + (pattern == "one_hot" ? 1000 : 1)) + (pixels - lit) * black_stops) /
           pixels;
}

TEST_F(ExposureStability, areasMeterBlackOneLightAndACheckerboardAtEverySizeAndMipmapsDoNot) {
    const std::vector<glm::ivec2> sizes = {{1, 1},   {2, 2},   {3, 5},    {7, 1},     {1, 3},
                                           {31, 63}, {64, 64}, {101, 77}, {320, 240}, {641, 479}};
    const std::vector<std::pair<std::string, std::string>> patterns = {
        {"black", "black frame"}, {"checkerboard", "checkerboard"}, {"one_hot", "one light in the dark"}};
    Readings readings;
    for (const Reduction& reduction : reductions)
        for (const auto& [pattern, name] : patterns)
            for (const glm::ivec2 frame_size : sizes)
                readings.ask(reduction.set + Set{{"test_pattern", pattern}}, frame_size);
    readings.run();
    std::size_t next = 0;
    for (const Reduction& reduction : reductions)
        for (const auto& [pattern, name] : patterns) {
            double worst = 0;
            for (const glm::ivec2 frame_size : sizes)
                worst =
                    std::max(worst, std::abs(readings.of(next++, "metered_ev") - exact(pattern, frame_size)));
            tell(reduction, name + ", EV off at worst", decimals(worst, 3));
            if (reduction.name.starts_with("area")) {
                EXPECT_LE(worst, 0.01) << pattern; // what is promised of it
            } else if (reduction.name.starts_with("mipmap") && pattern != "black") {
                EXPECT_GT(worst, 1) << reduction.name << " with a " << pattern << " is " << news;
            } else if (pattern == "black") {
                EXPECT_LE(worst, 1 / 64.0) << reduction.name; // R16F has steps of that size there
            }
        }
}

TEST_F(ExposureStability, oneBadPixelOfTheSceneTakesTheExposureOnlyWithoutGuards) {
    Readings readings;
    const std::vector<const char*> values = {"nan", "inf", "-inf"};
    for (const Reduction& reduction : reductions) {
        readings.ask(reduction.set, meter_size);
        for (const char* guard : {"on", "off"})
            for (const char* value : values)
                readings.ask(reduction.set + Set{{"guard", guard}}, meter_size,
                             "hdr:9,9:" + std::string(value));
    }
    readings.run();
    std::size_t next = 0;
    for (const Reduction& reduction : reductions) {
        const double clean = readings.of(next++, "metered_ev");
        double guarded = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            guarded = std::max(guarded, std::abs(readings.of(next++, "metered_ev") - clean));
        // One of 4096 pixels, by at most the 43 stops between black and the brightest half float.
        EXPECT_LE(guarded, 0.02) << reduction.name;
        bool lost = false;
        for (const char* value : values) {
            const double off = std::abs(readings.of(next++, "metered_ev") - clean);
            tell(reduction, std::string("one pixel is ") + value + ", EV off without guards",
                 std::isfinite(off) ? decimals(off, 3) : "all of it");
            lost = lost || !std::isfinite(off);
        }
        tell(reduction, "with guards, at worst", decimals(guarded, 3));
        if (reduction.name != "mipmap_r16 (the original of 02)") { // its format can hold nothing but numbers
            EXPECT_TRUE(lost) << reduction.name << " without guards is " << news;
        }
    }
}

TEST_F(ExposureStability, withGuardsABadValueInAnyPassLeavesAnExposure) {
    Readings readings;
    struct Asked {
        std::string what;
        std::string pass;
        std::size_t clean;
        std::size_t bad;
    };
    std::vector<Asked> asked;
    for (const Reduction& reduction : reductions)
        for (const char* adapt : {"on", "off"}) {
            const Set set = reduction.set + Set{{"adapt", adapt}};
            const std::size_t clean = readings.ask(set, meter_size);
            for (const std::string& pass : reduction.passes)
                for (const char* value : {"nan", "inf", "-inf"})
                    asked.push_back({reduction.name + " " + pass + " " + value + " adapt=" + adapt, pass,
                                     clean,
                                     readings.ask(set, meter_size, pass + ":0,0:" + std::string(value))});
        }
    readings.run();
    for (const Asked& one : asked) {
        // From the darkest scene that is adapted to to the brightest.
        EXPECT_GE(readings.of(one.bad, "exposure_ev"), -9) << one.what;
        EXPECT_LE(readings.of(one.bad, "exposure_ev"), 9) << one.what;
        if (one.pass == "metered" || one.pass == "average1")
            continue; // the reading itself, and all that it has
        // At most a 64th of the frame is left out, which is within 10 stops of the rest.
        EXPECT_NEAR(readings.of(one.bad, "metered_ev"), readings.of(one.clean, "metered_ev"), 10 / 64.0)
            << one.what;
    }
    std::printf("%zu bad values, one by one in every pass: each frame has an exposure\n", asked.size());
}

TEST_F(ExposureStability, withoutGuardsABadExposureTakesTheWholeFrameAndWithThemNone) {
    charts::Frames frames(folders.programs / meter_rung);
    const auto ask = [&](const char* guard) {
        return frames.ask({{"overlay", "off"}, {"adapt", "off"}, {"guard", guard}}, meter_size, "frame",
                          "exposure:0,0:nan");
    };
    const std::size_t on = ask("on");
    const std::size_t off = ask("off");
    frames.run();
    // Pixels of one and the same colour, as a share of all.
    const auto blank = [&](std::size_t frame) {
        const auto pixels = frames.read(frame).pixels;
        return double(std::count(pixels.begin(), pixels.end(), pixels[0])) / double(pixels.size());
    };
    std::printf("exposure not a number: %.0f %% of the frame in one colour without guards, %.0f %% with\n",
                100 * blank(off), 100 * blank(on));
    EXPECT_EQ(blank(off), 1) << news;
    EXPECT_LE(blank(on), 0.1);
}

// A frame of one pixel, 1e-7 to 1e38. More than 65504 is stored as that or as infinite, as the driver does.
TEST_F(ExposureStability, lightOfAnyStrengthHasAnExposureThatFallsAsItGrows) {
    Readings readings;
    for (const Reduction& reduction : reductions)
        for (int decade = -7; decade <= 38; ++decade)
            readings.ask(reduction.set, {1, 1}, "hdr:0,0:1e" + std::to_string(decade));
    readings.run();
    std::size_t next = 0;
    for (const Reduction& reduction : reductions) {
        double before = std::numeric_limits<double>::infinity();
        for (int decade = -7; decade <= 38; ++decade) {
            const double exposure = readings.of(next++, "exposure_ev");
            EXPECT_TRUE(std::isfinite(exposure)) << reduction.name << " of 1e" << decade;
            if (decade > 4) continue;
            EXPECT_LE(exposure, before) << reduction.name << " of 1e" << decade;
            before = exposure;
        }
    }
}

} // namespace
} // namespace gll::stability
