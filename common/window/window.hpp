// A rung in a window: the frame clock, the keys and the mouse, and what is shown beside the picture.
#pragma once

#include "rung/request.hpp"

#include <optional>
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

// Opens a window and renders until it is closed. picture: the size of the picture to begin with; without it,
// the window has 1280x720. Throws NoWindow before anything was drawn. Returns 0.
int runWindow(const FrameRequest& request, std::optional<glm::ivec2> picture, const RungInfo& info,
              Settings& settings);

} // namespace gll
