// Undo and redo: what counts as one change, and what is forgotten.
#include "window/history.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

using State = History::State;

TEST(HistoryTest, aDraggedSliderIsOneChange) {
    History history({0});
    for (int i = 1; i <= 50; ++i)
        history.observe({double(i)}, 0.02 * i, true);
    history.observe({50}, 1.02, false);
    history.observe({50}, 2, false);
    EXPECT_EQ(history.undo({50}), State{0});
    EXPECT_EQ(history.redo({0}), State{50});
}

TEST(HistoryTest, whatLastsIsKeptOneByOne) {
    History history({0});
    for (const double value : {1.0, 2.0, 3.0}) {
        history.observe({value}, 10 * value, false);
        history.observe({value}, 10 * value + 1, false);
    }
    EXPECT_EQ(history.undo({3}), State{2});
    EXPECT_EQ(history.undo({2}), State{1});
    EXPECT_EQ(history.undo({1}), State{0});
    EXPECT_FALSE(history.canUndo({0}));
    EXPECT_EQ(history.undo({0}), std::nullopt);
    EXPECT_EQ(history.redo({0}), State{1});
}

TEST(HistoryTest, undoAtOnceAfterAChangeTakesItBack) {
    History history({0});
    EXPECT_TRUE(history.canUndo({7}));
    EXPECT_EQ(history.undo({7}), State{0});
    EXPECT_EQ(history.redo({0}), State{7});
}

TEST(HistoryTest, aChangeAfterUndoForgetsWhatWasUndone) {
    History history({0});
    (void)history.undo({1});
    history.observe({5}, 1, false);
    history.observe({5}, 2, false);
    EXPECT_FALSE(history.canRedo({5}));
    EXPECT_EQ(history.undo({5}), State{0});
}

TEST(HistoryTest, aThousandStatesAreKeptAndNoMore) {
    History history({0});
    double now_s = 0;
    for (int i = 1; i <= 3000; ++i) {
        history.observe({double(i)}, ++now_s, false);
        history.observe({double(i)}, ++now_s, false);
    }
    State state{3000};
    int steps = 0;
    while (const auto before = history.undo(state)) {
        state = *before;
        ++steps;
    }
    EXPECT_EQ(steps, 999);
    EXPECT_EQ(state, State{2001});
}

} // namespace
} // namespace gll::test
