// The command line every rung has: parsing it, and the files of --batch, whose keys are the same options.
#pragma once

#include "budget/budget.hpp"
#include "run/cost.hpp"
#include "rung/request.hpp"

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gll {

struct Options {
    ContextKind context = ContextKind::window;
    CounterKind counter = CounterKind::automatic;
    FrameRequest request;
    bool is_size_given = false;
    bool is_frame_given = false;
    std::filesystem::path window_state; // of the window; may be empty
    std::vector<FrameRequest> batch;    // in place of request, where --batch was given
    bool is_batch = false;
    std::optional<Budget> budget;           // for the request; no batch then
    std::optional<FrameRequest> or_picture; // in place of the window, where none can be opened
    bool list_settings = false;
    bool json = false;
};

// Parses a command line. Returns nothing where --help or --version was asked for and printed. Throws
// UsageError for what is wrong with the command line or the batch file ("FILE:line: what"),
// std::runtime_error where the batch file cannot be read. Leaves the settings at their defaults: the requests
// say what to set.
std::optional<Options> parseOptions(int argc, char** argv, const RungInfo& info, Settings& settings);

// "NAME:X,Y:VALUE", VALUE a number, inf, -inf or nan. Throws UsageError.
Injection parseInjection(const std::string& text);

// A size such as "640x480": both sides 1 to 16384, at most 64 Mi pixels. Throws UsageError.
glm::ivec2 parseSize(const std::string& text);

} // namespace gll
