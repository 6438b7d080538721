// Ambient occlusion: what comes closest to rays for what it costs, when every method has the same normals,
// noise and blur, and the constants that suit it best.
#include "charts/ssao.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "charts/occlusion_frames.hpp"
#include "support/choices.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::charts::ssao {
namespace {

namespace fs = std::filesystem;

constexpr const char* rung_name = "08_ssao";
constexpr glm::ivec2 picture_size{320, 240};
constexpr int rays = 144;

const Set shared = {{"ssao_normals", "geometric"},
                    {"ssao_noise", "interleaved"},
                    {"ssao_blur", "separable"},
                    {"ssao_bias", "0.003"}};

std::vector<OcclusionView> views() {
    return {{.scene = "cat"}, {.scene = "cat", .frame = 180}, {.scene = "room"}, {.scene = "corner"}};
}

struct Method {
    std::string name; // of the curve
    Set set;          // over the shared ones
    std::vector<std::string> samples;
    std::vector<std::pair<std::string, std::vector<std::string>>> tuned =
        {}; // constants, and what is tried of each
};

std::vector<Method> methods() {
    const std::vector<std::string> taps = {"8", "16", "32", "64"};
    const std::vector<std::string> powers = {"1", "1.4"};
    const std::vector<std::string> radii = {"0.6", "0.75", "0.9", "1.2"};
    return {
        {"cone",
         {{"ssao", "cone"}},
         taps,
         {{"ssao_strength", {"0.8", "1", "1.3", "1.7"}},
          {"ssao_power", powers},
          {"ssao_radius", {"0.6", "0.75", "0.9"}},
          {"ssao_bias", {"0.003", "0.02"}}}},
        {"hemisphere",
         {{"ssao", "hemisphere"}},
         taps,
         {{"ssao_strength", {"0.8", "1", "1.25", "1.5"}},
          {"ssao_power", powers},
          {"ssao_radius", {"0.6", "0.75", "0.9"}},
          {"ssao_bias", {"0.003", "0.02"}}}},
        {"sao",
         {{"ssao", "sao"}},
         taps,
         {{"ssao_strength", {"0.35", "0.5", "0.7", "1"}}, {"ssao_power", powers}, {"ssao_radius", radii}}},
        {"hbao",
         {{"ssao", "hbao"}},
         taps,
         {{"ssao_strength", {"1", "1.4", "1.8"}},
          {"ssao_power", powers},
          {"ssao_radius", radii},
          {"ssao_slices", {"1", "2"}}}},
        {"gtao",
         {{"ssao", "gtao"}},
         taps,
         {{"ssao_falloff", {"0", "0.3", "0.6"}},
          {"ssao_power", {"1", "1.2", "1.5"}},
          {"ssao_radius", {"0.6", "0.7", "0.874"}},
          {"ssao_slices", {"1", "2"}}}},
        {"bitmask", {{"ssao", "bitmask"}, {"ssao_slices", "1"}}, {"4", "8", "12", "16", "32", "64"}},
        {"bitmask, tuned",
         {{"ssao", "bitmask"}},
         {"12"},
         {{"ssao_thickness", {"0.3", "0.45", "0.6"}},
          {"ssao_power", {"1", "1.2"}},
          {"ssao_radius", {"0.6", "0.7", "0.8"}},
          {"ssao_slices", {"1", "2"}}}},
        {"bitmask, half resolution",
         {{"ssao", "bitmask"}, {"ssao_slices", "1"}, {"ssao_resolution", "half"}},
         {"12", "32"}},
        // as its authors set it: two slices of four taps, three of six
        {"gtao as in XeGTAO",
         {{"ssao", "gtao"},
          {"ssao_noise", "hilbert"},
          {"ssao_falloff", "0.615"},
          {"ssao_radius", "0.874"},
          {"ssao_power", "2.2"}},
         {"8", "18"}},
        // as texts have them: the normals of the normal map
        {"hemisphere as taught",
         {{"ssao", "hemisphere"},
          {"ssao_normals", "mapped"},
          {"ssao_blur", "separable"},
          {"ssao_strength", "1"},
          {"ssao_bias", "0.025"}},
         {"64"}},
        {"cone, mapped normals",
         {{"ssao_normals", "mapped"}, {"ssao_noise", "hash"}, {"ssao_blur", "off"}, {"ssao_bias", "0.03"}},
         {"16"}},
    };
}

Set joined(Set one, const Set& over) {
    for (const auto& [name, value] : over)
        one[name] = value;
    return one;
}

Set setOf(const Method& method, const std::string& samples) {
    Set set = joined(shared, method.set);
    set["ssao_samples"] = samples;
    if (method.name == "gtao as in XeGTAO") set["ssao_slices"] = samples == "8" ? "2" : "3";
    return set;
}

// Every combination of what is tried.
std::vector<Set> candidates(const Method& method) {
    std::vector<Set> all = {{}};
    for (const auto& [name, values] : method.tuned) {
        std::vector<Set> more;
        for (const Set& set : all)
            for (const std::string& value : values)
                more.push_back(joined(set, {{name, value}}));
        all = more;
    }
    return all;
}

// Of the cat's and the room's mean square errors.
double errorOf(const OcclusionFrames& frames, std::size_t set) {
    const double cat = frames.errors(set, "cat").all.rmse();
    const double room = frames.errors(set, "room").all.rmse();
    return std::sqrt(0.5 * (cat * cat + room * room));
}

Set tunedSet(const fs::path& rung, const Method& method) {
    const std::vector<Set> all = candidates(method);
    if (all.size() == 1) return all.front();
    sayProgress("08_ssao: tuning " + method.name + ", " + std::to_string(all.size()) + " settings");
    OcclusionFrames frames(rung, views(), {240, 180});
    for (const Set& set : all)
        frames.ask(joined(setOf(method, method.name == "hemisphere" ? "64" : "16"), set));
    frames.run(64);
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (errorOf(frames, i) < errorOf(frames, best)) best = i;
    return all[best];
}

std::string textOf(const Set& set) {
    std::string text;
    for (const auto& [name, value] : set)
        text += (text.empty() ? "" : " ") + name + "=" + value;
    return text;
}

Set setFrom(const std::string& text) {
    Set set;
    std::istringstream words(text);
    for (std::string word; words >> word;)
        set[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
    return set;
}

Set recommended() {
    return joined(shared, {{"ssao", "bitmask"}, {"ssao_slices", "1"}, {"ssao_samples", "12"}});
}

// What else might have been recommended.
std::vector<std::string> variants() {
    return {"",
            "ssao_spacing=even",
            "ssao_rounding=floor",
            "ssao_rounding=ceil",
            "ssao_sectors=uniform",
            "ssao_slices=2",
            "ssao_thickness=0.3",
            "ssao_thickness=1.2",
            "ssao_normals=depth",
            "ssao_normals=mapped",
            "ssao_noise=hash",
            "ssao_noise=hilbert",
            "ssao_blur=plane",
            "ssao_blur=off",
            "ssao=gtao ssao_falloff=0",
            "ssao=gtao ssao_falloff=1"};
}

void requireAll(const fs::path& programs) {
    std::set<std::string> names = {"off"};
    for (const Method& method : methods())
        if (method.set.contains("ssao")) names.insert(method.set.at("ssao"));
    test::requireCovered(programs / rung_name, "ssao", names);
}

std::string markOf(const Method& method, const std::string& samples) {
    if (method.name == "bitmask" && samples == "12") return "recommended";
    if (method.name == "cone, mapped normals") return "the original of 10";
    return "";
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    requireAll(programs);
    const fs::path rung = programs / rung_name;
    Table table{{"method", "cost_cu", "set"}, {}};
    std::vector<Set> sets;
    for (const Method& method : methods()) {
        const Set tuned = tunedSet(rung, method);
        for (const std::string& samples : method.samples) {
            sets.push_back(joined(setOf(method, samples), tuned));
            table.rows.push_back({method.name + " " + samples});
        }
    }
    std::vector<Set> seen = sets;
    for (Set& set : seen)
        set["view"] = "visibility";
    const auto reports = costs(rung, seen, picture_size);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        double cost = 0;
        for (const auto& pass : reports[i].at("passes")) {
            const std::string name = pass.at("name");
            if (name.starts_with("ssao") || name == "lighting") cost += pass.at("cu").get<double>();
        }
        table.rows[i].push_back(decimals(cost, 2));
        table.rows[i].push_back(textOf(sets[i]));
    }
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requireAll(programs);
    const Costs costs(costs_csv);
    const Table measured = readCsv(costs_csv);
    OcclusionFrames frames(programs / rung_name, views(), picture_size);
    for (const auto& row : measured.rows)
        frames.ask(setFrom(row[2]));
    frames.ask({{"ssao", "off"}});
    for (const std::string& one : variants())
        frames.ask(joined(recommended(), setFrom(one)));
    frames.run(rays);

    Table table{{"method", "taps", "RMSE cat", "RMSE room", "RMSE corner", "to the screen, cat",
                 "to the screen, room", "bias where dark", "noise", "cost cu", "note"},
                {}};
    const auto tell = [&](const std::string& name, const std::string& samples, std::size_t i,
                          const std::string& cost, const std::string& mark) {
        table.rows.push_back({name, samples, decimals(frames.errors(i, "cat").all.rmse(), 3),
                              decimals(frames.errors(i, "room").all.rmse(), 3),
                              decimals(frames.errors(i, "corner").all.rmse(), 3),
                              decimals(frames.errors(i, "cat").on_screen.rmse(), 3),
                              decimals(frames.errors(i, "room").on_screen.rmse(), 3),
                              decimals(frames.errors(i, "cat").dark.bias(), 2),
                              decimals(frames.errors(i).noise.rmse(), 4), cost, mark});
    };
    std::vector<Point> cat, room;
    std::size_t i = 0;
    for (const Method& method : methods())
        for (const std::string& samples : method.samples) {
            const std::string name = method.name + " " + samples;
            if (i >= measured.rows.size() || measured.rows[i][0] != name)
                throw std::runtime_error(costs_csv.string() + ": lacks " + name +
                                         " in its place; run tutorials/pages charts ssao");
            const double cost = costs.of(name, "cost_cu");
            const std::string mark = markOf(method, samples);
            cat.push_back({method.name, "taps " + samples, cost, frames.errors(i, "cat").all.rmse(), mark});
            room.push_back({method.name, "taps " + samples, cost, frames.errors(i, "room").all.rmse(), mark});
            cat.back().settings = room.back().settings = setFrom(measured.rows[i][2]);
            tell(method.name, samples, i, decimals(cost, 2), mark);
            ++i;
        }
    tell("off", "", i++, "", "");
    writeCsv(folder / "ssao.csv", table);

    Table choices{{"recommended, but", "RMSE cat", "RMSE room", "RMSE corner", "noise"}, {}};
    for (const std::string& one : variants()) {
        choices.rows.push_back(
            {one.empty() ? "nothing" : one, decimals(frames.errors(i, "cat").all.rmse(), 3),
             decimals(frames.errors(i, "room").all.rmse(), 3),
             decimals(frames.errors(i, "corner").all.rmse(), 3), decimals(frames.errors(i).noise.rmse(), 4)});
        ++i;
    }
    writeCsv(folder / "ssao_choices.csv", choices);

    Table constants{{"method", "constants"}, {}};
    std::size_t row = 0;
    for (const Method& method : methods()) {
        Set set = setFrom(measured.rows[row][2]);
        set.erase("ssao_samples"); // the row's, and of XeGTAO's also slices
        if (method.samples.size() > 1 && method.set.contains("ssao_power")) set.erase("ssao_slices");
        constants.rows.push_back({method.name, textOf(set)});
        row += method.samples.size();
    }
    writeCsv(folder / "ssao_constants.csv", constants);

    Axes axes{.title = "Ambient occlusion: how close to rays at the triangles?",
              .subtitle = "scene=cat, frames 60 and 180, 320x240, radius 0.6",
              .x = "cost of occlusion, blur and look-up, copies (cu) at 320x240",
              .y = "RMSE of the visibility",
              .log_y = true,
              .floor = 0.02,
              .rung = rung_name};
    drawChart(folder / "ssao_cat.svg", axes, cat);
    axes.subtitle = "scene=room, frame 60, 320x240, radius 0.6";
    axes.floor = 0.05;
    drawChart(folder / "ssao_room.svg", axes, room);
}

} // namespace gll::charts::ssao
