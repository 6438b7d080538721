// The window by GLFW: clock, keys, mouse, presenting and saving frames.
#include "window/window.hpp"

#include "rung/capture.hpp"
#include "window/panel.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace gll {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

struct GlfwLibrary {
    GlfwLibrary() {
        // Asked for a display that nothing names, Wayland's library complains on stderr where there is no
        // XDG_RUNTIME_DIR.
        const bool wayland = isSet("WAYLAND_DISPLAY") || isSet("WAYLAND_SOCKET");
        if (!wayland && !isSet("DISPLAY")) throw NoWindow("neither DISPLAY nor WAYLAND_DISPLAY is set");
#ifdef GLFW_PLATFORM // GLFW 3.4, which otherwise tries Wayland first
        if (!wayland) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (glfwInit() != GLFW_TRUE) throw NoWindow(glfwReason());
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

class WindowContext final : public Context {
  public:
    WindowContext(const std::string& title, glm::ivec2 size) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
        if (window_ == nullptr) throw NoWindow(glfwReason());
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        try {
            load(glfwGetProcAddress);
        } catch (...) {
            glfwDestroyWindow(window_);
            throw;
        }
    }
    ~WindowContext() override { glfwDestroyWindow(window_); }
    const char* kind() const override { return "window"; }
    GLFWwindow* window() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
};

// Frame numbers by the wall clock, 60 a second, from where they were last set; or standing still.
class FrameClock {
  public:
    explicit FrameClock(int first_frame) : base_(first_frame) {}

    int frame() const {
        const double elapsed_s = paused_ ? 0 : secondsSince(start_);
        return static_cast<int>(
            std::min<double>(base_ + std::floor(elapsed_s * frames_per_second), max_frame));
    }
    bool paused() const { return paused_; }
    void pause(bool paused) {
        base_ = frame();
        start_ = Clock::now();
        paused_ = paused;
    }
    void step(int frames) {
        pause(true);
        base_ = std::clamp(base_ + frames, 1, max_frame);
    }

  private:
    int base_;
    Clock::time_point start_ = Clock::now();
    bool paused_ = false;
};

// Times passes: on a GPU by its own clock, read one frame later; in software by waiting for each.
class PassTimer final : public PassObserver {
  public:
    explicit PassTimer(bool software) : software_(software) {}
    ~PassTimer() override { glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data()); }
    PassTimer(const PassTimer&) = delete;
    PassTimer& operator=(const PassTimer&) = delete;

    // Before a frame: the times of the frame before.
    std::vector<PassTime> begin() {
        std::vector<PassTime> times = std::move(pending_);
        pending_.clear();
        if (!software_)
            for (std::size_t i = 0; i < times.size(); ++i) {
                GLuint64 elapsed_ns = 0;
                glGetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &elapsed_ns);
                times[i].time_ms = double(elapsed_ns) * 1e-6;
            }
        return times;
    }
    void before(const std::string&) override {
        start_ = Clock::now();
        if (software_) {
            glFinish();
            return;
        }
        if (pending_.size() == queries_.size()) {
            queries_.push_back(0);
            glGenQueries(1, &queries_.back());
        }
        glBeginQuery(GL_TIME_ELAPSED, queries_[pending_.size()]);
    }
    void after(const DrawnPass& pass) override {
        software_ ? glFinish() : glEndQuery(GL_TIME_ELAPSED);
        pending_.push_back({pass.name, secondsSince(start_) * 1e3});
    }

  private:
    bool software_;
    std::vector<GLuint> queries_;
    std::vector<PassTime> pending_;
    Clock::time_point start_;
};

// The running window: what the callbacks change and the loop reads.
class RungWindow {
  public:
    RungWindow(const FrameRequest& request, const RungInfo& info, Settings& settings)
        : info_(info), settings_(settings), given_(request.files),
          context_(info.name + " - GL Ladder", request.size), renderer_(context_, info, request.files),
          clock_(request.first_frame), timer_(context_.info().is_software) {
        glfwSetWindowUserPointer(context_.window(), this);
        glfwSetKeyCallback(context_.window(), onKey);
        glfwSetCursorPosCallback(context_.window(), onCursor);
        glfwSetMouseButtonCallback(context_.window(), onButton);
        glfwSetScrollCallback(context_.window(), onScroll);
        panel_.emplace(context_.window());
        state_.renderer = context_.info().renderer;
        showWarnings();
    }

