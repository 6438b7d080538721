// The report: one HTML file that needs no network, with all frames that are not the same and their
// references.
#pragma once

#include "frame_check/check.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gll::frame_check {

// Frames of what is not the same have to be there still, and their FLIP maps are drawn where they were kept.
// One `for_review` can accept frames, where review() serves it. Throws std::runtime_error where the file
// cannot be written.
void writeReport(const std::filesystem::path& file, const std::string& title,
                 const std::vector<SuiteResult>& suites, bool for_review = false);

} // namespace gll::frame_check
