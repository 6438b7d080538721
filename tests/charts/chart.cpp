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

} // namespace

std::vector<bool> paretoFront(const std::vector<Point>& points) {
    std::vector<bool> front;
    for (const Point& point : points)
        front.push_back(std::none_of(points.begin(), points.end(), [&](const Point& other) {
            return other.cost <= point.cost && other.error <= point.error &&
                   (other.cost < point.cost || other.error < point.error);
        }));
    return front;
}

void drawChart(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points) {
    const std::vector<bool> front = paretoFront(points);
    const auto y = [&](double error) { return axes.log_y ? std::max(error, axes.floor) : error; };
    std::vector<std::string> methods;
    for (const Point& point : points)
        if (std::find(methods.begin(), methods.end(), point.method) == methods.end())
            methods.push_back(point.method);

    std::ostringstream data;
    std::ostringstream plot;
    std::ostringstream labels;
    // The front as a step line, from the cheapest on.
    std::vector<const Point*> steps;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (front[i]) steps.push_back(&points[i]);
    std::sort(steps.begin(), steps.end(), [](const Point* a, const Point* b) { return a->cost < b->cost; });
    data << "$front << EOD\n";
    for (const Point* point : steps)
        data << exact(point->cost) << " " << exact(y(point->error)) << "\n";
    data << "EOD\n";
    plot << "plot $front with fsteps lw 2 lc rgb '#000000' title 'Pareto front'";
    constexpr int shapes[] = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12, 1, 2, 3};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::ostringstream grey;
        std::ostringstream black;
        std::ostringstream curve;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (points[i].method != methods[m]) continue;
            const std::string place = exact(points[i].cost) + " " + exact(y(points[i].error)) + "\n";
            curve << place;
            (front[i] ? black : grey) << place;
            if (!points[i].mark.empty())
                labels << "set label " << inQuotes(points[i].mark) << " at " << exact(points[i].cost) << ","
                       << exact(y(points[i].error)) << " offset 0.8,0.7 font ',12' front\n";
        }
        const std::string number = std::to_string(m);
        const std::string shape = std::to_string(shapes[m % std::size(shapes)]);
        data << "$curve" << number << " << EOD\n" << curve.str() << "EOD\n";
        plot << ", \\\n $curve" << number << " with lines lw 1 dt 3 lc rgb '#999999' notitle";
        bool titled = false;
        for (const auto& [points_text, color, name] :
             {std::tuple(black.str(), "#000000", "$black"), std::tuple(grey.str(), "#8a8a8a", "$grey")}) {
            if (points_text.empty()) continue;
            data << name << number << " << EOD\n" << points_text << "EOD\n";
            plot << ", \\\n " << name << number << " with points pt " << shape << " ps 0.9 lw 1.5 lc rgb '"
                 << color << "' " << (titled ? std::string("notitle") : "title " + inQuotes(methods[m]));
            titled = true;
        }
    }

    const test::TemporaryFolder folder;
    std::ostringstream script;
    script << "set terminal svg size 900,520 dynamic enhanced background rgb 'white' font 'sans-serif,14' "
              "name 'chart'\n"
           << "set output 'chart.svg'\n"
           << data.str() << labels.str() << "set title " << inQuotes(axes.title) << " noenhanced\n"
           << "set xlabel " << inQuotes(axes.x) << "\nset ylabel " << inQuotes(axes.y) << "\n"
           << "set key outside right top Left reverse spacing 1.2 font ',11' noenhanced\nset grid lc rgb "
              "'#dddddd'\n"
           << "set border 3\nset tics nomirror\nset xrange [0:*]\n"
           << (axes.log_y ? "set logscale y\nset format y '%g'\n" : "set yrange [0:*]\n") << plot.str()
           << "\n";
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
