// The whole main() of a rung: command line, then a window or headless rendering, then an exit code.
#pragma once

#include "rung/rung.hpp"

namespace gll {

// Runs a rung with its declared settings. Returns what main() should: 0 done, 1 failed (one line on stderr),
// 2 wrong usage (likewise), 130 interrupted.
int runRung(int argc, char** argv, const RungInfo& info, Settings& settings);

// The same for a class R with a nested type R::Options, whose member "all" is the Settings it declares into,
// and a constructor R(RungResources, const R::Options&).
template <class R>
int run(int argc, char** argv, RungInfo info) {
    typename R::Options options;
    info.make = [&options](RungResources resources) -> std::unique_ptr<Rung> {
        return std::make_unique<R>(std::move(resources), options);
    };
    return runRung(argc, argv, info, options.all);
}

} // namespace gll
