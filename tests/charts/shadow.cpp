// Shadows: which bias leaves neither acne nor a gap, and what a filter costs for how close it comes to the
// truth. The truth is rays against the plot's triangles, over the same footprint.
#include "charts/shadow.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "support/choices.hpp"
#include "truth/shadow_plot.hpp"

#include <set>
#include <string>
#include <vector>

namespace gll::charts::shadow {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 error_size{240, 180};
constexpr glm::ivec2 cost_size{640, 480};
constexpr int elevations_deg[] = {5, 10, 20, 40, 60, 80};
constexpr int map_size = 512;

struct Bias {
    std::string name;
    std::string mark = {};
};
const std::vector<Bias> biases = {{"constant"},    {"slope", "the original of 10"},
                                  {"texel"},       {"normal_offset"},
                                  {"front_faces"}, {"plane", "recommended"}};

struct Method {
    std::string name;
    Set set;
    std::string dial = {};
    std::string mark = {};
};

std::vector<Method> filterMethods() {
    std::vector<Method> methods;
    for (const char* filter : {"pcf", "rotated_disk", "vsm", "evsm", "msm"})
        for (const char* width : {"1", "3", "5", "7", "9"}) {
            const bool recommended = filter == std::string("pcf") && width == std::string("3");
            methods.push_back({filter,
                               {{"shadow_filter", filter}, {"shadow_pcf", width}, {"shadow_bias", "plane"}},
                               std::string("width ") + width,
                               recommended ? "recommended" : ""});
        }
    return methods;
}

void requireAll(const fs::path& programs) {
    std::set<std::string> names;
    for (const Bias& bias : biases)
        names.insert(bias.name);
    test::requireCovered(programs / "07_shadow_map", "shadow_bias", names);
    std::set<std::string> filters{
        "pcss"}; // its width follows the sun's, so that no one footprint is right: see its page
    for (const Method& method : filterMethods())
        filters.insert(method.name);
    test::requireCovered(programs / "07_shadow_map", "shadow_filter", filters);
}

Set plotSet(int elevation_deg) {
    return {{"scene", "plot"},
            {"shadow_size", std::to_string(map_size)},
            {"sun_elevation_deg", std::to_string(elevation_deg)}};
}

Set joined(Set one, const Set& other) {
    one.insert(other.begin(), other.end());
    return one;
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    requireAll(programs);
    std::vector<Set> sets;
    Table table{{"method", "cost_cu"}, {}};
    for (const Bias& bias : biases) {
        sets.push_back(joined(plotSet(40), {{"shadow_bias", bias.name}, {"shadow_pcf", "3"}}));
        table.rows.push_back({"bias " + bias.name});
    }
    for (const Method& method : filterMethods()) {
        sets.push_back(joined(plotSet(40), method.set));
        table.rows.push_back({method.name + " " + method.dial});
    }
    const auto reports = costs(programs / "07_shadow_map", sets, cost_size);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        double cost = 0; // of the shadow alone
        for (const auto& pass : reports[i].at("passes")) {
            const std::string name = pass.at("name");
            if (name.starts_with("shadow") || name == "sun") cost += pass.at("cu").get<double>();
        }
        table.rows[i].push_back(decimals(cost, 2));
    }
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requireAll(programs);
    const Costs costs(costs_csv);
    const auto scene = truth::plotRays();
    const std::vector<Method> methods = filterMethods();
    Frames frames(programs / "07_shadow_map");
    struct Asked {
        std::size_t position, normal;
        std::vector<std::size_t> biases, filters;
    };
    std::vector<Asked> asked;
    for (const int elevation : elevations_deg) {
        const Set set = plotSet(elevation);
        Asked& at = asked.emplace_back();
        at.position = frames.ask(set, error_size, "position");
        at.normal = frames.ask(set, error_size, "normal");
        for (const Bias& bias : biases)
            at.biases.push_back(frames.ask(joined(set, {{"shadow_bias", bias.name}, {"shadow_pcf", "3"}}),
                                           error_size, "sun"));
        for (const Method& method : methods)
            at.filters.push_back(frames.ask(joined(set, method.set), error_size, "sun"));
    }
    frames.run();

