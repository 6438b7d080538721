// Running programs, and saying how one failed.
#include "support/process.hpp"

#include <stdexcept>

namespace gll::test {

std::filesystem::path program(const std::string& name) {
    return std::filesystem::path(GLLADDER_PROGRAMS) / name;
}

Result run(const Command& command, std::chrono::milliseconds limit) { return Process(command).wait(limit); }

Result runToSuccess(const Command& command, std::chrono::milliseconds limit) {
    Result result = run(command, limit);
    if (result.exit_code == 0) return result;
    std::string said = result.err;
    while (!said.empty() && said.back() == '\n')
        said.pop_back();
    const std::string name = command.program.filename().string();
    if (result.timed_out)
        throw std::runtime_error(name + " was ended after " + std::to_string(limit.count() / 1000) + " s");
    throw std::runtime_error(name + " ended with " + std::to_string(result.exit_code) + ": " +
                             said.substr(said.rfind('\n') + 1));
}

} // namespace gll::test
