// Exposure reductions against the exact log-average, at a thousand frame sizes.
#include "charts/exposure.hpp"

#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "measure/color.hpp"
#include "support/choices.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gll::charts::exposure {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 cost_size{1280, 720};
constexpr glm::ivec2 largest_size{4096, 2160};
constexpr glm::ivec2 usual_size{1920, 1080}; // told apart from the rest
constexpr int rendered_pixels =
    20000; // frames of up to so many are rendered; of larger ones, the model's word
constexpr glm::ivec2 scene_size{2048, 1080}; // of the picture that larger frames are sampled from
constexpr double epsilon = 1e-8;             // the rung's default, added to every luminance
constexpr double promised_ev = 0.01;
constexpr double promised_cu = 2;

// log2(epsilon + luminance) of every pixel, from the bottom row up.
struct Stops {
    glm::ivec2 size{1};
    std::vector<float> pixels;

    float at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)];
    }
};

// log2 of the log-average.
double truth(const Stops& stops) {
    double sum = 0;
    for (const float stop : stops.pixels)
        sum += stop;
    return sum / double(stops.pixels.size());
}

// Models of the reductions, with the roundings that matter. As Mesa's glGenerateMipmap does it, every level
// is the one before sampled with GL_LINEAR in the middle of each texel: right where sides halve evenly,
// blind to columns and rows elsewhere.
template <class Stored>
double mipmapped(Stops level, const Stored& stored) {
    for (float& value : level.pixels)
        value = stored(value);
    while (level.size != glm::ivec2(1)) {
        Stops next{glm::max(level.size / 2, 1), {}};
        next.pixels.reserve(static_cast<std::size_t>(next.size.x) * static_cast<std::size_t>(next.size.y));
        struct Tap {
            int first, second;
            float share;
        };
        const auto tap = [](int i, int from, int to) {
            const double place = (i + 0.5) * from / to - 0.5;
            const int first = static_cast<int>(std::floor(place));
            return Tap{std::max(first, 0), std::min(first + 1, from - 1), static_cast<float>(place - first)};
        };
        std::vector<Tap> columns;
        for (int x = 0; x < next.size.x; ++x)
            columns.push_back(tap(x, level.size.x, next.size.x));
        for (int y = 0; y < next.size.y; ++y) {
            const Tap row = tap(y, level.size.y, next.size.y);
            for (const Tap& column : columns) {
                const auto along = [&](int j) {
                    const float a = level.at(column.first, j);
                    return a + (level.at(column.second, j) - a) * column.share;
                };
                const float low = along(row.first);
                next.pixels.push_back(stored(low + (along(row.second) - low) * row.share));
            }
        }
        level = std::move(next);
    }
    return level.pixels[0];
}

// Towards zero to a half float, as llvmpipe stores them, of values whose exponent one has.
float asHalf(float value) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & 0xFFFFE000U); // 10 of 23 bits
}

double mipmapR16f(const Stops& stops) {
    return mipmapped(stops, [](float value) { return asHalf(value); });
}

double mipmapR16(const Stops& stops, double white_point) {
    const double darkest = std::log2(epsilon);
    const double range = std::log2(white_point) - darkest;
    Stops mapped = stops;
    for (float& value : mapped.pixels)
        value = static_cast<float>((value - darkest) / range);
    const auto stored = [](float value) {
        return std::nearbyint(std::clamp(value, 0.0F, 1.0F) * 65535.0F) / 65535.0F;
    };
    return darkest + range * mipmapped(std::move(mapped), stored);
}

// The area average in float32, its sums in the shader's order.
double areaAverage(Stops source) {
    do {
        Stops target{(source.size + 7) / 8, {}};
        for (int v = 0; v < target.size.y; ++v)
            for (int u = 0; u < target.size.x; ++u) {
                const glm::ivec2 begin = glm::ivec2(u, v) * source.size;
                const glm::ivec2 end = begin + source.size;
                const glm::ivec2 first = begin / target.size;
                const glm::ivec2 last = (end - 1) / target.size;
                float mean = 0;
                for (int y = first.y; y <= last.y; ++y) {
                    const int height =
                        std::min(end.y, (y + 1) * target.size.y) - std::max(begin.y, y * target.size.y);
                    float row = 0;
                    for (int x = first.x; x <= last.x; ++x) {
                        const int width =
                            std::min(end.x, (x + 1) * target.size.x) - std::max(begin.x, x * target.size.x);
                        row += static_cast<float>(width) * source.at(x, y);
                    }
                    mean += static_cast<float>(height) / static_cast<float>(source.size.y) *
                            (row / static_cast<float>(source.size.x));
                }
                target.pixels.push_back(mean);
            }
        source = std::move(target);
    } while (source.size != glm::ivec2(1));
    return source.pixels[0];
}

