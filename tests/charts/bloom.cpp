// Bloom filters against exact convolution: how much a response depends on where the light is, whether light
// is lost or made, how round it is, and what a person would see.
#include "charts/bloom.hpp"

#include "charts/frames.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "truth/convolution.hpp"

#include <cmath>
#include <cstdio>
#include <random>

namespace gll::charts {
namespace {

namespace fs = std::filesystem;
using truth::ColorImage;
using truth::ScalarImage;

// A copy is the unit, so that a quarter or a sixteenth of 1280x720 gives the same figures to a few
// hundredths; under callgrind, ten full-resolution passes take minutes otherwise.
constexpr glm::ivec2 pyramid_cost_size{640, 360};
constexpr glm::ivec2 gaussian_cost_size{320, 180};
constexpr glm::ivec2 scene_size{480, 270};
constexpr double emitter = 1000;
// What a picture gets of its bloom: enough to see, as in the rungs' defaults.
constexpr double bloom_strength = 0.25;

struct Method {
    std::string name;
    std::string dial;
    std::string mark;
    Set set;
    std::string rung = "04_pyramid_bloom";
    int period_px = 32; // the response repeats when the light moves by so much
    int adding = 1;     // how many levels add their light
};

bool isPyramid(const Method& method) { return method.rung == "04_pyramid_bloom"; }

std::vector<Method> methods() {
    std::vector<Method> list;
    const auto pyramid = [&](const std::string& name, const std::string& down, const std::string& up,
                             const std::vector<int>& levels, const std::string& blur = "none") {
        for (const int count : levels) {
            const bool spline = down == "spline";
            Method method{.name = name,
                          .dial = "levels " + std::to_string(count),
                          .mark = {},
                          .set = {{"down_filter", down},
                                  {"up_filter", up},
                                  {"blur", blur},
                                  {"levels", std::to_string(count)},
                                  {"threshold", "0"},
                                  {"karis", "none"},
                                  {"finest", spline ? "off" : "on"},
                                  {"normalise", "on"}},
                          .period_px = 1 << count,
                          .adding = spline ? count - 1 : count};
            if (count == 5 && name == "5 taps, tent") method.mark = "seed 000";
            if (count == 5 && blur == "gaussian") method.mark = "seed 001";
            if (count == 5 && spline) method.mark = "recommended";
            list.push_back(method);
        }
    };
    pyramid("spline by area, spline", "spline", "spline", {3, 4, 5, 6});
    pyramid("13 taps, tent", "13tap", "tent", {3, 4, 5, 6});
    pyramid("13 taps, Gaussian, tent", "13tap", "tent", {4, 5}, "gaussian");
    pyramid("5 taps, tent", "5tap", "tent", {3, 4, 5, 6});
    pyramid("[1 3 3 1], tent", "4tap", "tent", {3, 4, 5, 6});
    pyramid("13 taps, 4 taps", "13tap", "4tap", {4, 5, 6});
    pyramid("5 taps, dual filter", "5tap", "dual", {4, 5, 6});
    pyramid("box, bilinear", "box", "bilinear", {4, 5, 6});
    const auto gaussian = [&](const std::string& name, const std::string& dial, Set set, int period,
                              const std::string& mark = "") {
        set["threshold"] = "1000";
        list.push_back({name, dial, mark, std::move(set), "03_gaussian_bloom", period});
    };
    for (const int iterations : {5, 20})
        gaussian("ping-pong, 9 taps", "iterations " + std::to_string(iterations),
                 {{"blur", "ping_pong_9tap"}, {"iterations", std::to_string(iterations)}}, 1,
                 iterations == 5 ? "seed 003" : "");
    for (const int iterations : {5, 20})
        gaussian("ping-pong, 5 fetches", "iterations " + std::to_string(iterations),
                 {{"blur", "ping_pong_5fetch"}, {"iterations", std::to_string(iterations)}}, 1);
    for (const int iterations : {5, 20})
        gaussian("half resolution, 5 taps", "iterations " + std::to_string(iterations),
                 {{"blur", "half_resolution_5tap"}, {"iterations", std::to_string(iterations)}}, 2,
                 iterations == 5 ? "seed 004" : "");
    for (const int sigma : {8, 16})
        gaussian("one wide Gaussian", "sigma " + std::to_string(sigma),
                 {{"blur", "wide_gaussian"}, {"sigma", std::to_string(sigma)}}, 1);
    return list;
}

std::string key(const Method& method) { return method.name + ", " + method.dial; }

// Where a method leaves its bloom. Splines give small frames one of the frame's own size.
std::string bloomTarget(const Method& method, glm::ivec2 size) {
    if (!isPyramid(method)) return "blurred";
    return method.set.at("down_filter") == "spline" && std::min(size.x, size.y) < 64 ? "bloom" : "bloom0";
}

// The part of the light that a method's numbers leave to a strength: pyramids only add.
double gain(const Method& method) { return method.adding; }

// What a method takes to lie beyond the edges.
truth::Edge edgeOf(const Method& method) {
    return isPyramid(method) && method.set.at("down_filter") == "spline" ? truth::Edge::mirror
                                                                         : truth::Edge::clamp;
}

struct Errors {
    double sigma_px = 0;
    double shift_variance = 0;
    double energy_error = 0;
    double squareness = 0;
    double flip[3] = {}; // mean HDR-FLIP: swarm, lights, hall
};

double sum(const ColorImage& image) {
    double total = 0;
    for (const glm::dvec3& color : image.pixels)
        total += color.g;
    return total;
}

// The distance at which a response has fallen to a tenth of its middle: along the diagonals over along the
// axes.
double diagonalOverAxis(const ScalarImage& response) {
    const int x = response.width / 2;
    const int y = response.height / 2;
    const double tenth = response.at(x, y) / 10;
    const auto radius = [&](int dx, int dy) {
        double before = response.at(x, y);
        for (int i = 1; i < x; ++i) {
            const double here = response.at(x + i * dx, y + i * dy);
            if (here < tenth) return (i - 1 + (before - tenth) / (before - here)) * std::hypot(dx, dy);
            before = here;
        }
        return 0.0;
    };
    const double axis = radius(1, 0) + radius(-1, 0) + radius(0, 1) + radius(0, -1);
    const double diagonal = radius(1, 1) + radius(-1, 1) + radius(1, -1) + radius(-1, -1);
    return diagonal / axis;
}

class Bench {
  public:
    Bench(const fs::path& programs, const std::vector<Method>& list)
        : programs_(programs), list_(list), responses_(list.size()) {
        writeExr(folder_ / "black.exr", ColorImage(16, 16));
        makeScenes();
    }