    void loop() {
        while (glfwWindowShouldClose(context_.window()) == GLFW_FALSE) {
            glm::ivec2 size(0);
            glfwGetFramebufferSize(context_.window(), &size.x, &size.y);
            if (size.x < 1 || size.y < 1 || glfwGetWindowAttrib(context_.window(), GLFW_ICONIFIED) != 0) {
                glfwWaitEvents(); // minimised: nothing to draw until it is back
                continue;
            }
            const Clock::time_point start = Clock::now();
            renderIfChanged(size);
            present(size);
            if (save_asked_) save(size);
            // Where the display does not hold the loop to its rate (no vertical sync, or nothing moves), wait
            // for events instead of spinning.
            const double rest_s =
                (clock_.paused() ? 1.0 / 30 : 1.0 / frames_per_second) - secondsSince(start);
            if (rest_s > 1e-3)
                glfwWaitEventsTimeout(rest_s);
            else
                glfwPollEvents();
        }
    }

  private:
    static RungWindow& self(GLFWwindow* window) {
        return *static_cast<RungWindow*>(glfwGetWindowUserPointer(window));
    }

    static void onKey(GLFWwindow* window, int key, int, int action, int) {
        RungWindow& that = self(window);
        if (action == GLFW_RELEASE || that.panel_->hasKeyboard()) return;
        if (key == GLFW_KEY_PERIOD) that.clock_.step(1);
        if (key == GLFW_KEY_COMMA) that.clock_.step(-1);
        if (action == GLFW_REPEAT) return;
        if (key == GLFW_KEY_SPACE) that.clock_.pause(!that.clock_.paused());
        if (key == GLFW_KEY_R) that.resetCamera();
        if (key == GLFW_KEY_P) that.save_asked_ = true;
        if (key == GLFW_KEY_H) that.panel_->visible = !that.panel_->visible;
        if (key == GLFW_KEY_ESCAPE && !that.panel_->closePopup()) glfwSetWindowShouldClose(window, GLFW_TRUE);
    }

    // Where on the window's width the divider of two compared methods is; nothing where none is shown.
    std::optional<double> divider() const {
        std::optional<double> place;
        bool is_shown = false;
        for (const Setting& setting : settings_.all()) {
            if (setting.role == Setting::Role::shows_divider) is_shown = setting.value != 0;
            if (setting.role == Setting::Role::divider) place = setting.value;
        }
        return is_shown ? place : std::nullopt;
    }

    static double width(GLFWwindow* window) { // in the cursor's units
        int width = 1;
        glfwGetWindowSize(window, &width, nullptr);
        return std::max(width, 1);
    }

    static void onButton(GLFWwindow* window, int button, int action, int) {
        constexpr double reach = 10;
        RungWindow& that = self(window);
        if (button != GLFW_MOUSE_BUTTON_LEFT) return;
        const auto divider = that.divider();
        that.drags_divider_ = action == GLFW_PRESS && divider && !that.panel_->hasMouse() &&
                              std::abs(that.cursor_x_ - *divider * width(window)) < reach;
    }

