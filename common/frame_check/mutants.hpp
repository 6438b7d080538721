// Small faults for shaders: what a slip of the hand makes of a line of GLSL.
#pragma once

#include <string>
#include <vector>

namespace gll::frame_check {

struct Mutant {
    std::string file;        // from the shaders' folder: "lib/tone_map.glsl"
    int line = 0;            // from 1
    std::string operation;   // such as "arithmetic", "bypass", "term"
    std::string before = {}; // the lines that change, spaces made one
    std::string after = {};  // what they become
    std::string text = {};   // the whole file with the fault in it
};

// All faults of a file, in order of place. Operators are swapped and signs dropped, comparisons turned round,
// constants scaled, channels exchanged, terms and factors dropped, min and max exchanged, calls replaced by
// their argument, samples taken beside the place, branches never or always taken, assignments left out. Left
// alone are comments, preprocessor lines, declarations of the interface, and constants below 0.001 or above
// 10000, which only keep a division finite or scatter bits. Some faults change nothing; some do not compile.
std::vector<Mutant> mutantsOf(const std::string& file, const std::string& text);

} // namespace gll::frame_check
