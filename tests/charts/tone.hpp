// The chart of tone maps.
#pragma once

#include <filesystem>
#include <string>

namespace gll::charts {

// What a tone map does to a sweep: 40 colours and a grey, each from six stops down to eight up.
struct ToneFigures {
    double hue_mean_deg = 0; // how far hues turn, in ICtCp
    double hue_largest_deg = 0;
    double largest_fall = 0;   // of the output where a grey grows; display light
    double largest_output = 0; // of any channel
};
ToneFigures toneFigures(const std::string& tone_map);

// Measures what each tone map takes more than clamping does, in instructions per pixel of the display pass of
// 01_hdr and in copies, and writes it as a table: a minute or two, under callgrind. The fetch, exposure and
// encoding are in both and so fall out.
void measureToneCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// Measures the curves themselves (in double, as the truth tests hold the shaders to them), takes costs from
// the table, and writes tone.csv, tone_hue.svg and tone_aces.svg into the folder. Renders nothing.
void drawToneCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                    const std::filesystem::path& folder);

} // namespace gll::charts
