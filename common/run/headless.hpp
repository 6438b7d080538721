// Rendering without a window: to files, in batches, for measuring and for listing what a rung has.
#pragma once

#include "run/options.hpp"

namespace gll {

// An error as every rung says it: one line on stderr. Returns the exit code.
int reportError(const RungInfo& info, std::string message, int exit_code);

// Does what the options ask for and prints what was written. Throws std::runtime_error or UsageError on
// failure; a batch says so, with the line, and goes on with the next one. Returns the exit code: 0, 130 where
// Ctrl-C ended it between two frames, or that of the first line of a batch that failed.
int runHeadless(const Options& options, const RungInfo& info, Settings& settings);

// --settings: settings, presets, and, from a small frame rendered for the purpose, targets and passes. Where
// no context is to be had, those two are left out and the reason is printed. Of a batch, once for each line.
int listSettings(const Options& options, const RungInfo& info, Settings& settings);

} // namespace gll
