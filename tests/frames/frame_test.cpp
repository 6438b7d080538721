// What must hold of the rung's frames, whatever the scene: rendered by the program, as people run it.
#include "io/image.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

namespace gll::test {
namespace {

// A pyramid without texture coordinates or images, and a sky of two grey halves.
class DeferredFrame : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write("scene/pyramid.obj",
                      "mtllib pyramid.mtl\nusemtl stone\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0\n"
                      "f 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n");
        folder_.write("scene/pyramid.mtl", "newmtl stone\nKd 0.8 0.7 0.6\nPr 0.5\n");
        Image sky;
        sky.width = 16;
        sky.height = 8;
        sky.channels = 3;
        std::vector<float> pixels(16 * 8 * 3, 0.2F);
        std::fill(pixels.begin(), pixels.begin() + 16 * 4 * 3, 1.0F);
        sky.pixels = pixels;
        saveImage(folder_.path() / "scene/sky.hdr", sky);
    }

    // Renders a batch of lines in which OUT stands for the folder.
    void render(std::string batch) {
        for (std::size_t at = 0; (at = batch.find("OUT", at)) != std::string::npos;)
            batch.replace(at, 3, folder_.path().string());
        folder_.write("batch.jsonl", batch);
        const std::string folder = folder_.path().string();
        const std::string command = std::string(GLLADDER_RUNG) + " --headless --mesh " + folder +
                                    "/scene/pyramid.obj --floor " + folder +
                                    "/scene/pyramid.mtl --environment " + folder + "/scene/sky.hdr --batch " +
                                    folder + "/batch.jsonl > " + folder + "/log";
        ASSERT_EQ(std::system(command.c_str()), 0);
    }

    Image image(const std::string& name) const { return loadImage(folder_.path() / name); }

    TemporaryFolder folder_;
};

TEST_F(DeferredFrame, isTheSameAfterTheWindowWasOnePixel) {
    render(R"({"size":"320x240","out":"OUT/before.png"}
{"size":"1x1","out":"OUT/tiny.png"}
{"size":"7x301","out":"OUT/odd.png","set":{"ssao_blur":"separable","ssao_resolution":"half","normals":"oct16","positions":"depth24","gloss":"palette"}}
{"size":"320x240","out":"OUT/after.png"}
)");
    EXPECT_EQ(image("before.png").pixels, image("after.png").pixels);
    EXPECT_EQ(image("tiny.png").width, 1);
}

TEST_F(DeferredFrame, hasNothingInfiniteInAnyAttachmentOfAnyLayout) {
    std::string batch;
    const auto add = [&](const std::string& target, const std::string& set) {
        batch += R"({"size":"160x120","target":")" + target + R"(","out":"OUT/)" +
                 std::to_string(std::count(batch.begin(), batch.end(), '\n')) + R"(.exr","set":{)" + set +
                 "}}\n";
    };
    for (const std::string layout :
         {R"("normals":"rgba16f")", R"("normals":"oct16")", R"("positions":"depth24")",
          R"("normals":"oct16","positions":"depth24","gloss":"palette")"})
        for (const std::string target : {"albedo", "normal", "depth", "ssao", "shadow", "lit"})
            add(target, layout + R"(,"ssao":"gtao")");
    add("position", "");
    add("position", R"("normals":"oct16")");
    add("lit",
        R"("ssao_blur":"separable","ssao_resolution":"half","environment_diffuse":"sh9","environment_specular":"prefiltered","texture_filter":"anisotropic","albedo":"srgb","shadow_bias":"texel")");
    render(batch);
    for (long i = 0; i < std::count(batch.begin(), batch.end(), '\n'); ++i) {
        const Image target = image(std::to_string(i) + ".exr");
        float largest = 0;
        for (const float value : std::get<std::vector<float>>(target.pixels)) {
            ASSERT_TRUE(std::isfinite(value)) << "line " << i + 1;
            largest = std::max(largest, value);
        }
        EXPECT_GT(largest, 0) << "line " << i + 1;
    }
}

TEST_F(DeferredFrame, isTheSumOfItsLights) {
    render(R"({"size":"160x120","target":"lit","out":"OUT/all.exr"}
{"size":"160x120","target":"lit","out":"OUT/sun.exr","set":{"points":false,"environment":false}}
{"size":"160x120","target":"lit","out":"OUT/points.exr","set":{"sun":false,"environment":false}}
{"size":"160x120","target":"lit","out":"OUT/environment.exr","set":{"sun":false,"points":false}}
{"size":"160x120","target":"lit","out":"OUT/none.exr","set":{"sun":false,"points":false,"environment":false}}
)");
    const auto values = [&](const std::string& name) {
        return std::get<std::vector<float>>(image(name).pixels);
    };
    const auto all = values("all.exr");
    const auto sun = values("sun.exr");
    const auto points = values("points.exr");
    const auto environment = values("environment.exr");
    const auto none = values("none.exr");
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i % 4 == 3) continue; // alpha: whether there is anything
        ASSERT_NEAR(all[i], sun[i] + points[i] + environment[i], 2e-3F * (1 + all[i])); // of half floats
        ASSERT_EQ(none[i], 0);
    }
}

TEST_F(DeferredFrame, looksNearlyTheSameFromEveryLayout) {
    render(
        R"({"size":"160x120","out":"OUT/seed.png","set":{"filmstrip":false,"ssao_blur":"separable","ssao_noise":"interleaved"}}
{"size":"160x120","out":"OUT/octahedral.png","set":{"filmstrip":false,"ssao_blur":"separable","ssao_noise":"interleaved","normals":"oct16"}}
{"size":"160x120","out":"OUT/depth.png","set":{"filmstrip":false,"ssao_blur":"separable","ssao_noise":"interleaved","positions":"depth24"}}
{"size":"160x120","out":"OUT/compact.png","set":{"filmstrip":false,"ssao_blur":"separable","ssao_noise":"interleaved","normals":"oct16","positions":"depth24","gloss":"palette"}}
)");
    const auto bytes = [&](const std::string& name) {
        return std::get<std::vector<std::uint8_t>>(image(name + ".png").pixels);
    };
    const auto seed = bytes("seed");
    for (const std::string layout : {"octahedral", "depth", "compact"}) {
        const auto other = bytes(layout);
        double squares = 0;
        for (std::size_t i = 0; i < seed.size(); ++i)
            squares += std::pow(double(seed[i]) - other[i], 2);
        EXPECT_LT(std::sqrt(squares / double(seed.size())), 1.0) << layout; // code of 255
    }
}

} // namespace
} // namespace gll::test
