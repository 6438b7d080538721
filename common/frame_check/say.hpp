// What a check says besides its report: lines for people, JUnit's XML, and GitHub's annotations.
#pragma once

#include "frame_check/check.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gll::frame_check {

struct Counts {
    std::size_t same = 0;
    std::size_t tolerated = 0;
    std::size_t different = 0;
    std::size_t incomparable = 0; // a suite's problems too

    // 2 where anything could not be compared, else 1 where anything differs, else 0.
    int exitCode() const { return incomparable > 0 ? 2 : different > 0 ? 1 : 0; }
    // "200 frames: 173 same, 2 tolerated, 25 different, 0 not compared"
    std::string text() const;
};
Counts countsOf(const std::vector<SuiteResult>& suites);

// One line: verdict, name, what was measured; a map of the frame in letters below where it differs.
std::string line(const CaseResult& result);
std::string word(Outcome outcome); // "same", "tolerated", "DIFFERENT", "NOT COMPARED"

// ::error and ::warning commands of GitHub's runner, one a case, in the order of the results.
std::string annotations(const std::vector<SuiteResult>& suites);

// A test suite for each suite, a test case for each case; what is tolerated is said in system-out. Written
// whole; throws std::runtime_error where that fails.
void writeJunit(const std::filesystem::path& file, const std::vector<SuiteResult>& suites);

// A line for each tolerated case, or no file at all.
void writeWarnings(const std::filesystem::path& file, const std::vector<SuiteResult>& suites);

// Text as XML and HTML hold it, without the control characters that neither can.
std::string escaped(const std::string& text);

} // namespace gll::frame_check
