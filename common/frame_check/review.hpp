// Reviewing frames in a browser: the report of a suite with buttons that accept, for the person at this
// machine.
#pragma once

#include "frame_check/check.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gll::frame_check {

struct ReviewOptions {
    std::string title = {};
    SuiteChanges changes = {}; // with which the suites were read
    bool adds = false;         // what is accepted stands beside what other renderers drew
};

// Serves the report at an address of this machine that it prints, until Ctrl-C. The address holds a random
// token, and a request that does not know it, or that a page from elsewhere makes, is refused. A frame that
// is accepted, with a reason, goes through accept(), and its result becomes `same`. Throws std::runtime_error
// where CI is set, and where no address can be had.
void review(std::vector<SuiteResult>& suites, const ReviewOptions& options);

} // namespace gll::frame_check
