// What a misspelt name is answered with: the nearest one, or nothing where none is near.
#include "rung/nearest.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

const std::vector<std::string> names = {"threshold", "tone_map",  "levels",        "intensity",
                                        "5tap",      "aces_hill", "hdr",           "bloom0",
                                        "bloom1",    "headless",  "aces_narkowicz"};

TEST(NearestName, answersOneLetterMoreLessOrOther) {
    EXPECT_EQ(nearestName("thresholdd", names), "threshold");
    EXPECT_EQ(nearestName("threshld", names), "threshold");
    EXPECT_EQ(nearestName("treshhold", names), "threshold");
    EXPECT_EQ(nearestName("6tap", names), "5tap");
    EXPECT_EQ(nearestName("hdd", names), "hdr");
}

TEST(NearestName, countsTwoNeighboursThatAreSwappedOnce) {
    EXPECT_EQ(nearestName("hrd", names), "hdr"); // of three letters only one may be wrong
    EXPECT_EQ(nearestName("drh", names), "");
    EXPECT_EQ(nearestName("levesl", {"leaves", "levels"}), "levels");
}

TEST(NearestName, takesTheNearestAndOfThoseTheFirst) {
    EXPECT_EQ(nearestName("bloom", names), "bloom0");
    EXPECT_EQ(nearestName("bloom1x", names), "bloom1");
}

TEST(NearestName, countsNeitherCapitalsNorDashes) {
    EXPECT_EQ(nearestName("Tone-Map", names), "tone_map");
    EXPECT_EQ(nearestName("HDR", names), "hdr");
}

TEST(NearestName, takesABeginningForTheWhole) {
    EXPECT_EQ(nearestName("thresh", names), "threshold");
    EXPECT_EQ(nearestName("aces", names), "aces_hill");
}

TEST(NearestName, guessesNothingFromWhatIsNotNear) {
    for (const std::string text : {"", "x", "colour", "vulkan", "---", "\xff\xff\xff"})
        EXPECT_EQ(nearestName(text, names), "") << text;
    EXPECT_EQ(nearestName("anything", {}), "");
    EXPECT_EQ(nearestName(std::string(10'000'000, 'h'), names), "") << "and takes no time for it";
}

TEST(NearestName, isAskedAboutAtTheEndOfAnError) {
    EXPECT_EQ(didYouMean("levles", names), "; did you mean levels?");
    EXPECT_EQ(didYouMean("vulkan", names), "");
}

} // namespace
} // namespace gll::test
