// No more than a scene needs: the cheapest settings whose frames differ from the best settings' by no more
// than a budget. Which settings trade accuracy for cost, a rung says by Settings::dial().
#pragma once

#include "process/process.hpp"
#include "rung/request.hpp"

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace gll {

// How far a frame may be from that of the best settings.
struct Budget {
    enum class Kind {
        flip, // mean FLIP of what a display shows, 0 to 1
        rmse, // root mean squared difference of display values, 0 to 1
        ev    // difference in exposure, stops; for rungs that meter
    };
    Kind kind = Kind::flip;
    double limit = 0;
};

// "flip=0.01", "rmse=0.004" or "ev=0.05"; the limit above 0, at most 1 (16 for ev). Throws UsageError.
Budget parseBudget(const std::string& text);
const char* kindName(Budget::Kind kind); // "flip", "rmse" or "ev"

// What a search ended with. Costs are of the frame that the request names, in copies (cu).
struct BudgetResult {
    Budget budget;
    using Sets = std::vector<std::pair<std::string, std::string>>;
    Sets set = {};                            // of the dials, what differs from the present settings
    Sets best = {};                           // every dial as it was measured against
    Sets picked = {};                         // every dial as it was found
    std::vector<std::string> not_needed = {}; // "levels above 3", "format=rgba16f (rgba8 will do)"
    double error_to_spend = 0; // the part of the limit that was kept to in the frames looked at
    double error = 0;          // the largest in all frames looked at, of the budget's kind
    double cost_cu = 0;
    double best_cost_cu = 0;
    double present_error = 0; // of the settings that the search began with, likewise
    double present_cost_cu = 0;
    std::string counter = {};           // what costs were counted with
    std::vector<glm::ivec3> views = {}; // the frames looked at: number, width, height
    int combinations = 0;               // there are
    int tried = 0;                      // were rendered
};

// Called as the search goes on, with what it is at.
using BudgetProgress = std::function<void(const std::string&)>;

// Searches for the request, whose settings must be applied; leaves the settings at what it found. Costs are
// counted by this program run a second time with --counter `counter`, so that the rasteriser there works in
// one thread, whatever it does here. Throws UsageError where the rung has no dials, or no exposure and the
// budget is of EV; std::runtime_error where costs cannot be counted. Returns nothing where `interrupted` says
// so between two frames.
std::optional<BudgetResult> searchBudget(Renderer& renderer, const FrameRequest& request,
                                         const Budget& budget, const std::string& counter,
                                         const RungInfo& info, Settings& settings,
                                         const BudgetProgress& progress,
                                         const std::function<bool()>& interrupted);

// Four lines: what was picked, what it costs, what the settings before cost and how far off they are, and
// what was not needed.
std::string budgetText(const BudgetResult& result);
std::string budgetJson(const BudgetResult& result, const RungInfo& info); // one line, the four among it

// For a window, which goes on drawing meanwhile: this program run a second time to search, which says on its
// standard error what it is at, and what came of it.
inline constexpr const char* progress_variable = "GLLADDER_PROGRESS"; // of its environment
Command budgetCommand(const Budget& budget, const FrameRequest& request, const std::string& context);
struct BudgetAnswer {
    BudgetResult::Sets set;
    std::string text; // the four lines, or why there are none
};
BudgetAnswer budgetAnswer(const ProcessResult& result);

} // namespace gll