    std::vector<Errors> measure() {
        std::vector<Errors> errors(list_.size());
        for (const char* rung : {"04_pyramid_bloom", "03_gaussian_bloom"})
            measureResponses(rung, errors);
        for (int scene = 0; scene < 3; ++scene)
            measureScene(scene, errors);
        sayProgress("");
        return errors;
    }

  private:
    std::vector<std::string> blackScene(const std::string& rung) const {
        return rung == "04_pyramid_bloom"
                   ? std::vector<std::string>{"--image", (folder_ / "black.exr").string()}
                   : std::vector<std::string>{};
    }

    // One light of 1000 in the dark.
    static std::size_t askEmitter(Frames& frames, const Method& method, glm::ivec2 size, glm::ivec2 place) {
        const std::string where = ":" + std::to_string(place.x) + "," + std::to_string(place.y) + ":" +
                                  std::to_string(int(emitter));
        return frames.ask(method.set, size, bloomTarget(method, size),
                          (isPyramid(method) ? "scene" : "bright") + where);
    }

    void measureResponses(const std::string& rung, std::vector<Errors>& errors) {
        for (std::size_t m = 0; m < list_.size(); ++m) {
            const Method& method = list_[m];
            if (method.rung != rung) continue;
            sayProgress("responses: " + key(method));
            Frames frames(programs_ / rung, blackScene(rung));
            // Over one period along a row and along a column, about the middle.
            const int side = std::max(256, 8 * method.period_px);
            const glm::ivec2 size(side);
            const int middle = side / 2;
            std::vector<glm::ivec2> shifts;
            std::vector<std::size_t> shifted;
            for (const glm::ivec2 direction : {glm::ivec2(1, 0), {0, 1}})
                for (int i = 0; i < method.period_px; ++i) {
                    shifts.push_back(direction * (i - method.period_px / 2));
                    shifted.push_back(askEmitter(frames, method, size, middle + shifts.back()));
                }
            std::mt19937 random(1); // its sequence is the standard's, the same everywhere
            std::vector<std::size_t> sized;
            for (const glm::ivec2 frame_size : {glm::ivec2(2, 2),
                                                {3, 3},
                                                {3, 5},
                                                {5, 5},
                                                {7, 9},
                                                {12, 17},
                                                {23, 31},
                                                {33, 47},
                                                {63, 64},
                                                {65, 97},
                                                {100, 101},
                                                {127, 129},
                                                {201, 255},
                                                {256, 257},
                                                {333, 300},
                                                {500, 500},
                                                {641, 479},
                                                {1023, 768}})
                for (int i = 0; i < 3; ++i) {
                    const int x = static_cast<int>(random() % static_cast<unsigned>(frame_size.x));
                    const int y = static_cast<int>(random() % static_cast<unsigned>(frame_size.y));
                    sized.push_back(askEmitter(frames, method, frame_size, {x, y}));
                    sizes_.push_back(frame_size);
                }
            frames.run();

            std::vector<ColorImage> responses;
            for (const std::size_t frame : shifted)
                responses.push_back(resized(frames.read(frame), side, side));
            const auto half = static_cast<std::ptrdiff_t>(method.period_px);
            const auto variance = [&](std::ptrdiff_t from) {
                return truth::shiftVariance({responses.begin() + from, responses.begin() + from + half},
                                            {shifts.begin() + from, shifts.begin() + from + half},
                                            method.period_px)
                    .mean;
            };
            errors[m].shift_variance = (variance(0) + variance(half)) / 2;
            // Their mean, moved back to the middle.
            ScalarImage mean(side, side);
            for (std::size_t i = 0; i < responses.size(); ++i)
                for (int y = 0; y < side; ++y)
                    for (int x = 0; x < side; ++x) {
                        const glm::ivec2 from = glm::ivec2(x, y) + shifts[i];
                        if (from.x >= 0 && from.y >= 0 && from.x < side && from.y < side)
                            mean.at(x, y) += responses[i].at(from.x, from.y).g / double(responses.size());
                    }
            errors[m].sigma_px = std::sqrt(truth::moments(mean).variance_px2());
            errors[m].squareness = std::abs(diagonalOverAxis(mean) - 1);
            const double whole = truth::moments(mean).sum;
            for (double& value : mean.pixels)
                value /= whole;
            responses_[m] = mean;
            for (std::size_t i = 0; i < sized.size(); ++i) {
                const glm::ivec2 frame_size = sizes_[i];
                const double light = sum(resized(frames.read(sized[i]), frame_size.x, frame_size.y));
                errors[m].energy_error =
                    std::max(errors[m].energy_error, std::abs(light / (emitter * gain(method)) - 1));
            }
            sizes_.clear();
        }
    }

