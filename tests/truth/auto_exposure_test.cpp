// 02_auto_exposure's frames and readings, as its command line gives them, against double.
#include "02_auto_exposure/auto_exposure.hpp"
#include "auto_exposure_reference.hpp"
#include "io/image.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "tone_reference.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

namespace gll::truth {
namespace {

using namespace auto_exposure;

// The rung's own frames and readings, all from one batch.
class RungTest : public testing::Test {
  protected:
    struct Request {
        std::string name;
        int frame = 60;
        std::string size = "64x48";
        std::map<std::string, std::string> set = {};
        std::string target = {};
    };

    static std::vector<Request> requests() {
        std::vector<Request> all;
        for (int frame = 1; frame <= 60; ++frame)
            all.push_back({"metered " + std::to_string(frame), frame, "64x48", {{"adapt", "off"}}});
        for (const int frame : {60, 180, 2, 961, 1140, 999'999, 999'999 - 960, 60, 1, 180})
            all.push_back({"again " + std::to_string(all.size()) + " " + std::to_string(frame), frame});
        for (const char* size : {"101x77", "64x48"})
            for (const std::string& reduction :
                 test::choicesOf(test::program("02_auto_exposure"), "reduction"))
                all.push_back({std::string(size) + " " + reduction, 60, size, {{"reduction", reduction}}});
        all.push_back({"hdr", 60, "101x77", {}, "hdr"});
        for (const char* pattern : {"black", "flat", "checkerboard", "one_hot", "ramp"})
            all.push_back({pattern, 60, "100x60", {{"test_pattern", pattern}}});
        for (const char* tone_map : {"reinhard_extended", "aces_hill", "clamp"})
            all.push_back({std::string("shown ") + tone_map,
                           60,
                           "101x77",
                           {{"tone_map", tone_map}, {"overlay", "off"}}});
        return all;
    }

    static void SetUpTestSuite() {
        folder = std::make_unique<test::TemporaryFolder>();
        std::string lines;
        for (const Request& request : requests()) {
            nlohmann::json line{{"out", file(request.name).string()},
                                {"frame", request.frame},
                                {"size", request.size},
                                {"set", request.set},
                                {"readings", true}};
            if (request.name == "hdr") line["target"] = "hdr";
            lines += line.dump() + "\n";
        }
        const auto result = test::runToSuccess(
            {test::program("02_auto_exposure"),
             {"--headless", "--json", "--batch", folder->write("batch.jsonl", lines).string()}});
        std::istringstream out(result.out);
        std::string line;
        for (const Request& request : requests()) {
            std::getline(out, line);
            readings[request.name] = nlohmann::json::parse(line).at("readings");
        }
    }
    static void TearDownTestSuite() { folder.reset(); }

    static std::filesystem::path file(std::string name) {
        std::replace(name.begin(), name.end(), ' ', '_');
        return *folder / (name + (name == "hdr" ? ".exr" : ".png"));
    }
    // Throws where the reading is null: not a finite number.
    static double reading(const std::string& name, const char* key) {
        return readings.at(name).at(key).get<double>();
    }

    static Light hdr() {
        const Image image = loadImage(file("hdr"));
        const auto& values = std::get<std::vector<float>>(image.pixels);
        Light light{{image.width, image.height}, {}};
        for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels))
            light.pixels.emplace_back(values[i], values[i + 1], values[i + 2]);
        return light;
    }

    static inline std::unique_ptr<test::TemporaryFolder> folder;
    static inline std::map<std::string, nlohmann::json> readings;
};

TEST_F(RungTest, metersTheTargetItDrew) {
    EXPECT_NEAR(reading("101x77 area", "metered_ev"), logAverage(hdr()), 1e-4);
    for (const char* reduction : {"mipmap_r16", "mipmap_r16f", "histogram"})
        std::printf("101x77 %-12s %+.4f EV\n", reduction,
                    reading(std::string("101x77 ") + reduction, "metered_ev") - logAverage(hdr()));
}