// The histogram with all samples counting: the mean of up to 64x64 of them, each somewhere in its cell.
double sampledMean(const Stops& stops) {
    const glm::ivec2 grid = glm::min(stops.size, 64);
    double sum = 0;
    for (int i = 0; i < grid.x * grid.y; ++i) {
        std::uint32_t h = static_cast<std::uint32_t>(i) * 0x9E3779B1U;
        h = (h ^ (h >> 15)) * 0x85EBCA77U;
        h = (h ^ (h >> 13)) * 0xC2B2AE3DU;
        const glm::dvec2 scattered = glm::dvec2(h & 0xFFFFU, h >> 16) / 65536.0;
        const glm::ivec2 cell(i % grid.x, i / grid.x);
        const glm::ivec2 first = cell * stops.size / grid;
        const glm::ivec2 next = (cell + 1) * stops.size / grid;
        const glm::ivec2 texel = first + glm::ivec2(scattered * glm::dvec2(next - first));
        sum += stops.at(texel.x, texel.y);
    }
    return sum / double(grid.x * grid.y);
}

struct Reduction {
    std::string name;
    std::string mark;
    Set set;
    std::function<double(const Stops&)> model;
    double tolerance_ev; // between model and rung
};

std::vector<Reduction> reductions(const fs::path& programs) {
    const auto white = [](double white_point) {
        return [white_point](const Stops& stops) { return mipmapR16(stops, white_point); };
    };
    std::vector<Reduction> list = {
        {"mipmap_r16, white point 0.22",
         "the original of 02",
         {{"reduction", "mipmap_r16"}, {"white_point", "0.22"}},
         white(0.22),
         0.005},
        {"mipmap_r16, white point 1024",
         "",
         {{"reduction", "mipmap_r16"}, {"white_point", "1024"}},
         white(1024),
         0.005},
        {"mipmap_r16f", "", {{"reduction", "mipmap_r16f"}}, mipmapR16f, 0.02},
        {"area", "recommended", {{"reduction", "area"}}, areaAverage, 1e-4},
        {"histogram, all samples",
         "",
         {{"reduction", "histogram"}, {"low_percent", "0"}, {"high_percent", "100"}},
         sampledMean,
         1e-3}};
    test::requireCovered(programs / "02_auto_exposure", "reduction", test::valuesOf(list, "reduction"));
    return list;
}

// What a frame shows: the rung's name for it, and its luminance where that needs no rendering.
struct Content {
    std::string pattern;
    std::string name;
};
const std::vector<Content> contents = {
    {"none", "scene"}, {"ramp", "ramp"}, {"checkerboard", "checkerboard"}, {"one_hot", "one light"}};

// A thousand: usual ones, then any, even in the logarithm.
std::vector<glm::ivec2> frameSizes() {
    std::vector<glm::ivec2> sizes = {{1, 1},       {2, 2},      {3, 3},     {64, 64},     {320, 240},
                                     {640, 480},   {641, 479},  {500, 500}, {800, 600},   {1024, 768},
                                     {1280, 720},  {1366, 768}, usual_size, {2048, 1024}, {2560, 1440},
                                     {3840, 2160}, {4096, 1},   {1, 2160},  largest_size};
    std::mt19937 random(1); // its sequence is the standard's, the same everywhere
    const auto side = [&](int largest) {
        return static_cast<int>(std::exp2(std::log2(largest + 1.0) * double(random()) / 4294967296.0));
    };
    while (sizes.size() < 1000) {
        const int x = side(largest_size.x);
        sizes.emplace_back(x, side(largest_size.y));
    }
    return sizes;
}

double pixelCount(glm::ivec2 size) { return double(size.x) * size.y; }

Stops stopsOf(glm::ivec2 size, const std::function<double(int, int)>& luminance) {
    Stops stops{size, {}};
    stops.pixels.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            stops.pixels.push_back(static_cast<float>(std::log2(epsilon + luminance(x, y))));
    return stops;
}

Stops stopsOf(const measure::ColorImage& frame) {
    return stopsOf({frame.width, frame.height}, [&](int x, int y) {
        return measure::luminance709(frame.at(x, frame.height - 1 - y)); // pictures begin at the top
    });
}

