// Charts of 09: matt and glossy surfaces under a sky, against integrals over all of it.
#pragma once

#include <filesystem>

namespace gll::charts::environment {

void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// What each method costs and how far off it is, by roughness; samples against the error of what is stored;
// tables against fits.
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::environment