    // Three pictures in linear light: the swarm, one-pixel lights, and a hall, as photographs are.
    void makeScenes() {
        const auto render = [&](const char* rung) {
            Frames frames(programs_ / rung);
            const std::size_t frame = frames.ask({}, scene_size, "hdr");
            frames.run();
            return frames.read(frame);
        };
        scenes_.push_back(render("05_hdr_bloom"));
        ColorImage lights(scene_size.x, scene_size.y, glm::dvec3(0.01));
        std::mt19937 random(2);
        for (int i = 0; i < 60; ++i) {
            const int x = static_cast<int>(random() % static_cast<unsigned>(scene_size.x));
            const int y = static_cast<int>(random() % static_cast<unsigned>(scene_size.y));
            const double light = std::pow(10, 1 + 2 * double(random() % 1000) / 1000);
            lights.at(x, y) = light * glm::dvec3(1, 0.4 + 0.2 * (i % 3), 0.2 + 0.3 * (i % 4));
        }
        scenes_.push_back(lights);
        scenes_.push_back(render("01_hdr"));
    }

    void measureScene(int scene, std::vector<Errors>& errors) {
        const ColorImage& light = scenes_[static_cast<std::size_t>(scene)];
        const fs::path file = folder_ / "scene.exr";
        writeExr(file, light);
        for (const char* rung : {"04_pyramid_bloom", "03_gaussian_bloom"}) {
            Frames frames(programs_ / rung, {"--image", file.string()});
            std::vector<std::size_t> asked;
            for (const Method& method : list_)
                if (method.rung == rung) {
                    Set set = method.set;
                    set["threshold"] = "0"; // everything blooms
                    asked.push_back(frames.ask(set, scene_size, bloomTarget(method, scene_size)));
                }
            frames.run();
            std::size_t next = 0;
            for (std::size_t m = 0; m < list_.size(); ++m) {
                const Method& method = list_[m];
                if (method.rung != rung) continue;
                sayProgress("scene " + std::to_string(scene + 1) + " of 3: " + key(method));
                const ColorImage bloom = resized(frames.read(asked[next++]), scene_size.x, scene_size.y);
                const ColorImage truth = truth::convolved(light, responses_[m], edgeOf(method));
                const auto withBloom = [&](const ColorImage& added, double strength) {
                    ColorImage picture = light;
                    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
                        picture.pixels[i] += added.pixels[i] * strength;
                    return picture;
                };
                errors[m].flip[scene] =
                    truth::summary(truth::hdrFlip(withBloom(bloom, bloom_strength / gain(method)),
                                                  withBloom(truth, bloom_strength))
                                       .map)
                        .mean;
            }
        }
    }

