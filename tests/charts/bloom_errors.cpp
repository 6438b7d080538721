// Sends lights and pictures through every bloom and compares what comes out with exact convolution.
#include "charts/bloom_errors.hpp"

#include "charts/spline_energy.hpp"
#include "charts/table.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "truth/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace gll::charts {
namespace {

namespace fs = std::filesystem;
using measure::ColorImage;
using measure::ScalarImage;

// Divided by 64 without a rest: these pictures are about filters, the sizes below about sizes.
constexpr glm::ivec2 scene_size{320, 192};
// Black around the pictures, 5 widths and more: what a method takes to lie beyond the edges, some clamp and
// some mirror, is none of its filter's doing.
constexpr int scene_margin_px = 96;
constexpr glm::ivec2 framed_size = scene_size + 2 * scene_margin_px;
constexpr double emitter = 1000;
// What a picture gets of its bloom: enough to see, as in the rungs' defaults.
constexpr double bloom_strength = 0.25;

// The glow a pyramid is after, tight and wide at once: a Gaussian a level, each twice as wide as the one
// before, with as much light.
const truth::GaussianMixture wanted_glow{{{0.25, 1}, {0.25, 2}, {0.25, 4}, {0.25, 8}}};

double sum(const ColorImage& image) {
    double total = 0;
    for (const glm::dvec3& color : image.pixels)
        total += color.g;
    return total;
}

double arriving(const ColorImage& bloom, const ComparedBloom& method) {
    return sum(bloom) / (emitter * method.gain());
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

// A light that is sent through a method.
struct Light {
    glm::ivec2 size; // of the frame
    glm::ivec2 place;
    bool inner; // far from the edges
};

// Lights in frames of all kinds of sizes, three a size: two anywhere, one far from the edges where the size
// has such a place. A blur at full resolution knows no odd size, and takes long: small frames do.
std::vector<Light> lightsFor(const ComparedBloom& method) {
    constexpr int far_px = 96; // 5 sigmas of the whole, 3 of a pyramid's widest level
    std::mt19937 random(1);    // its sequence is the standard's, the same everywhere
    std::vector<Light> lights;
    for (const glm::ivec2 size : {glm::ivec2(2, 2),
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
            const int margin = i == 2 && std::min(size.x, size.y) > 2 * far_px ? far_px : 0;
            const glm::uvec2 room(size - 2 * margin);
            const int x = margin + static_cast<int>(random() % room.x);
            const int y = margin + static_cast<int>(random() % room.y);
            if (method.period_px > 1 || size.x < 100) lights.push_back({size, {x, y}, margin > 0});
        }
    return lights;
}

class Bench {
  public:
    Bench(const fs::path& programs, const std::vector<ComparedBloom>& list)
        : programs_(programs), list_(list), errors_(list.size()), responses_(list.size()) {
        writeExr(folder_ / "black.exr", ColorImage(16, 16));
        makeScenes();
    }

    std::vector<BloomErrors> measure() {
        for (const char* rung : {"04_pyramid_bloom", "03_gaussian_bloom"}) {
            measureResponses(rung);
            measureEnergy(rung);
        }
        for (std::size_t scene = 0; scene < scenes_.size(); ++scene)
            measureScene(scene);
        sayProgress("");
        return errors_;
    }

  private:
    Frames blackFrames(const std::string& rung) const {
        return Frames(programs_ / rung, rung == "04_pyramid_bloom"
                                            ? std::vector<std::string>{"--image", folder_ / "black.exr"}
                                            : std::vector<std::string>{});
    }

    // One light of 1000 in the dark.
    static std::size_t askEmitter(Frames& frames, const ComparedBloom& method, glm::ivec2 size,
                                  glm::ivec2 place) {
        const std::string where = ":" + std::to_string(place.x) + "," + std::to_string(place.y) + ":" +
                                  std::to_string(int(emitter));
        return frames.ask(method.set, size, method.target(size), method.firstPass() + where);
    }

    // Over one period along a row and along a column, about the middle.
    void measureResponses(const std::string& rung) {
        struct Sweep {
            std::size_t method;
            int side;
            std::vector<glm::ivec2> shifts;
            std::vector<std::size_t> asked;
        };
        std::vector<Sweep> sweeps;
        Frames frames = blackFrames(rung);
        for (std::size_t m = 0; m < list_.size(); ++m) {
            const ComparedBloom& method = list_[m];
            if (method.rung != rung) continue;
            // Six widths to each side, and a multiple of the period, so that no level has an odd side.
            const int half_side =
                std::max(3, static_cast<int>(std::ceil(6 * method.width_px / method.period_px))) *
                method.period_px;
            Sweep sweep{m, 2 * half_side, {}, {}};
            for (const glm::ivec2 direction : {glm::ivec2(1, 0), {0, 1}})
                for (int i = 0; i < method.period_px; ++i) {
                    sweep.shifts.push_back(direction * (i - method.period_px / 2));
                    sweep.asked.push_back(askEmitter(frames, method, glm::ivec2(sweep.side),
                                                     sweep.side / 2 + sweep.shifts.back()));
                }
            sweeps.push_back(sweep);
        }
        sayProgress("responses: rendering with " + rung);
        frames.run();
        for (const Sweep& sweep : sweeps) {
            const ComparedBloom& method = list_[sweep.method];
            BloomErrors& errors = errors_[sweep.method];
            sayProgress("responses: " + key(method));
            std::vector<ColorImage> responses;
            for (const std::size_t frame : sweep.asked)
                responses.push_back(resized(frames.read(frame), sweep.side, sweep.side));
            const auto half = static_cast<std::ptrdiff_t>(method.period_px);
            const auto variance = [&](std::ptrdiff_t from) {
                return measure::shiftVariance(
                           {responses.begin() + from, responses.begin() + from + half},
                           {sweep.shifts.begin() + from, sweep.shifts.begin() + from + half},
                           method.period_px)
                    .mean;
            };
            errors.shift_variance = (variance(0) + variance(half)) / 2;
            const ScalarImage mean = meanResponse(responses, sweep.shifts);
            errors.sigma_px = std::sqrt(truth::moments(mean).variance_px2());
            errors.squareness = std::abs(diagonalOverAxis(mean) - 1);
            for (const ColorImage& response : responses)
                addEnergy(errors, arriving(response, method), true);
            responses_[sweep.method] = mean;
            const double whole = truth::moments(mean).sum;
            for (double& value : responses_[sweep.method].pixels)
                value /= whole;
        }
    }

    // With each response moved back to the middle.
    static ScalarImage meanResponse(const std::vector<ColorImage>& responses,
                                    const std::vector<glm::ivec2>& shifts) {
        ScalarImage mean(responses.front().width, responses.front().height);
        for (std::size_t i = 0; i < responses.size(); ++i)
            for (int y = 0; y < mean.height; ++y)
                for (int x = 0; x < mean.width; ++x) {
                    const glm::ivec2 from = glm::ivec2(x, y) + shifts[i];
                    if (from.x >= 0 && from.y >= 0 && from.x < mean.width && from.y < mean.height)
                        mean.at(x, y) += responses[i].at(from.x, from.y).g / double(responses.size());
                }
        return mean;
    }

    // light: what arrives, over what was sent
    static void addEnergy(BloomErrors& errors, double light, bool inner) {
        const double error = std::abs(light - 1);
        errors.energy_error = std::max(errors.energy_error, error);
        if (inner) errors.inner_energy_error = std::max(errors.inner_energy_error, error);
    }

    void measureEnergy(const std::string& rung) {
        Frames frames = blackFrames(rung);
        std::vector<std::size_t> asked;
        for (const ComparedBloom& method : list_)
            if (method.rung == rung && method.competes())
                for (const Light& light : lightsFor(method))
                    asked.push_back(askEmitter(frames, method, light.size, light.place));
        sayProgress("energy: rendering with " + rung);
        frames.run();
        std::size_t next = 0;
        for (std::size_t m = 0; m < list_.size(); ++m) {
            const ComparedBloom& method = list_[m];
            if (method.rung != rung || !method.competes()) continue;
            sayProgress("energy: " + key(method));
            for (const Light& light : lightsFor(method)) {
                const double arrived =
                    arriving(resized(frames.read(asked[next++]), light.size.x, light.size.y), method);
                addEnergy(errors_[m], arrived, light.inner);
                if (method.mark != recommended) continue;
                const int shorter = std::min(light.size.x, light.size.y);
                const double exact = splineLight(splineShares(light.size.x, shorter, method.levels),
                                                 splineShares(light.size.y, shorter, method.levels),
                                                 light.place.x, light.place.y);
                errors_[m].rounding = std::max(errors_[m].rounding, std::abs(arrived - exact));
            }
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
        scenes_.push_back(framed(render("05_hdr_bloom")));
        ColorImage lights(scene_size.x, scene_size.y, glm::dvec3(0.01));
        std::mt19937 random(2);
        for (int i = 0; i < 60; ++i) {
            const int x = static_cast<int>(random() % static_cast<unsigned>(scene_size.x));
            const int y = static_cast<int>(random() % static_cast<unsigned>(scene_size.y));
            const double light = std::pow(10, 1 + 2 * double(random() % 1000) / 1000);
            lights.at(x, y) = light * glm::dvec3(1, 0.4 + 0.2 * (i % 3), 0.2 + 0.3 * (i % 4));
        }
        scenes_.push_back(framed(lights));
        scenes_.push_back(framed(render("01_hdr")));
    }

    static ColorImage framed(const ColorImage& picture) {
        ColorImage result(framed_size.x, framed_size.y);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                result.at(x + scene_margin_px, y + scene_margin_px) = picture.at(x, y);
        return result;
    }
    static ColorImage unframed(const ColorImage& picture) {
        ColorImage result(scene_size.x, scene_size.y);
        for (int y = 0; y < result.height; ++y)
            for (int x = 0; x < result.width; ++x)
                result.at(x, y) = picture.at(x + scene_margin_px, y + scene_margin_px);
        return result;
    }

    void measureScene(std::size_t scene) {
        const ColorImage& light = scenes_[scene];
        const fs::path file = folder_ / "scene.exr";
        writeExr(file, light);
        for (const char* rung : {"04_pyramid_bloom", "03_gaussian_bloom"}) {
            Frames frames(programs_ / rung, {"--image", file.string()});
            std::vector<std::size_t> asked;
            for (const ComparedBloom& method : list_)
                if (method.rung == rung) {
                    Set set = method.set;
                    set["threshold"] = "0"; // everything blooms
                    asked.push_back(frames.ask(set, framed_size, method.target(framed_size)));
                }
            frames.run();
            std::size_t next = 0;
            for (std::size_t m = 0; m < list_.size(); ++m) {
                const ComparedBloom& method = list_[m];
                if (method.rung != rung) continue;
                sayProgress("scene " + std::to_string(scene + 1) + " of 3: " + key(method));
                const ColorImage bloom = resized(frames.read(asked[next++]), framed_size.x, framed_size.y);
                const auto withBloom = [&](const ColorImage& added, double strength) {
                    ColorImage picture = light;
                    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
                        picture.pixels[i] += added.pixels[i] * strength;
                    return unframed(picture);
                };
                const auto flipTo = [&](const ScalarImage& point_spread) {
                    const ColorImage exact = truth::convolved(light, point_spread, truth::Edge::zero);
                    return measure::summary(measure::hdrFlip(withBloom(bloom, bloom_strength / method.gain()),
                                                             withBloom(exact, bloom_strength))
                                                .map)
                        .mean;
                };
                errors_[m].flip[scene] = flipTo(responses_[m]);
                if (scene == 1 && method.competes())
                    errors_[m].mixture_flip = flipTo(
                        pointSpread(truth::matched(wanted_glow, errors_[m].sigma_px * errors_[m].sigma_px)));
            }
        }
    }

    const fs::path programs_;
    const std::vector<ComparedBloom>& list_;
    test::TemporaryFolder folder_;
    std::vector<BloomErrors> errors_;
    std::vector<ScalarImage> responses_; // of each method: its mean over all places, sum 1
    std::vector<ColorImage> scenes_;
};

} // namespace

std::vector<ComparedBloom> comparedBlooms() {
    std::vector<ComparedBloom> list;
    const auto pyramid = [&](const PyramidPair& pair, bool finest, int levels, double width_px,
                             const std::string& radius, const std::string& mark) {
        ComparedBloom method{pyramidMethod(pair, finest)};
        method.set.insert(
            {{"levels", std::to_string(levels)}, {"threshold", "0"}, {"karis", "none"}, {"normalise", "on"}});
        method.dial = "levels " + std::to_string(levels) + (finest ? ", finest on" : ", finest off");
        if (pair.blurred) {
            method.set["radius"] = radius;
            method.dial += ", radius " + radius;
        }
        method.mark = mark;
        method.width_px = width_px;
        method.period_px = 1 << levels;
        method.levels = levels;
        list.push_back(method);
    };
    for (const PyramidPair& pair : pyramid_pairs) {
        const std::string original = pair.original;
        // With a Gaussian on every level it takes a level less, and radii that make up for it were measured;
        // a box is narrow for its levels.
        const int levels = pair.blurred ? 4 : std::string(pair.down) == "box" ? 6 : 5;
        const bool splines = std::string(pair.down) == "spline";
        pyramid(pair, true, levels, compared_width_px, "0.86", pair.blurred ? "" : original);
        pyramid(pair, false, levels, compared_width_px, "0.64", splines ? recommended : "");
        if (splines)
            for (int i = 1; i >= 0; --i)
                pyramid(pair, false, 3 + i, widths_px[i], "", "");
        if (pair.blurred) pyramid(pair, true, 5, 25, "0.5", original + " (25 px)");
    }

    const auto gaussian = [&](const Blur& blur, const std::string& setting, const std::string& value,
                              double width_px, const std::string& mark = "") {
        ComparedBloom method{{"03_gaussian_bloom",
                              blur.name,
                              {{"blur", blur.setting}, {setting, value}, {"threshold", "1000"}}}};
        method.dial = setting + " " + value;
        method.mark = mark;
        method.width_px = width_px;
        method.period_px = method.halves() ? 2 : 1;
        list.push_back(method);
    };
    for (const Blur& blur : gaussian_blurs) {
        const std::string setting = blur.setting;
        if (setting == "mipmap") continue; // no blur of a width: it is what 03 shows to break
        for (const double width_px : widths_px)
            gaussian(blur, "sigma", shortNumber(width_px), width_px);
        if (setting == "ping_pong_9tap")
            gaussian(blur, "iterations", "5", 3.8, "the original of 03 (3.8 px)");
        if (setting == "half_resolution_5tap")
            gaussian(blur, "iterations", "5", 11, "the second original of 03 (11 px)");
        if (setting == "wide_gaussian") gaussian(blur, "sigma", "3.78", 3.8, "recommended in 03");
    }
    return list;
}

std::vector<BloomErrors> bloomErrors(const fs::path& programs, const std::vector<ComparedBloom>& blooms) {
    return Bench(programs, blooms).measure();
}

} // namespace gll::charts
