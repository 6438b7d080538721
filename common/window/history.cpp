// Keeping states.
#include "window/history.hpp"

namespace gll {
namespace {

constexpr double settled_s = 0.4; // longer than between two steps of a mouse wheel
constexpr std::size_t most_states = 1000;

} // namespace

void History::observe(const State& now, double now_s, bool is_held) {
    if (now != seen_ || is_held) {
        seen_ = now;
        seen_since_s_ = now_s;
    } else if (now_s - seen_since_s_ >= settled_s) {
        keep(now);
    }
}

void History::keep(const State& now) {
    if (now == states_[present_]) return;
    states_.resize(present_ + 1); // what was undone is forgotten
    states_.push_back(now);
    if (states_.size() > most_states) states_.erase(states_.begin());
    present_ = states_.size() - 1;
}

std::optional<History::State> History::undo(const State& now) {
    keep(now);
    if (present_ == 0) return {};
    return states_[--present_];
}

std::optional<History::State> History::redo(const State& now) {
    if (!canRedo(now)) return {};
    return states_[++present_];
}

} // namespace gll
