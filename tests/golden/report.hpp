// One HTML page of frames that are not as blessed: new, reference and amplified difference, from local files
// alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gll::test {

struct ReportEntry {
    std::string name;
    std::string verdict = {};   // "failed: ...", "tolerated: ..."
    std::string request;        // the settings, as JSON
    std::string image;          // file names beside the page
    std::string reference = {}; // empty: there is none
    std::string difference = {};
};

void writeReport(const std::filesystem::path& page, const std::string& title,
                 const std::vector<ReportEntry>& entries);

} // namespace gll::test