    constexpr int bands_deg[] = {0, 15, 30, 45, 60, 75, 85, 89};
    constexpr std::size_t band_count = std::size(bands_deg) - 1;
    std::vector<truth::ShadowErrors> overall(biases.size());
    std::vector<std::vector<truth::ShadowErrors>> by_slope(biases.size(),
                                                           std::vector<truth::ShadowErrors>(band_count));
    std::vector<truth::ShadowErrors> filters(methods.size());
    for (std::size_t e = 0; e < asked.size(); ++e) {
        const measure::ColorImage positions = frames.read(asked[e].position);
        const Image normals = loadImage(frames.file(asked[e].normal)); // two numbers, no color
        for (const int width : {1, 3, 5, 7, 9}) {
            const truth::SunTruth sun = truth::plotSun(elevations_deg[e], map_size, width);
            const auto shadows = truth::trueShadows(*scene, sun, positions, normals);
            for (std::size_t i = 0; i < methods.size(); ++i)
                if (methods[i].set.at("shadow_pcf") == std::to_string(width))
                    filters[i].add(shadows, sun, frames.read(asked[e].filters[i]));
            if (width != 3) continue;
            for (std::size_t i = 0; i < biases.size(); ++i) {
                const measure::ColorImage visible = frames.read(asked[e].biases[i]);
                overall[i].add(shadows, sun, visible);
                for (std::size_t band = 0; band < band_count; ++band)
                    by_slope[i][band].add(shadows, sun, visible, static_cast<float>(bands_deg[band]),
                                          static_cast<float>(bands_deg[band + 1]));
            }
        }
    }

    Table table{{"bias", "acne %", "leak %", "gap texels", "RMSE", "RMSE hard", "cost cu", "note"}, {}};
    for (std::size_t i = 0; i < biases.size(); ++i)
        table.rows.push_back({biases[i].name, shortNumber(overall[i].acnePercent()),
                              shortNumber(overall[i].leakPercent()), shortNumber(overall[i].gapTexels()),
                              shortNumber(overall[i].rmseToFilter()), shortNumber(overall[i].rmseToHard()),
                              decimals(costs.of("bias " + biases[i].name, "cost_cu"), 2), biases[i].mark});
    writeCsv(folder / "shadow_bias.csv", table);
    std::vector<Point> acne, gap;
    Table slopes{{"bias", "slopes", "acne %", "gap texels"}, {}};
    for (std::size_t i = 0; i < biases.size(); ++i)
        for (std::size_t band = 0; band < band_count; ++band) {
            const std::string name =
                std::to_string(bands_deg[band]) + " to " + std::to_string(bands_deg[band + 1]);
            const double middle = 0.5 * (bands_deg[band] + bands_deg[band + 1]);
            acne.push_back({biases[i].name, "", middle, by_slope[i][band].acnePercent(),
                            band == 3 ? biases[i].mark : ""});
            gap.push_back(
                {biases[i].name, "", middle, by_slope[i][band].gapTexels(), band == 3 ? biases[i].mark : ""});
            acne.back().settings = gap.back().settings =
                Set{{"shadow_bias", biases[i].name}, {"shadow_pcf", "3"}};
            slopes.rows.push_back({biases[i].name, name, shortNumber(by_slope[i][band].acnePercent()),
                                   shortNumber(by_slope[i][band].gapTexels())});
        }
    writeCsv(folder / "shadow_slopes.csv", slopes);
    const std::string subtitle =
        "scene=plot shadow_size=512 shadow_pcf=3, the sun 5 to 80 degrees up, 240x180";
    Axes axes{.title = "Biases: how much of what is lit shades itself?",
              .subtitle = subtitle,
              .x = "angle between the surface and the sun, degrees",
              .y = "acne, % of lit pixels",
              .log_y = true,
              .floor = 0.01,
              .dial_is_given = true,
              .rung = "07_shadow_map"};
    drawChart(folder / "shadow_acne.svg", axes, acne);
    axes.title = "Biases: how far does light leak in where things touch?";
    axes.y = "gap, texels";
    axes.floor = 0.1;
    drawChart(folder / "shadow_gap.svg", axes, gap);

    Table filter_table{{"filter", "width", "RMSE", "acne %", "leak %", "cost cu", "note"}, {}};
    std::vector<Point> points;
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const double cost = costs.of(methods[i].name + " " + methods[i].dial, "cost_cu");
        filter_table.rows.push_back(
            {methods[i].name, methods[i].set.at("shadow_pcf"), shortNumber(filters[i].rmseToFilter()),
             shortNumber(filters[i].acnePercent()), shortNumber(filters[i].leakPercent()), decimals(cost, 2),
             methods[i].mark});
        points.push_back(
            {methods[i].name, methods[i].dial, cost, filters[i].rmseToFilter(), methods[i].mark});
        points.back().settings = methods[i].set;
    }
    writeCsv(folder / "shadow_filters.csv", filter_table);
    drawChart(
        folder / "shadow_filters.svg",
        {.title = "Filters: how close to rays over the same width?",
         .subtitle = "scene=plot shadow_size=512 shadow_bias=plane, the sun 5 to 80 degrees up, 240x180",
         .x = "cost of map and lookup, copies (cu) at 640x480",
         .y = "RMSE of the sun's visibility",
         .dial_is_given = true,
         .rung = "07_shadow_map"},
        points);
}

} // namespace gll::charts::shadow
