// Where tone maps break, in 01: hues that turn, light that comes out darker than less light, and light that
// no float can square.
#include "charts/frames.hpp"
#include "charts/tone.hpp"
#include "measure/color.hpp"
#include "page_table.hpp"
#include "support/choices.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* hdr_rung = "01_hdr";
constexpr const char* recommended = "pbr_neutral";

class ToneStability : public testing::Test {
  protected:
    static void SetUpTestSuite() { tone_maps = test::choicesOf(folders.programs / hdr_rung, "tone_map"); }
    static void TearDownTestSuite() { table.check(); }

    static void tell(const std::string& tone_map, const std::string& failure, const std::string& number) {
        std::printf("%s: %s %s\n", tone_map.c_str(), failure.c_str(), number.c_str());
        table.set(tone_map + (tone_map == recommended  ? " (recommended)"
                              : tone_map == "reinhard" ? " (the original of 01)"
                                                       : ""),
                  failure, number);
    }

    static inline std::vector<std::string> tone_maps;
    static inline PageTable table{hdr_rung};
};

// The charts' own sweep of 40 colours over 14 stops.
TEST_F(ToneStability, pbrNeutralTurnsHuesLeastAndNoCurveShowsMoreGreyLightAsLess) {
    for (const std::string& tone_map : tone_maps) {
        const charts::ToneFigures figures = charts::toneFigures(tone_map);
        tell(tone_map, "hue turns by degrees, mean", decimals(figures.hue_mean_deg, 1));
        tell(tone_map, "at most", decimals(figures.hue_largest_deg, 0));
        if (tone_map == recommended) {
            EXPECT_LE(figures.hue_mean_deg, 4);
            EXPECT_LE(figures.hue_largest_deg, 30);
        } else {
            EXPECT_GT(figures.hue_mean_deg, 4) << tone_map << " is " << news;
            EXPECT_GT(figures.hue_largest_deg, 30) << tone_map << " is " << news;
        }
        EXPECT_LE(figures.largest_fall, 1e-6) << tone_map; // below what 16 bits can show
        EXPECT_LE(figures.largest_output, 1) << tone_map;
    }
}

// The codes that a display is sent for greys of 1e-7 to 1e38, and for one that is infinite and one that is no
// number.
struct Shown {
    std::vector<int> codes;
    int infinite = 0;
    int no_number = 0;
};

constexpr int darkest_decade = -7;
constexpr int decades = 46;

TEST_F(ToneStability, withGuardsLightOfAnyStrengthIsShownAndMoreIsNeverDarker) {
    const test::TemporaryFolder folder;
    measure::ColorImage ramp(decades, 1);
    for (int x = 0; x < decades; ++x)
        ramp.at(x, 0) = glm::dvec3(std::pow(10, darkest_decade + x));
    charts::writeExr(folder / "ramp.exr", ramp);
    charts::Frames frames(folders.programs / hdr_rung, {"--image", (folder / "ramp.exr").string()});
    for (const std::string& tone_map : tone_maps)
        for (const char* guard : {"on", "off"})
            for (const char* value : {"", "inf", "nan"}) {
                nlohmann::json inject;
                if (*value != '\0') inject = "scene:0,0:" + std::string(value);
                frames.ask({{"tone_map", tone_map}, {"guard", guard}, {"format", "rgba32f"}}, {decades, 1},
                           "frame", inject);
            }
    frames.run();
    std::size_t next = 0;
    const auto code = [](const glm::dvec3& color) {
        return static_cast<int>(std::lround(255 * measure::srgbEncoded(color.g)));
    };
    const auto shown = [&] {
        Shown result;
        for (const glm::dvec3& color : frames.read(next++).pixels)
            result.codes.push_back(code(color));
        result.infinite = code(frames.read(next++).pixels[0]);
        result.no_number = code(frames.read(next++).pixels[0]);
        return result;
    };
    for (const std::string& tone_map : tone_maps) {
        const Shown guarded = shown();
        for (std::size_t i = 1; i < guarded.codes.size(); ++i)
            EXPECT_GE(guarded.codes[i], guarded.codes[i - 1]) << tone_map << ", step " << i;
        EXPECT_GE(guarded.codes.back(), 254) << tone_map;
        EXPECT_EQ(guarded.infinite, guarded.codes.back()) << tone_map;
        EXPECT_EQ(guarded.no_number, 0) << tone_map;

        const Shown bare = shown();
        std::string breaks;
        for (std::size_t i = 1; i < bare.codes.size() && breaks.empty(); ++i)
            if (bare.codes[i] < bare.codes[i - 1])
                breaks = "1e" + std::to_string(darkest_decade + static_cast<int>(i));
        tell(tone_map, "darker again without guards from", breaks.empty() ? "never" : breaks);
        tell(tone_map, "infinite light, code without guards", std::to_string(bare.infinite));
        tell(tone_map, "with guards", std::to_string(guarded.infinite));
        if (tone_map.starts_with("aces")) {
            EXPECT_FALSE(breaks.empty()) << tone_map << " without guards is " << news;
        }
        if (tone_map == "reinhard" || tone_map == "pbr_neutral") { // infinity over infinity
            EXPECT_LT(bare.infinite, 10) << tone_map << " without guards is " << news;
        }
    }
}

} // namespace
} // namespace gll::stability
