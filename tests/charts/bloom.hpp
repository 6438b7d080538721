// The chart of bloom filters.
#pragma once

#include "charts/chart.hpp"

#include <filesystem>

namespace gll::charts::bloom {

// Measures what each filter costs, with every method's dial, and writes it as a table:
// minutes, under callgrind. Costs are of the bloom alone: its passes, and the fetch that adds it to the
// picture.
void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& csv);

// Measures errors, takes costs from the table, and writes bloom.csv, bloom_shift.svg, bloom_energy.svg and
// bloom_flip.svg into the folder. Throws std::runtime_error where a recommended setting misses what is
// promised of it.
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::bloom
