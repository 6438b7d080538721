// The bar under the picture: play, step, scrub, speed, loop and record.
#pragma once

#include "window/layout.hpp"
#include "window/timeline.hpp"

#include <optional>
#include <string>

namespace gll {

struct RecordingState {
    bool is_recording = false;
    int done = 0; // of the frames asked for
    int of = 0;
};

class TimelineBar {
  public:
    struct Actions {
        std::optional<Timeline::Loop> record;
        bool cancel_recording = false;
    };
    Actions draw(const Rectangle& place, float pixels_per_unit, Timeline& timeline,
                 const RecordingState& recording);

  private:
    Timeline::Loop range_{1, 240}; // what loops or is recorded
    int scrub_end_ = 600;
};

} // namespace gll
