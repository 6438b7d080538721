// 08_ssao against rays, and the rays against what is known exactly.
// A new case: ask OcclusionFrames for its settings; errors() compares them with rays at the same triangles.
#include "charts/occlusion_frames.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace gll::test {
namespace {

using charts::OcclusionFrames;
using charts::Set;
using truth::OcclusionErrors;

constexpr glm::ivec2 size{160, 120};
constexpr int rays = 100;

const Set recommended = {{"ssao", "bitmask"},           {"ssao_normals", "geometric"},
                         {"ssao_noise", "interleaved"}, {"ssao_blur", "separable"},
                         {"ssao_samples", "12"},        {"ssao_slices", "1"},
                         {"ssao_bias", "0.003"}};

Set with(Set set, const Set& more) {
    for (const auto& [name, value] : more)
        set[name] = value;
    return set;
}

// The methods, each with the strength that suits it.
const std::vector<Set> methods = {
    {{"ssao", "cone"}, {"ssao_strength", "1.3"}}, {{"ssao", "hemisphere"}, {"ssao_strength", "1"}},
    {{"ssao", "sao"}, {"ssao_strength", "0.5"}},  {{"ssao", "hbao"}, {"ssao_strength", "1.4"}},
    {{"ssao", "gtao"}, {"ssao_falloff", "0"}},    {{"ssao", "bitmask"}}};

TEST(Rays, inACornerFindTheLightThatGeometrySays) {
    const auto corner = truth::occlusionScene("corner");
    std::vector<truth::SeenPoint> points;
    const double distances[] = {0.02, 0.1, 0.3, 0.5, 0.59, 0.7};
    for (const double distance : distances) {
        points.push_back({true, {0, 0, distance}, {0, 1, 0}}); // on the floor
        points.push_back({true, {1, distance, 0}, {0, 0, 1}}); // on the wall
    }
    points.emplace_back();
    const std::vector<float> seen = truth::trueVisibility(*corner, points, 0.6F, 4096);
    for (std::size_t i = 0; i < std::size(distances); ++i)
        for (const std::size_t side : {0U, 1U})
            EXPECT_NEAR(seen[2 * i + side], truth::cornerVisibility(distances[i], 0.6), 0.003)
                << distances[i];
    EXPECT_EQ(seen.back(), 1) << "nothing is not occluded";
    EXPECT_NEAR(truth::cornerVisibility(1e-9, 0.6), 0.5, 1e-6);
    EXPECT_EQ(truth::cornerVisibility(0.6, 0.6), 1);
}

TEST(Rays, areTheSameFromTheScreenAsFromTheTrianglesWhereAllIsSeen) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "corner"}}, size);
    frames.ask({{"ssao", "off"}});
    frames.run(400);
    const truth::TrueOcclusion& truth = frames.views()[0].truth;
    double squares = 0;
    for (std::size_t i = 0; i < truth.points.size(); ++i)
        squares += std::pow(truth.visibility[i] - truth.on_screen[i], 2);
    // The edge of the screen's surface is cut off by half a pixel.
    EXPECT_LT(std::sqrt(squares / double(truth.points.size())), 0.03);
}

TEST(Ssao, ofEveryMethodFindsOnlyWhatIsThere) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "corner"}}, size);
    for (const Set& method : methods)
        frames.ask(with(recommended, method));
    frames.run(rays);
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const OcclusionErrors errors = frames.errors(i);
        ASSERT_GT(errors.flat.count(), 1000U);
        // The samples of hemisphere dive below a plane that is seen at a grazing angle: see the page.
        EXPECT_LT(errors.flat.rmse(),
                  methods[i].at("ssao") == "hemisphere" || methods[i].at("ssao") == "cone" ? 0.05 : 0.004)
            << methods[i].at("ssao");
        EXPECT_LT(errors.creased.rmse(), 0.19) << methods[i].at("ssao"); // 0.26 without any
    }
}

TEST(Ssao, byHorizonsAndBySectorsComesToWhatIsExactInACorner) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "corner"}}, size);
    for (const char* method : {"gtao", "bitmask"})
        frames.ask(
            with(recommended,
                 {{"ssao", method}, {"ssao_falloff", "0"}, {"ssao_slices", "4"}, {"ssao_samples", "64"}}));
    frames.ask(
        with(recommended, {{"ssao_sectors", "uniform"}, {"ssao_slices", "4"}, {"ssao_samples", "64"}}));
    frames.run(400);
    EXPECT_LT(frames.errors(0).creased.rmse(), 0.05);
    EXPECT_LT(frames.errors(1).creased.rmse(), 0.05);
    EXPECT_GT(frames.errors(2).creased.rmse(), 1.3 * frames.errors(1).creased.rmse())
        << "sectors of one angle do not weigh light by its cosine";
}

TEST(Ssao, recommendedIsCloseToRaysAndHalfAsFarOffAsAHemisphereOf64) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "cat"}, {.scene = "cat", .frame = 180}},
                           {320, 240});
    frames.ask(recommended);
    frames.ask(with(recommended, {{"ssao", "hemisphere"}, {"ssao_samples", "64"}, {"ssao_strength", "1"}}));
    frames.ask(with(recommended, {{"ssao_normals", "mapped"}}));
    frames.ask(with(recommended, {{"ssao_resolution", "half"}}));
    frames.run(rays);
    const double error = frames.errors(0).all.rmse();
    EXPECT_LT(error, 0.03);
    EXPECT_GT(frames.errors(1).all.rmse(), 1.9 * error);
    EXPECT_GT(frames.errors(2).all.rmse(), 3 * error) << "the floor's normal map is no slope of its";
    EXPECT_LT(frames.errors(3).all.rmse(), 1.7 * error);
    EXPECT_LT(frames.errors(0).noise.rmse(), 0.005);
}

TEST(Ssao, getsBetterByTheTap) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "cat"}, {.scene = "room"}}, size);
    for (const char* samples : {"4", "8", "16", "64"})
        frames.ask(with(recommended, {{"ssao_samples", samples}}));
    frames.run(rays);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_LT(frames.errors(i).all.rmse(), frames.errors(i - 1).all.rmse()) << i;
}

TEST(Ssao, toldFromDepthAloneFindsTheNormalsOfTheTriangles) {
    OcclusionFrames frames(program("08_ssao"), {{.scene = "room"}}, size);
    frames.ask(recommended);
    frames.ask(with(recommended, {{"ssao_normals", "depth"}}));
    frames.run(rays);
    EXPECT_LT(frames.errors(1).all.rmse(), 1.1 * frames.errors(0).all.rmse());
}

} // namespace
} // namespace gll::test
