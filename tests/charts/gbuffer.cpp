// G-buffers: how many bytes a pixel, and which, before the lit picture shows no difference to one made from
// 32-bit floats; and how many bits a normal.
#include "charts/gbuffer.hpp"

#include "06_gbuffer/gbuffer.hpp"
#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "measure/color.hpp"
#include "support/choices.hpp"
#include "truth/gbuffer_reference.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::charts::gbuffer {
namespace {

namespace fs = std::filesystem;
using measure::ColorImage;

constexpr glm::ivec2 cost_size{640, 480};
constexpr glm::ivec2 frame_size{320, 240};
const char* const rung = "06_gbuffer";

struct Layout {
    std::string name;
    Set set;
    std::string mark = {};
};

const Set float_layout = {
    {"normals", "rgba32f"}, {"positions", "rgba32f"}, {"albedo", "float"}, {"gloss", "float"}};

// Normals in few bits beside gloss in eight, sRGB albedo and the depth buffer.
Layout small(const std::string& normals, bool precise) {
    Set set = {{"normals", normals}, {"positions", "depth24"}, {"gloss", "8"}, {"albedo", "srgb"}};
    if (precise) set["precise"] = "on";
    return {normals + (precise ? " precise" : ""), set};
}

const std::vector<Layout> layouts = {
    {"original", {}, "the original"},
    {"normals=oct16", {{"normals", "oct16"}}},
    {"positions=depth24", {{"positions", "depth24"}}},
    {"oct16, depth24, palette", {{"normals", "oct16"}, {"positions", "depth24"}, {"gloss", "palette"}}},
    small("rgb8", false),
    small("rgb10", false),
    small("oct8", false),
    small("oct10", false),
    small("oct10", true),
    small("oct12", false),
    small("oct12", true),
    small("oct16", false),
    {"oct16, float albedo",
     {{"normals", "oct16"}, {"positions", "depth24"}, {"gloss", "8"}, {"albedo", "float"}}},
    {"oct12, 10-bit albedo",
     {{"normals", "oct12"},
      {"precise", "on"},
      {"positions", "depth24"},
      {"gloss", "8"},
      {"albedo", "root10"}}},
    {"packed", {{"packing", "rgba16"}, {"positions", "depth24"}}, "recommended"},
    {"packed, 16-bit depth", {{"packing", "rgba16"}, {"positions", "depth16"}}},
    {"packed, stored positions", {{"packing", "rgba16"}}}};

struct Scene {
    std::string name;
    Set set;
};
const std::vector<Scene> scenes = {
    {"yard", {}},
    {"side", {{"camera_yaw_deg", "90"}, {"camera_pitch_deg", "-8"}, {"camera_zoom", "0.8"}}},
    {"glossy floor", {{"floor_shininess", "2048"}, {"texture_filter", "mipmapped"}}},
    {"near", {{"camera_zoom", "2.5"}, {"camera_pitch_deg", "12"}, {"texture_filter", "mipmapped"}}}};

Set together(Set left, const Set& right) {
    for (const auto& [name, value] : right)
        left[name] = value;
    return left;
}

int bytesOf(Format format) {
    switch (format) {
    case Format::r8:
        return 1;
    case Format::rg8:
    case Format::r16f:
    case Format::depth16:
        return 2;
    case Format::rgba8:
    case Format::srgb8_alpha8:
    case Format::rgb10_a2:
    case Format::rg16:
    case Format::r32f:
    case Format::depth24: // which drivers keep in 32
    case Format::depth32f:
        return 4;
    case Format::rgba16:
    case Format::rgba16f:
        return 8;
    case Format::rgba32f:
        return 16;
    default:
        throw std::logic_error("a format of the G-buffer has no size here");
    }
}

// Of a pixel, depth included, by the rung's own list of targets.
int bytesOf(const Set& set) {
    Settings settings;
    const gll::gbuffer::GBufferOptions options(settings);
    for (const auto& [name, value] : set)
        settings.set(name + "=" + value);
    int bytes = 0;
    for (const Attachment& attachment : options.attachments())
        bytes += bytesOf(attachment.format);
    return bytes;
}

// From linear light to what eight bits hold, 0 to 255.
ColorImage shownCodes(ColorImage image) {
    for (glm::dvec3& color : image.pixels)
        for (int c = 0; c < 3; ++c)
            color[c] = 255 * measure::srgbEncoded(color[c]);
    return image;
}

struct LitError {
    double percent =
        0;           // of the pixels that show a surface, those of which a channel is off by more than a code
    double rmse = 0; // codes, over the same pixels
};

LitError litError(const ColorImage& shown, const ColorImage& reference, const ColorImage& surfaces) {
    LitError error;
    int count = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        if (surfaces.pixels[i].r == 0) continue;
        const glm::dvec3 off = glm::abs(shown.pixels[i] - reference.pixels[i]);
        error.percent += std::max({off.r, off.g, off.b}) > 1 + 1e-3 ? 100 : 0;
        error.rmse += glm::dot(off, off) / 3;
        ++count;
    }
    error.percent /= count;
    error.rmse = std::sqrt(error.rmse / count);
    return error;
}

