// What the hostile tests share: running the rung in a folder of its own, and what every refusal must look
// like.
#pragma once

#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

namespace gll::test {

// The rung under test, from the command line.
const std::filesystem::path& rungProgram();

// Runs it in the folder without a display, so that nothing waits in a window.
Command rungCommand(const TemporaryFolder& folder, std::vector<std::string> arguments);

// The exit code, exactly one line "NN_name: error: ..." on stderr, all of the parts in it, and no crash.
void expectRefusal(const Result& result, int exit_code, const std::vector<std::string>& parts);

// A row of a table of command lines to refuse; "{}" in arguments stands for the folder they run in.
struct Refusal {
    const char* name; // letters and digits
    std::vector<std::string> arguments;
    int exit_code = 2;
    std::vector<std::string> parts = {}; // of the message
};
void PrintTo(const Refusal& refusal, std::ostream* stream);

// Runs the row in an empty folder: refused, and nothing left there.
void checkRefusal(const Refusal& refusal);

// Names the tests of a table after its rows.
struct RefusalName {
    std::string operator()(const ::testing::TestParamInfo<Refusal>& info) const { return info.param.name; }
};

} // namespace gll::test