    const fs::path programs_;
    const std::vector<Method>& list_;
    test::TemporaryFolder folder_;
    std::vector<ScalarImage> responses_; // of each method: its mean over all places, sum 1
    std::vector<ColorImage> scenes_;
    std::vector<glm::ivec2> sizes_;
};

} // namespace

void measureBloomCosts(const fs::path& programs, const fs::path& csv) {
    Table table{{"method", "cost_cu"}, {}};
    const std::vector<Method> list = methods();
    for (const std::string rung : {"04_pyramid_bloom", "03_gaussian_bloom"}) {
        std::vector<Set> sets;
        for (const Method& method : list)
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
        for (const Method& method : list) {
            if (method.rung != rung) continue;
            double cu = fetch_cu;
            for (const auto& pass : reports[next].at("passes")) {
                const std::string name = pass.at("name");
                for (const char* prefix : {"bright", "down", "blur", "up", "horizontal", "vertical", "half"})
                    if (name.starts_with(prefix)) {
                        cu += pass.at("cu").get<double>();
                        break;
                    }
            }
            ++next;
            char text[32];
            std::snprintf(text, sizeof text, "%.2f", cu);
            table.rows.push_back({key(method), text});
        }
    }
    writeCsv(csv, table);
}

void drawBloomCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    const std::vector<Method> list = methods();
    std::map<std::string, double> cost;
    for (const auto& row : readCsv(costs_csv).rows)
        cost[row[0]] = std::stod(row[1]);
    const std::vector<Errors> errors = Bench(programs, list).measure();

    Table table{{"method", "dial", "sigma px", "cost cu", "shift variance", "energy error", "squareness",
                 "HDR-FLIP swarm", "HDR-FLIP lights", "HDR-FLIP hall", "note"},
                {}};
    std::vector<Point> shift, energy, flip;
    std::string missed;
    for (std::size_t m = 0; m < list.size(); ++m) {
        const Method& method = list[m];
        const Errors& e = errors[m];
        if (!cost.contains(key(method)))
            throw std::runtime_error(costs_csv.string() + ": has no \"" + key(method) +
                                     "\"; measure the costs anew");
        const double cu = cost[key(method)];
        table.rows.push_back({method.name, method.dial, shortNumber(e.sigma_px), shortNumber(cu),
                              shortNumber(e.shift_variance), shortNumber(e.energy_error),
                              shortNumber(e.squareness), shortNumber(e.flip[0]), shortNumber(e.flip[1]),
                              shortNumber(e.flip[2]), method.mark});
        const auto point = [&](double error) {
            return Point{method.name, method.dial, cu, error, method.mark};
        };
        shift.push_back(point(100 * e.shift_variance));
        energy.push_back(point(100 * e.energy_error));
        flip.push_back(point((e.flip[0] + e.flip[1] + e.flip[2]) / 3));
        const auto promise = [&](const char* what, double value, double bound) {
            if (method.mark == "recommended" && !(value <= bound))
                missed += std::string(what) + " is " + shortNumber(value) + ", not at most " +
                          shortNumber(bound) + "; ";
        };
        promise("its shift variance", e.shift_variance, 0.02);
        promise("its energy error", e.energy_error, 0.005);
        promise("its squareness", e.squareness, 0.02);
        promise("its cost in copies", cu, 5);
    }
    writeCsv(folder / "bloom.csv", table);
    const std::string x = "cost, copies (cu)";
    drawChart(
        folder / "bloom_shift.svg",
        {"Bloom filters: does the glow depend on where the light is?", x, "shift variance, %", true, 0.001},
        shift);
    drawChart(folder / "bloom_energy.svg",
              {"Bloom filters: is light lost or made, from 2x2 to 1023x768?", x, "largest energy error, %",
               true, 0.01},
              energy);
    drawChart(folder / "bloom_flip.svg",
              {"Bloom filters: what would a person see, against exact convolution?", x,
               "mean HDR-FLIP over three scenes", true, 1e-4},
              flip);
    if (!missed.empty()) throw std::runtime_error("the recommended bloom misses its promise: " + missed);
}

} // namespace gll::charts
