// The clock of the window.
#include "window/timeline.hpp"

#include "rung/frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gll {

Timeline::Timeline(int first_frame) : position_(std::clamp(first_frame, 1, max_frame)) {}

void Timeline::advance(double now_s) {
    const double elapsed_s = last_s_ ? std::max(now_s - *last_s_, 0.0) : 0;
    last_s_ = now_s;
    if (!is_playing_) return;
    position_ = std::min<double>(position_ + elapsed_s * frames_per_second * speed_, max_frame);
    if (!loop_ || (position_ >= loop_->first && position_ < loop_->last + 1)) return;
    const double length = loop_->last + 1 - loop_->first;
    const double beyond = std::fmod(position_ - loop_->first, length);
    position_ = position_ < loop_->first ? loop_->first : loop_->first + beyond;
}

int Timeline::frame() const { return static_cast<int>(position_); }

void Timeline::step(int frames) {
    seek(frame() + frames);
    is_playing_ = false;
}

void Timeline::seek(int frame) { position_ = std::clamp(frame, 1, max_frame); }

void Timeline::setSpeed(double speed) { speed_ = std::clamp(speed, 1.0 / 64, 16.0); }

void Timeline::setLoop(std::optional<Loop> loop) {
    if (loop) {
        loop->first = std::clamp(loop->first, 1, max_frame);
        loop->last = std::clamp(loop->last, 1, max_frame);
        if (loop->first > loop->last) std::swap(loop->first, loop->last);
    }
    loop_ = loop;
}

} // namespace gll
