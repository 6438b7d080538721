// Where ambient occlusion on the screen breaks, in 08: on what is flat, behind edges, where things touch, and
// from frame to frame.
#include "08_ssao/room.hpp"
#include "charts/occlusion_frames.hpp"
#include "page_table.hpp"
#include "support/choices.hpp"

#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>
#include <map>
#include <optional>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* ssao_rung = "08_ssao";
constexpr glm::ivec2 ssao_size(320, 240);
constexpr const char* original = "the original: `cone`, mapped normals, hashed noise";

// What the screen shows at a place, in a frame's visibility: nothing where another surface is seen there.
double seenAt(glm::vec3 place, const Camera& camera, const truth::TrueOcclusion& truth,
              const measure::ColorImage& visible) {
    const float aspect = static_cast<float>(visible.width) / static_cast<float>(visible.height);
    const glm::vec4 clip = camera.clipFromView(aspect) * camera.viewFromWorld() * glm::vec4(place, 1);
    const glm::vec2 uv = 0.5F + 0.5F * glm::vec2(clip) / clip.w;
    const glm::vec2 pixel(uv.x * static_cast<float>(visible.width) - 0.5F,
                          (1 - uv.y) * static_cast<float>(visible.height) - 0.5F);
    const glm::ivec2 first(glm::floor(pixel));
    if (first.x < 0 || first.y < 0 || first.x + 1 >= visible.width || first.y + 1 >= visible.height)
        return NAN;
    const glm::vec2 f = pixel - glm::vec2(first);
    double sum = 0;
    for (const int y : {0, 1})
        for (const int x : {0, 1}) {
            const auto i = static_cast<std::size_t>((first.y + y) * visible.width + first.x + x);
            constexpr float near = 0.05F; // world units
            if (!truth.points[i].is_surface || glm::distance(truth.points[i].position, place) > near)
                return NAN;
            sum += double((x == 1 ? f.x : 1 - f.x) * (y == 1 ? f.y : 1 - f.y)) * visible.pixels[i].r;
        }
    return sum;
}

class SsaoStability : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        frames.emplace(folders.programs / ssao_rung,
                       std::vector<charts::OcclusionView>{
                           {.scene = "room"}, {.scene = "room", .frame = 61}, {.scene = "cat"}},
                       ssao_size);
        const Set best = {{"ssao_normals", "geometric"},
                          {"ssao_noise", "interleaved"},
                          {"ssao_blur", "separable"},
                          {"ssao_bias", "0.003"}};
        // The strengths that suit them, see ssao_constants.csv.
        const std::map<std::string, std::string> strengths = {
            {"cone", "1"}, {"hemisphere", "1.25"}, {"sao", "0.5"}, {"hbao", "1.4"}};
        const std::map<std::string, Set> more = {{"gtao", {{"ssao_falloff", "0"}}},
                                                 {"bitmask", {{"ssao_slices", "1"}, {"ssao_samples", "12"}}}};
        frames->ask({});
        names.emplace_back(original);
        for (const std::string& method : test::choicesOf(folders.programs / ssao_rung, "ssao")) {
            if (method == "off") continue;
            Set set = best + Set{{"ssao", method}};
            if (const auto found = strengths.find(method); found != strengths.end())
                set["ssao_strength"] = found->second;
            if (const auto found = more.find(method); found != more.end()) set = set + found->second;
            frames->ask(set);
            names.push_back(method + (method == "bitmask" ? " (recommended)" : ""));
        }
        frames->run(100);
    }
    static void TearDownTestSuite() {
        table.check();
        frames.reset();
    }

    static void tell(std::size_t method, const std::string& failure, const std::string& number) {
        std::printf("%s: %s %s\n", names[method].c_str(), failure.c_str(), number.c_str());
        table.set(names[method], failure, number);
    }

    static inline std::vector<std::string> names;
    static inline std::optional<charts::OcclusionFrames> frames;
    static inline PageTable table{ssao_rung};
};

TEST_F(SsaoStability, darkensWhatIsFlatByNormalMapsAndBySamplesThatDiveBelowIt) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double error = frames->errors(i).flat.rmse();
        tell(i, "where nothing is near, RMSE", decimals(error, 3));
        if (names[i] == original) {
            EXPECT_GT(error, 0.1) << news;
        } else
            EXPECT_LT(error, 0.06) << names[i];
    }
}

TEST_F(SsaoStability, darkensWhatLiesFarBehindEdges) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const truth::PixelErrors halo = frames->errors(i, "room").halo;
        ASSERT_GT(halo.count(), 100U);
        tell(i, "behind edges, too light (+) or dark (-) by", decimals(halo.bias(), 2));
        EXPECT_LT(std::abs(halo.bias()), 0.3) << names[i];
    }
}

TEST_F(SsaoStability, isTooLightWhereThingsTouch) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const truth::PixelErrors dark = frames->errors(i, "cat").dark;
        ASSERT_GT(dark.count(), 100U);
        tell(i, "where less than half arrives, too light by", decimals(dark.bias(), 2));
    }
    EXPECT_LT(frames->errors(names.size() - 1, "cat").dark.bias(), 0.15) << names.back();
}

// Within eight pixels of the border. What lies outside occludes as well, and no method sees it.
TEST_F(SsaoStability, doesNotKnowWhatLiesOutsideThePicture) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const truth::PixelErrors border = frames->errors(i, "room").border;
        ASSERT_GT(border.count(), 1000U);
        tell(i, "at the picture's border, RMSE", decimals(border.rmse(), 3));
        EXPECT_LT(border.rmse(), 0.1) << names[i];
    }
}

TEST_F(SsaoStability, isNoiseWithoutABlur) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double noise = frames->errors(i).noise.rmse();
        tell(i, "noise, RMS", decimals(noise, 3));
        if (names[i] == original) {
            EXPECT_GT(noise, 0.1) << news;
        } else
            EXPECT_LT(noise, 0.015) << names[i];
    }
}

TEST_F(SsaoStability, flickersByTheFrameWhereItIsNoise) {
    const Camera before = ssao::cameraOf("room", 60 / 60.0F);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const measure::ColorImage earlier = frames->visible(i, 0);
        const measure::ColorImage later = frames->visible(i, 1);
        const truth::TrueOcclusion& truth = frames->views()[1].truth;
        truth::PixelErrors change;
        for (std::size_t p = 0; p < truth.points.size(); ++p) {
            if (!truth.points[p].is_surface) continue;
            const double seen = seenAt(truth.points[p].position, before, frames->views()[0].truth, earlier);
            if (std::isfinite(seen)) change.add(later.pixels[p].r - seen);
        }
        ASSERT_GT(change.count(), 10000U);
        tell(i, "from frame to frame, RMS", decimals(change.rmse(), 3));
        EXPECT_LT(change.rmse(), names[i] == original ? 0.1 : 0.02) << names[i];
    }
}

} // namespace
} // namespace gll::stability
