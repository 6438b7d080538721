// The charts of 08_ssao: what methods of ambient occlusion cost, against how far they are from rays.
#pragma once

#include <filesystem>

namespace gll::charts::ssao {

// Also seeks, for each method, the strength, exponent, radius, bias and number of slices with which it comes
// closest to rays, so that none is judged by constants that suit another.
void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::ssao
