// The charts of 07_shadow_map: biases over slopes, filters by cost.
#pragma once

#include <filesystem>

namespace gll::charts::shadow {

void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::shadow
