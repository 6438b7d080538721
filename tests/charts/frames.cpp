// Batches for rungs, and what comes back of them.
#include "charts/frames.hpp"

#include "io/image.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace gll::charts {

std::size_t Frames::ask(const Set& set, glm::ivec2 size, const std::string& target,
                        const nlohmann::json& inject, int frame, const std::string& preset) {
    nlohmann::json line{{"preset", preset},
                        {"set", set},
                        {"size", std::to_string(size.x) + "x" + std::to_string(size.y)},
                        {"frame", frame},
                        {"target", target},
                        {"out", file(count_).string()}};
    if (!inject.is_null()) line["inject"] = inject;
    lines_ += line.dump() + "\n";
    return count_++;
}

void Frames::run() {
    std::vector<std::string> arguments = {"--headless", "--batch",
                                          folder_.write("batch.jsonl", lines_).string()};
    arguments.insert(arguments.end(), arguments_.begin(), arguments_.end());
    test::runToSuccess({rung_, arguments}, std::chrono::minutes(20));
}

measure::ColorImage Frames::read(std::size_t number) const {
    const Image image = loadImage(file(number));
    measure::requireFinite(image, rung_.filename().string() + ", frame " + std::to_string(number));
    return measure::linearColor(image);
}

std::vector<nlohmann::json> costs(const std::filesystem::path& rung, const std::vector<Set>& sets,
                                  glm::ivec2 size, const std::vector<std::string>& more_arguments) {
    std::string lines;
    for (const Set& set : sets)
        lines += nlohmann::json{{"cost", "passes"},
                                {"set", set},
                                {"size", std::to_string(size.x) + "x" + std::to_string(size.y)}}
                     .dump() +
                 "\n";
    const test::TemporaryFolder folder;
    std::vector<std::string> arguments = {"--headless", "--counter",
                                          "callgrind",  "--json",
                                          "--batch",    folder.write("batch.jsonl", lines).string()};
    arguments.insert(arguments.end(), more_arguments.begin(), more_arguments.end());
    const test::Result result = test::runToSuccess({rung, arguments}, std::chrono::minutes(60));
    std::vector<nlohmann::json> reports;
    std::istringstream stream(result.out);
    for (std::string line; std::getline(stream, line);)
        reports.push_back(nlohmann::json::parse(line));
    return reports;
}

measure::ColorImage resized(const measure::ColorImage& source, int width, int height) {
    if (source.width == width && source.height == height) return source;
    measure::ColorImage result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) * source.width / width - 0.5;
            const double v = (y + 0.5) * source.height / height - 0.5;
            const int i = static_cast<int>(std::floor(u));
            const int j = static_cast<int>(std::floor(v));
            const auto at = [&](int a, int b) {
                return source.at(std::clamp(a, 0, source.width - 1), std::clamp(b, 0, source.height - 1));
            };
            result.at(x, y) = (at(i, j) * (1 - (u - i)) + at(i + 1, j) * (u - i)) * (1 - (v - j)) +
                              (at(i, j + 1) * (1 - (u - i)) + at(i + 1, j + 1) * (u - i)) * (v - j);
        }
    return result;
}

void writeExr(const std::filesystem::path& file, const measure::ColorImage& image) {
    std::vector<float> values;
    for (const glm::dvec3& color : image.pixels)
        for (int c = 0; c < 3; ++c)
            values.push_back(static_cast<float>(color[c]));
    saveImage(file,
              {.width = image.width, .height = image.height, .channels = 3, .pixels = std::move(values)});
}

void sayProgress(const std::string& what) {
    if (isatty(fileno(stderr)) != 0) std::fprintf(stderr, "\r%s\033[K", what.c_str());
}

} // namespace gll::charts
