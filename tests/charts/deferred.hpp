// The chart of 10_deferred: what each part of a whole frame costs, and what the frame is off by without it.
#pragma once

#include <filesystem>

namespace gll::charts::deferred {

void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::deferred
