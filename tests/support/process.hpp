// Running a program to its end. Tests use rungs as people do, through their command line.
#pragma once

#include "process/process.hpp"

namespace gll::test {

using gll::Command;
using gll::Process;
using Result = gll::ProcessResult;

// One of the programs built here: a rung, frame_check, frame_error.
std::filesystem::path program(const std::string& name);

Result run(const Command& command, std::chrono::milliseconds limit = std::chrono::seconds(60));

// Throws std::runtime_error saying how it ended, and its last line on stderr, unless that was with 0.
Result runToSuccess(const Command& command, std::chrono::milliseconds limit = std::chrono::seconds(110));

} // namespace gll::test
