// A rung in a window: the frame clock, the keys and the mouse, and the panel.
#pragma once

#include "rung/request.hpp"

#include <stdexcept>
#include <string>

namespace gll {

// No window can be opened: no display, or none that can do what the rungs need. Names --headless.
struct NoWindow : std::runtime_error {
    explicit NoWindow(const std::string& why)
        : std::runtime_error("no window can be opened here (" + why +
                             "); run with --headless to render to a file instead"),
          reason(why) {}
    std::string reason;
};

// Opens a window of the size asked for and renders until it is closed. Throws NoWindow before anything was
// drawn. Returns 0.
int runWindow(const FrameRequest& request, const RungInfo& info, Settings& settings);

} // namespace gll
