// What the passes of frames cost, counted by this program run a second time, so that the rasteriser there
// works in one thread, whatever it does here. Private to common/budget.
#pragma once

#include "rung/request.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gll {

// What a frame costs, in all or in one pass, per pixel of the frame.
struct Cost {
    double cu = 0;
    double bytes = 0;     // written and read
    unsigned program = 0; // of a pass
};
using PassCosts = std::map<std::string, Cost>;

Cost sumOf(const PassCosts& passes);

struct CountedPasses {
    std::vector<PassCosts> of_settings; // in their order
    std::string counter;                // what they were counted with
};

// The request's frame with each of some lists of KEY=VALUE over its own settings. context: "osmesa" or "egl".
// Returns nothing where `interrupted` says so meanwhile; throws std::runtime_error where costs cannot be
// counted.
std::optional<CountedPasses> countPasses(FrameRequest request,
                                         const std::vector<std::vector<std::string>>& settings,
                                         const std::string& context, const std::string& counter,
                                         const std::function<bool()>& interrupted);

} // namespace gll