void drawNormals(const fs::path& programs, const fs::path& folder) {
    Table table{{"normals", "precise", "bits", "mean degrees", "largest degrees"}, {}};
    std::vector<Point> points;
    const std::vector<glm::dvec3> directions = truth::spreadDirections(200'000);
    for (const std::string& normals : test::choicesOf(programs / rung, "normals")) {
        if (normals == "rgba32f") continue; // the reference
        for (const bool precise : {false, true}) {
            if (precise && truth::octahedralBits(normals) == 0) continue;
            const truth::NormalError error =
                truth::normalError(directions, [&, precise = precise](const glm::dvec3& n) {
                    return truth::storedNormal(normals, precise, n);
                });
            const int bits = truth::normalBits(normals);
            table.rows.push_back({normals, precise ? "on" : "off", std::to_string(bits),
                                  decimals(error.mean_deg, 4), decimals(error.largest_deg, 4)});
            const std::string method = truth::octahedralBits(normals) == 0 ? "x, y and z"
                                       : precise                           ? "octahedral, precise"
                                                                           : "octahedral";
            points.push_back({method, normals, double(bits), error.mean_deg});
            points.back().settings = Set{{"normals", normals}};
            if (precise) points.back().settings->emplace("precise", "on");
        }
    }
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
        return a.method != b.method ? a.method < b.method : a.cost < b.cost;
    });
    writeCsv(folder / "gbuffer_normals.csv", table);
    drawChart(folder / "gbuffer_normals.svg",
              {.title = "Normals: how many degrees do so many bits cost?",
               .subtitle = "200,000 directions all over the sphere",
               .x = "bits per normal",
               .y = "mean error, degrees",
               .log_y = true,
               .floor = 1e-3,
               .rung = rung},
              points);
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    std::vector<Set> sets;
    for (const Layout& layout : layouts)
        sets.push_back(layout.set);
    const auto reports = costs(programs / rung, sets, cost_size);
    Table table{{"layout", "cost_cu"}, {}};
    for (std::size_t i = 0; i < layouts.size(); ++i)
        table.rows.push_back({layouts[i].name, decimals(reports[i].at("sum_cu").get<double>(), 2)});
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    test::requireCovered(programs / rung, "normals", test::valuesOf(layouts, "normals"),
                         {{"rgba16f", "the original's"}, {"rgba32f", "the reference"}});
    test::requireCovered(programs / rung, "albedo", test::valuesOf(layouts, "albedo"),
                         {{"linear", "the original's"}});
    const Costs costs(costs_csv);
    Frames frames(programs / rung);
    for (const Scene& scene : scenes) {
        frames.ask(together(scene.set, {{"view", "gloss"}}), frame_size, "frame"); // 0: background
        frames.ask(together(scene.set, float_layout), frame_size, "frame");
        for (const Layout& layout : layouts)
            frames.ask(together(scene.set, layout.set), frame_size, "frame");
    }
    frames.run();

    Table table{{"layout", "bytes/pixel", "cost cu"}, {}};
    for (const Scene& scene : scenes)
        table.columns.push_back(scene.name + " off %");
    table.columns.insert(table.columns.end(), {"worst RMSE codes", "note"});
    std::vector<LitError> errors; // scene by scene
    const std::size_t per_scene = layouts.size() + 2;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        const ColorImage surfaces = frames.read(s * per_scene);
        const ColorImage reference = shownCodes(frames.read(s * per_scene + 1));
        for (std::size_t i = 0; i < layouts.size(); ++i)
            errors.push_back(litError(shownCodes(frames.read(s * per_scene + 2 + i)), reference, surfaces));
    }
    std::vector<Point> by_bytes, by_cost;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
        const Layout& layout = layouts[i];
        const double cost = costs.of(layout.name, "cost_cu");
        std::vector<std::string> row = {layout.name, std::to_string(bytesOf(layout.set)), decimals(cost, 2)};
        LitError worst;
        for (std::size_t s = 0; s < scenes.size(); ++s) {
            const LitError& error = errors[s * layouts.size() + i];
            row.push_back(decimals(error.percent, 3));
            worst.percent = std::max(worst.percent, error.percent);
            worst.rmse = std::max(worst.rmse, error.rmse);
        }
        row.insert(row.end(), {decimals(worst.rmse, 3), layout.mark});
        table.rows.push_back(row);
        by_bytes.push_back({layout.name, "", double(bytesOf(layout.set)), worst.percent, layout.mark});
        by_cost.push_back({layout.name, "", cost, worst.rmse, layout.mark});
        by_bytes.back().settings = by_cost.back().settings = layout.set;
    }
    writeCsv(folder / "gbuffer.csv", table);
    const std::string measured = "worst of four views of the yard at 320x240, against 32-bit floats";
    drawChart(folder / "gbuffer_bytes.svg",
              {.title = "G-buffers: how many bytes before no pixel shows it?",
               .subtitle = measured,
               .x = "bytes per pixel, depth included",
               .y = "lit pixels off by more than 1/255, %",
               .log_y = true,
               .floor = 0.01,
               .rung = rung},
              by_bytes);
    drawChart(folder / "gbuffer_cost.svg",
              {.title = "G-buffers: does packing cost more than it saves?",
               .subtitle = measured,
               .x = "cost of the frame in copies (cu)",
               .y = "RMSE of lit pixels, codes of 255",
               .log_y = true,
               .floor = 0.01,
               .rung = rung},
              by_cost);
    drawNormals(programs, folder);
}

} // namespace gll::charts::gbuffer
