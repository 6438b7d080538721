// 01_hdr's frames against what its formats, tone maps, divider and false colours must make of the same scene
// light.
#include "01_hdr/tone_map.hpp"
#include "io/image.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <cstdio>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gll::truth::hdr_frames {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int width = 160;
constexpr int height = 120;

using Pixels = std::vector<glm::dvec3>; // top row first; 8-bit pictures in codes

class HdrTruth : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<test::TemporaryFolder>();
        std::string lines;
        const auto ask = [&](const std::string& file, const Json& set, const char* target,
                             const Json& inject) {
            Json line{
                {"out", (*folder / file).string()}, {"size", "160x120"}, {"set", set}, {"inject", inject}};
            if (*target != '\0') line["target"] = target;
            lines += line.dump() + "\n";
        };
        const Json none = Json::array();
        for (const std::string& format : test::choicesOf(test::program("01_hdr"), "format"))
            ask(format + ".exr", {{"format", format}, {"brightness", 3}}, "hdr", none);
        for (const std::string tone_map : hdr::tone_maps) {
            ask(tone_map + ".png", {{"tone_map", tone_map}, {"format", "rgba32f"}, {"brightness", 3}}, "",
                none);
            for (const char* value : {"nan", "inf", "-inf", "1e9"})
                ask(tone_map + value + ".png",
                    {{"tone_map", tone_map}, {"format", "rgba32f"}, {"brightness", 3}}, "",
                    {std::string("scene:70,50:") + value});
        }
        ask("stops.png",
            {{"tone_map", "clamp"},
             {"format", "rgba32f"},
             {"brightness", 3},
             {"view", "stops"},
             {"encode", "srgb"}},
            "", none);
        test::runToSuccess({test::program("01_hdr"),
                            {"--headless", "--batch", folder->write("batch.jsonl", lines).string()}});
    }
    static void TearDownTestSuite() { folder.reset(); }

    static Pixels read(const std::string& file) {
        const Image image = loadImage(*folder / file);
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        Pixels result;
        std::visit(
            [&](const auto& values) {
                for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels))
                    result.emplace_back(values[i], values[i + 1], values[i + 2]);
            },
            image.pixels);
        return result;
    }

    static std::unique_ptr<test::TemporaryFolder> folder;
};
std::unique_ptr<test::TemporaryFolder> HdrTruth::folder;

// The largest error of a format, of the value itself and of the value's proportion, where it must hold it.
struct Error {
    double absolute = 0;
    double relative = 0;
};

Error errorOf(const Pixels& actual, const Pixels& truth, double highest) {
    Error error;
    for (std::size_t i = 0; i < truth.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double expected = std::min(truth[i][c], highest);
            const double difference = std::abs(actual[i][c] - expected);
            error.absolute = std::max(error.absolute, difference);
            if (expected > 1e-3) error.relative = std::max(error.relative, difference / expected);
        }
    return error;
}

TEST_F(HdrTruth, fixedPointClampsAndFloatsKeepTheirShareOfEveryValue) {
    const Pixels truth = read("rgba32f.exr");
    double brightest_channel = 0;
    for (const glm::dvec3& color : truth)
        brightest_channel = std::max({brightest_channel, color.r, color.g, color.b});
    EXPECT_GT(brightest_channel, 200) << "the scene should be far brighter than 1";
    const auto check = [&](const std::string& format, double highest, double absolute, double relative) {
        const Error error = errorOf(read(format + ".exr"), truth, highest);
        std::printf("%-16s largest error %.2g, relative %.2g\n", format.c_str(), error.absolute,
                    error.relative);
        EXPECT_LE(error.absolute, absolute) << format;
        EXPECT_LE(error.relative, relative) << format;
    };
    // Half a step, or a whole one where llvmpipe's store truncates: in all but 8 bits.
    check("rgba8", 1, 0.51 / 255, 1);
    check("rgb10_a2", 1, 1.01 / 1023, 1);
    check("r11f_g11f_b10f", 65024, 65504, 1.01 / 32);
    check("rgba16f", 65504, 65504, 1.01 / 1024);
    test::requireCovered(test::program("01_hdr"), "format",
                         {"rgba8", "rgb10_a2", "r11f_g11f_b10f", "rgba16f"},
                         {{"rgba32f", "what the others are compared with"}});
}

