// Tone maps: what a curve does to hue, how far it is from the film rendering that some of them are fits to,
// and whether more light ever comes out as less.
#include "charts/tone.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "measure/color.hpp"
#include "support/choices.hpp"
#include "truth/aces.hpp"
#include "truth/tone_reference.hpp"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::charts {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 cost_size{640, 360};

struct Curve {
    std::string tone_map;
    double white_point = 4; // luminance; for reinhard_extended
    std::string dial = {};
    std::string mark = {};

    glm::dvec3 operator()(const glm::dvec3& linear_color) const {
        return truth::toneMapped(tone_map, linear_color, white_point);
    }
    Set settings() const {
        if (dial.empty()) return {{"tone_map", tone_map}};
        return {{"tone_map", tone_map}, {"white_point", shortNumber(white_point)}};
    }
};

std::vector<Curve> curves(const fs::path& programs) {
    std::vector<Curve> list;
    for (const std::string& name : test::choicesOf(programs / "01_hdr", "tone_map"))
        if (name == "reinhard_extended")
            for (const int white_point : {1, 2, 4, 8, 16})
                list.push_back({name, double(white_point), "white " + std::to_string(white_point)});
        else
            list.push_back({name, 4, "",
                            name == "reinhard"      ? "the original of 01"
                            : name == "pbr_neutral" ? "recommended"
                                                    : ""});
    return list;
}

// Colours whose brightest channel is 1: twelve hues, 30 degrees of HSV apart, each as a pure colour and with
// a floor under its channels that leaves nine tenths and half of it; and four a person would check first.
std::vector<glm::dvec3> colors() {
    std::vector<glm::dvec3> list;
    for (const double floor : {0.0, 0.1, 0.5})
        for (int hue = 0; hue < 12; ++hue) {
            const auto channel = [&](int offset) {
                const double distance = std::abs(((hue + offset) % 12) / 2.0 - 3) - 1;
                return floor + (1 - floor) * truth::saturated(distance);
            };
            list.emplace_back(channel(0), channel(8), channel(4));
        }
    list.emplace_back(1, 0.125, 0.025); // ember: (8, 1, 0.2) three stops down
    list.emplace_back(1, 0.62, 0.48);   // skin
    list.emplace_back(0.30, 0.55, 1);   // sky
    list.emplace_back(0.42, 1, 0.15);   // leaves
    return list;
}

constexpr int first_stop = -6;
constexpr int last_stop = 8;

// Each of them from six stops down to eight stops up.
std::vector<glm::dvec3> sweep() {
    std::vector<glm::dvec3> list;
    for (const glm::dvec3& color : colors())
        for (int stop = first_stop; stop <= last_stop; ++stop)
            list.push_back(color * std::exp2(stop));
    return list;
}

// From linear scene light to linear display light, colour by colour.
using Rendering = std::function<std::vector<glm::dvec3>(std::vector<glm::dvec3>)>;

Rendering by(const Curve& curve) {
    return [curve](std::vector<glm::dvec3> colors) {
        for (glm::dvec3& color : colors)
            color = curve(color);
        return colors;
    };
}

struct HueError {
    double mean_deg = 0;
    double largest_deg = 0;
    double lab_mean_deg = 0; // the same angles in CIELAB
    double washed_out = 0;   // share of colours that come out without a hue
};

// ICtCp's hue depends a little on how much light there is, and a change of light is no turn of hue: the input
// is compared at the luminance of the output. Colours that nobody could tell from a grey (delta E ITP below
// 1, BT.2124) have no hue any more and are counted instead.
HueError hueError(const Rendering& rendering) {
    const std::vector<glm::dvec3> scene = sweep();
    const std::vector<glm::dvec3> display = rendering(scene);
    HueError error;
    int with_hue = 0;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        const double luminance = measure::luminance709(display[i]);
        if (measure::deltaEItp(measure::ictcp(display[i]), measure::ictcp(glm::dvec3(luminance))) < 1)
            continue;
        const measure::ColorDifference difference =
            measure::colorDifference(scene[i] * (luminance / measure::luminance709(scene[i])), display[i]);
        const double angle_deg = difference.ictcp_hue_deg.value();
        error.mean_deg += angle_deg;
        error.lab_mean_deg += difference.lab_hue_deg.value();
        error.largest_deg = std::max(error.largest_deg, angle_deg);
        ++with_hue;
    }
    error.mean_deg /= with_hue;
    error.lab_mean_deg /= with_hue;
    error.washed_out = 1 - with_hue / double(scene.size());
    return error;
}

