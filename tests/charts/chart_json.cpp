// Charts as JSON.
#include "charts/chart_json.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gll::charts {
namespace {

using Json = nlohmann::ordered_json;

Json pointJson(const Axes& axes, const Point& point, bool on_front) {
    // A cost comes from a table. What is computed is given in as many digits as do not change with a
    // compiler.
    Json json{{"method", point.method}, {"dial", point.dial},
              {"x", point.cost},        {"y", std::stod(shortNumber(point.error))},
              {"front", on_front},      {"competes", point.competes},
              {"mark", point.mark}};
    if (!point.settings) return json;
    json["rung"] = point.rung.empty() ? axes.rung : point.rung;
    json["settings"] = Json::array();
    for (const auto& [name, value] : *point.settings)
        json["settings"].push_back(name + "=" + value);
    return json;
}

} // namespace

void writeChartJson(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points) {
    Json head{{"title", axes.title},
              {"subtitle", axes.subtitle},
              {"x", {{"label", axes.x}, {"log", axes.log_x}}},
              {"y", {{"label", axes.y}, {"log", axes.log_y}}}};
    if (axes.log_y) head["y"]["floor"] = axes.floor;
    const std::vector<bool> front = frontOf(axes, points);
    std::ofstream stream(file);
    stream << "{\n";
    for (const auto& [name, value] : head.items())
        stream << "  " << Json(name).dump() << ": " << value.dump() << ",\n";
    stream << "  \"points\": [\n";
    for (std::size_t i = 0; i < points.size(); ++i)
        stream << "    " << pointJson(axes, points[i], front[i]).dump()
               << (i + 1 < points.size() ? ",\n" : "\n");
    stream << "  ]\n}\n";
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

} // namespace gll::charts
