// Where shadow filters break, in 07: light through what stands in its way, and noise where edges are soft.
#include "charts/frames.hpp"
#include "page_table.hpp"
#include "support/choices.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <iterator>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* shadow_rung = "07_shadow_map";
constexpr glm::ivec2 shadow_size(320, 240);

class ShadowStability : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        filters = test::choicesOf(folders.programs / shadow_rung, "shadow_filter");
    }
    static void TearDownTestSuite() { table.check(); }

    static void tell(const std::string& filter, const std::string& failure, const std::string& number) {
        std::printf("%s: %s %s\n", filter.c_str(), failure.c_str(), number.c_str());
        table.set(filter + (filter == "pcf" ? " (the original)" : ""), failure, number);
    }

    // How much of the sun each pixel of the plot sees, by each filter.
    static std::vector<measure::ColorImage> visible(const Set& settings) {
        charts::Frames frames(folders.programs / shadow_rung);
        for (const std::string& filter : filters)
            frames.ask(Set{{"scene", "plot"}, {"shadow_bias", "plane"}, {"shadow_filter", filter}} + settings,
                       shadow_size, "sun");
        frames.run();
        std::vector<measure::ColorImage> images;
        for (std::size_t i = 0; i < filters.size(); ++i)
            images.push_back(frames.read(i));
        return images;
    }

    static inline std::vector<std::string> filters;
    static inline PageTable table{shadow_rung};
};

// Seen from behind, with the shadows of both plates, of the boxes and of the wall. All filters have a width
// of 9 texels but pcss, which is as wide as the sun makes it; comparisons are the measure of what is dark.
TEST_F(ShadowStability, varianceLetsLightThroughAndFourMomentsLetLessButAlsoSome) {
    const std::vector<measure::ColorImage> seen =
        visible({{"shadow_pcf", "9"}, {"camera_yaw_deg", "180"}, {"sun_radius_deg", "0.3"}});
    ASSERT_EQ(filters[0], "pcf");
    for (std::size_t i = 0; i < filters.size(); ++i) {
        int dark = 0;
        int lit = 0;
        double most = 0;
        for (std::size_t p = 0; p < seen[i].pixels.size(); ++p) {
            if (seen[0].pixels[p].r > 0) continue;
            ++dark;
            lit += seen[i].pixels[p].r > 0.05 ? 1 : 0;
            most = std::max(most, seen[i].pixels[p].r);
        }
        ASSERT_GT(dark, 5000);
        const double percent = 100.0 * lit / dark;
        tell(filters[i], "of the pixels wholly in shadow, % that are lit by more than 0.05",
             decimals(percent, 2));
        tell(filters[i], "the brightest of them", decimals(most, 2));
        if (filters[i] == "vsm" || filters[i] == "msm") {
            EXPECT_GT(most, 0.2) << filters[i] << " is " << news;
        } else {
            EXPECT_LT(percent, 1) << filters[i];
        }
    }
}

// From pixel to pixel a soft edge changes smoothly, and noise does not: what a pixel differs from the mean of
// its four neighbours by, where these are all in the soft part of an edge.
TEST_F(ShadowStability, turnedDisksAreNoisyAndSquaresAreNot) {
    const std::vector<measure::ColorImage> seen = visible({{"shadow_pcf", "9"},
                                                           {"shadow_size", "256"},
                                                           {"sun_radius_deg", "3"},
                                                           {"camera_zoom", "2"},
                                                           {"camera_yaw_deg", "180"}});
    for (std::size_t i = 0; i < filters.size(); ++i) {
        const measure::ColorImage& image = seen[i];
        double sum = 0;
        int count = 0;
        const auto at = [&](int x, int y) { return image.at(x, y).r; };
        const auto is_soft = [](double value) { return value > 0.1 && value < 0.9; };
        for (int y = 1; y < image.height - 1; ++y)
            for (int x = 1; x < image.width - 1; ++x) {
                const double around[] = {at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)};
                if (!is_soft(at(x, y)) || !std::all_of(std::begin(around), std::end(around), is_soft))
                    continue;
                const double off = at(x, y) - 0.25 * (around[0] + around[1] + around[2] + around[3]);
                sum += off * off;
                ++count;
            }
        ASSERT_GT(count, 100) << filters[i];
        const double noise = std::sqrt(sum / count);
        tell(filters[i], "noise in soft edges, RMS", decimals(noise, 3));
        if (filters[i] == "rotated_disk" || filters[i] == "pcss") {
            EXPECT_GT(noise, 0.02) << filters[i] << " is " << news;
        } else {
            EXPECT_LT(noise, 0.02) << filters[i];
        }
    }
}

// The high plate stands nearer the sun than the fixed view begins; its shadow alone falls on this corner.
TEST_F(ShadowStability, whatStandsBeforeTheSunsViewCastsItsShadow) {
    charts::Frames frames(folders.programs / shadow_rung);
    const char* const fits[] = {"fixed", "fitted", "stable"};
    for (const char* fit : fits)
        frames.ask({{"scene", "plot"},
                    {"shadow_bias", "plane"},
                    {"shadow_fit", fit},
                    {"sun_elevation_deg", "60"},
                    {"sun_azimuth_deg", "30"},
                    {"camera_yaw_deg", "180"}},
                   shadow_size, "sun");
    frames.run();
    for (std::size_t i = 0; i < std::size(fits); ++i) {
        const measure::ColorImage seen = frames.read(i);
        EXPECT_LT(seen.at(33, 213).r, 0.01) << fits[i];
        EXPECT_GT(seen.at(110, 213).r, 0.99) << fits[i];
    }
}

} // namespace
} // namespace gll::stability
