// The clock of the window.
#include "rung/frame.hpp"
#include "window/timeline.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

TEST(TimelineTest, sixtyFramesASecondFromTheFirst) {
    Timeline timeline(60);
    timeline.advance(100);
    EXPECT_EQ(timeline.frame(), 60);
    timeline.advance(100.5);
    EXPECT_EQ(timeline.frame(), 90);
    timeline.setSpeed(0.5);
    timeline.advance(101.5);
    EXPECT_EQ(timeline.frame(), 120);
}

TEST(TimelineTest, aPauseLosesNoFrameAndSkipsNone) {
    Timeline timeline(1);
    timeline.advance(0);
    timeline.play(false);
    timeline.advance(50);
    EXPECT_EQ(timeline.frame(), 1);
    timeline.play(true);
    timeline.advance(50.1);
    EXPECT_EQ(timeline.frame(), 7);
}

TEST(TimelineTest, aStepStandsStill) {
    Timeline timeline(10);
    timeline.step(-1);
    EXPECT_EQ(timeline.frame(), 9);
    EXPECT_FALSE(timeline.isPlaying());
    timeline.step(-100);
    EXPECT_EQ(timeline.frame(), 1);
    timeline.seek(max_frame + 5);
    EXPECT_EQ(timeline.frame(), max_frame);
    timeline.step(1);
    EXPECT_EQ(timeline.frame(), max_frame);
}

TEST(TimelineTest, aLoopShowsBothItsEndsAndNothingOutside) {
    Timeline timeline(200);
    timeline.setLoop(Timeline::Loop{20, 10});
    EXPECT_EQ(timeline.loop(), (Timeline::Loop{10, 20}));
    timeline.advance(0);
    bool first = false;
    bool last = false;
    for (int i = 1; i < 400; ++i) {
        timeline.advance(i / frames_per_second);
        EXPECT_GE(timeline.frame(), 10);
        EXPECT_LE(timeline.frame(), 20);
        first = first || timeline.frame() == 10;
        last = last || timeline.frame() == 20;
    }
    EXPECT_TRUE(first && last);
    timeline.setLoop(std::nullopt);
    timeline.advance(100);
    EXPECT_GT(timeline.frame(), 20);
}

TEST(TimelineTest, noClockThatStandsOrLeapsLeavesTheRange) {
    Timeline timeline(max_frame - 1);
    timeline.advance(10);
    timeline.advance(5); // a clock that goes back is waited for
    EXPECT_EQ(timeline.frame(), max_frame - 1);
    timeline.setSpeed(1e9);
    timeline.advance(1e9);
    EXPECT_EQ(timeline.frame(), max_frame);
}

} // namespace
} // namespace gll::test
