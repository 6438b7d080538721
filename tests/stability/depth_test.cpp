// Faces that lie in one plane, or nearly: which of them is seen depends on the bits of the depth buffer.
#include "page_table.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <iterator>

namespace gll::stability {
namespace {

TEST(DepthStability, withSixteenBitsFacesFightInOneToTwoPercentOfTheSwarm) {
    charts::Frames frames(folders.programs / "05_hdr_bloom");
    constexpr int numbers[] = {1, 60, 180};
    for (const int number : numbers)
        for (const char* depth : {"depth24", "depth16"})
            frames.ask({{"depth", depth}}, {640, 480}, "hdr", nullptr, number);
    frames.run();
    for (std::size_t i = 0; i < std::size(numbers); ++i) {
        const measure::ColorImage fine = frames.read(2 * i);
        const measure::ColorImage coarse = frames.read(2 * i + 1);
        int different = 0;
        for (std::size_t p = 0; p < fine.pixels.size(); ++p)
            different += fine.pixels[p] != coarse.pixels[p] ? 1 : 0;
        const double percent = 100.0 * different / static_cast<double>(fine.pixels.size());
        std::printf("frame %d: %.2f %% of the scene's pixels differ with 16 bits of depth\n", numbers[i],
                    percent);
        EXPECT_GT(percent, 1) << news;
        EXPECT_LT(percent, 2);
    }
}

} // namespace
} // namespace gll::stability
