// The chart of exposure reductions: a frame's luminances to one.
#pragma once

#include <filesystem>

namespace gll::charts::exposure {

// Measures what each reduction of 02_auto_exposure costs at 1280x720, its passes alone, and writes it as a
// table: minutes, under callgrind.
void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// Measures each reduction's error at a thousand frame sizes, and writes exposure.csv, exposure_worst.svg and
// exposure_mean.svg into the folder. Small frames are rendered and read; of large ones, which would take too
// long, a model of the reduction does the sums. Throws std::runtime_error where the model and the rung differ
// on a small frame, or where the recommended reduction misses what is promised of it.
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::exposure
