// A chart of cost against error: its picture as SVG, drawn by gnuplot, and its points as JSON.
#pragma once

#include "charts/table.hpp" // what a chart shows

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gll::charts {

// One setting of a method: a point. Points of one method that follow each other are joined, in the order of
// its dial.
struct Point {
    std::string method;    // "13 taps down, tent up"
    std::string dial;      // "levels 5"; empty where the method has none
    double cost = 0;       // x
    double error = 0;      // y
    std::string mark = {}; // "the original of 04", "recommended": named in the chart; else empty
    bool competes = true;  // false: of the method's curve, but the answer to another question than the others
    bool hollow = false;   // drawn as a hollow shape, which Axes::hollow explains
    // What makes a rung draw so, by name: of the settings that the chart's points name, those not at their
    // default. Nothing where no settings do.
    std::optional<std::map<std::string, std::string>> settings = {};
    std::string rung = {}; // whose settings these are; empty: Axes::rung
};

struct Axes {
    std::string title;
    std::string subtitle = {}; // at which frame size and which settings it was measured
    std::string x;             // with its unit
    std::string y;
    bool log_y = false; // errors of 0 are then drawn at the bottom, as "at most"
    double floor = 0;   // the bottom of a logarithmic axis, > 0 there
    // The dial is what the scene asks for and not for us to choose: a method is judged by its worst.
    bool dial_is_given = false;
    bool x_is_cost = true;   // false: no method is cheaper than another, and there is no front
    bool log_x = false;      // from the power of ten below the cheapest
    std::string others = {}; // what points are that do not compete
    std::string hollow = {}; // what hollow shapes are
    std::string rung = {};   // whose methods these are
};

// Whether a point competes and no other such is at once as cheap and as accurate, and better in one of the
// two.
std::vector<bool> paretoFront(const std::vector<Point>& points);

// The same for methods judged by their worst: true at the worst point of each method that no other beats.
std::vector<bool> worstFront(const std::vector<Point>& points);

// By either, as the axes have it; of what costs nothing, none.
std::vector<bool> frontOf(const Axes& axes, const std::vector<Point>& points);

// Writes FILE (.svg) and, for pages shown dark, FILE_dark.svg. A method has one shape and colour, by its
// place among the points' methods, and is named at one of its points, or in a key where there is no room;
// marks stand at their points, and so do the dial's ends where they have room. The front is joined by a step
// line, what lies behind it is paler. FILE.json has the same points for programs: errors to
// three digits. The same points give the same bytes. Throws std::runtime_error where gnuplot cannot be run,
// std::invalid_argument without points or for a logarithmic axis without a bottom or with a cost of 0.
void drawChart(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points);

} // namespace gll::charts
