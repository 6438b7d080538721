// Whether the frames of suites show what goes wrong in a shader: small faults are put into a copy of the
// shaders, one after the other, and each should make a case fail.
#pragma once

#include "frame_check/mutants.hpp"
#include "frame_check/render.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gll::frame_check {

// A fault that no frame can show.
struct Excuse {
    std::string file;         // the whole file where no line is named
    std::string line = {};    // as it is, spaces made one
    std::string becomes = {}; // what the fault makes of it

    bool covers(const Mutant& mutant) const {
        return file == mutant.file && (line.empty() || (line == mutant.before && becomes == mutant.after));
    }
};
// From JSON: [{"file", "line", "becomes", "why"}, ...]. Throws std::runtime_error where it cannot be read and
// where an excuse has no reason.
std::vector<Excuse> readExcuses(const std::filesystem::path& json_file);

enum class Verdict {
    killed,   // a case fails
    survived, // none does
    excused,  // none does, and none can
    invalid,  // there is no frame: it does not compile
};

struct MutationOutcome {
    Mutant mutant;
    Verdict verdict = Verdict::survived;
    std::string by = {}; // the case that shows it, or how much the frames differ
    double seconds = 0;
};

struct MutationOptions {
    std::filesystem::path shaders = {}; // the folder; of what lies in it, files that end as GLSL does
    std::string only = {};              // shaders whose name holds this
    std::size_t sample = 0;             // so many faults in all, of those that are not excused; 0: by share
    double share = 0.05;                // of each file's faults, but at least three
    std::uint64_t seed = 1;             // which ones
    unsigned jobs = 1;                  // suites at once
    std::vector<Excuse> excuses = {};
    // A program that ends without a frame and says this on stderr has seen the fault itself.
    std::string noticed = {};
    // The suite as it is drawn with the shaders in folder/shaders, a copy. Called before each drawing,
    // and once for each copy before any.
    std::function<Suite(const Suite&, const std::filesystem::path& folder)> within = {};
    // Whether a frame of the suite can be drawn with a shader. Where it is not given, that is tried,
    // by a file that is no shader.
    std::function<bool(const Suite&, const std::string& shader)> draws_with = {};
    std::function<void(const MutationOutcome&)> on_outcome =
        {}; // for people who wait; from one thread at a time
};

// The faults to try, by file and line, always the same ones for the same shaders, options and seed: which are
// chosen depends on each fault alone, so that a change of one line leaves the others be.
struct MutantChoice {
    std::vector<Mutant> mutants = {};
    std::size_t possible = 0;            // in all files
    std::vector<std::string> stale = {}; // excuses for what is not there
};
MutantChoice chooseMutants(const MutationOptions& options);

// The folder of shaders, copied into a temporary folder as shaders/, to put faults into.
class ShaderCopy {
  public:
    explicit ShaderCopy(const std::filesystem::path& shaders);
    const std::filesystem::path& path() const { return folder_.path(); }
    void write(const std::string& shader, const std::string& text) const;
    void restore(const std::string& shader) const; // as it is in the folder that was copied

  private:
    std::filesystem::path shaders_;
    TemporaryFolder folder_;
};

struct MutationResult {
    std::vector<MutationOutcome> outcomes = {};
    std::size_t possible = 0;
    std::vector<std::string> stale = {};  // excuses for what is not there, or is shown after all
    std::vector<std::string> unused = {}; // shaders, of those that were tried, that no case is drawn with
    std::vector<std::string> silent = {}; // shaders that make nothing fail where they do not compile

    std::size_t count(Verdict verdict) const;
};

// Whether something that the suite runs is told of {shaders}: else no copy of them is ever drawn with.
bool isToldOfShaders(const Suite& suite);

// Tries the faults. A frame is held to its case's rule, against the case's picture, or, where another
// renderer drew that, against what this one draws without a fault. Throws std::runtime_error where that
// cannot be drawn.
MutationResult mutate(const std::vector<Suite>& suites, const MutationOptions& options);

} // namespace gll::frame_check
