// What of a whole frame does not stay where it is when the camera turns a little, in 10.
#include "charts/frames.hpp"
#include "page_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* deferred_rung = "10_deferred";

class DeferredStability : public testing::Test {
  protected:
    static void TearDownTestSuite() { table.check(); }
    static inline PageTable table{deferred_rung};
};

// Of a frame as it is displayed. At most a quarter of a pixel is no change that anybody could see in the
// scene.
TEST_F(DeferredStability, sparklesWhereTexturesAndOcclusionAreSampledTooRarely) {
    struct Case {
        const char* name;
        const char* preset;
        Set set;
    };
    const Case methods[] = {
        {"the original", "original", {}},
        {"the original, `texture_filter=mipmapped`", "original", {{"texture_filter", "mipmapped"}}},
        {"recommended", "recommended", {}},
        {"recommended, `texture_filter=bilinear`", "recommended", {{"texture_filter", "bilinear"}}},
    };
    const glm::ivec2 size(320, 240);
    charts::Frames frames(folders.programs / deferred_rung);
    for (const Case& method : methods)
        for (const char* yaw_deg : {"0", "0.05"}) {
            const Set set = method.set + Set{{"filmstrip", "off"}, {"camera_yaw_deg", yaw_deg}};
            frames.ask(set, size, "frame", nullptr, 60, method.preset);
        }
    frames.run();
    double original = 0;
    for (std::size_t i = 0; i < std::size(methods); ++i) {
        const measure::ColorImage before = frames.read(2 * i);
        const measure::ColorImage after = frames.read(2 * i + 1);
        double squares = 0;
        int jumps = 0;
        for (std::size_t p = 0; p < before.pixels.size(); ++p) {
            const auto code = [](double light) {
                return 255 * std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2);
            };
            const double change = code(after.pixels[p].g) - code(before.pixels[p].g);
            squares += change * change;
            jumps += std::abs(change) > 16 ? 1 : 0;
        }
        const double rmse = std::sqrt(squares / double(before.pixels.size()));
        const std::string percent = decimals(100.0 * jumps / double(before.pixels.size()), 2);
        std::printf("%s: %.2f codes, %s %% of the pixels by more than 16\n", methods[i].name, rmse,
                    percent.c_str());
        table.set(methods[i].name, "camera turned by 0.05 degrees, RMSE in codes", decimals(rmse, 2));
        table.set(methods[i].name, "pixels that change by more than 16, %", percent);
        if (i == 0) original = rmse;
        if (methods[i].name == std::string("recommended")) {
            EXPECT_LT(rmse, 0.5 * original);
        }
    }
}

} // namespace
} // namespace gll::stability
