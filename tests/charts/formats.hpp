// The chart of floating-point formats, and of two that are not.
#pragma once

#include <filesystem>

namespace gll::charts::formats {

// Measures what a frame of 01_hdr costs with each format of its target, and writes it as a table: a minute,
// under callgrind.
void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// Renders frames with each format, compares them with the 32-bit one's, and writes formats.csv, formats.svg
// and formats_flip.svg into the folder.
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::formats
