// Running a program beside this one: what it printed, how it ended.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <vector>

namespace gll {

struct ProcessResult {
    int exit_code = -1; // 128 + the signal's number where a signal ended it
    bool signalled = false;
    bool timed_out = false;   // and was killed for it
    long peak_memory_kib = 0; // the most it had in memory at once
    double cpu_seconds = 0;   // its own, and those of programs that it waited for
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

// One word for a POSIX shell, quoted where that is needed.
std::string shellWord(const std::string& word);
// Its program and arguments as a line for a POSIX shell, quoted where that needs it.
std::string shellLine(const Command& command);

// A program under way. Killed where it is still running when this ends.
class Process {
  public:
    // Throws std::runtime_error where the program cannot be started.
    explicit Process(const Command& command);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const;
    // The last whole line that it has written to its standard error so far; empty where there is none.
    std::string lastErrorLine() const;
    // How it ended, once it has; until then nothing, at once.
    std::optional<ProcessResult> poll();
    // Waits for its end, and kills it where that takes longer.
    ProcessResult wait(std::chrono::milliseconds limit);

  private:
    ProcessResult ended(int status, const rusage& usage);

    pid_t id_ = -1;
    int out_ = -1; // files in memory: nobody has to drain them, and nothing is left behind
    int err_ = -1;
};

} // namespace gll
