// How 02_auto_exposure adapts over time, against the exponential and the recursion from the first frame.
#include "02_auto_exposure/auto_exposure.hpp"
#include "auto_exposure_reference.hpp"

#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace gll::truth {
namespace {

using namespace auto_exposure;

TEST(Adaptation, toAConstantSceneIsAnExponential) {
    for (const auto& [start, goal, tau_s] : {std::tuple(-8.0, 1.0, up_s), std::tuple(2.0, -6.0, down_s)}) {
        double stop = start;
        for (int n = 1; n <= 300; ++n) {
            stop = adapted(stop, goal, {up_s, down_s}, dt_s);
            ASSERT_NEAR(stop, goal + (start - goal) * std::exp(-n * dt_s / tau_s), 1e-9) << n;
        }
    }
    EXPECT_EQ(adapted(-3, 4, {0, 1}, dt_s), 4) << "a time constant of 0 is at once";
    EXPECT_EQ(adapted(4, -3, {0, 1}, 0), 4) << "no time, no change";
}

TEST(Adaptation, halvingTheStepLeavesTheCurve) {
    double coarse = -8;
    double fine = -8;
    for (int n = 0; n < 100; ++n) {
        coarse = adapted(coarse, 1, {up_s, down_s}, dt_s);
        fine = adapted(adapted(fine, 1, {up_s, down_s}, dt_s / 2), 1, {up_s, down_s}, dt_s / 2);
    }
    EXPECT_NEAR(coarse, fine, 1e-9);
}

TEST(Adaptation, olderFramesThanThoseThatMatterChangeLessThanTheBound) {
    for (const AdaptationSpeed speed : {AdaptationSpeed{up_s, down_s}, {2, 0.1}, {0, 0}, {0, 3}}) {
        std::mt19937 random(3);
        double low = -9; // the two furthest apart that an eye can begin
        double high = 9;
        const int frames = framesThatMatter(speed, dt_s, 18);
        for (int n = 0; n < frames; ++n) {
            const double seen = -9 + 18 * (double(random()) / 4294967296.0);
            low = adapted(low, seen, speed, dt_s);
            high = adapted(high, seen, speed, dt_s);
        }
        EXPECT_LE(std::abs(high - low), frames == 0 ? 18 : 0.001) << speed.up_s << " " << speed.down_s;
        if (speed.up_s == up_s) {
            EXPECT_EQ(frames, 706); // ceil(1.2 * 60 * ln(18000))
        }
    }
}

class HistoryTest : public testing::Test {
  protected:
    static constexpr int period = 240;
    // A scene that goes from -7 to 1 and back, with a step.
    double scene(int number) {
        ++meterings;
        const int n = (number - 1) % period;
        return -3 + 4 * std::sin(n * 0.0261799) + (n > 100 ? 1 : 0);
    }
    double before(AdaptationHistory& history, int number, const std::string& made_with = "a") {
        return history.before(number, options, made_with, [&](int n) { return scene(n); }).value();
    }
    // From frame 1, whatever the number.
    double reference(int number) {
        double stop = scene(1);
        for (int n = 2; n < number; ++n) {
            const double goal = scene(n);
            const double tau_s = goal > stop ? up_s : down_s;
            stop = goal + (stop - goal) * std::exp(-dt_s / tau_s);
        }
        return stop;
    }
    Settings settings;
    AutoExposureOptions options{settings};
    int meterings = 0;
};

TEST_F(HistoryTest, isTheRecursionFromTheFirstFrame) {
    AdaptationHistory history(period);
    EXPECT_FALSE(history.before(1, options, "a", [&](int n) { return scene(n); }).has_value());
    for (const int number : {2, 3, 60, 180, 700, 707, 708, 1000, 5000})
        EXPECT_NEAR(before(history, number), reference(number), number <= 707 ? 1e-6 : 0.001) << number;
}

TEST_F(HistoryTest, dependsOnTheFrameAlone) {
    AdaptationHistory history(period);
    std::map<int, double> alone;
    for (const int number : {2, 60, 180, 999, 10'000'000}) {
        AdaptationHistory fresh(period);
        alone[number] = before(fresh, number);
    }
    for (const int number : {180, 2, 10'000'000, 60, 999, 60, 180})
        EXPECT_EQ(before(history, number), alone[number]) << number;
    EXPECT_EQ(alone[10'000'000], before(history, 10'000'000 - 10 * period)) << "the scene repeats";
}

TEST_F(HistoryTest, metersEveryFrameOfTheSceneOnceUntilWhatItDependsOnChanges) {
    AdaptationHistory history(period);
    for (const int number : {60, 10, 60, 60})
        before(history, number);
    EXPECT_EQ(meterings, 59);
    before(history, 100'000);
    EXPECT_EQ(meterings, period);
    settings.set("adapt_up_s", "0.1");
    before(history, 60);
    EXPECT_EQ(meterings, period) << "speeds change what is made of the readings, not the readings";
    before(history, 60, "b");
    EXPECT_EQ(meterings, period + 59);
}

} // namespace
} // namespace gll::truth
