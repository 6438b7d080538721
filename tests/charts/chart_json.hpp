// A chart's points as JSON, for the panel of a rung's window and for programs.
#pragma once

#include "charts/chart.hpp"

namespace gll::charts {

// Writes an object with title, subtitle, x and y (each label, log; y its floor) and points, one a line:
// method, dial, x, y to three digits, front, competes, mark, and where settings make it rung and settings,
// KEY=VALUE each. Throws std::runtime_error where it cannot be written.
void writeChartJson(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points);

} // namespace gll::charts
