// The sun's views while the camera turns: what stays where it was in the map.
#include "07_shadow_map/shadow_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace gll::test {
namespace {

using namespace gll::shadow_map;

// The farthest that texels move over places of the ground, in texels of the nearest whole: from one frame to
// the next, for a camera that turns by a tenth of a degree a frame. What moves by whole texels has the same
// texels.
double largestMove(const char* fit) {
    Settings settings;
    const ShadowOptions options(settings);
    settings.set(std::string("shadow_fit=") + fit);
    const float elevation_rad = 0.7F;
    const shadow_map::Sun sun = {.to_sun = {0.3F * std::cos(elevation_rad), std::sin(elevation_rad),
                                            std::sqrt(0.91F) * std::cos(elevation_rad)}};
    const auto view_at = [&](int frame) {
        const float turn_rad = 0.0017453F * static_cast<float>(frame);
        return sunViews(
                   sun,
                   gbuffer::View({.position = {4.6F * std::cos(turn_rad), 2.3F, 4.6F * std::sin(turn_rad)},
                                  .target = {0, 1, 0},
                                  .vertical_field_of_view_deg = 50,
                                  .near = 0.1F,
                                  .far = 60},
                                 4.0F / 3),
                   options)
            .front();
    };
    const auto texel = [&](const SunView& view, const glm::vec3& place) {
        return glm::dvec2(view.clipFromWorld() * glm::vec4(place, 1)) * (0.5 * double(int(options.size)));
    };
    constexpr std::array<glm::vec3, 3> places = {{{-3, 0, -3}, {2, 1, 0}, {0, 0, 4}}};
    double largest = 0;
    for (int frame = 1; frame <= 200; ++frame)
        for (const glm::vec3& place : places) {
            const glm::dvec2 move = texel(view_at(frame), place) - texel(view_at(frame - 1), place);
            for (const double along : {move.x, move.y})
                largest = std::max(largest, std::abs(along - std::round(along)));
        }
    std::printf("%s: texels move by up to %.4f texels\n", fit, largest);
    return largest;
}

TEST(SunView, movesByWholeTexelsWhereItIsStableAndByPartsWhereItIsFitted) {
    EXPECT_LT(largestMove("stable"), 0.004); // of a comparison's bilinear weight: 1/255
    EXPECT_GT(largestMove("fitted"), 0.25);
}

} // namespace
} // namespace gll::test
