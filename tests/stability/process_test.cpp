// What breaks a program rather than a picture: sizes that change and change again, and guards that cost too
// much.
#include "page_table.hpp"
#include "support/process.hpp"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace gll::stability {
namespace {

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

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
            lines += nlohmann::json{{"size", size}, {"out", (folder / out).string()}}.dump() + "\n";
        };
        line(sizes[0], "first.png");
        for (int round = 0; round < rounds; ++round)
            for (const char* size : sizes)
                line(size, "any.png");
        line(sizes[0], "last.png");
        // Any OpenGL error ends the program with 1.
        const test::Result result = test::runToSuccess(
            {folders.programs / GetParam(),
             {"--context", "osmesa", "--batch", folder.write("batch.jsonl", lines).string()},
             // AddressSanitizer would keep what was freed.
             {{"ASAN_OPTIONS", "quarantine_size_mb=1"}}});
        EXPECT_FALSE(content(folder / "first.png").empty());
        EXPECT_EQ(content(folder / "first.png"), content(folder / "last.png"));
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

struct GuardedChain {
    const char* rung;
    charts::Set set;
};

class GuardCost : public testing::TestWithParam<GuardedChain> {};

// Scenes are left out, and so drawn as cheaply as can be. The display pass of 01 is in that of 03, and what
// 05 has is in 03 and 04.
TEST_P(GuardCost, staysBelowAFifthOfACopy) {
    const GuardedChain& chain = GetParam();
    const test::TemporaryFolder folder;
    std::vector<std::string> image;
    if (chain.set.count("test_pattern") == 0) {
        charts::writeExr(folder / "grey.exr", truth::ColorImage(8, 8, glm::dvec3(0.5)));
        image = {"--image", (folder / "grey.exr").string()};
    }
    const auto reports =
        charts::costs(folders.programs / chain.rung,
                      {chain.set + charts::Set{{"guard", "on"}}, chain.set + charts::Set{{"guard", "off"}}},
                      {64, 48}, image);
    double cost_cu = 0;
    for (std::size_t i = 0; i < 2; ++i)
        for (const auto& pass : reports[i].at("passes"))
            if (pass.at("name") != "scene") cost_cu += (i == 0 ? 1 : -1) * pass.at("cu").get<double>();
    std::printf("guards of %s: %.3f copies\n", chain.rung, cost_cu);
    EXPECT_LT(cost_cu, 0.2);
    EXPECT_GT(cost_cu, 0.02) << "there is no guard any more";
}
INSTANTIATE_TEST_SUITE_P(
    Chains, GuardCost,
    testing::Values(GuardedChain{"02_auto_exposure",
                                 {{"adapt", "off"}, {"overlay", "off"}, {"test_pattern", "flat"}}},
                    GuardedChain{"03_gaussian_bloom", {}}),
    [](const auto& chain) { return std::string(chain.param.rung); });

} // namespace
} // namespace gll::stability
