// 07_shadow_map against rays: the sun's view, and the bias that needs no number chosen for the scene.
// A new case: ask for its frames in Plot::errors(), which shoots rays at the same triangles.
#include "charts/frames.hpp"
#include "support/process.hpp"
#include "truth/shadow_plot.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace gll::test {
namespace {

TEST(RayScene, findsTheNearestTriangleAndNothingBeside) {
    const std::vector<glm::vec3> corners = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {0, 0, 3}, {1, 0, 3}, {0, 1, 3}};
    const std::vector<std::uint32_t> indices = {3, 4, 5, 0, 1, 2};
    const truth::RayScene scene(corners, indices);
    EXPECT_FLOAT_EQ(scene.distance({0.2F, 0.2F, 0}, {0, 0, 1}), 2);
    EXPECT_FLOAT_EQ(scene.distance({0.2F, 0.2F, 2}, {0, 0, 1}), 1) << "the surface itself is not counted";
    EXPECT_TRUE(std::isinf(scene.distance({0.8F, 0.8F, 0}, {0, 0, 1})));
}

struct Plot {
    std::unique_ptr<truth::RayScene> rays = truth::plotRays();

    // Of the rung with these settings, the sun at these elevations, in a map of 512 texels.
    truth::ShadowErrors errors(const charts::Set& set, int filter_width,
                               const std::vector<int>& elevations_deg) const {
        charts::Frames frames(program("07_shadow_map"));
        for (const int elevation : elevations_deg) {
            charts::Set all = set;
            all.insert({{"scene", "plot"},
                        {"shadow_size", "512"},
                        {"shadow_pcf", std::to_string(filter_width)},
                        {"sun_elevation_deg", std::to_string(elevation)}});
            for (const char* target : {"position", "normal", "sun"})
                frames.ask(all, {160, 120}, target);
        }
        frames.run();
        truth::ShadowErrors errors;
        for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
            const truth::SunTruth sun = truth::plotSun(elevations_deg[i], 512, filter_width);
            errors.add(truth::trueShadows(*rays, sun, frames.read(3 * i), loadImage(frames.file(3 * i + 1))),
                       sun, frames.read(3 * i + 2));
        }
        return errors;
    }
};

TEST(Shadow, ofThePlaneRuleIsWithoutAcneAndGapsUpTo85DegreesAtFourTaps) {
    const truth::ShadowErrors errors = Plot().errors({{"shadow_bias", "plane"}}, 3, {5, 15, 30, 50, 80});
    EXPECT_LE(errors.acnePercent(), 0.1);
    EXPECT_LE(errors.gapTexels(), 1);
    EXPECT_LE(errors.leakPercent(), 0.05);
}

TEST(Shadow, ofAConstantBiasHasAcneWhereTheSunIsLow) {
    EXPECT_GT(Plot().errors({{"shadow_bias", "constant"}}, 3, {15}).acnePercent(), 20);
}

TEST(Shadow, looksAlongTheLightThatShadesAndAsPrintedDoesNot) {
    const Plot plot;
    EXPECT_LT(plot.errors({{"shadow_bias", "plane"}}, 1, {40, 60}).rmseToHard(), 0.06);
    EXPECT_GT(plot.errors({{"shadow_bias", "plane"}, {"shadow_fit", "as_printed"}}, 1, {40, 60}).rmseToHard(),
              0.08);
}

} // namespace
} // namespace gll::test
