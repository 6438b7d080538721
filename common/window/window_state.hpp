// What a window is left as, and opened as again: the one file of --window-state, and what is remembered for
// every rung.
#pragma once

#include "rung/request.hpp"
#include "window/inspector.hpp"
#include "window/timeline.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gll {

// How people like their windows: remembered for all of them.
struct WindowPreferences {
    bool panel = true;
    bool strip = false;
    double panel_em = LayoutWish().panel_em;
    double text_size = 1;
    bool waits_for_display = true;
    bool shows_times = true;
};

// All of it.
struct WindowState {
    WindowPreferences preferences;
    std::string rung;
    glm::ivec2 picture{0};
    int frame = 1;
    bool is_playing = true;
    double speed = 1;
    std::optional<Timeline::Loop> loop;
    std::vector<std::string> sets_a; // KEY=VALUE over the defaults
    std::vector<std::string> sets_b;
    bool edits_b = false;
    std::string comparison = "off"; // see Comparison::mode_names
    double divider = 0.5;
    std::optional<PassTarget> inspected;
    RungFiles files;
};

// Text of files, and back. Reading throws std::runtime_error "FILE: KEY: what is wrong, what to do"; what it
// leaves out is as by default.
std::string windowStateJson(const WindowState& state);
WindowState readWindowState(const std::filesystem::path& file);

// gl-ladder/window.json in the folder of the person's settings. What cannot be read is as by default, and
// what cannot be written is not remembered.
WindowPreferences rememberedPreferences();
void rememberPreferences(const WindowPreferences& preferences);

} // namespace gll