// The past is metered in small square frames, and here in 64x48: both see the same walk.
TEST_F(RungTest, adaptsAlongTheWalkAsTheRecursionInDoubleDoes) {
    double stop = reading("metered 1", "metered_ev");
    for (int frame = 2; frame <= 60; ++frame) {
        const double goal = reading("metered " + std::to_string(frame), "metered_ev");
        stop = goal + (stop - goal) * std::exp(-dt_s / (goal > stop ? up_s : down_s));
    }
    const double actual = std::log2(reading("64x48 area", "adapted_luminance"));
    std::printf("frame 60: adapted to %.4f, in double from the readings %.4f\n", actual, stop);
    EXPECT_NEAR(actual, stop, 0.03);
    EXPECT_GT(std::abs(actual - reading("64x48 area", "metered_ev")), 0.3)
        << "nothing to adapt to proves nothing";
}

TEST_F(RungTest, aFrameIsTheSameHoweverOneComesToIt) {
    const auto same = [](const std::string& a, const std::string& b) {
        EXPECT_EQ(readings.at(a), readings.at(b)) << a << " and " << b;
        EXPECT_EQ(loadImage(file(a)).pixels, loadImage(file(b)).pixels) << a << " and " << b;
    };
    same("again 60 60", "again 67 60");
    same("again 60 60", "64x48 area");
    same("again 61 180", "again 69 180");
    same("again 65 999999", "again 66 999039"); // a round of the walk apart, both with a full history
    EXPECT_NE(readings.at("again 60 60"), readings.at("again 61 180"));
    const auto alone =
        test::runToSuccess({test::program("02_auto_exposure"),
                            {"--headless", "--json", "--readings", "--size", "64x48", "--frame", "180"}});
    EXPECT_EQ(nlohmann::json::parse(alone.out).at("readings"), readings.at("again 61 180"));
}

TEST_F(RungTest, exposureIsKeyOverTheLuminanceAdaptedTo) {
    for (const auto& [name, values] : readings) {
        const double average = values.at("adapted_luminance");
        const double key = 1.03 - 2 / (2 + std::log10(average + 1));
        EXPECT_NEAR(values.at("key"), key, 1e-6) << name;
        EXPECT_NEAR(values.at("exposure_ev"), std::log2(key / average), 1e-4) << name;
    }
}

TEST_F(RungTest, aFrameOfAKnownAverageIsMeteredAsThat) {
    EXPECT_NEAR(reading("black", "metered_ev"), std::log2(epsilon), 1e-4);
    EXPECT_NEAR(reading("flat", "metered_ev"), std::log2(0.18), 1e-3); // 0.18 as a half float
    EXPECT_NEAR(reading("checkerboard", "metered_ev"), std::log2(epsilon) / 2, 1e-4);
    EXPECT_NEAR(reading("one_hot", "metered_ev"), (5999 * std::log2(epsilon) + std::log2(1000)) / 6000, 1e-4);
    EXPECT_NEAR(reading("ramp", "metered_ev"), -4, 1e-3);
    // What is adapted to stays within the limits, so that even black has an exposure a person can live with.
    for (const char* dark : {"black", "checkerboard", "one_hot"})
        EXPECT_NEAR(std::log2(reading(dark, "adapted_luminance")), lowest_stop, 1e-4) << dark;
}

TEST_F(RungTest, thePresentedFrameIsTheSceneExposedToneMappedAndEncoded) {
    const Light light = hdr();
    for (const std::string tone_map : {"reinhard_extended", "aces_hill", "clamp"}) {
        const Image image = loadImage(file("shown " + tone_map));
        const auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
        const double exposure = std::exp2(reading("shown " + tone_map, "exposure_ev"));
        double largest = 0;
        for (std::size_t i = 0; i < light.pixels.size(); ++i) {
            const glm::dvec3 expected =
                encoded("srgb", toneMapped(tone_map, glm::dvec3(light.pixels[i]) * exposure, white_point)) *
                255.0;
            for (int c = 0; c < 3; ++c)
                largest = std::max(
                    largest,
                    std::abs(
                        bytes[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(c)] -
                        expected[c]));
        }
        std::printf("%-18s largest error %.3f of a code\n", tone_map.c_str(), largest);
        EXPECT_LE(largest, 0.52) << tone_map; // half a code is the rounding to 8 bits
    }
}

} // namespace
} // namespace gll::truth
