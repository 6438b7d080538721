// A rung in a window: the frame clock, the keys and the mouse, and what is shown beside the picture.
#pragma once

#include "rung/request.hpp"

#include <filesystem>
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

// What is asked of the window itself.
struct WindowRequest {
    std::optional<glm::ivec2> picture; // its size to begin with; without it, the window has 1280x720
    std::filesystem::path state_file;  // --window-state: what to begin with, where it is there, and to leave
    bool is_frame_given = false;       // the request's frame is asked for, whatever the file has
};

// Opens a window and renders until it is closed. Throws NoWindow before anything was drawn,
// std::runtime_error where the state's file cannot be read or written. Returns 0.
int runWindow(const FrameRequest& request, const WindowRequest& wished, const RungInfo& info,
              Settings& settings);

} // namespace gll