    static void onCursor(GLFWwindow* window, double x, double y) {
        RungWindow& that = self(window);
        const double dx = x - that.cursor_x_;
        const double dy = y - that.cursor_y_;
        that.cursor_x_ = x;
        that.cursor_y_ = y;
        if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) != GLFW_PRESS || that.panel_->hasMouse())
            return;
        if (that.drags_divider_) {
            that.nudge(Setting::Role::divider, [&](double) { return x / width(window); });
            return;
        }
        constexpr double degrees_per_unit = 0.4;
        that.nudge(Setting::Role::orbit_yaw,
                   [&](double v) { return std::remainder(v + dx * degrees_per_unit, 360); });
        that.nudge(Setting::Role::orbit_pitch, [&](double v) { return v + dy * degrees_per_unit; });
    }

    static void onScroll(GLFWwindow* window, double, double steps) {
        RungWindow& that = self(window);
        if (that.panel_->hasMouse()) return;
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

    void renderIfChanged(glm::ivec2 size) {
        const int frame = clock_.frame();
        const std::vector<std::string> sets_now = settings_.changed();
        const bool times = panel_->wantsPassTimes();
        if (frame == state_.frame && size == rendered_size_ && sets_now == rendered_sets_ && !times) return;
        const Clock::time_point start = Clock::now();
        if (times) state_.pass_times = timer_.begin();
        renderer_.render(frame, size, times ? &timer_ : nullptr);
        if (context_.info().is_software) glFinish();
        showWarnings();
        state_.frame_time_ms = secondsSince(start) * 1e3;
        state_.frame = frame;
        rendered_size_ = size;
        rendered_sets_ = sets_now;
        readings_are_current_ = false;
    }

    // The first of them: all are on the terminal, and a panel full of them would hide the picture.
    void showWarnings() {
        const std::vector<std::string> lines = renderer_.takeWarnings();
        if (lines.empty()) return;
        state_.message = "warning: " + lines.front();
        if (lines.size() > 1) state_.message += "\nand more, on the terminal";
    }

    void present(glm::ivec2 size) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer_.presented().id());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glDisable(GL_FRAMEBUFFER_SRGB); // the frame is encoded already
        glDisable(GL_SCISSOR_TEST);
        glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, size.x, size.y);
        state_.paused = clock_.paused();
        if (panel_->visible && !readings_are_current_) { // reading waits for the frame: only for who looks
            state_.readings = renderer_.readings();
            readings_are_current_ = true;
        }
        state_.searching_s = search_ ? secondsSince(search_start_) : 0;
        if (secondsSince(message_start_) > message_length_s_) state_.message.clear();
        state_.can_undo = !found_.empty() && stands(found_.back());
        panel_->draw(settings_, state_);
        attendSearch(size);
        context_.debugLog().check("OpenGL, presenting");
        glfwSwapBuffers(context_.window());
    }

    // Searches within a budget in a process of its own, and takes over what it finds.
    void attendSearch(glm::ivec2 size) {
        if (panel_->stop_asked) search_.reset();
        if (panel_->undo_asked) undoSearch();
        if (panel_->search_asked) startSearch(*panel_->search_asked, size);
        if (!search_) return;
        const std::optional<ProcessResult> result = search_->poll();
        if (!result) return;
        search_.reset();
        const BudgetAnswer answer = budgetAnswer(*result);
        std::vector<Change> found;
        for (const auto& [name, value] : answer.set) {
            found.push_back({name, settings_.at(name).text(), value});
            settings_.set(name, value);
        }
        if (!found.empty()) found_.push_back(found);
        state_.search_answer = answer.text;
        print(answer.text);
    }

    struct Change {
        std::string setting;
        std::string before;
        std::string found;
    };

    bool stands(const std::vector<Change>& changes) const {
        return std::all_of(changes.begin(), changes.end(), [&](const Change& change) {
            return settings_.at(change.setting).text() == change.found;
        });
    }

    void undoSearch() {
        std::string text = "undone:";
        for (const Change& change : found_.back()) {
            settings_.set(change.setting, change.before);
            text += " --set " + change.setting + "=" + change.before;
        }
        found_.pop_back();
        state_.search_answer = text;
        print(text);
    }

    // For who started the program in a terminal.
    static void print(const std::string& text) {
        std::printf("%s\n", text.c_str());
        std::fflush(stdout);
    }

    // In the panel too, as long as it takes to read.
    void say(const std::string& message) {
        state_.message = message;
        message_length_s_ = 4 + 0.05 * static_cast<double>(message.size());
        message_start_ = Clock::now();
        print(message);
    }

    void startSearch(const Budget& budget, glm::ivec2 size) {
        FrameRequest request;
        request.size = size;
        request.first_frame = request.last_frame = state_.frame;
        request.sets = settings_.changed();
        request.files = given_;
        try {
            search_.emplace(budgetCommand(budget, request, headlessContext()));
            search_start_ = Clock::now();
            state_.search_answer.clear();
        } catch (const std::runtime_error& error) {
            state_.search_answer = error.what(); // as for a frame that cannot be saved
        }
    }

    // Where a GPU draws, frames and costs are the GPU's.
    const char* headlessContext() const { return context_.info().is_software ? "" : "egl"; }

    // The present frame into the current folder, and beside it the command line that renders it again, into
    // yet another file: nothing is ever overwritten.
    void save(glm::ivec2 size) {
        save_asked_ = false;
        const auto isTaken = [](const std::string& stem) {
            return std::filesystem::exists(stem + ".png") || std::filesystem::exists(stem + ".txt") ||
                   std::filesystem::exists(stem + "_again.png");
        };
        try {
            const std::string first = info_.name + "_frame_" + std::to_string(state_.frame);
            std::string stem = first;
            for (int i = 2; isTaken(stem); ++i)
                stem = first + "_" + std::to_string(i);
            FrameRequest request;
            request.size = size;
            request.first_frame = request.last_frame = state_.frame;
            // What the frame was rendered with: the panel may have changed a setting since.
            request.sets = rendered_sets_;
            request.files = given_;
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
    FrameClock clock_;
    PassTimer timer_;
    std::optional<Panel> panel_;
    PanelState state_;
    glm::ivec2 rendered_size_{0};
    std::vector<std::string> rendered_sets_;
    bool readings_are_current_ = false;
    std::optional<Process> search_; // for the cheapest settings within a budget
    Clock::time_point search_start_;
    std::vector<std::vector<Change>> found_; // what searches changed and undo takes back, the last at the end
    Clock::time_point message_start_;
    double message_length_s_ = 0;
    bool save_asked_ = false;
    bool drags_divider_ = false;
    double cursor_x_ = 0;
    double cursor_y_ = 0;
};

} // namespace

int runWindow(const FrameRequest& request, const RungInfo& info, Settings& settings) {
    request.applyTo(settings);
    RungWindow(request, info, settings).loop();
    return 0;
}

} // namespace gll
