// Layouts of the G-buffer: bytes and cost of a pixel against how far off the lit picture is.
#pragma once

#include <filesystem>

namespace gll::charts::gbuffer {

// Writes what a frame of each layout costs, counted by callgrind, into the table.
void measureCosts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv);

// Writes gbuffer.csv, gbuffer_normals.csv and their charts into the folder.
void drawCharts(const std::filesystem::path& programs, const std::filesystem::path& costs_csv,
                const std::filesystem::path& folder);

} // namespace gll::charts::gbuffer
