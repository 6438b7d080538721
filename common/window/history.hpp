// Undo and redo: every state that a person's changes led to, of which one is the present.
#pragma once

#include <optional>
#include <vector>

namespace gll {

// A state is every number that can be changed, in an order of the owner's.
class History {
  public:
    using State = std::vector<double>;

    explicit History(State first) : states_{std::move(first)} {}

    // A new state is kept once it has lasted: a slider that is dragged is one change, not fifty. To be called
    // before each frame with a clock in seconds, and whether something is being held.
    void observe(const State& now, double now_s, bool is_held);

    bool canUndo(const State& now) const { return present_ > 0 || now != states_[present_]; }
    bool canRedo(const State& now) const { return present_ + 1 < states_.size() && now == states_[present_]; }
    // The state before, or after, the present one. Nothing where there is none.
    std::optional<State> undo(const State& now);
    std::optional<State> redo(const State& now);

  private:
    void keep(const State& now);

    std::vector<State> states_;
    std::size_t present_ = 0;
    State seen_; // when last asked
    double seen_since_s_ = 0;
};

} // namespace gll
