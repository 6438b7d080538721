// The panel beside the picture: every setting in its group, presets, what differs from them, times and the
// search within a budget, made from the settings' declarations.
#pragma once

#include "budget/budget.hpp"
#include "window/chart_view.hpp"
#include "window/layout.hpp"
#include "window/pass_timer.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gll {

// What the panel shows beside the settings.
struct PanelState {
    std::string renderer;
    int frame = 0; // 0: nothing rendered yet
    bool is_playing = false;
    double shown_per_s = 0;                             // frames a second that reach the window
    double frame_time_ms = 0;                           // of drawing, not of waiting for the display
    bool is_gpu_time = false;                           // else the wall's, of a renderer in software
    std::vector<PassTime> pass_times;                   // empty until asked for
    std::vector<Reading> readings;                      // of the frame shown, where the rung has some
    std::optional<CostProbe::Costs> point_costs = {};   // of chartPoints(), as far as they are known
    std::optional<CostProbe::Costs> present_costs = {}; // of the settings as they are
    double searching_s = 0;      // how long a search within a budget has been under way; 0: none is
    std::string search_progress; // what it is at
    std::string search_answer;   // what the last search found, or why it did not
    bool has_found = false;      // settings that differ from the present ones
    std::string edited;          // "A" or "B", where two are compared
    bool can_undo = false;
    bool can_redo = false;
    bool waits_for_display = true; // vertical sync
    float text_size = 1;           // of what the display wants
    bool shows_times = true;       // which are others at every moment
};

// What was asked for in the panel in the last draw().
struct PanelActions {
    std::optional<Budget> search;
    bool stop_search = false;
    bool take_found = false;
    bool undo = false;
    bool redo = false;
    bool copy_command = false;
    bool show_help = false;
    bool compare = false; // or no longer
    bool inspect = false;
    std::optional<bool> wait_for_display;
    std::optional<bool> show_times;
    std::optional<float> text_size;
};

// The name of a setting for people: "Exposure (EV)" for exposure_ev.
std::string labelOf(const std::string& name);

class Panel {
  public:
    // Presets are remembered; what a setting differs from is the preset that is nearest now.
    Panel(std::string rung, Settings& settings);

    // Changes settings as the person does.
    PanelActions draw(const Rectangle& place, float pixels_per_unit, Settings& settings,
                      const PanelState& state);

    // The settings that the chart, where it is in sight, asks to be counted.
    const std::vector<std::vector<std::string>>& chartPoints() const { return chart_points_; }
    bool wantsPassTimes() const { return pass_times_open_; }
    void focus() { focus_ = true; } // for the keyboard, in the next draw()

  private:
    struct Preset {
        std::string name;
        std::string help;
        std::vector<double> values;
    };
    void presetsSection(Settings& settings, const PanelState& state, PanelActions& actions);
    void settingsSection(Settings& settings);
    void table(const char* name, const std::vector<Setting*>& shown, const Settings& settings);
    void row(Setting& setting, double preset_value, const std::string& why_idle);
    void chartSection(Settings& settings, const PanelState& state);
    void budgetSection(const PanelState& state, PanelActions& actions);
    void timesSection(const PanelState& state, PanelActions& actions);
    void choosePreset(const std::vector<double>& now); // the one most alike
    double presetValue(const Settings& settings, const Setting& setting) const;

    std::string rung_;
    std::vector<Preset> presets_;
    std::string edited_;             // the side that was shown last
    std::size_t preset_ = 0;         // the one that settings are marked to differ from
    std::optional<ChartView> chart_; // once it was looked at
    std::vector<std::vector<std::string>> chart_points_;
    Budget budget_{Budget::Kind::flip, 0.01};
    bool pass_times_open_ = false;
    bool focus_ = false;
};

} // namespace gll
