// Tables as CSV, charts as SVG by gnuplot.
#include "charts/chart.hpp"

#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace gll::charts {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string inQuotes(const std::string& text) { return "\"" + text + "\""; } // texts are the program's own

std::string exact(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

// The picture, in pixels from its top left.
constexpr double width = 900;
constexpr double height = 520;
constexpr double plot_left = 112;
constexpr double plot_right = 665;
constexpr double plot_top = 55;
constexpr double plot_bottom = 450;

struct Box {
    double left, top, right, bottom;

    bool overlaps(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

// The chart's ranges, and where a point lands in the picture.
struct Scale {
    double x_begin = 0;
    double x_end = 1;
    double y_begin = 0;
    double y_end = 1;
    bool log_x = false;
    bool log_y = false;

    double x(double cost) const {
        return plot_left + (plot_right - plot_left) * part(cost, x_begin, x_end, log_x);
    }
    double y(double error) const {
        return plot_bottom - (plot_bottom - plot_top) * part(error, y_begin, y_end, log_y);
    }

  private:
    static double part(double value, double begin, double end, bool logarithmic) {
        return logarithmic ? std::log(value / begin) / std::log(end / begin)
                           : (value - begin) / (end - begin);
    }
};

Scale scaleFor(const Axes& axes, const std::vector<Point>& points) {
    double cost = 0;
    double cheapest = points.front().cost;
    double error = axes.floor;
    for (const Point& point : points) {
        cost = std::max(cost, point.cost);
        cheapest = std::min(cheapest, point.cost);
        error = std::max(error, point.error);
    }
    Scale scale;
    scale.log_x = axes.log_x;
    scale.log_y = axes.log_y;
    scale.x_end = cost > 0 ? cost * 1.08 : 1;
    if (axes.log_x) {
        scale.x_begin = cheapest / 3; // room for names
        scale.x_end = cost * 1.5;
    }
    if (axes.log_y) {
        scale.y_begin = axes.floor;
        scale.y_end = std::pow(10, std::floor(std::log10(error)) + 1);
    } else if (error > 0)
        scale.y_end = error * 1.12;
    return scale;
}

// Puts texts beside their points where they cover nothing that is there already.
class Labels {
  public:
    void keepFree(const Box& box) { taken_.push_back(box); }

    // A text that must be there falls back to the upper right; another is left out.
    void put(const std::string& text, double x, double y, int font_px, bool must, const char* color) {
        const double text_width = 0.66 * font_px * double(text.size());
        const double half_height = 0.55 * font_px;
        constexpr double gap = 8;
        struct Place {
            double dx, dy;
            bool to_the_left;
        };
        constexpr Place places[] = {{gap, 0, false},   {-gap, 0, true},   {gap, -11, false},
                                    {gap, 11, false},  {-gap, -11, true}, {-gap, 11, true},
                                    {gap, -22, false}, {gap, 22, false},  {-gap, -22, true},
                                    {-gap, 22, true},  {gap, -36, false}, {-gap, -36, true}};
        constexpr std::size_t near_places = 6; // farther off, a small text would seem to be another point's
        const Place* chosen = must ? &places[2] : nullptr;
        for (std::size_t i = 0; i < (must ? std::size(places) : near_places); ++i) {
            const Place& place = places[i];
            const Box box = boxAt(x + place.dx, y + place.dy, text_width, half_height, place.to_the_left);
            if (box.left < plot_left + 2 || box.right > plot_right + 5 || box.top < plot_top - 12 ||
                box.bottom > plot_bottom - 2)
                continue;
            if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.overlaps(box); }))
                continue;
            chosen = &place;
            break;
        }
        if (chosen == nullptr) return;
        keepFree(boxAt(x + chosen->dx, y + chosen->dy, text_width, half_height, chosen->to_the_left));
        script_ << "set label " << inQuotes(text) << " at screen " << exact((x + chosen->dx) / width) << ","
                << exact(1 - (y + chosen->dy) / height) << (chosen->to_the_left ? " right" : " left")
                << " font '," << font_px << "' tc rgb '" << color << "' noenhanced front\n";
    }

    std::string script() const { return script_.str(); }

  private:
    static Box boxAt(double x, double y, double text_width, double half_height, bool to_the_left) {
        const double left = to_the_left ? x - text_width : x;
        return {left, y - half_height, left + text_width, y + half_height};
    }

    std::vector<Box> taken_;
    std::ostringstream script_;
};

} // namespace

std::vector<bool> paretoFront(const std::vector<Point>& points) {
    std::vector<bool> front;
    for (const Point& point : points)
        front.push_back(point.competes && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                            return other.competes && other.cost <= point.cost && other.error <= point.error &&
                                   (other.cost < point.cost || other.error < point.error);
                        }));
    return front;
}

