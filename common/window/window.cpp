// The window's loop: keys, mouse, presenting and saving frames, and what the panel asks for.
#include "window/window.hpp"

#include "rung/capture.hpp"
#include "window/error_view.hpp"
#include "window/glfw_window.hpp"
#include "window/help.hpp"
#include "window/history.hpp"
#include "window/inspector.hpp"
#include "window/layout.hpp"
#include "window/live_shaders.hpp"
#include "window/panel.hpp"
#include "window/pass_timer.hpp"
#include "window/recorder.hpp"
#include "window/timeline.hpp"
#include "window/timeline_bar.hpp"
#include "window/ui.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace gll {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr glm::ivec2 usual_window(1280, 720);

// Tells several, in their order.
class Observers final : public PassObserver {
  public:
    void add(PassObserver& observer) { observers_.push_back(&observer); }
    PassObserver* orNone() { return observers_.empty() ? nullptr : this; }

    void before(const std::string& pass) override {
        for (PassObserver* observer : observers_)
            observer->before(pass);
    }
    void after(const DrawnPass& pass) override {
        for (PassObserver* observer : observers_)
            observer->after(pass);
    }

  private:
    std::vector<PassObserver*> observers_;
};

// The running window: what the callbacks change and the loop reads.
class RungWindow {
  public:
    RungWindow(const FrameRequest& request, std::optional<glm::ivec2> picture, const RungInfo& info,
               Settings& settings)
        : info_(info), settings_(settings), given_(request.files),
          context_(info.name + " - GL Ladder", usual_window), renderer_(context_, info, request.files),
          live_(info.name, renderer_.shaders()), timeline_(request.first_frame),
          timer_(context_.info().is_software), panel_(info.name, settings), help_(Resources(), info.name),
          history_(values()) {
        glfwSetWindowUserPointer(context_.window(), this);
        glfwSetKeyCallback(context_.window(), onKey);
        glfwSetCursorPosCallback(context_.window(), onCursor);
        glfwSetMouseButtonCallback(context_.window(), onButton);
        glfwSetScrollCallback(context_.window(), onScroll);
        ui_.emplace(context_);
        if (picture) setPictureSize(*picture);
        state_.renderer = context_.info().renderer;
        state_.is_gpu_time = false;
        showWarnings();
    }

    void loop() {
        while (glfwWindowShouldClose(context_.window()) == GLFW_FALSE) {
            const glm::ivec2 size = context_.sizePx();
            if (size.x < 1 || size.y < 1 || glfwGetWindowAttrib(context_.window(), GLFW_ICONIFIED) != 0) {
                glfwWaitEvents(); // minimised: nothing to draw until it is back
                continue;
            }
            const Clock::time_point start = Clock::now();
            timeline_.advance(secondsSince(start_));
            layout_ = layOut(size, ui_->emPx(), wish_);
            renderIfChanged(layout_.picture.size);
            present(size);
            if (save_asked_) save();
            // Where the display does not hold the loop to its rate (no vertical sync, or nothing moves), wait
            // for events instead of spinning.
            const double rest_s =
                (timeline_.isPlaying() ? 1.0 / frames_per_second : 1.0 / 30) - secondsSince(start);
            if (state_.waits_for_display && rest_s > 1e-3)
                glfwWaitEventsTimeout(rest_s);
            else
                glfwPollEvents();
        }
    }

  private:
    static RungWindow& self(GLFWwindow* window) {
        return *static_cast<RungWindow*>(glfwGetWindowUserPointer(window));
    }

