// Two pictures of one frame, A and B, from different settings: beside each other, in turns, or how they
// differ.
#pragma once

#include "rung/rung.hpp"
#include "window/history.hpp"

#include <future>
#include <optional>

namespace gll {

// How far B is from A, of what a display is sent.
struct Difference {
    int frame = 0;
    double flip = 0; // the mean
    double rmse = 0;
    int pixels = 0; // that differ
    int of = 0;
    Image map = {}; // FLIP's, as colours
};

class Comparison {
  public:
    enum class Mode { off, divider, blink, difference, flip };
    static constexpr const char* mode_names[] = {"off", "divider", "blink", "difference", "flip"};
    static constexpr float difference_factor = 16;

    Mode mode = Mode::off;
    double divider = 0.5; // of the width, A is to the left

    // Measures in a thread of its own, while nothing else is measured and at most once a second; key: what
    // tells these pictures from others. Each picture must be complete.
    void measure(const Renderer& a, const Renderer& b, int frame, const History::State& key, double now_s);
    const std::optional<Difference>& measured() const { return measured_; }
    // Forgets what was measured: the pictures are others now.
    void forget() { measured_.reset(); }

    // Which of the two is to be seen in turns.
    static bool showsB(double now_s);

    // The picture of the difference, or FLIP's map, where that is the mode and is there; null: the pictures
    // themselves are shown.
    const Framebuffer* picture(Renderer& a, const Renderer& b);

  private:
    std::future<Difference> running_;
    History::State measured_key_;
    double next_s_ = 0;
    std::optional<Difference> measured_;
    bool is_uploaded_ = false;
    Framebuffer shown_{{{.name = "difference", .format = Format::rgba8}}, {1, 1}};
};

} // namespace gll
