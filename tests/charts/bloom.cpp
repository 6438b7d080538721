// Bloom filters against exact convolution: how much a response depends on where the light is, whether light
// is lost or made, how round it is, and what a person would see.
#include "charts/bloom.hpp"

#include "charts/bloom_errors.hpp"
#include "charts/chart.hpp"
#include "charts/spline_energy.hpp"

#include <cstddef>
#include <cstdio>
#include <stdexcept>

namespace gll::charts::bloom {
namespace {

namespace fs = std::filesystem;

// A copy is the unit, so that a quarter or a sixteenth of 1280x720 gives the same figures to a few
// hundredths; under callgrind, ten full-resolution passes take minutes otherwise.
constexpr glm::ivec2 pyramid_cost_size{640, 360};
constexpr glm::ivec2 gaussian_cost_size{320, 180};

// How far the width of a method that only has levels for a dial may be from compared_width_px. Wider is in
// its favor: the wider of two such pyramids is the steadier, and costs hardly more.
constexpr double most_narrower = 0.15;
constexpr double most_wider = 0.3;

// Whether a pass of 03 or 04 is part of the bloom and not of the scene or the display.
bool drawsBloom(const std::string& pass) {
    for (const char* beginning : {"bright", "down", "blur", "up", "horizontal", "vertical", "half"})
        if (pass.starts_with(beginning)) return true;
    return false;
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& csv) {
    requireAllBloomFilters(programs);
    Table table{{"method", "cost_cu"}, {}};
    const std::vector<ComparedBloom> list = comparedBlooms();
    for (const std::string rung : {"04_pyramid_bloom", "03_gaussian_bloom"}) {
        std::vector<Set> sets;
        for (const ComparedBloom& method : list)
            if (method.rung == rung) sets.push_back(method.set);
        // The fetch that adds the bloom: what the last pass of 05_hdr_bloom takes more with it than without.
        static double fetch_cu = 0;
        if (fetch_cu == 0) {
            const auto reports =
                costs(programs / "05_hdr_bloom", {{{"bloom", "on"}}, {{"bloom", "off"}}}, pyramid_cost_size);
            for (std::size_t i = 0; i < 2; ++i)
                for (const auto& pass : reports[i].at("passes"))
                    if (pass.at("name") == "composite")
                        fetch_cu += (i == 0 ? 1 : -1) * pass.at("cu").get<double>();
        }
        const auto reports =
            costs(programs / rung, sets, rung == "04_pyramid_bloom" ? pyramid_cost_size : gaussian_cost_size);
        std::size_t next = 0;
        for (const ComparedBloom& method : list) {
            if (method.rung != rung) continue;
            double cu = fetch_cu;
            for (const auto& pass : reports[next].at("passes"))
                if (drawsBloom(pass.at("name"))) cu += pass.at("cu").get<double>();
            ++next;
            char text[32];
            std::snprintf(text, sizeof text, "%.2f", cu);
            table.rows.push_back({key(method), text});
        }
    }
    writeCsv(csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requireAllBloomFilters(programs);
    const std::vector<ComparedBloom> list = comparedBlooms();
    const Costs costs(costs_csv);
    const std::vector<BloomErrors> errors = bloomErrors(programs, list);

    Table table{{"method", "dial", "width px", "cost cu", "shift variance %", "inner energy error %",
                 "energy error %", "squareness %", "HDR-FLIP swarm", "HDR-FLIP lights", "HDR-FLIP hall",
                 "HDR-FLIP to mixture", "note"},
                {}};
    Table goals{{"the recommended bloom's", "at most", "is"}, {}};
    std::vector<Point> shift, energy, flip;
    std::string missed;
    const auto promise = [&](const std::string& what, double value, double bound) {
        if (!(value <= bound))
            missed += what + " is " + shortNumber(value) + ", not at most " + shortNumber(bound) + "; ";
    };
    for (std::size_t m = 0; m < list.size(); ++m) {
        const ComparedBloom& method = list[m];
        const BloomErrors& e = errors[m];
        const double cu = costs.of(key(method), "cost_cu");
        const auto ifCompared = [&](double value) {
            return method.competes() ? shortNumber(value) : std::string();
        };
        table.rows.push_back({method.name, method.dial, shortNumber(e.sigma_px),
                              decimals(cu, cu < 100 ? 2 : 0), shortNumber(100 * e.shift_variance),
                              ifCompared(100 * e.inner_energy_error), ifCompared(100 * e.energy_error),
                              shortNumber(100 * e.squareness), shortNumber(e.flip[0]), shortNumber(e.flip[1]),
                              shortNumber(e.flip[2]), ifCompared(e.mixture_flip), method.mark});
        Set own = method.set; // without what all have, for their equal terms
        for (const char* name : {"threshold", "karis", "normalise"})
            own.erase(name);
        // What is drawn is what the table says, to the same digits.
        const auto point = [&](const std::string& dial, double error) {
            return Point{method.name,
                         dial,
                         cu,
                         std::stod(shortNumber(error)),
                         method.mark,
                         method.competes(),
                         method.finestAdds(),
                         own,
                         method.rung};
        };
        if (method.competes() || !method.mark.empty()) {
            shift.push_back(point("", 100 * e.shift_variance));
            flip.push_back(point("", (e.flip[0] + e.flip[1] + e.flip[2]) / 3));
        }
        if (method.competes() && !method.finestAdds()) {
            energy.push_back(point("inside", 100 * e.inner_energy_error));
            energy.back().mark = "";
            energy.push_back(point("anywhere", 100 * e.energy_error));
        }
        if (method.competes()) {
            const std::string width = "the width of " + key(method) + ", px,";
            promise(width, e.sigma_px, method.width_px * (1 + most_wider));
            promise("less " + width, -e.sigma_px, -method.width_px * (1 - most_narrower));
        }
        if (method.mark != recommended) continue;
        const auto goal = [&](const std::string& what, double value, double bound) {
            goals.rows.push_back({what, shortNumber(bound), shortNumber(value)});
            promise("the recommended bloom's " + what, value, bound);
        };
        const double exact = largestSplineEnergyError(method.levels, 2048);
        goal("shift variance, %", 100 * e.shift_variance, 2);
        goal("energy error of the lights that were rendered, %", 100 * e.energy_error, 0.5);
        goal("energy error in exact arithmetic, any place in any frame from 2x2 to 2048x2048, %", 100 * exact,
             0.5);
        goal("the same, and the most that rendering added to it, %", 100 * (exact + e.rounding), 0.5);
        goal("squareness, %", 100 * e.squareness, 2);
        goal("cost, copies", cu, 5);
    }
    writeCsv(folder / "bloom_goals.csv", goals);
    writeCsv(folder / "bloom.csv", table);
    const std::string x = "cost, copies (cu)";
    const std::string others = "small: at other widths";
    const std::string hollow = "hollow: finest=on, full: off";
    const std::string terms = "18 px wide, threshold=0 karis=none normalise=on; ";
    const std::string costs_at = "cost at 640x360 (Gaussians 320x180)";
    drawChart(folder / "bloom_shift.svg",
              {.title = "Bloom: does the glow change with the place of its light?",
               .subtitle = terms + "square frames; " + costs_at,
               .x = x,
               .y = "shift variance, %",
               .log_y = true,
               .floor = 0.1,
               .log_x = true,
               .others = others,
               .hollow = hollow},
              shift);
    drawChart(folder / "bloom_energy.svg",
              {.title = "Bloom: is light lost or made, in frames of any size?",
               .subtitle = "18 px wide, threshold=0 normalise=on finest=off; 18 frame sizes; " + costs_at,
               .x = x,
               .y = "largest energy error, %",
               .log_y = true,
               .floor = 0.01,
               .dial_is_given = true,
               .log_x = true},
              energy);
    drawChart(folder / "bloom_flip.svg",
              {.title = "Bloom: what would a person see, against exact convolution?",
               .subtitle = terms + "frames of 512x384; " + costs_at,
               .x = x,
               .y = "mean HDR-FLIP over three scenes",
               .log_y = true,
               .floor = 1e-3,
               .log_x = true,
               .others = others,
               .hollow = hollow},
              flip);
    if (!missed.empty()) throw std::runtime_error("bloom: " + missed);
}

} // namespace gll::charts::bloom
