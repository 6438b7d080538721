// Whole frames: the original's, the recommended one, and those between, where one part is taken from the
// other or left out. They are compared with a frame that has every part as its own rung found it closest to
// the truth.
#include "charts/deferred.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "measure/flip.hpp"
#include "support/process.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::charts::deferred {
namespace {

namespace fs = std::filesystem;

constexpr const char* rung_name = "10_deferred";
constexpr glm::ivec2 picture_size{320, 240};
constexpr glm::ivec2 cost_size{640, 480};
constexpr int picture_frames[] = {60, 150, 300};

// How it is shown is taste and no part's error.
const Set look = {{"filmstrip", "off"}, {"tone_map", "pbr_neutral"}, {"encode", "srgb"}};

// The settings of a part: of the original none is named, as they are the defaults.
struct Part {
    std::string name;
    Set recommended;
    Set reference; // over the recommended ones
    Set without = {};
};

const std::vector<Part> parts = {
    {"G-buffer",
     {{"packing", "rgba16"}, {"positions", "depth24"}},
     {{"packing", "separate"},
      {"positions", "rgba32f"},
      {"normals", "rgba32f"},
      {"albedo", "float"},
      {"geometric", "on"}}},
    {"textures", {{"texture_filter", "mipmapped"}}, {{"texture_filter", "anisotropic"}}},
    {"shadow",
     {{"shadow_bias", "plane"}, {"shadow_pcf", "3"}, {"shadow_fit", "stable"}, {"shadow_size", "2048"}},
     {{"shadow_size", "4096"}}},
    {"occlusion",
     {{"ssao", "bitmask"},
      {"ssao_normals", "geometric"},
      {"ssao_noise", "interleaved"},
      {"ssao_blur", "separable"},
      {"ssao_samples", "12"},
      {"ssao_slices", "1"},
      {"ssao_bias", "0.003"},
      {"ssao_resolution", "half"},
      {"ssao_multi_bounce", "on"},
      {"occluded_direct", "off"}},
     {{"ssao_resolution", "full"}, {"ssao_samples", "64"}, {"ssao_slices", "4"}},
     {{"ssao", "off"}}},
    {"environment",
     {{"environment_diffuse", "sh9_sun"},
      {"environment_specular", "prefiltered"},
      {"prefilter_samples", "32"},
      {"environment_sun", "on"},
      {"environment_brdf", "table"},
      {"environment_energy", "fdez_aguera"}},
     {{"prefilter_samples", "1024"}, {"brdf_table_size", "64"}},
     {{"environment", "off"}}},
    {"sun", {}, {}, {{"sun", "off"}}},
    {"coloured lights", {}, {}, {{"points", "off"}}},
};

Set joined(Set one, const Set& over) {
    for (const auto& [name, value] : over)
        one[name] = value;
    return one;
}

Set recommendedButFor(const std::string& part) {
    Set set = look;
    for (const Part& each : parts)
        if (each.name != part) set = joined(set, each.recommended);
    return set;
}

struct Method {
    std::string kind, part;
    Set set;
};

std::vector<Method> methods() {
    std::vector<Method> all = {{"the original", "", look}, {"recommended", "", recommendedButFor("")}};
    for (const Part& part : parts)
        if (!part.recommended.empty())
            all.push_back({"the original's", part.name, recommendedButFor(part.name)});
    for (const Part& part : parts)
        if (!part.recommended.empty()) all.push_back({"better", part.name, joined(look, part.recommended)});
    for (const Part& part : parts)
        if (!part.without.empty())
            all.push_back({"without", part.name, joined(recommendedButFor(""), part.without)});
    all.push_back(
        {"occlusion for every pixel", "", joined(recommendedButFor(""), {{"ssao_resolution", "full"}})});
    return all;
}

std::string nameOf(const Method& method) {
    return method.kind + (method.part.empty() ? "" : " " + method.part);
}

// The parts must be those of --preset recommended.
void requirePreset(const fs::path& rung) {
    const auto listed = nlohmann::json::parse(test::runToSuccess({rung, {"--settings", "--json"}}).out);
    for (const auto& preset : listed.at("presets"))
        if (preset.at("name") == "recommended") {
            Set values;
            for (const auto& value : preset.at("values"))
                values[value.at(0)] = value.at(1);
            if (values == recommendedButFor("")) return;
        }
    throw std::runtime_error("--preset recommended of 10_deferred has other settings than its chart's parts");
}

Set referenceSet() {
    Set set = recommendedButFor("");
    for (const Part& part : parts)
        set = joined(set, part.reference);
    return set;
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    requirePreset(programs / rung_name);
    std::vector<Set> sets;
    Table table{{"method", "cost_cu"}, {}};
    for (const Method& method : methods()) {
        sets.push_back(method.set);
        table.rows.push_back({nameOf(method)});
    }
    const auto reports = costs(programs / rung_name, sets, cost_size);
    for (std::size_t i = 0; i < reports.size(); ++i)
        table.rows[i].push_back(decimals(reports[i].at("sum_cu").get<double>(), 2));
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requirePreset(programs / rung_name);
    const Costs costs(costs_csv);
    const std::vector<Method> all = methods();
    Frames frames(programs / rung_name);
    std::vector<std::size_t> references;
    std::vector<std::vector<std::size_t>> asked(all.size());
    for (const int number : picture_frames) {
        references.push_back(frames.ask(referenceSet(), picture_size, "frame", nullptr, number));
        for (std::size_t i = 0; i < all.size(); ++i)
            asked[i].push_back(frames.ask(all[i].set, picture_size, "frame", nullptr, number));
    }
    frames.run();
    std::vector<double> errors(all.size(), 0);
    for (std::size_t r = 0; r < references.size(); ++r) {
        const measure::ColorImage reference = frames.read(references[r]);
        for (std::size_t i = 0; i < all.size(); ++i)
            errors[i] += measure::summary(measure::flip(frames.read(asked[i][r]), reference)).mean /
                         double(references.size());
    }

    std::map<std::string, std::size_t> at;
    std::vector<Point> points;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = nameOf(all[i]);
        at[name] = i;
        const std::string mark = name == "recommended"    ? "recommended"
                                 : name == "the original" ? "the original"
                                                          : "";
        if (all[i].kind == "without") continue; // another picture, and no cheaper way to the same
        const std::string shown = all[i].kind == "better"           ? "better " + all[i].part
                                  : all[i].kind == "the original's" ? "original " + all[i].part
                                                                    : name;
        points.push_back({shown, "", costs.of(name, "cost_cu"), errors[i], mark, true, false, all[i].set});
        for (const auto& [taste, value] : look)
            points.back().settings->erase(taste);
    }
    const auto number = [&](const std::string& name, bool cost) {
        const auto found = at.find(name);
        if (found == at.end()) return std::string("-");
        return cost ? decimals(costs.of(name, "cost_cu"), 2) : decimals(errors[found->second], 4);
    };
    Table table{{"part", "cu with the original's", "FLIP with the original's", "cu without", "FLIP without",
                 "cu of the original with this alone", "FLIP of the original with this alone"},
                {}};
    for (const Part& part : parts)
        table.rows.push_back({part.name, number("the original's " + part.name, true),
                              number("the original's " + part.name, false),
                              number("without " + part.name, true), number("without " + part.name, false),
                              number("better " + part.name, true), number("better " + part.name, false)});
    writeCsv(folder / "deferred_parts.csv", table);
    Table whole{{"frame", "cost cu", "FLIP"}, {}};
    for (const char* name : {"the original", "recommended", "occlusion for every pixel"})
        whole.rows.push_back({name, number(name, true), number(name, false)});
    writeCsv(folder / "deferred.csv", whole);
    drawChart(folder / "deferred_flip.svg",
              {.title = "The whole frame: what is each part worth?",
               .subtitle = "frames 60, 150 and 300, 320x240, tone_map=pbr_neutral encode=srgb",
               .x = "cost of the frame, copies (cu) at 640x480",
               .y = "mean FLIP to the frame of best parts",
               .rung = rung_name},
              points);
}

} // namespace gll::charts::deferred
