// The chart of tone maps.
#pragma once

#include <filesystem>

namespace gll::charts {

// Measures what each tone map takes more than clamping does, in instructions per pixel of the display pass of
// 01_hdr and in copies, and writes it as a table: a minute or two, under callgrind. The fetch, exposure and
// encoding are in both and so fall out.
void measureToneCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// Measures the curves themselves (in double, as the truth tests hold the shaders to them), takes costs from
// the table, and writes tone.csv, tone_hue.svg and tone_aces.svg into the folder. Renders nothing.
void drawToneCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                    const std::filesystem::path& folder);

} // namespace gll::charts
