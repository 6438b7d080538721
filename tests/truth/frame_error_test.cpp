// frame_error as people and charts call it; what it refuses is in hostile/frame_error.cpp.
#include "io/image.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "support/messages.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace gll::measure {
namespace {

Image image(int channels, ColorSpace color_space) {
    Image result;
    result.width = 24;
    result.height = 16;
    result.channels = channels;
    result.color_space = color_space;
    return result;
}

// A checkerboard of two codes, opaque where there is an alpha.
Image board(int channels, std::uint8_t light, std::uint8_t dark) {
    Image result = image(channels, ColorSpace::srgb);
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int c = 0; c < channels; ++c)
                bytes.push_back(c == 3 ? std::uint8_t(255) : (x / 4 + y / 4) % 2 == 0 ? light : dark);
    result.pixels = std::move(bytes);
    return result;
}

// Light that doubles from left to right, times a factor.
Image light(float factor) {
    Image result = image(3, ColorSpace::linear);
    std::vector<float> values;
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            values.insert(values.end(), 3, factor * std::exp2(static_cast<float>(x) / 3 - 2));
    result.pixels = std::move(values);
    return result;
}

class FrameError : public testing::Test {
  protected:
    test::Result run(std::vector<std::string> arguments) const {
        return test::runToSuccess({.program = test::program("frame_error"),
                                   .arguments = std::move(arguments),
                                   .folder = folder.path()});
    }
    nlohmann::json measured(const std::string& one, const std::string& other) const {
        return nlohmann::json::parse(run({one, other, "--json"}).out);
    }
    void save(const std::string& name, const Image& contents) const { saveImage(folder / name, contents); }

    test::TemporaryFolder folder;
};

TEST_F(FrameError, ofDisplayValuesIsWhatTheLibraryComputes) {
    const Image one = board(3, 200, 100);
    const Image other = board(3, 190, 110);
    save("one.png", one);
    save("other.png", other);
    const auto result = measured("one.png", "other.png");
    EXPECT_EQ(result["kind"], "ldr");
    EXPECT_EQ(result["width"], 24);
    EXPECT_EQ(result["height"], 16);
    EXPECT_EQ(result["pixels_per_degree"], 67);
    EXPECT_NEAR(result["rmse"].get<double>(), 10 / 255.0, 1e-12);
    EXPECT_NEAR(result["psnr_db"].get<double>(), 20 * std::log10(25.5), 1e-9);
    EXPECT_NEAR(result["flip_mean"].get<double>(), summary(flip(linearColor(one), linearColor(other))).mean,
                1e-12);
    EXPECT_NEAR(result["hdr_flip_mean"].get<double>(),
                summary(hdrFlip(linearColor(one), linearColor(other)).map).mean, 1e-12);
    EXPECT_GT(result["flip_mean"].get<double>(), 0.01);
}

TEST_F(FrameError, ofLinearLightIsWhatTheLibraryComputes) {
    save("one.exr", light(2));
    save("other.exr", light(1));
    const auto result = measured("one.exr", "other.exr");
    EXPECT_EQ(result["kind"], "hdr");
    EXPECT_NEAR(result["energy_ratio"].get<double>(), 2, 1e-6);
    EXPECT_NEAR(result["log2_rmse_ev"].get<double>(), 1, 1e-3);
    EXPECT_NEAR(result["rmse"].get<double>(), rmse(linearColor(light(2)), linearColor(light(1))), 1e-9);
    EXPECT_NEAR(result["relative_rmse"].get<double>(),
                relativeRmse(linearColor(light(2)), linearColor(light(1))), 1e-9);
    const HdrFlip expected = hdrFlip(linearColor(light(2)), linearColor(light(1)));
    EXPECT_NEAR(result["hdr_flip_mean"].get<double>(), summary(expected.map).mean, 1e-9);
    EXPECT_EQ(result["hdr_flip_exposures"], expected.exposures.count);
    EXPECT_NEAR(result["flip_mean"].get<double>(),
                summary(flip(linearColor(light(2)), linearColor(light(1)))).mean, 1e-9);
    EXPECT_FALSE(result.contains("psnr_db"));
}

TEST_F(FrameError, ofAFrameAndItselfIsNone) {
    save("one.png", board(4, 200, 100));
    save("one.exr", light(1));
    save("one.hdr", light(1));
    for (const std::string name : {"one.png", "one.exr", "one.hdr"}) {
        const auto result = measured(name, name);
        for (const char* error : {"rmse", "flip_mean", "flip_max", "flip_weighted_median", "hdr_flip_mean",
                                  "relative_rmse", "log2_rmse_ev", "alpha_rmse"})
            EXPECT_EQ(result[error], 0) << name << " " << error;
        EXPECT_EQ(result["energy_ratio"], 1) << name;
        EXPECT_EQ(result.value("psnr_db", nlohmann::json()), nullptr) << "infinite";
    }
}

TEST_F(FrameError, comparesAlphaApart) {
    Image clear = board(4, 200, 100);
    for (std::size_t i = 3; i < 24 * 16 * 4; i += 4)
        std::get<std::vector<std::uint8_t>>(clear.pixels)[i] = 204;
    save("clear.png", clear);
    save("opaque.png", board(3, 200, 100));
    const auto result = measured("clear.png", "opaque.png");
    EXPECT_EQ(result["rmse"], 0);
    EXPECT_NEAR(result["alpha_rmse"].get<double>(), 0.2, 1e-9);
}

TEST_F(FrameError, writesTheMapThatItMeans) {
    save("one.png", board(3, 200, 100));
    save("other.png", board(3, 100, 200));
    run({"one.png", "other.png", "--map", "map.png"});
    const Image expected = heatMap(flip(linearColor(board(3, 200, 100)), linearColor(board(3, 100, 200))));
    EXPECT_EQ(loadImage(folder / "map.png").pixels, expected.pixels);
}

TEST_F(FrameError, hasAViewingDistance) {
    save("one.png", board(3, 200, 100));
    save("other.png", board(3, 150, 150));
    const auto error = [&](const char* ppd) {
        return nlohmann::json::parse(
                   run({"one.png", "other.png", "--json", "--pixels-per-degree", ppd}).out)["flip_mean"]
            .get<double>();
    };
    EXPECT_GT(error("20"), 1.5 * error("200"));
}

TEST_F(FrameError, saysItsNumbersToPeopleToo) {
    save("one.png", board(3, 200, 100));
    const test::Result result = run({"one.png", "one.png"});
    EXPECT_CONTAINS(result.out, "flip_mean                 0\n");
    EXPECT_CONTAINS(result.out, "psnr_db                   infinite\n");
    EXPECT_EQ(result.err, "") << "no progress where no terminal is";
    EXPECT_CONTAINS(run({"--help"}).out, "--pixels-per-degree");
    EXPECT_CONTAINS(run({"--version"}).out, "frame_error ");
}

} // namespace
} // namespace gll::measure
