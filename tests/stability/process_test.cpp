// What breaks a program rather than a picture: sizes that change and change again, frames that share a
// rendering, and guards that cost too much.
#include "charts/bloom_methods.hpp"
#include "page_table.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <iterator>

namespace gll::stability {
namespace {

constexpr const char* sizes[] = {"640x480", "1x1",    "7680x1",  "1x1",    "641x479", "1x7680", "320x240",
                                 "2x3",     "64x64",  "333x77",  "1280x8", "8x1280",  "500x5",  "96x96",
                                 "255x257", "128x16", "1023x33", "3x5",    "480x270", "31x63"};

class ResizeStability : public testing::TestWithParam<const char*> {};

// Every resize makes targets anew. A leak of the smallest of them ten times over would show.
TEST_P(ResizeStability, twoHundredSizesLeakNothingAndLeaveTheSameFrame) {
    const test::TemporaryFolder folder;
    // The peak of so many rounds of the sizes above; 1 writes the frame at its beginning and end.
    const auto peakKib = [&](int rounds) {
        std::string lines;
        const auto line = [&](const char* size, const std::filesystem::path& out) {
            nlohmann::json request{{"size", size}, {"out", (folder / out).string()}};
            if (GetParam() == std::string("03_gaussian_bloom"))
                request["set"] = {{"iterations", 1}}; // all five pairs of passes share two targets
            lines += request.dump() + "\n";
        };
        line(sizes[0], "first.png");
        for (int round = 0; round < rounds; ++round)
            for (const char* size : sizes)
                line(size, "any.png");
        line(sizes[0], "last.png");
        // Any OpenGL error ends the program with 1.
        const test::Result result =
            test::runToSuccess({folders.programs / GetParam(),
                                {"--headless", "--batch", folder.write("batch.jsonl", lines).string()},
                                // AddressSanitizer would keep what was freed.
                                {{"ASAN_OPTIONS", "quarantine_size_mb=1"}}});
        EXPECT_FALSE(test::contents(folder / "first.png").empty());
        EXPECT_EQ(test::contents(folder / "first.png"), test::contents(folder / "last.png"));
        return result.peak_memory_kib;
    };
    const long once = peakKib(1);
    const long ten_times = peakKib(10);
    std::printf("%s: at most %.1f MiB with 20 resizes, %.1f with 200\n", GetParam(), double(once) / 1024,
                double(ten_times) / 1024);
    // Half of a target of 640x480 in RGBA16F for each round that was added.
    EXPECT_LE(ten_times - once, 9 * 640 * 480 * 8 / 1024 / 2);
}
INSTANTIATE_TEST_SUITE_P(Rungs, ResizeStability,
                         testing::Values("01_hdr", "02_auto_exposure", "03_gaussian_bloom",
                                         "04_pyramid_bloom", "05_hdr_bloom"),
                         [](const auto& rung) { return std::string(rung.param); });

// A batch renders a frame once for all of its targets that are asked for in a row.
TEST(Batch, givesEveryTargetWhatItIsAlone) {
    const test::TemporaryFolder folder;
    const std::vector<nlohmann::json> frames = {
        {{"target", "hdr"}},
        {{"target", "bloom0"}},
        {{"target", "bright"}}, // a pass: the same target before levels are added to it
        {{"target", "frame"}},
        {{"target", "hdr"}, {"size", "40x30"}},
        {{"target", "bloom0"}, {"size", "40x30"}, {"set", {"threshold=0.2"}}},
        {{"target", "hdr"}, {"size", "40x30"}, {"set", {"threshold=0.2"}}, {"frame", 7}},
        {{"target", "bloom0"}, {"size", "40x30"}, {"frame", 7}},
        {{"target", "hdr"}, {"size", "40x30"}, {"frame", 7}, {"inject", "scene:5,5:90"}},
        {{"target", "bloom0"}, {"size", "40x30"}, {"frame", 7}, {"inject", "scene:5,5:90"}}};
    const auto out = [&](const char* how, std::size_t i) {
        return folder / (how + std::to_string(i) + ".exr");
    };
    const auto render = [&](const std::string& lines) {
        test::runToSuccess({folders.programs / "05_hdr_bloom",
                            {"--headless", "--batch", folder.write("batch.jsonl", lines).string()}});
    };
    std::string together;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        nlohmann::json line = frames[i];
        line["out"] = out("together", i).string();
        together += line.dump() + "\n";
        line["out"] = out("alone", i).string();
        render(line.dump() + "\n");
    }
    render(together);
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_EQ(test::contents(out("together", i)), test::contents(out("alone", i))) << frames[i];
}

// At the small end of what is promised, 320x180 to 3840x2160: there what the driver does once a pass, and
// what the smallest levels take more, count the most. No level of the first halves evenly.
TEST(BloomCost, ofTheRecommendedSplinesStaysBelowFiveCopiesAtOddSizes) {
    const test::TemporaryFolder folder;
    charts::writeExr(folder / "grey.exr", measure::ColorImage(8, 8, glm::dvec3(0.5)));
    charts::Set splines = charts::pyramidMethod(charts::pyramid_pairs[0], false).set;
    splines.erase("blur"); // 05 has none
    splines["karis"] = "none";
    for (const glm::ivec2 size : {glm::ivec2(321, 193), {323, 181}}) {
        const auto reports = charts::costs(folders.programs / "05_hdr_bloom", {splines, {{"bloom", "off"}}},
                                           size, {"--image", (folder / "grey.exr").string()});
        const double cost_cu = reports[0].at("sum_cu").get<double>() - reports[1].at("sum_cu").get<double>();
        std::printf("bloom at %dx%d: %.2f copies\n", size.x, size.y, cost_cu);
        EXPECT_LE(cost_cu, 5);
        EXPECT_GT(cost_cu, 2) << "not all of its passes were counted";
    }
}

struct GuardedChain {
    const char* rung;
    charts::Set set;
};

class GuardCost : public testing::TestWithParam<GuardedChain> {};

// Scenes are left out, and so drawn as cheaply as can be. The chains that guard the most; the display pass of
// 01 is in that of 03, what 05 has is in 03 and 04, and in 02 one pass of the meter and the last one check a
// number.
TEST_P(GuardCost, staysBelowAFifthOfACopy) {
    const GuardedChain& chain = GetParam();
    const test::TemporaryFolder folder;
    charts::writeExr(folder / "grey.exr", measure::ColorImage(8, 8, glm::dvec3(0.5)));
    // Each twice, and the smaller count: what the driver does once is no cost of a pass.
    const charts::Set on = chain.set + charts::Set{{"guard", "on"}};
    const charts::Set off = chain.set + charts::Set{{"guard", "off"}};
    const glm::ivec2 size(64, 48);
    const auto reports = charts::costs(folders.programs / chain.rung, {on, off, on, off}, size,
                                       {"--image", (folder / "grey.exr").string()});
    // Instructions over one count of the copy: each report's own differs by a thousandth from the others,
    // which is 0.05 copies of a chain that takes fifty.
    double instructions = 0;
    double copy = reports[0].at("copy_per_pixel");
    for (const nlohmann::json& report : reports)
        copy = std::min(copy, report.at("copy_per_pixel").get<double>());
    for (std::size_t i = 0; i < reports[0].at("passes").size(); ++i) {
        if (reports[0].at("passes")[i].at("name") == "scene") continue;
        const auto least = [&](std::size_t first) {
            const auto counted = [&](std::size_t report) {
                const auto& pass = reports[report].at("passes")[i];
                return pass.at("per_pixel").get<double>() * pass.at("size")[0].get<double>() *
                       pass.at("size")[1].get<double>();
            };
            return std::min(counted(first), counted(first + 2));
        };
        instructions += least(0) - least(1);
    }
    const double cost_cu = instructions / (copy * size.x * size.y);
    std::printf("guards of %s: %.3f copies\n", chain.rung, cost_cu);
    EXPECT_LT(cost_cu, 0.2);
    EXPECT_GT(cost_cu, 0.02) << "there is no guard any more";
}
INSTANTIATE_TEST_SUITE_P(Chains, GuardCost,
                         testing::Values(GuardedChain{"03_gaussian_bloom", {}},
                                         GuardedChain{
                                             "04_pyramid_bloom",
                                             charts::pyramidMethod(charts::pyramid_pairs[0], false).set}),
                         [](const auto& chain) { return std::string(chain.param.rung); });

} // namespace
} // namespace gll::stability
