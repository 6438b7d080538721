// The panel over the picture: every setting, presets, reset, times and keys, made from the settings'
// declarations.
#pragma once

#include "budget/budget.hpp"

#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace gll {

struct PassTime {
    std::string name;
    double time_ms = 0;
};

// What the panel shows beside the settings.
struct PanelState {
    std::string renderer;
    int frame = 0; // 0: nothing rendered yet
    bool paused = false;
    double frame_time_ms = 0;         // of drawing, not of waiting for the display
    std::vector<PassTime> pass_times; // empty until asked for
    std::vector<Reading> readings;    // of the frame shown, where the rung has some
    double searching_s = 0;           // how long a search within a budget has been under way; 0: none is
    bool can_undo = false;            // whether what a search found still stands, and can be taken back
    std::string search_answer;        // what the last search found, or why it did not
    std::string message;              // what happened just now, such as a file written
};

class Panel {
  public:
    // Made after the window's own callbacks are set, which Dear ImGui then passes events on to.
    explicit Panel(GLFWwindow* window);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    // Draws over the default framebuffer, which must be bound. Changes settings as the person does.
    void draw(Settings& settings, const PanelState& state);

    // Whether a button was pressed in the last draw(): to search within that budget, to stop the search, or
    // to take back what it found.
    std::optional<Budget> search_asked;
    bool stop_asked = false;
    bool undo_asked = false;

    // Closes the list of choices that is open. False where none is.
    bool closePopup();

    bool visible = true;
    bool wantsPassTimes() const { return visible && pass_times_open_; }
    // Whether the mouse or keyboard is busy in the panel, so that they mean nothing to the scene.
    bool hasMouse() const;
    bool hasKeyboard() const;

  private:
    void settingsSection(Settings& settings);
    void widget(Setting& setting);
    void budgetSection(const PanelState& state);
    bool beginCombo(const char* label, const char* chosen) const;
    void tooltip(const std::string& text) const;
    void wrappedText(const std::string& text) const;
    void messageLine(const std::string& text) const;

    Budget budget_{Budget::Kind::flip, 0.01};
    bool pass_times_open_ = false;
    bool close_popup_ = false; // in the next draw()
    float scale_ = 1;          // pixels per unit: 2 on most HiDPI displays
};

} // namespace gll