// A frame without rendering it. scene: the picture to sample it from.
Stops modelled(const Content& content, glm::ivec2 size, const Stops& scene) {
    if (content.pattern == "none") {
        Stops stops{size, {}};
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                stops.pixels.push_back(scene.at(static_cast<int>((x + 0.5) * scene.size.x / size.x),
                                                static_cast<int>((y + 0.5) * scene.size.y / size.y)));
        return stops;
    }
    if (content.pattern == "ramp") {
        std::vector<float> columns;
        for (int x = 0; x < size.x; ++x)
            columns.push_back(static_cast<float>(
                std::log2(epsilon + asHalf(static_cast<float>(std::exp2(-12 + 16 * (x + 0.5) / size.x))))));
        Stops stops{size, {}};
        for (int y = 0; y < size.y; ++y)
            stops.pixels.insert(stops.pixels.end(), columns.begin(), columns.end());
        return stops;
    }
    const auto dark = static_cast<float>(std::log2(epsilon));
    const float light = content.pattern == "one_hot" ? std::log2(1000.0F) : 0.0F;
    Stops stops{
        size, std::vector<float>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), dark)};
    const auto at = [&](int x, int y) -> float& {
        return stops.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                            static_cast<std::size_t>(x)];
    };
    if (content.pattern == "one_hot")
        at(size.x / 2, size.y / 2) = light;
    else
        for (int y = 0; y < size.y; ++y)
            for (int x = (y + 1) % 2; x < size.x; x += 2)
                at(x, y) = light;
    return stops;
}

// What the rung meters, and the frame it metered, for small sizes.
class Metered {
  public:
    Metered(fs::path rung, const std::vector<Reduction>& list) : rung_(std::move(rung)), list_(list) {}

    void ask(const Content& content, glm::ivec2 size) {
        for (std::size_t r = 0; r < list_.size(); ++r) {
            Set set = list_[r].set;
            set.insert({{"adapt", "off"}, {"overlay", "off"}, {"test_pattern", content.pattern}});
            nlohmann::json line{{"readings", true},
                                {"set", set},
                                {"size", std::to_string(size.x) + "x" + std::to_string(size.y)}};
            if (r == 0 && content.pattern == "none") {
                line["target"] = "hdr";
                line["out"] = frame(count_).string();
            }
            lines_ += line.dump() + "\n";
        }
        ++count_;
    }
    void run() {
        const test::Result result = test::runToSuccess(
            {rung_, {"--headless", "--json", "--batch", folder_.write("batch.jsonl", lines_).string()}},
            std::chrono::minutes(20));
        std::istringstream stream(result.out);
        for (std::string line; std::getline(stream, line);)
            if (line.starts_with("{"))
                readings_.push_back(
                    nlohmann::json::parse(line).at("readings").at("metered_ev").get<double>());
        if (readings_.size() != count_ * list_.size())
            throw std::runtime_error(rung_.string() + ": gave " + std::to_string(readings_.size()) +
                                     " readings of " + std::to_string(count_ * list_.size()));
    }
    // Valid after run(), numbered in the order they were asked for.
    double reading(std::size_t number, std::size_t reduction) const {
        return readings_[number * list_.size() + reduction];
    }
    Stops stops(std::size_t number) const { return stopsOf(measure::linearColor(loadImage(frame(number)))); }

  private:
    fs::path frame(std::size_t number) const { return folder_ / (std::to_string(number) + ".exr"); }

    fs::path rung_;
    const std::vector<Reduction>& list_;
    test::TemporaryFolder folder_;
    std::string lines_;
    std::size_t count_ = 0;
    std::vector<double> readings_;
};

struct Errors {
    double worst_ev = 0;
    double sum_ev = 0;
    glm::ivec2 worst_size{1};
    double usual_ev = 0; // at usual_size

