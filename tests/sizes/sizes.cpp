// Every target at sizes that are tiny, odd, large or a single row; or at two small ones with every setting at
// all its choices or both ends of its range: rendered without an error, finite everywhere.
// Usage: sizes RUNG [settings]
#include "io/image.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <stdexcept>

namespace {
using namespace gll;
using namespace gll::test;

struct Frame {
    std::string size;
    std::string setting; // NAME=VALUE; empty: as it is by default
    std::string target;  // empty: what a display shows
    std::filesystem::path file;
};

constexpr const char* sizes[] = {"1x1", "2x3", "641x479", "1920x1080", "16384x1", "1x16384"};
constexpr const char* small_sizes[] = {"1x1", "7x3"}; // where every setting is tried, one at a time

// The first value that is infinite or not a number, as words; empty: there is none.
std::string firstNotFinite(const Image& image) {
    const auto* floats = std::get_if<std::vector<float>>(&image.pixels);
    if (floats == nullptr) return "";
    for (std::size_t i = 0; i < floats->size(); ++i)
        if (!std::isfinite((*floats)[i])) {
            const std::size_t pixel = i / static_cast<std::size_t>(image.channels);
            const auto width = static_cast<std::size_t>(image.width);
            return std::to_string((*floats)[i]) + " at (" + std::to_string(pixel % width) + "," +
                   std::to_string(pixel / width) + ")";
        }
    return "";
}

// A target may be smaller than the frame, the frame may not.
std::string whatIsWrong(const Frame& frame) {
    const Image image = loadImage(frame.file);
    const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
    if (frame.target.empty() && size != frame.size) return "it is " + size;
    return firstNotFinite(image);
}

nlohmann::json listed(const std::filesystem::path& rung) {
    return nlohmann::json::parse(runToSuccess({rung, {"--settings", "--json"}}).out);
}

// The targets that there are with each of some settings.
std::vector<std::vector<std::string>> targetsWith(const std::filesystem::path& rung,
                                                  const std::vector<std::string>& settings,
                                                  const TemporaryFolder& folder) {
    std::string lines;
    for (const std::string& setting : settings)
        lines += nlohmann::json{{"set", {setting}}}.dump() + "\n";
    std::istringstream printed(
        runToSuccess({rung, {"--settings", "--json", "--batch", folder.write("list.jsonl", lines).string()}})
            .out);
    std::vector<std::vector<std::string>> targets;
    for (std::string line; std::getline(printed, line);)
        targets.push_back(nlohmann::json::parse(line).at("targets"));
    if (targets.size() != settings.size()) throw std::runtime_error("the rung does not list every line");
    return targets;
}

// Each setting as NAME=VALUE at all its choices, or at both ends of its range.
std::vector<std::string> everySetting(const nlohmann::json& settings) {
    std::vector<std::string> all;
    for (const auto& setting : settings) {
        const std::string name = setting.at("name").get<std::string>() + "=";
        if (name == "instances=") continue;        // the most there may be take a minute to draw
        if (name == "shadow_size=") continue;      // and the largest map of shadows half a minute
        if (name.ends_with("tone_map=")) continue; // whose target has eight bits, and is finite
        if (setting.contains("choices"))
            for (const auto& choice : setting.at("choices"))
                all.push_back(name + choice.get<std::string>());
        else if (setting.at("kind") == "toggle")
            all.insert(all.end(), {name + "on", name + "off"});
        else
            all.insert(all.end(), {name + setting.at("min").dump(), name + setting.at("max").dump()});
    }
    return all;
}

int check(const std::filesystem::path& rung, bool every_setting) {
    const TemporaryFolder folder;
    std::vector<Frame> frames;
    std::vector<std::string> unlike; // settings that are not as by default in any frame
    std::string lines;
    const auto add = [&](const std::string& setting, std::vector<std::string> targets,
                         std::span<const char* const> its_sizes) {
        if (targets.empty()) throw std::runtime_error("the rung lists no targets");
        targets.emplace_back();
        for (const char* size : its_sizes)
            for (const std::string& target : targets) {
                const std::string name = std::to_string(frames.size()) + (target.empty() ? ".png" : ".exr");
                frames.push_back({size, setting, target, folder / name});
                nlohmann::json line{{"frame", 60}, {"size", size}, {"out", frames.back().file.string()}};
                line["set"] = unlike;
                if (!setting.empty()) line["set"].push_back(setting);
                if (!target.empty()) line["target"] = target;
                lines += line.dump() + "\n";
            }
    };
    const nlohmann::json by_default = listed(rung);
    if (every_setting) {
        // A map of shadows is as large whatever the frame is, and here is written hundreds of times.
        for (const auto& setting : by_default.at("settings"))
            if (setting.at("name") == "shadow_size") unlike = {"shadow_size=64"};
        const std::vector<std::string> settings = everySetting(by_default.at("settings"));
        const auto targets = targetsWith(rung, settings, folder);
        for (std::size_t i = 0; i < settings.size(); ++i)
            add(settings[i], targets[i], small_sizes);
    } else {
        add("", by_default.at("targets"), sizes);
    }
    runToSuccess({rung, {"--headless", "--batch", folder.write("batch.jsonl", lines).string()}});
    int failures = 0;
    for (const Frame& frame : frames) {
        const std::string wrong = whatIsWrong(frame);
        if (wrong.empty()) continue;
        std::printf("%s %s %s: %s\n", frame.size.c_str(), frame.setting.c_str(), frame.target.c_str(),
                    wrong.c_str());
        ++failures;
    }
    std::printf("%zu frames and targets, %d of them wrong\n", frames.size(), failures);
    return failures == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    const bool every_setting = argc == 3 && std::string(argv[2]) == "settings";
    if (argc != 2 && !every_setting) {
        std::fprintf(stderr, "usage: sizes RUNG [settings]\n");
        return 2;
    }
    try {
        return check(argv[1], every_setting);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sizes: error: %s\n", error.what());
        return 1;
    }
}