std::vector<bool> worstFront(const std::vector<Point>& points) {
    std::vector<Point> worst;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto same = std::find_if(worst.begin(), worst.end(),
                                       [&](const Point& w) { return w.method == points[i].method; });
        const auto place = static_cast<std::size_t>(same - worst.begin());
        if (same == worst.end()) {
            worst.push_back(points[i]);
            places.push_back(i);
        } else if (points[i].error > same->error) {
            worst[place] = points[i];
            places[place] = i;
        }
    }
    const std::vector<bool> best = paretoFront(worst);
    std::vector<bool> front(points.size());
    for (std::size_t i = 0; i < worst.size(); ++i)
        front[places[i]] = best[i];
    return front;
}

void drawChart(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points) {
    if (points.empty() || (axes.log_y && !(axes.floor > 0)))
        throw std::invalid_argument(file.string() + ": a chart needs points, a logarithmic one a bottom");
    if (axes.log_x && std::any_of(points.begin(), points.end(), [](const Point& p) { return !(p.cost > 0); }))
        throw std::invalid_argument(file.string() +
                                    ": what costs nothing has no place on a logarithmic axis");
    const std::vector<bool> front = axes.dial_is_given ? worstFront(points) : paretoFront(points);
    const Scale scale = scaleFor(axes, points);
    const auto y = [&](double error) { return axes.log_y ? std::max(error, axes.floor) : error; };
    std::vector<std::string> methods;
    for (const Point& point : points)
        if (std::find(methods.begin(), methods.end(), point.method) == methods.end())
            methods.push_back(point.method);
    // Black where a method is on the front: of a dial that is given, with all of its points.
    std::vector<bool> black = front;
    if (axes.dial_is_given)
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < points.size(); ++j)
                if (front[j] && points[i].method == points[j].method) black[i] = true;

    std::ostringstream data;
    std::ostringstream plot;
    Labels labels;
    for (const Point& point : points) {
        const double px = scale.x(point.cost);
        const double py = scale.y(y(point.error));
        labels.keepFree({px - 6, py - 6, px + 6, py + 6});
    }

    // The front as a step line: what a cost buys, from the cheapest on.
    std::vector<const Point*> steps;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (front[i]) steps.push_back(&points[i]);
    std::sort(steps.begin(), steps.end(), [](const Point* a, const Point* b) { return a->cost < b->cost; });
    data << "$front << EOD\n";
    for (std::size_t i = 0; i < steps.size(); ++i) {
        data << exact(steps[i]->cost) << " " << exact(y(steps[i]->error)) << "\n";
        if (i + 1 == steps.size()) break;
        const double left = scale.x(steps[i]->cost);
        const double right = scale.x(steps[i + 1]->cost);
        const double above = scale.y(y(steps[i]->error));
        const double below = scale.y(y(steps[i + 1]->error));
        labels.keepFree({left, above - 2, right, above + 2});
        labels.keepFree({right - 2, above, right + 2, below});
    }
    data << "EOD\n";
    plot << "plot $front with steps lw 2 lc rgb '#000000' title 'Pareto front (grey: not on it)'";

    // Full and open by turns, so that two that coincide are both seen; where open ones say something else,
    // full ones only, then the same in blue.
    constexpr int shapes[] = {7, 4, 9, 10, 13, 6, 5, 8, 11, 12, 1, 2, 3};
    constexpr int full_shapes[] = {7, 5, 9, 11, 13, 15}; // each one's open shape is the one before
    const bool pairs = !axes.hollow.empty();
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const bool blue = pairs && m >= std::size(full_shapes);
        const int shape = pairs ? full_shapes[m % std::size(full_shapes)] : shapes[m % std::size(shapes)];
        struct Group {
            const char* name;
            const char* color;
            const char* size;
            std::string points = {};
        };
        Group groups[] = {{"$black", blue ? "#0072b2" : "#000000", "0.9"},
                          {"$grey", blue ? "#7db8da" : "#8a8a8a", "0.9"},
                          {"$other", blue ? "#7db8da" : "#8a8a8a", "0.5"},
                          {"$open_black", blue ? "#0072b2" : "#000000", "0.9"},
                          {"$open_grey", blue ? "#7db8da" : "#8a8a8a", "0.9"},
                          {"$open_other", blue ? "#7db8da" : "#8a8a8a", "0.5"}};
        std::ostringstream curve;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (points[i].method != methods[m]) continue;
            const std::string place = exact(points[i].cost) + " " + exact(y(points[i].error)) + "\n";
            curve << place;
            const std::size_t group = !points[i].competes ? 2 : black[i] ? 0 : 1;
            groups[group + (points[i].hollow ? 3 : 0)].points += place;
        }
        const std::string number = std::to_string(m);
        data << "$curve" << number << " << EOD\n" << curve.str() << "EOD\n";
        plot << ", \\\n $curve" << number << " with lines lw 1 dt 3 lc rgb '#999999' notitle";
        bool titled = false;
        for (const Group& group : groups) {
            if (group.points.empty()) continue;
            const bool open = std::string(group.name).starts_with("$open");
            data << group.name << number << " << EOD\n" << group.points << "EOD\n";
            plot << ", \\\n " << group.name << number << " with points pt " << (open ? shape - 1 : shape)
                 << " ps " << group.size << " lw 1.5 lc rgb '" << group.color << "' "
                 << (titled ? std::string("notitle") : "title " + inQuotes(methods[m]));
            titled = true;
        }
    }

    const auto put = [&](const Point& point, const std::string& text, int font_px, bool must,
                         const char* color) {
        if (!text.empty())
            labels.put(text, scale.x(point.cost), scale.y(y(point.error)), font_px, must, color);
    };
    for (const Point& point : points)
        put(point, point.mark, 12, true, "#000000");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool first = i == 0 || points[i - 1].method != points[i].method;
        const bool last = i + 1 == points.size() || points[i + 1].method != points[i].method;
        const bool at_the_bottom = axes.log_y && points[i].error < axes.floor;
        if ((axes.dial_is_given && !at_the_bottom) || (!axes.dial_is_given && first != last))
            put(points[i], points[i].dial, 10, false, "#606060");
    }

    const test::TemporaryFolder folder;
    std::ostringstream script;
    script << "set encoding utf8\nset terminal svg size " << width << "," << height
           << " dynamic enhanced background rgb 'white' font 'sans-serif,14' name 'chart'\n"
           << "set output 'chart.svg'\n"
           << "set lmargin at screen " << exact(plot_left / width) << "\nset rmargin at screen "
           << exact(plot_right / width) << "\nset tmargin at screen " << exact(1 - plot_top / height)
           << "\nset bmargin at screen " << exact(1 - plot_bottom / height) << "\n"
           << data.str() << labels.script() << "set title " << inQuotes(axes.title) << " noenhanced\n"
           << "set xlabel " << inQuotes(axes.x) << " noenhanced\nset ylabel " << inQuotes(axes.y)
           << " noenhanced\n"
           << "set key at screen " << exact((plot_right + 15) / width) << "," << exact(1 - plot_top / height)
           << " left top Left reverse spacing 1.2 samplen 2 font ',11' noenhanced\n"
           << "set grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\nset xrange ["
           << exact(scale.x_begin) << ":" << exact(scale.x_end) << "]\nset yrange [" << exact(scale.y_begin)
           << ":" << exact(scale.y_end) << "]\n";
    if (axes.log_y) {
        script << "set logscale y\nset format y '%g'\n";
        if (std::any_of(points.begin(), points.end(), [&](const Point& p) { return p.error < axes.floor; }))
            script << "set ytics add ('≤ " << exact(axes.floor) << "' " << exact(axes.floor) << ")\n";
    }
    if (axes.log_x) script << "set logscale x\nset format x '%g'\n";
    if (pairs)
        plot << ", \\\n NaN with points pt 6 ps 0.9 lw 1.5 lc rgb '#8a8a8a' title " << inQuotes(axes.hollow);
    if (!axes.others.empty())
        plot << ", \\\n NaN with points pt 7 ps 0.5 lc rgb '#8a8a8a' title " << inQuotes(axes.others);
    script << plot.str() << "\n";
    folder.write("chart.gp", script.str());
    test::runToSuccess(
        {.program = "/usr/bin/env", .arguments = {"gnuplot", "chart.gp"}, .folder = folder.path()});
    std::filesystem::copy_file(folder / "chart.svg", file, std::filesystem::copy_options::overwrite_existing);
}

