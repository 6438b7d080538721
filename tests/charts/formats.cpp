// Formats: how many bytes a pixel of light needs before a person sees no difference, and before an
// eight-bit display shows none.
#include "charts/formats.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "measure/color.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "support/choices.hpp"

#include <set>
#include <string>
#include <vector>

namespace gll::charts::formats {
namespace {

namespace fs = std::filesystem;
using measure::ColorImage;

constexpr glm::ivec2 frame_size{640, 360};
constexpr int exposures_ev[] = {-5, 0, 5}; // the window, the hall, its dark corners

struct StorageFormat {
    std::string name;
    int bytes_per_pixel;
    std::string mark = {};
};
const std::vector<StorageFormat> formats = {{"rgba8", 4},
                                            {"rgb10_a2", 4},
                                            {"r11f_g11f_b10f", 4},
                                            {"rgba16f", 8, "the original of 01, recommended"},
                                            {"rgba32f", 16}};

void requireAllFormats(const fs::path& programs) {
    std::set<std::string> names;
    for (const StorageFormat& format : formats)
        names.insert(format.name);
    test::requireCovered(programs / "01_hdr", "format", names);
}

// From linear light to what eight bits hold, 0 to 255.
ColorImage codes(ColorImage image) {
    for (glm::dvec3& color : image.pixels)
        for (int c = 0; c < 3; ++c)
            color[c] = 255 * measure::srgbEncoded(color[c]);
    return image;
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    requireAllFormats(programs);
    std::vector<Set> sets;
    for (const StorageFormat& format : formats)
        sets.push_back({{"format", format.name}});
    const auto reports = costs(programs / "01_hdr", sets, frame_size);
    Table table{{"method", "cost_cu"}, {}};
    for (std::size_t i = 0; i < formats.size(); ++i)
        table.rows.push_back({formats[i].name, decimals(reports[i].at("sum_cu").get<double>(), 2)});
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requireAllFormats(programs);
    const Costs costs(costs_csv);
    Frames frames(programs / "01_hdr");
    for (const int ev : exposures_ev)
        for (const StorageFormat& format : formats)
            frames.ask({{"format", format.name}, {"exposure_ev", std::to_string(ev)}}, frame_size, "frame");
    frames.run();

    Table table{{"format", "exposure EV", "bytes/pixel", "cost cu", "RMSE codes", "FLIP mean", "note"}, {}};
    std::vector<Point> rmse, flip;
    std::size_t first = 0;
    for (const int ev : exposures_ev) {
        const ColorImage reference = frames.read(first + formats.size() - 1); // rgba32f
        std::string dial = ev > 0 ? "+" : "";
        dial += std::to_string(ev) + " EV";
        for (std::size_t i = 0; i < formats.size(); ++i) {
            const StorageFormat& format = formats[i];
            const std::string mark = ev == 0 ? format.mark : "";
            const ColorImage frame = frames.read(first + i);
            const double code_error = measure::rmse(codes(frame), codes(reference));
            const double flip_error = measure::summary(measure::flip(frame, reference)).mean;
            table.rows.push_back({format.name, std::to_string(ev), std::to_string(format.bytes_per_pixel),
                                  decimals(costs.of(format.name, "cost_cu"), 2), shortNumber(code_error),
                                  shortNumber(flip_error), format.mark});
            rmse.push_back({format.name, dial, double(format.bytes_per_pixel), code_error, mark});
            flip.push_back({format.name, dial, double(format.bytes_per_pixel), flip_error, mark});
            rmse.back().settings = flip.back().settings = Set{{"format", format.name}};
        }
        first += formats.size();
    }
    writeCsv(folder / "formats.csv", table);
    Axes axes{.title = "Formats: how far is the shown frame from the 32-bit one?",
              .subtitle = "640x360, tone_map=reinhard, exposure_ev = -5, 0 and 5",
              .x = "bytes per pixel",
              .y = "RMSE, codes of 255",
              .log_y = true,
              .floor = 0.01,
              .dial_is_given = true,
              .rung = "01_hdr"};
    drawChart(folder / "formats.svg", axes, rmse);
    axes.title = "Formats: what would a person see, against the 32-bit frame?";
    axes.y = "mean FLIP";
    axes.floor = 1e-4;
    drawChart(folder / "formats_flip.svg", axes, flip);
}

} // namespace gll::charts::formats
