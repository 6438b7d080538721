// Running a program and waiting for it: what it printed, how it ended.
// Tests use rungs as people do, through their command line.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace gll::test {

struct Result {
    int exit_code = -1; // 128 + the signal's number where a signal ended it
    bool signalled = false;
    bool timed_out = false;     // and was killed for it
    long peak_resident_kib = 0; // the most memory it had at once
    std::string out;
    std::string err;
};

struct Command {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::map<std::string, std::optional<std::string>> environment = {}; // changes to it; nullopt unsets
    std::filesystem::path folder = {};                                  // to run in; empty: this one
    std::optional<unsigned> file_limit_kib = {}; // writing beyond fails, as on a full disk
};

// A program under way. Killed where it is still running when this ends.
class Process {
  public:
    // Throws std::runtime_error where the program cannot be started.
    explicit Process(const Command& command);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const;
    Result wait(std::chrono::milliseconds limit);

  private:
    pid_t id_ = -1;
    int out_ = -1; // unlinked files: nobody has to drain them, and nothing is left behind
    int err_ = -1;
};

Result run(const Command& command, std::chrono::milliseconds limit = std::chrono::seconds(60));

// Throws std::runtime_error saying how it ended, and its last line on stderr, unless that was with 0.
Result runToSuccess(const Command& command, std::chrono::milliseconds limit = std::chrono::seconds(110));

} // namespace gll::test