struct AcesDistance {
    double as_it_is = 0; // mean delta E ITP
    double at_best = 0;  // the same with the exposure that brings the curve nearest
    double best_ev = 0;
};

AcesDistance acesDistance(const Curve& curve, const std::vector<glm::dvec3>& scene,
                          const std::vector<glm::dvec3>& aces_itp) {
    const auto at = [&](double ev) {
        double total = 0;
        for (std::size_t i = 0; i < scene.size(); ++i)
            total += measure::deltaEItp(measure::ictcp(curve(scene[i] * std::exp2(ev))), aces_itp[i]);
        return total / double(scene.size());
    };
    AcesDistance distance{.as_it_is = at(0), .at_best = at(0), .best_ev = 0};
    for (int tenth = -30; tenth <= 30; ++tenth)
        if (const double here = at(tenth / 10.0); here < distance.at_best) {
            distance.at_best = here;
            distance.best_ev = tenth / 10.0;
        }
    return distance;
}

// Below what 16 bits can show. OpenColorIO computes in float32 with tables.
constexpr double noticeable_fall = 1e-6;

struct GreyScale {
    double largest_fall = 0; // of the output where the input grows
    double range_ev = 0; // from where the first code above black is shown to where the last below white is
    double largest = 0;
    double mid_grey = 0; // what 0.18 becomes
};

GreyScale greyScale(const Rendering& rendering) {
    GreyScale grey;
    const double black = measure::srgbDecoded(0.5 / 255);
    const double white = measure::srgbDecoded(254.5 / 255);
    constexpr int steps_per_stop = 1000;
    std::vector<glm::dvec3> ramp;
    for (int i = -24 * steps_per_stop; i <= 16 * steps_per_stop; ++i)
        ramp.emplace_back(std::exp2(double(i) / steps_per_stop));
    int shown_stops = 0;
    double highest = 0;
    for (const glm::dvec3& shown : rendering(ramp)) {
        grey.largest_fall = std::max(grey.largest_fall, highest - shown.g);
        highest = std::max(highest, shown.g);
        if (shown.g >= black && shown.g < white) ++shown_stops;
    }
    grey.range_ev = double(shown_stops) / steps_per_stop;
    grey.mid_grey = rendering({glm::dvec3(0.18)})[0].g;
    grey.largest = highest;
    for (const glm::dvec3& shown : rendering(sweep()))
        grey.largest = std::max({grey.largest, shown.r, shown.g, shown.b});
    return grey;
}

// The columns of the table that need no cost, in its order.
std::vector<std::string> figures(const HueError& hue, const AcesDistance& aces, const GreyScale& grey) {
    return {decimals(hue.mean_deg, 2),      decimals(hue.largest_deg, 1),
            decimals(hue.lab_mean_deg, 2),  decimals(100 * hue.washed_out, 1),
            decimals(aces.as_it_is, 1),     decimals(aces.at_best, 1),
            decimals(aces.best_ev, 1),      grey.largest_fall > noticeable_fall ? "no" : "yes",
            shortNumber(grey.largest_fall), decimals(grey.range_ev, 1),
            decimals(grey.largest, 3),      decimals(grey.mid_grey, 3)};
}

} // namespace

ToneFigures toneFigures(const std::string& tone_map) {
    const Rendering rendering = by({tone_map});
    const HueError hue = hueError(rendering);
    const GreyScale grey = greyScale(rendering);
    return {hue.mean_deg, hue.largest_deg, grey.largest_fall, grey.largest};
}