    void add(double error_ev, glm::ivec2 size) {
        sum_ev += error_ev;
        if (size == usual_size) usual_ev = error_ev;
        if (error_ev > worst_ev) {
            worst_ev = error_ev;
            worst_size = size;
        }
    }
};

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    const std::vector<Reduction> list = reductions(programs);
    std::vector<Set> sets;
    for (const Reduction& reduction : list) {
        sets.push_back(reduction.set);
        sets.back().insert({{"adapt", "off"}, {"overlay", "off"}});
    }
    const auto reports = costs(programs / "02_auto_exposure", sets, cost_size);
    Table table{{"method", "cost_cu"}, {}};
    for (std::size_t i = 0; i < list.size(); ++i) {
        double cu = 0;
        for (const auto& pass : reports[i].at("passes"))
            for (const char* prefix : {"log_luminance", "average", "histogram", "metered"})
                if (pass.at("name").get<std::string>().starts_with(prefix)) cu += pass.at("cu").get<double>();
        table.rows.push_back({list[i].name, decimals(cu, 2)});
    }
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    const Costs costs(costs_csv);
    const std::vector<Reduction> list = reductions(programs);
    const std::vector<glm::ivec2> sizes = frameSizes();

    Metered metered(programs / "02_auto_exposure", list);
    for (const Content& content : contents)
        for (const glm::ivec2 size : sizes)
            if (pixelCount(size) <= rendered_pixels) metered.ask(content, size);
    metered.run();
    Frames scenes(programs / "02_auto_exposure");
    scenes.ask({{"adapt", "off"}, {"overlay", "off"}}, scene_size, "hdr");
    scenes.run();
    const Stops scene = stopsOf(scenes.read(0));

    std::vector<std::vector<Errors>> errors(list.size(), std::vector<Errors>(contents.size()));
    std::size_t number = 0;
    for (std::size_t c = 0; c < contents.size(); ++c)
        for (const glm::ivec2 size : sizes) {
            sayProgress(contents[c].name + ", " + std::to_string(size.x) + "x" + std::to_string(size.y));
            const bool rendered = pixelCount(size) <= rendered_pixels;
            const Stops stops =
                rendered && c == 0 ? metered.stops(number) : modelled(contents[c], size, scene);
            const double exact = truth(stops);
            for (std::size_t r = 0; r < list.size(); ++r) {
                double measured = list[r].model(stops);
                if (rendered) {
                    const double reading = metered.reading(number, r);
                    if (!(std::abs(measured - reading) <= list[r].tolerance_ev))
                        throw std::runtime_error(
                            list[r].name + ", " + contents[c].name + ", " + std::to_string(size.x) + "x" +
                            std::to_string(size.y) + ": the rung meters " + std::to_string(reading) +
                            " EV, its model here " + std::to_string(measured) + "; make them agree again");
                    measured = reading;
                }
                errors[r][c].add(std::abs(measured - exact), size);
            }
            if (rendered) ++number;
        }
    sayProgress("");

    Table table{{"reduction", "content", "cost cu", "worst EV error", "at", "mean EV error",
                 "EV error at 1920x1080", "note"},
                {}};
    std::vector<Point> worst, mean;
    std::string missed;
    for (std::size_t r = 0; r < list.size(); ++r) {
        const double cu = costs.of(list[r].name, "cost_cu");
        for (std::size_t c = 0; c < contents.size(); ++c) {
            const Errors& e = errors[r][c];
            const double mean_ev = e.sum_ev / double(sizes.size());
            table.rows.push_back({list[r].name, contents[c].name, decimals(cu, 2), shortNumber(e.worst_ev),
                                  std::to_string(e.worst_size.x) + "x" + std::to_string(e.worst_size.y),
                                  shortNumber(mean_ev), shortNumber(e.usual_ev), list[r].mark});
            const std::string mark = c == 0 ? list[r].mark : "";
            worst.push_back({list[r].name, contents[c].name, cu, e.worst_ev, mark});
            mean.push_back({list[r].name, contents[c].name, cu, mean_ev, mark});
            worst.back().settings = mean.back().settings = list[r].set;
            if (list[r].mark == "recommended" && !(e.worst_ev <= promised_ev && cu <= promised_cu))
                missed += contents[c].name + ": " + shortNumber(e.worst_ev) + " EV for " + decimals(cu, 2) +
                          " copies; ";
        }
    }
    writeCsv(folder / "exposure.csv", table);
    Axes axes{.title = "Metering: how far off can the average be?",
              .subtitle =
                  "a thousand frame sizes from 1x1 to 4096x2160, four contents, adapt=off; cost at 1280x720",
              .x = "cost, copies (cu)",
              .y = "largest error, EV",
              .log_y = true,
              .floor = 1e-6,
              .dial_is_given = true,
              .rung = "02_auto_exposure"};
    drawChart(folder / "exposure_worst.svg", axes, worst);
    axes.title = "Metering: how far off is the average, over all sizes?";
    axes.y = "mean error, EV";
    drawChart(folder / "exposure_mean.svg", axes, mean);
    if (!missed.empty()) throw std::runtime_error("the recommended reduction misses its promise: " + missed);
}

} // namespace gll::charts::exposure