TEST_F(HdrTruth, everyToneMapShowsItsFormulaOfTheSceneLight) {
    const Pixels light = read("rgba32f.exr");
    for (const std::string tone_map : hdr::tone_maps) {
        const Pixels shown = read(tone_map + ".png");
        double largest = 0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            const glm::dvec3 expected = encoded("gamma22", toneMapped(tone_map, light[i])) * 255.0;
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(shown[i][c] - expected[c]));
        }
        std::printf("%-18s largest error %.3f of a code\n", tone_map.c_str(), largest);
        EXPECT_LE(largest, 0.51) << tone_map; // half a code is the rounding to 8 bits
    }
}

TEST_F(HdrTruth, aPixelThatIsNoNumberOrInfiniteStaysOnePixelAndBecomesItsLimit) {
    constexpr std::size_t hit = 50 * width + 70;
    for (const std::string tone_map : hdr::tone_maps) {
        const Pixels good = read(tone_map + ".png");
        for (const std::string value : {"nan", "inf", "-inf", "1e9"}) {
            const Pixels bad = read(tone_map + value + ".png");
            const double limit = value == "nan" || value == "-inf" ? 0 : brightest;
            const glm::dvec3 expected = encoded("gamma22", toneMapped(tone_map, glm::dvec3(limit))) * 255.0;
            for (std::size_t i = 0; i < good.size(); ++i) {
                if (i != hit) {
                    ASSERT_EQ(bad[i], good[i]) << tone_map << " " << value << " pixel " << i;
                }
            }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(bad[hit][c], expected[c], 0.51) << tone_map << " " << value;
        }
    }
}

TEST_F(HdrTruth, aPictureOfOnesOwnIsDrawnAsItIsAndLargerOrSmallerAboutItsMiddle) {
    const auto render = [&](const char* size, const char* file) {
        test::runToSuccess({test::program("01_hdr"),
                            {"--image", (*folder / "rgba16f.exr").string(), "--target", "hdr", "--size", size,
                             "--out", (*folder / file).string()}});
        return loadImage(*folder / file);
    };
    render("160x120", "same.exr");
    EXPECT_EQ(read("same.exr"), read("rgba16f.exr"));
    // Half as wide at the same height: the middle half, pixel by pixel.
    const Image narrow = render("80x120", "narrow.exr");
    const Image whole = loadImage(*folder / "rgba16f.exr");
    const auto& narrow_values = std::get<std::vector<float>>(narrow.pixels);
    const auto& values = std::get<std::vector<float>>(whole.pixels);
    for (std::size_t y = 0; y < 120; ++y)
        for (std::size_t x = 0; x < 80; ++x) {
            const float expected = values[(y * 160 + x + 40) * static_cast<std::size_t>(whole.channels)];
            ASSERT_NEAR(narrow_values[(y * 80 + x) * static_cast<std::size_t>(narrow.channels)], expected,
                        1e-3F + 2e-3F * expected)
                << x << "," << y;
        }
}

// Each band has one colour, the colour of every pixel within that stop, but for the white stripes on what
// clips.
TEST_F(HdrTruth, falseColoursAreBandsOfAStopAndStripesWhereTheDisplayEnds) {
    const Pixels light = read("rgba32f.exr");
    const Pixels shown = read("stops.png");
    std::map<int, glm::dvec3> band;
    int striped = 0;
    int bands_seen = 0;
    for (int y = 0; y < height - 6; ++y) // above the scale
        for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(y * width + x);
            const double stops = std::log2(std::max(luminanceOf(light[i]), 1e-6));
            if (std::abs(stops - std::round(stops)) < 1e-3) continue; // either band is right
            const bool clips = std::max({light[i].r, light[i].g, light[i].b}) >= 1;
            if (clips && shown[i] == glm::dvec3(255)) {
                ++striped;
                continue;
            }
            const bool dark = std::max({light[i].r, light[i].g, light[i].b}) <= 0.00015;
            if (dark) continue;
            const auto [place, is_new] = band.try_emplace(static_cast<int>(std::floor(stops)), shown[i]);
            if (is_new) ++bands_seen;
            ASSERT_EQ(place->second, shown[i]) << x << "," << y << " of " << stops << " stops";
        }
    EXPECT_GT(bands_seen, 10);
    EXPECT_GT(striped, 100);
}

} // namespace
} // namespace gll::truth::hdr_frames
