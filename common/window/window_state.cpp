// Windows as JSON.
#include "window/window_state.hpp"

#include "window/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace gll {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
constexpr std::uintmax_t most_bytes = 1 << 20;

Json preferencesJson(const WindowPreferences& preferences) {
    return {{"panel", preferences.panel},
            {"strip", preferences.strip},
            {"panel_em", preferences.panel_em},
            {"text_size", preferences.text_size},
            {"waits_for_display", preferences.waits_for_display},
            {"shows_times", preferences.shows_times}};
}

std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

// Takes values out of an object, checked; a key that is not there changes nothing, one that nobody asks for
// is an error.
class Reader {
  public:
    Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json_.is_object()) fail("", "is no JSON object");
    }
    ~Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    void read(const char* key, bool& value) {
        if (const Json* found = find(key)) value = found->is_boolean() ? found->get<bool>() : failBool(key);
    }
    void read(const char* key, double& value, double min, double max) {
        const Json* found = find(key);
        if (found == nullptr) return;
        const double number = found->is_number() ? found->get<double>() : std::nan("");
        if (!(number >= min && number <= max))
            fail(key, "is no number from " + shortest(min) + " to " + shortest(max));
        value = number;
    }
    void read(const char* key, int& value, int min, int max) {
        double number = value;
        read(key, number, min, max);
        if (number != std::floor(number)) fail(key, "is no whole number");
        value = static_cast<int>(number);
    }
    void read(const char* key, std::string& value) {
        const Json* found = find(key);
        if (found == nullptr) return;
        if (!found->is_string()) fail(key, "is no text");
        value = found->get<std::string>();
    }
    void read(const char* key, std::vector<std::string>& values) {
        const Json* found = find(key);
        if (found == nullptr) return;
        const bool is_right =
            found->is_array() &&
            std::all_of(found->begin(), found->end(), [](const Json& one) { return one.is_string(); });
        if (!is_right) fail(key, "is no list of texts");
        values = found->get<std::vector<std::string>>();
    }
    const Json* find(const char* key) {
        asked_.emplace_back(key);
        const auto found = json_.find(key);
        return found == json_.end() || found->is_null() ? nullptr : &*found;
    }
    std::string at(const std::string& key) const { return where_ + ": " + key; }
    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        throw std::runtime_error((key.empty() ? where_ : at(key)) + " " + what +
                                 "; mend it, or remove the file");
    }
    void requireAllAsked() const {
        for (const auto& [key, value] : json_.items())
            if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
                fail(key, "is no key of a window");
    }

  private:
    bool failBool(const char* key) const { fail(key, "is neither true nor false"); }

    const Json& json_;
    std::string where_;
    std::vector<std::string> asked_;
};

void readPreferences(Reader& reader, WindowPreferences& preferences) {
    reader.read("panel", preferences.panel);
    reader.read("strip", preferences.strip);
    reader.read("panel_em", preferences.panel_em, 1, 1000);
    reader.read("text_size", preferences.text_size, 0.5, 3);
    reader.read("waits_for_display", preferences.waits_for_display);
    reader.read("shows_times", preferences.shows_times);
}

Json parsed(const fs::path& file) {
    std::error_code error;
    if (fs::file_size(file, error) > most_bytes && !error)
        throw std::runtime_error(file.string() + ": is larger than 1 MiB, which no window's state is");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    try {
        return Json::parse(stream);
    } catch (const Json::exception& problem) {
        throw std::runtime_error(file.string() + ": is no JSON (" + problem.what() +
                                 "); mend it, or remove the file");
    }
}

fs::path preferencesFile() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value == nullptr ? "" : value);
    };
    fs::path folder = variable("XDG_CONFIG_HOME"); // XDG Base Directory Specification
    if (!folder.is_absolute()) {
        if (variable("HOME").empty()) return {};
        folder = variable("HOME") / ".config";
    }
    return folder / "gl-ladder" / "window.json";
}

} // namespace

std::string windowStateJson(const WindowState& state) {
    Json json = preferencesJson(state.preferences);
    json["rung"] = state.rung;
    json["picture"] = {{"width", state.picture.x}, {"height", state.picture.y}};
    json["frame"] = state.frame;
    json["is_playing"] = state.is_playing;
    json["speed"] = state.speed;
    if (state.loop) json["loop"] = {{"first", state.loop->first}, {"last", state.loop->last}};
    json["a"] = state.sets_a;
    json["b"] = state.sets_b;
    json["edits_b"] = state.edits_b;
    json["comparison"] = state.comparison;
    json["divider"] = state.divider;
    if (state.inspected)
        json["inspected"] = {{"pass", state.inspected->pass}, {"target", state.inspected->name}};
    Json files = Json::object();
    for (const FileOption& option : file_options)
        if (const fs::path& file = state.files.*option.file; !file.empty())
            files[std::string(option.name)] = fs::absolute(file).string();
    json["files"] = files;
    return json.dump(1) + "\n";
}

WindowState readWindowState(const fs::path& file) {
    const Json json = parsed(file);
    Reader reader(json, file.string());
    WindowState state;
    readPreferences(reader, state.preferences);
    reader.read("rung", state.rung);
    if (const Json* picture = reader.find("picture")) {
        Reader size(*picture, reader.at("picture"));
        size.read("width", state.picture.x, 1, 16384);
        size.read("height", state.picture.y, 1, 16384);
        size.requireAllAsked();
    }
    reader.read("frame", state.frame, 1, max_frame);
    reader.read("is_playing", state.is_playing);
    reader.read("speed", state.speed, 1.0 / 64, 16);
    if (const Json* loop = reader.find("loop")) {
        Reader ends(*loop, reader.at("loop"));
        state.loop.emplace();
        ends.read("first", state.loop->first, 1, max_frame);
        ends.read("last", state.loop->last, 1, max_frame);
        ends.requireAllAsked();
    }
    reader.read("a", state.sets_a);
    reader.read("b", state.sets_b);
    reader.read("edits_b", state.edits_b);
    reader.read("comparison", state.comparison);
    const auto& modes = Comparison::mode_names;
    if (std::find(std::begin(modes), std::end(modes), state.comparison) == std::end(modes))
        reader.fail("comparison", "is none of off, divider, blink, difference and flip");
    reader.read("divider", state.divider, 0, 1);
    if (const Json* inspected = reader.find("inspected")) {
        Reader target(*inspected, reader.at("inspected"));
        state.inspected.emplace();
        target.read("pass", state.inspected->pass);
        target.read("target", state.inspected->name);
        target.requireAllAsked();
    }
    if (const Json* files = reader.find("files")) {
        Reader given(*files, reader.at("files"));
        for (const FileOption& option : file_options) {
            std::string path;
            given.read(std::string(option.name).c_str(), path);
            state.files.*option.file = path;
        }
        given.requireAllAsked();
    }
    reader.requireAllAsked();
    return state;
}

WindowPreferences rememberedPreferences() {
    WindowPreferences preferences;
    const fs::path file = preferencesFile();
    std::error_code error;
    if (file.empty() || !fs::exists(file, error)) return preferences;
    try {
        const Json json = parsed(file);
        Reader reader(json, file.string());
        readPreferences(reader, preferences);
        return preferences;
    } catch (const std::runtime_error&) {
        return {};
    }
}

void rememberPreferences(const WindowPreferences& preferences) {
    const fs::path file = preferencesFile();
    if (file.empty()) return;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    const fs::path fresh = file.string() + ".new"; // so that a second window never reads half of it
    std::ofstream(fresh) << preferencesJson(preferences).dump(1) << "\n";
    fs::rename(fresh, file, error);
}

} // namespace gll
