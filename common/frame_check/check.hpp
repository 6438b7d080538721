// Checking frames: those of a suite, or one picture against another.
#pragma once

#include "frame_check/render.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gll::frame_check {

enum class Outcome {
    same,         // the hash is blessed, or no pixel differs
    tolerated,    // within the rule, and said as a warning
    different,    // beyond the rule
    incomparable, // not drawn, no reference, or another kind of picture: nothing is known of it
};

// An intermediate target of a frame, in order of drawing.
struct Target {
    std::string name;
    bool differs = false;
};

// What came of one case; of a case that is the same only what stands before `frame`.
struct CaseResult {
    std::string suite = {}; // its name; empty for two pictures
    std::string name = {};
    Outcome outcome = Outcome::incomparable;
    std::string why = {}; // a sentence, where it is incomparable
    Rule rule = {};
    double seconds = 0;                   // waited for its frame, and comparing
    std::filesystem::path json_file = {}; // the case's; empty for two pictures

    std::filesystem::path frame = {};
    std::filesystem::path reference = {};
    std::string reference_renderer = {};
    std::string hash = {}; // of the frame
    std::string settings = {};
    std::string render_line = {}; // the command that draws it
    std::string bless_line = {};  // the command that accepts it
    std::optional<Measurement> measurement = {};
    std::vector<Target> targets = {}; // where both sides' are known

    // The first target that differs; "" where none does or that is not known.
    std::string firstDifferent() const;
    std::string fullName() const { return suite.empty() ? name : suite + "/" + name; }
};

struct CheckOptions {
    std::vector<std::string> patterns = {}; // as for a shell's files, of NAME or SUITE/NAME; none: every case
    bool keeps_maps = false;                // of FLIP, for a report
    bool looks_at_targets = true;           // of cases that differ
};

// The cases of a suite, checked. Files in it are there as long as it is.
struct SuiteResult {
    std::string name = {};
    std::string renderer = {}; // where a case is not the same
    std::vector<CaseResult> cases = {};
    std::vector<std::string> problems = {}; // of the suite itself: problemsOf(), where no pattern chooses
    std::shared_ptr<const Rendering> frames = {};
};

// Whether a case is chosen; every one is where there is no pattern.
bool isChosen(const Suite& suite, const Case& one, const std::vector<std::string>& patterns);

SuiteResult check(const Suite& suite, const CheckOptions& options);

// Never throws for a picture that cannot be read: that is incomparable.
CaseResult check(const std::filesystem::path& frame, const std::filesystem::path& reference, const Rule& rule,
                 bool keeps_map);

// The hashes of the pictures in a folder, in order of their names, by name without what orders them:
// "03_lit.exr" is "lit".
nlohmann::ordered_json targetHashes(const std::filesystem::path& folder);

} // namespace gll::frame_check
