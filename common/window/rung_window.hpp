// The running window: what the callbacks change and the loop reads.
#pragma once

#include "window/comparison.hpp"
#include "window/cost_probe.hpp"
#include "window/glfw_window.hpp"
#include "window/help.hpp"
#include "window/history.hpp"
#include "window/inspector.hpp"
#include "window/layout.hpp"
#include "window/panel.hpp"
#include "window/pass_timer.hpp"
#include "window/recorder.hpp"
#include "window/stage.hpp"
#include "window/timeline.hpp"
#include "window/timeline_bar.hpp"
#include "window/ui.hpp"
#include "window/window.hpp"
#include "window/window_state.hpp"

#include <chrono>
#include <optional>

namespace gll {

class RungWindow {
  public:
    RungWindow(const FrameRequest& request, const WindowRequest& wished, const RungInfo& info,
               Settings& settings);
    void loop(); // until the window is closed

  private:
    using Clock = std::chrono::steady_clock;

    // Keys, mouse and files (input.cpp).
    void listen();
    void key(int key, bool is_repeated, bool with_control, bool with_shift);
    void controlKey(int key, bool with_shift);
    bool functionKey(int key); // whether it was one: they mean the same wherever the keyboard is
    void plainKey(int key, bool is_repeated, bool with_shift);
    void compareKey(int key);
    void escape();
    void mouseButton(bool is_pressed);
    void mouseMoved(double x, double y);
    void wheel(double steps);
    void dropped(const std::vector<std::filesystem::path>& files);
    enum class Drag { nothing, camera, divider, panel_edge, inspected };
    Drag dragAt() const; // what the mouse would drag where it is
    void showEdge();     // the cursor says where the panel can be dragged wide
    // Changes a setting of a role within its range, to thousandths, where the rung has it.
    template <class Change>
    void nudge(Setting::Role role, const Change& change);
    void resetCamera();
    glm::dvec2 cursorPx() const;                    // from the cursor's place, in the display's units
    double cursorOnWidth() const;                   // of the picture
    std::optional<glm::ivec2> pictureTexel() const; // where the cursor is in the picture, from its lower left

    // Comparing.
    bool isComparing() const { return comparison_.mode != Comparison::Mode::off && layout_.panel.isShown(); }
    void compareWith(const std::string& preset); // or no longer, where that is what is compared with

    // A loop's parts.
    void prepare();
    void render();
    std::string probe() const;
    void present(glm::ivec2 window);
    void presentPictures(glm::ivec2 window);
    void askChartCosts();
    void drawPanels();
    void drawMessages();
    void attend(const PanelActions& asked);
    void attendSearch();
    void startSearch(const Budget& budget);
    void undo();
    void redo();
    void setTextSize(double size);
    void setPictureSize(glm::ivec2 picture);
    bool isInspecting() const { return layout_.strip.isShown() && inspector_.isInspecting(); }
    double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); } // s

    // What goes out.
    FrameRequest shownFrame() const { return stage_.rendered(stage_.edited()); }
    const char* headlessContext() const; // where a GPU draws, frames and costs are the GPU's
    std::string freeStem() const;        // a file's name without its ending that nothing here has
    void copyCommand();
    void save();
    void saveWindow(glm::ivec2 window);
    void record(const Timeline::Loop& range);
    void showWarnings();
    void show(const std::string& message);      // as long as it takes to read
    void say(const std::string& message);       // to the terminal, too
    static void print(const std::string& text); // for who started the program in a terminal
    WindowState windowState() const;
    void adopt(const WindowState& state);
    void leave();

    const RungInfo& info_;
    Settings& settings_;
    std::filesystem::path state_file_; // of --window-state; may be empty
    GlfwLibrary library_;
    WindowContext context_;
    Stage stage_;
    Timeline timeline_;
    PassTimer timer_;
    Inspector inspector_;
    Comparison comparison_;
    CostProbe compared_costs_; // of A and B
    CostProbe point_costs_;    // of the points of the chart in the panel
    CostProbe present_costs_;  // beside those
    Panel panel_;
    TimelineBar timeline_bar_;
    Help help_;
    History history_;
    Recorder recorder_;
    std::optional<Ui> ui_; // after the callbacks, which it passes events on to
    LayoutWish wish_;
    Layout layout_;
    PanelState state_;
    std::string compared_preset_; // what A was last compared with by a key
    bool readings_are_current_ = false;
    bool timed_ = false;            // whether the frame shown was
    bool observed_ = false;         // by the inspector
    std::optional<Process> search_; // for the cheapest settings within a budget
    double search_start_s_ = 0;
    BudgetResult::Sets found_;
    Clock::time_point start_ = Clock::now();
    double last_rendered_s_ = 0;
    std::string message_;
    double message_until_s_ = 0;
    bool save_asked_ = false;
    bool window_save_asked_ = false;
    Drag drags_ = Drag::nothing;
    bool shows_edge_ = false;
    glm::dvec2 cursor_{0};
};

} // namespace gll
