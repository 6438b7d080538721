// Accepting frames as references, by people who have looked at them.
#pragma once

#include "frame_check/suite.hpp"

#include <string>
#include <vector>

namespace gll::frame_check {

struct BlessOptions {
    std::vector<std::string> names = {}; // of cases; none: every one
    std::string because = {};            // never empty
    bool adds = false;                   // this renderer's frame beside those there, which stay
    bool makes = false;                  // a case that is not there, from the settings
    std::vector<std::string> settings =
        {}; // KEY=VALUE; a key may be "set.tone_map"; the same again makes a list
};

// Draws the frames twice, in both orders, and writes those that came out alike both times, or within the
// case's rule, as references. Says on stdout what became of each case. Returns whether all were accepted.
// Throws std::runtime_error where CI is set, where there is no reason, and where the names and settings make
// no case.
bool bless(Suite suite, const BlessOptions& options);

// Throws std::runtime_error where CI is set: nobody is there to look.
void requirePerson();

// Accepts the very frame that somebody was shown, once the case has been drawn again and came out alike,
// within its rule: what was looked at is what becomes the reference, and a frame by chance becomes none. Of
// the options, `because` and `adds` count. Returns what became of it. Throws std::runtime_error where it is
// not accepted.
std::string accept(const Suite& suite, const std::string& name, const Image& shown,
                   const BlessOptions& options);

// What matters to how a software rasteriser rounds: the processor's extensions, and what the environment
// takes from it. "sse4.1 avx avx2 fma"
std::string cpuFeatures();

} // namespace gll::frame_check