void measureToneCosts(const fs::path& programs, const fs::path& costs_csv) {
    std::vector<std::string> names;
    std::vector<Set> sets;
    for (const Curve& curve : curves(programs))
        if (names.empty() || names.back() != curve.tone_map) {
            names.push_back(curve.tone_map);
            sets.push_back({{"tone_map", curve.tone_map}});
        }
    const auto reports = costs(programs / "01_hdr", sets, cost_size);
    const auto display = [&](std::size_t i, const char* what) {
        for (const auto& pass : reports[i].at("passes"))
            if (pass.at("name") == "display") return pass.at(what).get<double>();
        throw std::runtime_error("01_hdr has no pass \"display\"");
    };
    Table table{{"method", "cost_cu", "instructions_per_pixel"}, {}};
    for (std::size_t i = 0; i < names.size(); ++i) // the first is clamp
        table.rows.push_back({names[i], decimals(display(i, "cu") - display(0, "cu"), 2),
                              decimals(display(i, "per_pixel") - display(0, "per_pixel"), 1)});
    writeCsv(costs_csv, table);
}

void drawToneCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    const Costs costs(costs_csv);
    std::vector<glm::dvec3> scene = sweep();
    for (int stop = first_stop; stop <= last_stop; ++stop)
        scene.emplace_back(std::exp2(stop));
    std::vector<glm::dvec3> aces_itp;
    for (const glm::dvec3& color : truth::acesDisplayLight(scene))
        aces_itp.push_back(measure::ictcp(color));

    Table table{{"tone map", "dial", "instructions/pixel", "cost cu", "hue error mean deg",
                 "hue error max deg", "CIELAB hue error mean deg", "washed out %", "delta E ITP to ACES",
                 "delta E ITP at best exposure", "best exposure EV", "monotonic in grey", "largest fall",
                 "range EV", "largest output", "18 % grey becomes", "note"},
                {}};
    std::vector<Point> hue, aces;
    for (const Curve& curve : curves(programs)) {
        const HueError turned = hueError(by(curve));
        const AcesDistance distance = acesDistance(curve, scene, aces_itp);
        const double instructions = costs.of(curve.tone_map, "instructions_per_pixel");
        std::vector<std::string> row = {curve.tone_map, curve.dial, decimals(instructions, 1),
                                        decimals(costs.of(curve.tone_map, "cost_cu"), 2)};
        for (const std::string& cell : figures(turned, distance, greyScale(by(curve))))
            row.push_back(cell);
        row.push_back(curve.mark);
        table.rows.push_back(row);
        hue.push_back({curve.tone_map, curve.dial, instructions, turned.mean_deg, curve.mark});
        aces.push_back({curve.tone_map, curve.dial, instructions, distance.at_best, curve.mark});
        hue.back().settings = aces.back().settings = curve.settings();
    }
    // What the fits are fits to: no program's tone map, so without a cost.
    std::vector<std::string> film = {"ACES RRT + ODT", "", "", ""};
    for (const std::string& cell :
         figures(hueError(truth::acesDisplayLight), {}, greyScale(truth::acesDisplayLight)))
        film.push_back(cell);
    film.emplace_back("the reference");
    table.rows.push_back(film);
    writeCsv(folder / "tone.csv", table);
    Axes axes{.title = "Tone maps: do colours keep their hue?",
              .subtitle = "40 colours, each from 6 stops down to 8 up; cost of the display pass at 640x360",
              .x = "instructions per pixel, over those of clamp",
              .y = "mean hue error in ICtCp, degrees",
              .rung = "01_hdr"};
    drawChart(folder / "tone_hue.svg", axes, hue);
    axes.title = "Tone maps: how near to the ACES film rendering?";
    axes.y = "mean delta E ITP, each at its best exposure";
    drawChart(folder / "tone_aces.svg", axes, aces);
}

} // namespace gll::charts
