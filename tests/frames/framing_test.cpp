// How a model of any shape and size is set up: whole in the picture, at every frame, and on the floor.
#include "gltf_maker.hpp"
#include "io/image.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <sstream>

namespace gll::test {
namespace {

constexpr float floor_half_width = 6;

// A box of this size anywhere; flat where a side is 0.
std::string box(const glm::dvec3& size, const glm::dvec3& at = glm::dvec3(0)) {
    std::ostringstream text;
    for (int corner = 0; corner < 8; ++corner) {
        text << "v";
        for (int axis = 0; axis < 3; ++axis)
            text << ' ' << at[axis] + size[axis] * ((corner >> axis & 1) - 0.5);
        text << '\n';
    }
    text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    return text.str();
}

// World positions as they are seen, with no floor in the way of telling: where y is over it, it is the model.
struct Seen {
    int pixels = 0;    // of the model
    int on_border = 0; // of them, on the picture's border
    float lowest = 1e9F;
    float highest = 0;
    float farthest = 0; // from the y axis
};

Seen look(const Image& positions) {
    Seen seen;
    const auto& values = std::get<std::vector<float>>(positions.pixels);
    for (int y = 0; y < positions.height; ++y)
        for (int x = 0; x < positions.width; ++x) {
            const float* p =
                &values[static_cast<std::size_t>((y * positions.width + x) * positions.channels)];
            if (p[1] < 0.003F && std::abs(p[0]) <= floor_half_width && std::abs(p[2]) <= floor_half_width &&
                p[1] > -0.003F)
                continue; // the floor, or nothing at all
            ++seen.pixels;
            if (x == 0 || y == 0 || x == positions.width - 1 || y == positions.height - 1) ++seen.on_border;
            seen.lowest = std::min(seen.lowest, p[1]);
            seen.highest = std::max(seen.highest, p[1]);
            seen.farthest = std::max(seen.farthest, std::hypot(p[0], p[2]));
        }
    return seen;
}

TEST(Framing, showsAllOfAModelWheneverAndStandsItOnTheFloor) {
    const std::vector<std::pair<const char*, std::string>> models = {
        {"wall", box({4, 3, 0})},
        {"wall from its side", box({0, 3, 4})},
        {"needle", box({0.2, 5, 0.2})},
        {"plane", box({3, 0, 3})},
        {"long plane", box({1, 0, 50})},
        {"tower", box({1, 6, 1})},
        {"car", box({1.8, 1.4, 4.5})},
        {"cube", box({1, 1, 1})},
        {"tiny", box({1e-6, 1e-6, 1e-6})},
        {"huge", box({1e30, 1e30, 1e30})},
        {"far away", box({100, 100, 100}, {1e5, -1e5, 1e5})},
        {"rod", box({20, 0.5, 0.5})},
    };
    for (const auto& [name, text] : models) {
        const TemporaryFolder folder;
        folder.write("model.obj", text);
        runToSuccess({GLLADDER_RUNG,
                      {"--headless", "--mesh", "model.obj", "--target", "position", "--size", "160x120",
                       "--frames", "1..1006:201", "--out", "%d.exr"}, // once round
                      {},
                      folder.path()});
        int most_pixels = 0;
        float highest = 0;
        float farthest = 0;
        for (int frame = 1; frame <= 1006; frame += 201) {
            const Seen seen = look(loadImage(folder.path() / (std::to_string(frame) + ".exr")));
            EXPECT_EQ(seen.on_border, 0) << name << " at frame " << frame;
            if (seen.pixels > 0) {
                EXPECT_GE(seen.lowest, 0.0F) << name << " at frame " << frame;
            }
            most_pixels = std::max(most_pixels, seen.pixels);
            highest = std::max(highest, seen.highest);
            farthest = std::max(farthest, seen.farthest);
        }
        EXPECT_GT(most_pixels, 50) << name;
        EXPECT_LT(highest, 2.21F) << name;
        EXPECT_LT(farthest, 1.36F) << name;
        EXPECT_GT(std::max(highest, farthest), 0.9F) << name << " is drawn as large as it may be";
    }
}

// The normal in the middle of frame 1, whose camera looks from +x; a model of this text alone on the floor.
glm::vec3 normalInTheMiddle(const std::string& name, const std::string& text) {
    const TemporaryFolder folder;
    folder.write(name, text);
    runToSuccess({GLLADDER_RUNG,
                  {"--headless", "--mesh", name, "--target", "normal", "--size", "32x24", "--frame", "1",
                   "--out", "normal.exr"},
                  {},
                  folder.path()});
    const Image image = loadImage(folder.path() / "normal.exr");
    const auto& values = std::get<std::vector<float>>(image.pixels);
    const float* n = &values[static_cast<std::size_t>((12 * image.width + 16) * image.channels)];
    return {n[0], n[1], n[2]};
}

TEST(Framing, turnsTheFrontOfAGltfToTheCamera) {
    GltfMaker maker;
    maker.attributes()["POSITION"] =
        maker.accessor(packed<float>({-1, 0, 0, 1, 0, 0, -1, 2, 0, 1, 2, 0}), 5126, "VEC3", 4);
    maker.primitive()["mode"] = 5; // a strip whose front is +z
    const glm::vec3 normal = normalInTheMiddle("model.gltf", maker.gltf());
    EXPECT_NEAR(glm::distance(normal, glm::vec3(1, 0, 0)), 0.0F, 1e-3F);
}

TEST(Framing, lightsASheetOnTheSideThatIsSeen) {
    const std::string corners = "v 0 0 -1\nv 0 0 1\nv 0 2 1\nv 0 2 -1\n";
    for (const char* face : {"f 1 2 3 4\n", "f 4 3 2 1\n", "vn 1 0 0\nf 1//1 2//1 3//1 4//1\n",
                             "vn 1 0 0\nf 4//1 3//1 2//1 1//1\n"}) {
        const glm::vec3 normal = normalInTheMiddle("model.obj", corners + face);
        EXPECT_NEAR(glm::distance(normal, glm::vec3(1, 0, 0)), 0.0F, 1e-3F) << face;
    }
    // The far and the near side of a box, and what has no thickness at all.
    EXPECT_NEAR(glm::distance(normalInTheMiddle("box.obj", box({1, 2, 2})), glm::vec3(1, 0, 0)), 0.0F, 1e-3F);
    EXPECT_NEAR(glm::distance(normalInTheMiddle("flat.obj", box({0, 2, 2})), glm::vec3(1, 0, 0)), 0.0F,
                1e-3F);
}

TEST(Framing, refusesAModelThatIsOnlyAPoint) {
    const TemporaryFolder folder;
    folder.write("model.obj", box({0, 0, 0}, {1, 2, 3}));
    const Result result = run({GLLADDER_RUNG,
                               {"--headless", "--mesh", "model.obj", "--size", "8x8", "--out", "a.png"},
                               {},
                               folder.path()});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("model.obj: all of its vertices lie at one place"), std::string::npos)
        << result.err;
}

} // namespace
} // namespace gll::test