    static void onKey(GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action == GLFW_RELEASE) return;
        RungWindow& that = self(window);
        const bool is_repeated = action == GLFW_REPEAT;
        if ((modifiers & GLFW_MOD_CONTROL) != 0)
            that.controlKey(key, (modifiers & GLFW_MOD_SHIFT) != 0);
        else if (!is_repeated && that.functionKey(key))
            return;
        else if (!that.ui_->hasKeyboard())
            that.plainKey(key, is_repeated);
    }

    void controlKey(int key, bool with_shift) {
        if (ui_->isTyping()) return;
        if (key == GLFW_KEY_Z) with_shift ? redo() : undo();
        if (key == GLFW_KEY_Y) redo();
        if (key == GLFW_KEY_C) copyCommand();
        if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD) setTextSize(state_.text_size * 1.125F);
        if (key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT) setTextSize(state_.text_size / 1.125F);
        if (key == GLFW_KEY_0 || key == GLFW_KEY_KP_0) setTextSize(1);
    }

    // Those that mean the same wherever the keyboard is.
    bool functionKey(int key) {
        if (key == GLFW_KEY_F1)
            help_.visible = !help_.visible;
        else if (key == GLFW_KEY_F11)
            context_.setFullScreen(!context_.isFullScreen());
        else if (key == GLFW_KEY_ESCAPE)
            escape();
        else
            return false;
        return true;
    }

    void escape() {
        if (ui_->escape()) return;
        if (help_.visible)
            help_.visible = false;
        else if (isInspecting())
            inspector_.select(std::nullopt);
        else
            glfwSetWindowShouldClose(context_.window(), GLFW_TRUE);
    }

    void plainKey(int key, bool is_repeated) {
        if (key == GLFW_KEY_PERIOD) timeline_.step(1);
        if (key == GLFW_KEY_COMMA) timeline_.step(-1);
        if (is_repeated) return;
        if (key == GLFW_KEY_SPACE) timeline_.play(!timeline_.isPlaying());
        if (key == GLFW_KEY_R) resetCamera();
        if (key == GLFW_KEY_P) save_asked_ = true;
        if (key == GLFW_KEY_H) wish_.panel = !wish_.panel;
        if (key == GLFW_KEY_I) wish_.strip = !wish_.strip;
        if (key == GLFW_KEY_TAB) panel_.focus();
    }

    // Where on the picture's width the divider of two compared methods is; nothing where none is shown.
    std::optional<double> divider() const {
        std::optional<double> place;
        bool is_shown = false;
        for (const Setting& setting : settings_.all()) {
            if (setting.role == Setting::Role::shows_divider) is_shown = setting.value != 0;
            if (setting.role == Setting::Role::divider) place = setting.value;
        }
        return is_shown ? place : std::nullopt;
    }

    // From the cursor's place, in the display's units, to pixels of the window.
    glm::dvec2 cursorPx() const { return cursor_ * double(context_.pixelsPerUnit()); }

    // Of the picture's width, at the cursor.
    double cursorOnWidth() const {
        return (cursorPx().x - layout_.picture.corner.x) / std::max(layout_.picture.size.x, 1);
    }

    static void onButton(GLFWwindow* window, int button, int action, int) {
        RungWindow& that = self(window);
        if (button != GLFW_MOUSE_BUTTON_LEFT) return;
        that.drags_ = action == GLFW_PRESS ? that.dragAt() : Drag::nothing;
    }

    enum class Drag { nothing, camera, divider, panel_edge, inspected };
    Drag dragAt() const {
        const double reach_px = 0.6 * ui_->emPx();
        if (layout_.panel.isShown() && std::abs(cursorPx().x - layout_.panel.size.x) < reach_px / 2)
            return Drag::panel_edge;
        if (ui_->hasMouse()) return Drag::nothing;
        const auto place = divider();
        if (isInspecting()) return Drag::inspected;
        if (place && std::abs(cursorOnWidth() - *place) * layout_.picture.size.x < reach_px)
            return Drag::divider;
        return Drag::camera;
    }

    static void onCursor(GLFWwindow* window, double x, double y) {
        RungWindow& that = self(window);
        const glm::dvec2 moved = glm::dvec2(x, y) - that.cursor_;
        that.cursor_ = {x, y};
        switch (that.drags_) {
        case Drag::nothing:
            that.showEdge();
            break;
        case Drag::panel_edge:
            that.wish_.panel_em = static_cast<float>(that.cursorPx().x) / that.ui_->emPx();
            break;
        case Drag::divider:
            that.nudge(Setting::Role::divider, [&](double) { return that.cursorOnWidth(); });
            break;
        case Drag::inspected:
            that.inspector_.drag(moved * double(that.context_.pixelsPerUnit()));
            break;
        case Drag::camera: {
            constexpr double degrees_per_unit = 0.4;
            that.nudge(Setting::Role::orbit_yaw,
                       [&](double v) { return std::remainder(v + moved.x * degrees_per_unit, 360); });
            that.nudge(Setting::Role::orbit_pitch, [&](double v) { return v + moved.y * degrees_per_unit; });
            break;
        }
        }
    }

    // The cursor says where the panel can be dragged wide.
    void showEdge() {
        const bool is_there = dragAt() == Drag::panel_edge;
        if (is_there == shows_edge_) return;
        shows_edge_ = is_there;
        ui_->keepCursor(is_there);
        context_.showResizeCursor(is_there);
    }

    static void onScroll(GLFWwindow* window, double, double steps) {
        RungWindow& that = self(window);
        if (that.ui_->hasMouse()) return;
        if (that.isInspecting()) return that.inspector_.zoom(steps, that.cursorPx());
        that.nudge(Setting::Role::orbit_zoom, [&](double v) { return v * std::pow(1.1, steps); });
    }

    // Changes a setting within its range, to thousandths, where the rung has it.
    template <class Change>
    void nudge(Setting::Role role, const Change& change) {
        for (Setting& setting : settings_.all())
            if (setting.role == role)
                setting.value =
                    std::clamp(std::round(change(setting.value) * 1000) / 1000, setting.min, setting.max);
    }

    void resetCamera() {
        for (Setting& setting : settings_.all())
            for (const auto role :
                 {Setting::Role::orbit_yaw, Setting::Role::orbit_pitch, Setting::Role::orbit_zoom})
                if (setting.role == role) setting.value = setting.default_value;
    }

    History::State values() const {
        History::State values;
        for (const Setting& setting : settings_.all())
            values.push_back(setting.value);
        return values;
    }
    void setValues(const std::optional<History::State>& values) {
        if (!values) return;
        for (std::size_t i = 0; i < values->size(); ++i)
            settings_.all()[i].value = (*values)[i];
    }
    void undo() { setValues(history_.undo(values())); }
    void redo() { setValues(history_.redo(values())); }

    void setTextSize(float size) { state_.text_size = std::clamp(size, 0.5F, 3.0F); }

    void setPictureSize(glm::ivec2 picture) {
        const glm::ivec2 size = windowFor(picture, ui_->emPx(), wish_);
        const float pixels_per_unit = context_.pixelsPerUnit();
        glfwSetWindowSize(context_.window(),
                          static_cast<int>(std::lround(static_cast<float>(size.x) / pixels_per_unit)),
                          static_cast<int>(std::lround(static_cast<float>(size.y) / pixels_per_unit)));
    }

    bool isInspecting() const { return layout_.strip.isShown() && inspector_.isInspecting(); }

    // What fits between the strip's lines of text.
    glm::ivec2 thumbnailSize() const {
        const auto height = static_cast<float>(layout_.strip.size.y) - 5 * ui_->emPx();
        const auto width = 1.6F * height;
        return glm::max(glm::ivec2(static_cast<int>(width), static_cast<int>(height)), glm::ivec2(1));
    }

    void renderIfChanged(glm::ivec2 size) {
        const int frame = timeline_.frame();
        const std::vector<std::string> sets_now = settings_.changed();
        const bool is_edited = live_.update();
        const bool strip = layout_.strip.isShown();
        const bool times = strip || (layout_.panel.isShown() && panel_.wantsPassTimes());
        const bool is_asked = (times && timeline_.isPlaying()) || (strip && inspector_.wantsFrame()) ||
                              times != timed_ || strip != observed_ || is_edited;
        if (frame == state_.frame && size == rendered_size_ && sets_now == rendered_sets_ && !is_asked)
            return;
        timed_ = times;
        observed_ = strip;
        const Clock::time_point start = Clock::now();
        if (times) state_.pass_times = timer_.begin();
        rendered_size_ = size;
        rendered_sets_ = sets_now;
        state_.frame = frame;
        readings_are_current_ = false;
        live_.attempt([&] {
            Observers observers;
            if (times) observers.add(timer_);
            if (strip) observers.add(inspector_);
            inspector_.begin(renderer_, thumbnailSize());
            renderer_.render(frame, size, observers.orNone());
            if (strip) inspector_.end();
        });
        if (context_.info().is_software) glFinish();
        showWarnings();
        state_.frame_time_ms = secondsSince(start) * 1e3;
        const double interval_s = secondsSince(last_rendered_);
        last_rendered_ = Clock::now();
        state_.shown_per_s += 0.15 * (1 / std::max(interval_s, 1e-4) - state_.shown_per_s);
    }

    // The first of them: all are on the terminal, and a panel full of them would hide the picture.
    void showWarnings() {
        const std::vector<std::string> lines = renderer_.takeWarnings();
        if (lines.empty()) return;
        show("warning: " + lines.front() + (lines.size() > 1 ? "\nand more, on the terminal" : ""));
    }

    void present(glm::ivec2 size) {
        if (isInspecting()) inspector_.look(renderer_, layout_.picture, cursorPx());
        glClearColor(0.07F, 0.07F, 0.07F, 1);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDisable(GL_SCISSOR_TEST);
        if (isInspecting()) {
            glClear(GL_COLOR_BUFFER_BIT);
            presentAt(inspector_.looked(), inspector_.lookedAt(), size);
        } else {
            presentAt(renderer_.presented(), layout_.picture, size);
        }
        state_.is_playing = timeline_.isPlaying();
        if (layout_.panel.isShown() && !readings_are_current_ && live_.isDrawn()) {
            state_.readings = renderer_.readings(); // waits for the frame: only for who looks
            readings_are_current_ = true;
        }
        state_.searching_s = search_ ? secondsSince(search_start_) : 0;
        const History::State now = values();
        history_.observe(now, secondsSince(start_), isHeld());
        state_.can_undo = history_.canUndo(now);
        state_.can_redo = history_.canRedo(now);
        ui_->begin(state_.text_size);
        const float pixels_per_unit = context_.pixelsPerUnit();
        if (layout_.panel.isShown()) attend(panel_.draw(layout_.panel, pixels_per_unit, settings_, state_));
        if (layout_.timeline.isShown()) {
            const RecordingState recording{recorder_.isRecording(),
                                           recorder_.isRecording() ? recorder_.done() : 0, recorder_.of()};
            const auto asked = timeline_bar_.draw(layout_.timeline, pixels_per_unit, timeline_, recording);
            if (asked.record) record(*asked.record);
            if (asked.cancel_recording) recorder_.cancel();
        }
        if (isInspecting()) inspector_.drawBar(layout_.picture, pixels_per_unit, ui_->emPx());
        if (layout_.strip.isShown())
            inspector_.drawStrip(layout_.strip, pixels_per_unit, state_.pass_times,
                                 inspector_.probe(renderer_.presented(), pictureTexel()));
        help_.draw(layout_.picture, pixels_per_unit);
        if (const auto said = recorder_.poll()) say(*said);
        errorsOver(layout_.picture, pixels_per_unit, live_.errors(), live_.isDrawn());
        if (secondsSince(message_start_) < message_length_s_ && wish_.panel)
            messageOver(layout_.picture, pixels_per_unit, message_);
        ui_->end();
        attendSearch();
        context_.debugLog().check("OpenGL, presenting");
        glfwSwapBuffers(context_.window());
    }

    // Where the cursor is in the picture, from its lower left; nothing where it is elsewhere.
    std::optional<glm::ivec2> pictureTexel() const {
        const glm::dvec2 place = cursorPx();
        const Rectangle& picture = layout_.picture;
        if (ui_->hasMouse() || !picture.contains(place) || rendered_size_ != picture.size) return {};
        const glm::ivec2 from_top(place - glm::dvec2(picture.corner));
        return glm::ivec2(from_top.x, picture.size.y - 1 - from_top.y);
    }

    // A framebuffer's picture in a place of that size in the window.
    void presentAt(const Framebuffer& picture, const Rectangle& place, glm::ivec2 window) {
        const int bottom = window.y - place.corner.y - place.size.y;
        glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.id());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glDisable(GL_FRAMEBUFFER_SRGB); // the frame is encoded already
        glDisable(GL_SCISSOR_TEST);
        glBlitFramebuffer(0, 0, place.size.x, place.size.y, place.corner.x, bottom,
                          place.corner.x + place.size.x, bottom + place.size.y, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, window.x, window.y);
    }

    bool isHeld() const {
        return glfwGetMouseButton(context_.window(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    }

    void attend(const PanelActions& asked) {
        if (asked.undo) undo();
        if (asked.redo) redo();
        if (asked.copy_command) copyCommand();
        if (asked.show_help) help_.visible = !help_.visible;
        if (asked.text_size) setTextSize(*asked.text_size);
        if (asked.stop_search) search_.reset();
        if (asked.search) startSearch(*asked.search);
        if (asked.wait_for_display) {
            state_.waits_for_display = *asked.wait_for_display;
            glfwSwapInterval(state_.waits_for_display ? 1 : 0);
        }
    }

    // Searches within a budget in a process of its own, and takes over what it finds.
    void attendSearch() {
        if (!search_) return;
        const std::optional<ProcessResult> result = search_->poll();
        if (!result) return;
        search_.reset();
        const BudgetAnswer answer = budgetAnswer(*result);
        for (const auto& [name, value] : answer.set)
            settings_.set(name, value);
        state_.search_answer = answer.text;
        print(answer.text);
    }

    void startSearch(const Budget& budget) {
        try {
            search_.emplace(budgetCommand(budget, shownFrame(), headlessContext()));
            search_start_ = Clock::now();
            state_.search_answer.clear();
        } catch (const std::runtime_error& error) {
            state_.search_answer = error.what(); // as for a frame that cannot be saved
        }
    }

    // What asks for the picture that is shown: the panel may have changed a setting since.
    FrameRequest shownFrame() const {
        FrameRequest request;
        request.size = rendered_size_;
        request.first_frame = request.last_frame = state_.frame;
        request.sets = rendered_sets_;
        request.files = given_;
        return request;
    }

    // Where a GPU draws, frames and costs are the GPU's.
    const char* headlessContext() const { return context_.info().is_software ? "" : "egl"; }

    void copyCommand() {
        FrameRequest request = shownFrame();
        request.out = freeStem() + ".png";
        const std::string line = shellLine(headlessCommand(request, headlessContext()));
        glfwSetClipboardString(context_.window(), line.c_str());
        say("copied: " + line);
    }

    void record(const Timeline::Loop& range) {
        FrameRequest request = shownFrame();
        request.first_frame = range.first;
        request.last_frame = range.last;
        try {
            recorder_.start(request, info_.name, headlessContext());
        } catch (const std::runtime_error& error) {
            say(error.what());
        }
    }

    // For who started the program in a terminal.
    static void print(const std::string& text) {
        std::printf("%s\n", text.c_str());
        std::fflush(stdout);
    }

    // As long as it takes to read.
    void show(const std::string& message) {
        message_ = message;
        message_length_s_ = 4 + 0.05 * static_cast<double>(message.size());
        message_start_ = Clock::now();
    }

    void say(const std::string& message) {
        show(message);
        print(message);
    }

    // A file's name without its ending that nothing in the current folder has: nothing is ever overwritten.
    std::string freeStem() const {
        const auto isTaken = [](const std::string& stem) {
            return std::filesystem::exists(stem + ".png") || std::filesystem::exists(stem + ".txt") ||
                   std::filesystem::exists(stem + "_again.png");
        };
        const std::string first = info_.name + "_frame_" + std::to_string(state_.frame);
        std::string stem = first;
        for (int i = 2; isTaken(stem); ++i)
            stem = first + "_" + std::to_string(i);
        return stem;
    }

    // The present frame into the current folder, and beside it the command line that renders it again, into
    // yet another file.
    void save() {
        save_asked_ = false;
        try {
            const std::string stem = freeStem();
            FrameRequest request = shownFrame();
            request.out = stem + "_again.png";
            const std::string line = shellLine(headlessCommand(request, headlessContext()));

            saveImage(stem + ".png", forFile(renderer_.image(), ".png"));
            std::ofstream text(stem + ".txt");
            text << line << "\n";
            text.close();
            if (!text) throw std::runtime_error(stem + ".txt: cannot be written");
            say("wrote " + stem + ".png");
        } catch (const std::runtime_error& error) {
            say(error.what()); // a full disk must not end the show
        }
    }

    const RungInfo& info_;
    Settings& settings_;
    RungFiles given_;
    GlfwLibrary library_;
    WindowContext context_;
    Renderer renderer_;
    LiveShaders live_;
    Timeline timeline_;
    PassTimer timer_;
    Panel panel_;
    TimelineBar timeline_bar_;
    Help help_;
    History history_;
    Recorder recorder_;
    Inspector inspector_;
    std::optional<Ui> ui_;
    LayoutWish wish_;
    Layout layout_;
    PanelState state_;
    glm::ivec2 rendered_size_{0};
    std::vector<std::string> rendered_sets_;
    bool readings_are_current_ = false;
    bool timed_ = false;            // whether the frame shown was
    bool observed_ = false;         // by the inspector
    std::optional<Process> search_; // for the cheapest settings within a budget
    Clock::time_point search_start_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_rendered_ = start_;
    std::string message_;
    Clock::time_point message_start_;
    double message_length_s_ = 0;
    bool save_asked_ = false;
    Drag drags_ = Drag::nothing;
    bool shows_edge_ = false;
    glm::dvec2 cursor_{0};
};

} // namespace

int runWindow(const FrameRequest& request, std::optional<glm::ivec2> picture, const RungInfo& info,
              Settings& settings) {
    request.applyTo(settings);
    RungWindow(request, picture, info, settings).loop();
    return 0;
}

} // namespace gll
