// Starting programs by fork and exec, their output kept in files that no folder has.
#include "process/process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gll {
namespace {

// In memory, so that nothing is left of it however this process ends.
int namelessFile() {
    const int file = memfd_create("output", MFD_CLOEXEC);
    if (file < 0)
        throw std::runtime_error(std::string("a file for a program's output: ") + std::strerror(errno));
    return file;
}

std::string contents(int file) {
    std::string text;
    char buffer[4096];
    off_t at = 0;
    for (ssize_t n = 0; (n = pread(file, buffer, sizeof buffer, at)) > 0; at += n)
        text.append(buffer, static_cast<std::size_t>(n));
    return text;
}

// In the child, between fork and exec: only what is safe there.
void become(const Command& command, int out, int err, char* const* arguments, char* const* environment) {
    prctl(PR_SET_PDEATHSIG, SIGKILL); // also where this process is itself killed
    if (!command.folder.empty() && chdir(command.folder.c_str()) != 0) _exit(126);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (command.file_limit_kib) {
        const rlim_t bytes = rlim_t(*command.file_limit_kib) << 10;
        const rlimit both{bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &both);
        std::signal(SIGXFSZ, SIG_IGN); // so that writing fails, as it does on a full disk
    }
    execve(command.program.c_str(), arguments, environment);
    _exit(127);
}

} // namespace

// Within single quotes nothing has a meaning but the quote itself.
std::string shellWord(const std::string& word) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,+-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string shellLine(const Command& command) {
    std::string line = shellWord(command.program.string());
    for (const std::string& argument : command.arguments)
        line += " " + shellWord(argument);
    return line;
}

Process::Process(const Command& command) {
    if (access(command.program.c_str(), X_OK) != 0)
        throw std::runtime_error(command.program.string() + ": is no program to run");
    std::vector<std::string> words{command.program.string()};
    words.insert(words.end(), command.arguments.begin(), command.arguments.end());
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        if (!command.environment.contains(text.substr(0, text.find('=')))) variables.push_back(text);
    }
    for (const auto& [name, value] : command.environment)
        if (value) variables.push_back(name + "=" + *value);
    const auto pointers = [](std::vector<std::string>& strings) {
        std::vector<char*> result;
        for (std::string& string : strings)
            result.push_back(string.data());
        result.push_back(nullptr);
        return result;
    };
    const std::vector<char*> arguments = pointers(words);
    const std::vector<char*> environment = pointers(variables);
    out_ = namelessFile();
    err_ = namelessFile();
    id_ = fork();
    if (id_ < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
    if (id_ == 0) become(command, out_, err_, arguments.data(), environment.data());
}

Process::~Process() {
    if (id_ > 0) {
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
    close(out_);
    close(err_);
}

void Process::signal(int number) const {
    if (id_ > 0) kill(id_, number);
}

std::string Process::lastErrorLine() const {
    const std::string text = contents(err_);
    const auto end = text.rfind('\n');
    if (end == std::string::npos) return {};
    const auto begin = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
    return begin == std::string::npos ? text.substr(0, end) : text.substr(begin + 1, end - begin - 1);
}

ProcessResult Process::ended(int status, const rusage& usage) {
    id_ = -1;
    ProcessResult result;
    result.signalled = WIFSIGNALED(status);
    result.exit_code = result.signalled ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    result.peak_memory_kib = usage.ru_maxrss;
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
        result.cpu_seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    result.out = contents(out_);
    result.err = contents(err_);
    return result;
}

std::optional<ProcessResult> Process::poll() {
    int status = 0;
    rusage usage{};
    if (wait4(id_, &status, WNOHANG, &usage) == 0) return std::nullopt;
    return ended(status, usage);
}

ProcessResult Process::wait(std::chrono::milliseconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    bool timed_out = false;
    for (;;) {
        if (std::optional<ProcessResult> result = poll()) {
            result->timed_out = timed_out;
            return *result;
        }
        if (!timed_out && std::chrono::steady_clock::now() > end) {
            kill(id_, SIGKILL);
            timed_out = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

} // namespace gll
