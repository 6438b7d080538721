// A rung in a window: the frame clock, the keys and the mouse, and the panel.
#pragma once

#include "app/options.hpp"

namespace gll {

// Opens a window of the size asked for and renders until it is closed. Throws std::runtime_error where there
// is no display, naming --headless. Returns 0.
int runWindow(const Options& options, const RungInfo& info, Settings& settings);

} // namespace gll
