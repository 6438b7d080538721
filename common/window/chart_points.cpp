// Reading charts.
#include "window/chart_points.hpp"

#include "rung/usage_error.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace gll {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

ChartAxis axisFrom(const Json& json) {
    ChartAxis axis{json.at("label"), json.at("log"), json.value("floor", 0.0)};
    if (!std::isfinite(axis.floor) || axis.floor < 0) throw std::runtime_error("a floor is not positive");
    return axis;
}

ChartPoint pointFrom(const Json& json) {
    ChartPoint point{.method = json.at("method"),
                     .dial = json.at("dial"),
                     .mark = json.at("mark"),
                     .x = json.at("x"),
                     .y = json.at("y"),
                     .is_on_front = json.at("front"),
                     .competes = json.at("competes")};
    if (!json.contains("rung")) return point;
    point.rung = json.at("rung");
    for (const std::string setting : json.at("settings")) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) throw std::runtime_error("setting \"" + setting + "\" has no =");
        point.settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
    }
    return point;
}

bool hasPlace(const Chart& chart, const ChartPoint& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && (!chart.x.is_log || point.x > 0) &&
           (!chart.y.is_log || point.y > 0 || chart.y.floor > 0);
}

// What the rung's points set, as numbers.
void findValues(Chart& chart, const std::string& rung, Settings& settings) {
    std::set<std::string> names;
    for (const ChartPoint& point : chart.points)
        if (point.rung == rung)
            for (const auto& [name, value] : point.settings)
                names.insert(name);
    for (ChartPoint& point : chart.points) {
        if (point.rung != rung) continue;
        for (const std::string& name : names)
            settings.at(name).value = settings.at(name).default_value;
        for (const auto& [name, value] : point.settings)
            settings.set(name, value);
        for (std::size_t i = 0; i < settings.all().size(); ++i)
            if (names.contains(settings.all()[i].name)) point.values[i] = settings.all()[i].value;
    }
}

} // namespace

Chart readChart(const fs::path& file) {
    try {
        std::ifstream stream(file);
        if (!stream) throw std::runtime_error("cannot be read");
        const Json json = Json::parse(stream);
        Chart chart{
            json.at("title"), json.at("subtitle"), axisFrom(json.at("x")), axisFrom(json.at("y")), {}};
        for (const Json& point : json.at("points")) {
            chart.points.push_back(pointFrom(point));
            if (!hasPlace(chart, chart.points.back()))
                throw std::runtime_error("the point \"" + chart.points.back().method +
                                         "\" has no place on the axes");
        }
        if (chart.points.empty()) throw std::runtime_error("has no points");
        return chart;
    } catch (const std::exception& error) { // of JSON's, too, which do not name the file
        throw std::runtime_error(file.string() + ": " + error.what());
    }
}

std::vector<Chart> chartsOf(const fs::path& tutorials, const std::string& rung, Settings& settings) {
    std::vector<fs::path> files;
    for (const auto& folder : fs::directory_iterator(tutorials)) {
        std::error_code error;
        for (fs::directory_iterator entry(folder.path() / "charts", error), end; !error && entry != end;
             entry.increment(error))
            if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    const auto isOwn = [&](const fs::path& file) {
        return file.parent_path().parent_path().filename() == rung;
    };
    std::sort(files.begin(), files.end(), [&](const fs::path& one, const fs::path& other) {
        return isOwn(one) != isOwn(other) ? isOwn(one) : one < other;
    });

    std::vector<double> before;
    for (const Setting& setting : settings.all())
        before.push_back(setting.value);
    const auto restore = [&] {
        for (std::size_t i = 0; i < before.size(); ++i)
            settings.all()[i].value = before[i];
    };
    std::vector<Chart> charts;
    for (const fs::path& file : files) {
        Chart chart = readChart(file);
        if (std::none_of(chart.points.begin(), chart.points.end(),
                         [&](const ChartPoint& point) { return point.rung == rung; }))
            continue;
        try {
            findValues(chart, rung, settings);
        } catch (const UsageError& error) {
            restore();
            throw std::runtime_error(file.string() + ": " + error.what());
        }
        charts.push_back(std::move(chart));
    }
    restore();
    return charts;
}

bool countsCopies(const Chart& chart) { return chart.x.label.find("copies (cu)") != std::string::npos; }

std::vector<std::vector<std::string>> drawablePoints(const Chart& chart) {
    std::vector<std::vector<std::string>> all;
    for (const ChartPoint& point : chart.points) {
        if (point.values.empty()) continue;
        all.emplace_back();
        for (const auto& [name, value] : point.settings)
            all.back().push_back(name + "=" + value);
    }
    return all;
}

CostsHere costsHere(const Chart& chart, const std::vector<double>& points_cu, double present_cu) {
    std::vector<double> more;
    std::size_t next = 0;
    for (const ChartPoint& point : chart.points)
        if (!point.values.empty() && next++ < points_cu.size()) more.push_back(points_cu[next - 1] - point.x);
    if (more.empty() || next != points_cu.size())
        throw std::logic_error("costs of other points than the chart's");
    const auto middle = more.begin() + static_cast<std::ptrdiff_t>(more.size() / 2);
    std::nth_element(more.begin(), middle, more.end());
    CostsHere here{.points = points_cu, .present = present_cu - *middle, .shared = *middle};
    for (double& cu : here.points)
        cu -= *middle;
    return here;
}

bool isPresent(const ChartPoint& point, const Settings& settings) {
    return !point.values.empty() &&
           std::all_of(point.values.begin(), point.values.end(),
                       [&](const auto& value) { return settings.all()[value.first].value == value.second; });
}

} // namespace gll
