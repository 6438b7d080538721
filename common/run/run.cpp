// Choosing between window and headless, and turning errors into one line and an exit code.
#include "run/run.hpp"

#include "run/cost.hpp"
#include "run/headless.hpp"
#include "run/options.hpp"
#include "rung/usage_error.hpp"
#include "window/window.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>

namespace gll {
namespace {

bool measures(const Options& options) {
    if (!options.is_batch) return options.request.cost;
    return std::any_of(options.batch.begin(), options.batch.end(),
                       [](const FrameRequest& request) { return request.cost; });
}

// The picture that was asked for in place of a window, and why it is one.
int renderInstead(Options options, const NoWindow& error, const RungInfo& info, Settings& settings) {
    options.context = ContextKind::headless;
    options.request = *options.or_picture;
    const int exit_code = runHeadless(options, info, settings);
    if (exit_code == 0)
        std::fprintf(stderr, "%s: no window can be opened here (%s); the picture is %s\n", info.name.c_str(),
                     error.reason.c_str(), std::filesystem::absolute(options.request.out).c_str());
    return exit_code;
}

int showWindow(const Options& options, const RungInfo& info, Settings& settings) {
    try {
        return runWindow(
            options.request,
            {.picture = options.is_size_given ? std::optional(options.request.size) : std::nullopt,
             .state_file = options.window_state,
             .is_frame_given = options.is_frame_given},
            info, settings);
    } catch (const NoWindow& error) {
        if (!options.or_picture) throw;
        return renderInstead(options, error, info, settings);
    }
}

} // namespace

int runRung(int argc, char** argv, const RungInfo& info, Settings& settings) {
    try {
        const std::optional<Options> options = parseOptions(argc, argv, info, settings);
        if (!options) return 0;
        if (options->list_settings) return listSettings(*options, info, settings);
        if (options->context == ContextKind::window) return showWindow(*options, info, settings);
        if (measures(*options)) prepareCost(options->counter, argv);
        return runHeadless(*options, info, settings);
    } catch (const UsageError& error) {
        return reportError(info, error.what(), 2);
    } catch (const std::bad_alloc&) {
        return reportError(info, "out of memory; ask for a smaller --size or fewer instances", 1);
    } catch (const std::exception& error) {
        return reportError(info, error.what(), 1);
    }
}

} // namespace gll
