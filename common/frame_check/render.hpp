// Drawing the frames of a suite: by its command, once for each case, or by its batch, all in one process.
#pragma once

#include "frame_check/suite.hpp"
#include "process/process.hpp"
#include "process/temporary_folder.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gll::frame_check {

struct Frame {
    std::filesystem::path file = {}; // the picture; empty where none was drawn
    std::filesystem::path targets =
        {};                 // the folder with its intermediate targets; empty where none were asked for
    std::string error = {}; // why there is none
};

// The frames of some cases, one after the other, each to be looked at as soon as it is there. Programs run in
// suite.json's folder, or the suite's own where there is none.
class Rendering {
  public:
    // `wants_targets` only where the suite has a way to ask for them. Throws std::runtime_error where a
    // command cannot be made: no command, a word in braces that nothing stands for, a program that is not
    // there.
    Rendering(const Suite& suite, std::vector<const Case*> cases, bool wants_targets = false);

    // The next frame, in the order of the cases. A case that cannot be drawn does not stop the others.
    Frame next();
    bool atEnd() const { return next_ >= cases_.size(); }
    // Whether the program was ended because it took longer than the suite's limit.
    bool hangs() const { return hangs_; }
    // All that the program has said on stderr, once it has ended.
    std::string messages();

  private:
    std::filesystem::path fileOf(std::size_t i) const;
    std::filesystem::path targetsOf(std::size_t i) const;
    void startBatch();
    Frame nextOfBatch(std::size_t i);
    Frame nextOfCommand(std::size_t i);
    std::string errorOf(std::size_t i) const;

    const Suite& suite_;
    std::vector<const Case*> cases_;
    bool wants_targets_;
    TemporaryFolder folder_;
    std::size_t next_ = 0;
    bool hangs_ = false;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::optional<Process> process_;
    std::optional<ProcessResult> end_;
};

bool hasTargets(const Suite& suite);

// What the suite's "renderer" says draws its frames; "" where it has none. Throws std::runtime_error where
// that fails.
std::string rendererOf(const Suite& suite);

// A line for a POSIX shell that draws a case's frame into NAME.png, for people to repeat it.
std::string commandLine(const Suite& suite, const Case& one);
// The suite's own command for blessing the case, or frame_check's.
std::string blessLine(const Suite& suite, const Case& one);

} // namespace gll::frame_check
