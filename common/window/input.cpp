// What keys, the mouse and dropped files do.
#include "window/rung_window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>

namespace gll {
namespace {

RungWindow*& shown() { // GLFW's callbacks are plain functions
    static RungWindow* window = nullptr;
    return window;
}

} // namespace

void RungWindow::listen() {
    shown() = this;
    GLFWwindow* window = context_.window();
    glfwSetKeyCallback(window, [](GLFWwindow*, int key, int scancode, int action, int modifiers) {
        if (action == GLFW_RELEASE) return;
        // Letters are those that are printed on the keys, wherever those are.
        const char* name = glfwGetKeyName(key, scancode);
        if (name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0')
            key = GLFW_KEY_A + (name[0] - 'a');
        shown()->key(key, action == GLFW_REPEAT, (modifiers & GLFW_MOD_CONTROL) != 0,
                     (modifiers & GLFW_MOD_SHIFT) != 0);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow*, double x, double y) { shown()->mouseMoved(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow*, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_LEFT) shown()->mouseButton(action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window, [](GLFWwindow*, double, double steps) { shown()->wheel(steps); });
    glfwSetDropCallback(window, [](GLFWwindow*, int count, const char** paths) {
        shown()->dropped(std::vector<std::filesystem::path>(paths, paths + count));
    });
}

void RungWindow::key(int key, bool is_repeated, bool with_control, bool with_shift) {
    if (with_control)
        controlKey(key, with_shift);
    else if (!is_repeated && functionKey(key))
        return;
    else if (!ui_->hasKeyboard())
        plainKey(key, is_repeated, with_shift);
}

void RungWindow::controlKey(int key, bool with_shift) {
    constexpr double step = 1.125;
    if (ui_->isTyping()) return;
    if (key == GLFW_KEY_Z) with_shift ? redo() : undo();
    if (key == GLFW_KEY_Y) redo();
    if (key == GLFW_KEY_C) copyCommand();
    if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD) setTextSize(double(state_.text_size) * step);
    if (key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT) setTextSize(double(state_.text_size) / step);
    if (key == GLFW_KEY_0 || key == GLFW_KEY_KP_0) setTextSize(1);
}

bool RungWindow::functionKey(int key) {
    if (key == GLFW_KEY_F1)
        help_.visible = !help_.visible;
    else if (key == GLFW_KEY_F2)
        panel_.focus();
    else if (key == GLFW_KEY_F11)
        context_.setFullScreen(!context_.isFullScreen());
    else if (key == GLFW_KEY_ESCAPE)
        escape();
    else
        return false;
    return true;
}

void RungWindow::escape() {
    if (ui_->closePopup()) return;
    if (help_.visible)
        help_.visible = false;
    else if (ui_->leavePanel())
        return;
    else if (isInspecting())
        inspector_.select(std::nullopt);
    else if (isComparing())
        comparison_.mode = Comparison::Mode::off;
    else
        glfwSetWindowShouldClose(context_.window(), GLFW_TRUE);
}

void RungWindow::plainKey(int key, bool is_repeated, bool with_shift) {
    if (key == GLFW_KEY_PERIOD) timeline_.step(1);
    if (key == GLFW_KEY_COMMA) timeline_.step(-1);
    if (is_repeated) return;
    if (key == GLFW_KEY_SPACE) timeline_.play(!timeline_.isPlaying());
    if (key == GLFW_KEY_R) resetCamera();
    if (key == GLFW_KEY_P) (with_shift ? window_save_asked_ : save_asked_) = true;
    if (key == GLFW_KEY_H) wish_.panel = !wish_.panel;
    if (key == GLFW_KEY_I) wish_.strip = !wish_.strip;
    compareKey(key);
}

void RungWindow::compareKey(int key) {
    if (key == GLFW_KEY_O) compareWith("original");
    if (key == GLFW_KEY_M) compareWith("recommended");
    if (key == GLFW_KEY_C)
        comparison_.mode =
            comparison_.mode == Comparison::Mode::off ? Comparison::Mode::divider : Comparison::Mode::off;
    if (!isComparing()) return;
    if (key == GLFW_KEY_X) stage_.swap();
    if (key == GLFW_KEY_B) stage_.edit(stage_.edited() == Stage::a ? Stage::b : Stage::a);
    if (key == GLFW_KEY_N) // the next way to show them
        comparison_.mode = comparison_.mode == Comparison::Mode::flip
                               ? Comparison::Mode::divider
                               : static_cast<Comparison::Mode>(static_cast<int>(comparison_.mode) + 1);
}

void RungWindow::compareWith(const std::string& preset) {
    const bool is_shown = comparison_.mode != Comparison::Mode::off && compared_preset_ == preset;
    comparison_.mode = is_shown ? Comparison::Mode::off : Comparison::Mode::divider;
    if (is_shown) return;
    compared_preset_ = preset;
    if (stage_.edited() == Stage::b) stage_.copy(Stage::b, Stage::a); // what is seen is compared
    stage_.edit(Stage::a);
    stage_.applyPreset(Stage::b, preset);
    stage_.shareCamera();
    if (stage_.differences(Stage::a).empty())
        say("A and B are the same, " + preset + "; change a setting, or compare with another preset");
}

glm::dvec2 RungWindow::cursorPx() const { return cursor_ * double(context_.pixelsPerUnit()); }

double RungWindow::cursorOnWidth() const {
    return (cursorPx().x - layout_.picture.corner.x) / std::max(layout_.picture.size.x, 1);
}

std::optional<glm::ivec2> RungWindow::pictureTexel() const {
    const glm::dvec2 place = cursorPx();
    const Rectangle& picture = layout_.picture;
    if (ui_->hasMouse() || !picture.contains(place) || shownFrame().size != picture.size) return {};
    const glm::ivec2 from_top(place - glm::dvec2(picture.corner));
    return glm::ivec2(from_top.x, picture.size.y - 1 - from_top.y);
}

RungWindow::Drag RungWindow::dragAt() const {
    const double reach_px = 0.6 * double(ui_->emPx());
    if (layout_.panel.isShown() && std::abs(cursorPx().x - layout_.panel.size.x) < reach_px / 2)
        return Drag::panel_edge;
    // The panels know only from the next frame on that the mouse is theirs.
    if (ui_->hasMouse() || !layout_.picture.contains(cursorPx())) return Drag::nothing;
    if (isInspecting()) return Drag::inspected;
    const bool has_divider = isComparing() && comparison_.mode == Comparison::Mode::divider;
    if (has_divider && std::abs(cursorOnWidth() - comparison_.divider) * layout_.picture.size.x < reach_px)
        return Drag::divider;
    return Drag::camera;
}

void RungWindow::mouseButton(bool is_pressed) { drags_ = is_pressed ? dragAt() : Drag::nothing; }

void RungWindow::mouseMoved(double x, double y) {
    const glm::dvec2 moved = glm::dvec2(x, y) - cursor_;
    cursor_ = {x, y};
    constexpr double degrees_per_unit = 0.4;
    switch (drags_) {
    case Drag::nothing:
        showEdge();
        break;
    case Drag::panel_edge:
        wish_.panel_em = std::max(std::min(static_cast<float>(cursorPx().x),
                                           widest_panel * static_cast<float>(context_.sizePx().x)) /
                                      ui_->emPx(),
                                  narrowest_panel_em);
        break;
    case Drag::divider:
        comparison_.divider = std::clamp(cursorOnWidth(), 0.0, 1.0);
        break;
    case Drag::inspected:
        inspector_.drag(moved * double(context_.pixelsPerUnit()));
        break;
    case Drag::camera:
        nudge(Setting::Role::orbit_yaw,
              [&](double v) { return std::remainder(v + moved.x * degrees_per_unit, 360); });
        nudge(Setting::Role::orbit_pitch, [&](double v) { return v + moved.y * degrees_per_unit; });
        break;
    }
}

void RungWindow::showEdge() {
    const bool is_there = dragAt() == Drag::panel_edge || dragAt() == Drag::divider;
    if (is_there == shows_edge_) return;
    shows_edge_ = is_there;
    ui_->keepCursor(is_there);
    context_.showResizeCursor(is_there);
}

void RungWindow::wheel(double steps) {
    if (ui_->hasMouse()) return;
    if (isInspecting()) return inspector_.zoom(steps, cursorPx());
    nudge(Setting::Role::orbit_zoom, [&](double v) { return v * std::pow(1.1, steps); });
}

template <class Change>
void RungWindow::nudge(Setting::Role role, const Change& change) {
    for (Setting& setting : settings_.all())
        if (setting.role == role)
            setting.value =
                std::clamp(std::round(change(setting.value) * 1000) / 1000, setting.min, setting.max);
}

void RungWindow::resetCamera() {
    for (Setting& setting : settings_.all())
        for (const auto role :
             {Setting::Role::orbit_yaw, Setting::Role::orbit_pitch, Setting::Role::orbit_zoom})
            if (setting.role == role) setting.value = setting.default_value;
}

// Each where the rung takes such a file.
void RungWindow::dropped(const std::vector<std::filesystem::path>& files) {
    RungFiles given = stage_.given();
    std::string names;
    for (const std::filesystem::path& file : files) {
        const FileOption* option = optionFor(file, info_.takes);
        if (option == nullptr) {
            std::string takes;
            for (const FileOption& one : file_options)
                if (info_.takes.contains(one.name))
                    takes += (takes.empty() ? "" : "; ") + std::string(one.help);
            return say(file.filename().string() + ": " + info_.name + " draws no such file. It takes " +
                       (takes.empty() ? "none" : takes));
        }
        given.*option->file = file;
        names += (names.empty() ? "" : ", ") + file.filename().string();
    }
    try {
        stage_.load(given);
        say("loaded " + names);
        showWarnings();
    } catch (const std::bad_alloc&) {
        say(names + ": there is not enough memory for it");
    } catch (const std::exception& error) {
        say(error.what());
    }
}

} // namespace gll