void writeCsv(const std::filesystem::path& file, const Table& table) {
    std::string text;
    const auto line = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            text += (i > 0 ? "," : "") +
                    (cells[i].find(',') == std::string::npos ? cells[i] : inQuotes(cells[i]));
        text += "\n";
    };
    line(table.columns);
    for (const auto& row : table.rows)
        line(row);
    write(file, text);
}

Table readCsv(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    Table table;
    std::string text;
    while (std::getline(stream, text)) {
        std::vector<std::string> cells(1);
        bool in_quotes = false;
        for (const char c : text) {
            if (c == '"')
                in_quotes = !in_quotes;
            else if (c == ',' && !in_quotes)
                cells.emplace_back();
            else
                cells.back() += c;
        }
        if (table.columns.empty())
            table.columns = cells;
        else if (cells.size() == table.columns.size())
            table.rows.push_back(cells);
        else
            throw std::runtime_error(file.string() + ": not as many cells as columns in \"" + text + "\"");
    }
    return table;
}

Costs::Costs(std::filesystem::path csv) : file_(std::move(csv)), table_(readCsv(file_)) {}

double Costs::of(const std::string& name, const std::string& column) const {
    const auto place = std::find(table_.columns.begin(), table_.columns.end(), column);
    for (const auto& row : table_.rows)
        if (row[0] == name && place != table_.columns.end())
            return std::stod(row[static_cast<std::size_t>(place - table_.columns.begin())]);
    throw std::runtime_error(file_.string() + ": has no " + column + " of \"" + name +
                             "\"; measure the costs anew");
}

std::string shortNumber(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.3g", value == 0 ? 0.0 : value);
    return buffer;
}

std::string decimals(double value, int count) {
    char buffer[400]; // the longest double has 309 digits before its point
    std::snprintf(buffer, sizeof buffer, "%.*f", count, value);
    const std::string text = buffer;
    return text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}

} // namespace gll::charts
