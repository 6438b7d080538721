// Which frame is shown: by the clock, forwards at any speed, over and over again, or standing still.
#pragma once

#include <optional>

namespace gll {

class Timeline {
  public:
    struct Loop {
        int first = 1; // both shown, first at most last
        int last = 1;

        bool operator==(const Loop&) const = default;
    };

    explicit Timeline(int first_frame);

    // To be called before each frame with a clock that only goes forward, in seconds.
    void advance(double now_s);

    int frame() const; // 1 to max_frame
    bool isPlaying() const { return is_playing_; }
    double speed() const { return speed_; } // 1: 60 frames a second
    std::optional<Loop> loop() const { return loop_; }

    void play(bool is_playing) { is_playing_ = is_playing; }
    void step(int frames); // and stands still there
    void seek(int frame);
    void setSpeed(double speed); // is limited to 1/64 to 16
    // Frames outside max_frame are moved inside, and the ends swapped where first comes after last.
    void setLoop(std::optional<Loop> loop);

  private:
    double position_; // in frames; its whole part is the frame shown
    double speed_ = 1;
    bool is_playing_ = true;
    std::optional<Loop> loop_;
    std::optional<double> last_s_;
};

} // namespace gll
