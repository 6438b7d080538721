// A rung's charts of what methods cost against how far off they are: the points of the pictures on its page,
// and the settings that each of them is.
#pragma once

#include "rung/settings.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gll {

struct ChartPoint {
    std::string method;
    std::string dial; // empty where the method has none
    std::string mark; // "recommended", "the original of 04"; or empty
    double x = 0;
    double y = 0;
    bool is_on_front = false;
    bool competes = true;  // false: the answer to another question than the others
    std::string rung = {}; // whose method it is; empty: no rung draws it
    // KEY and VALUE of what makes it so; what other points of its rung name is at its default.
    std::vector<std::pair<std::string, std::string>> settings = {};
    // The same as numbers, by their places among the settings of the rung that is shown; empty for others'.
    std::map<std::size_t, double> values = {};
};

struct ChartAxis {
    std::string label; // with the unit
    bool is_log = false;
    double floor = 0; // the bottom of a logarithmic axis, above 0; errors below it are drawn there
};

struct Chart {
    std::string title;
    std::string subtitle; // at which frame size and settings it was measured
    ChartAxis x, y;
    std::vector<ChartPoint> points;
};

// Whether x is a cost in copies, which can be counted here.
bool countsCopies(const Chart& chart);

// The settings of the points that the rung can draw, over its defaults, as KEY=VALUE; in their order.
std::vector<std::vector<std::string>> drawablePoints(const Chart& chart);

// Where frames counted on this machine lie along x. Charts count what methods differ in, and a frame has
// more: by how much more, most points agree.
struct CostsHere {
    std::vector<double> points; // of drawablePoints()
    double present = 0;
    double shared = 0; // what was taken off, cu
};

// From the copies that frames with the settings of drawablePoints(), and with the present ones, took. Throws
// std::logic_error where their numbers differ.
CostsHere costsHere(const Chart& chart, const std::vector<double>& points_cu, double present_cu);

// A chart as the charts program writes it. Throws std::runtime_error "FILE: what" for anything else.
Chart readChart(const std::filesystem::path& file);

// The charts in tutorials (the folder) that have points of the rung: those of its own folder first. Settings
// are those of the rung, and come back as they were. Throws as readChart(), and where a point has a setting
// that the rung does not.
std::vector<Chart> chartsOf(const std::filesystem::path& tutorials, const std::string& rung,
                            Settings& settings);

// Whether the settings are those of the point, as far as the chart's points differ in them.
bool isPresent(const ChartPoint& point, const Settings& settings);

} // namespace gll
