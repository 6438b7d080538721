// What a window writes: frames and the command lines that render them again, pictures of itself, its state,
// and messages.
#include "rung/capture.hpp"
#include "rung/usage_error.hpp"
#include "window/rung_window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace gll {

std::string RungWindow::freeStem() const {
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

void RungWindow::copyCommand() {
    FrameRequest request = shownFrame();
    request.out = freeStem() + ".png";
    const std::string line = shellLine(headlessCommand(request, headlessContext()));
    glfwSetClipboardString(context_.window(), line.c_str());
    say("copied: " + line);
}

void RungWindow::record(const Timeline::Loop& range) {
    FrameRequest request = shownFrame();
    request.first_frame = range.first;
    request.last_frame = range.last;
    try {
        recorder_.start(request, info_.name, headlessContext());
    } catch (const std::runtime_error& error) {
        say(error.what());
    }
}

// The present frame into the current folder, and beside it the command line that renders it again, into yet
// another file: nothing is ever overwritten.
void RungWindow::save() {
    save_asked_ = false;
    try {
        const std::string stem = freeStem();
        FrameRequest request = shownFrame();
        request.out = stem + "_again.png";
        const std::string line = shellLine(headlessCommand(request, headlessContext()));

        saveImage(stem + ".png", forFile(stage_.renderer(stage_.edited()).image(), ".png"));
        std::ofstream text(stem + ".txt");
        text << line << "\n";
        text.close();
        if (!text) throw std::runtime_error(stem + ".txt: cannot be written");
        say("wrote " + stem + ".png");
    } catch (const std::runtime_error& error) {
        say(error.what()); // a full disk must not end the show
    }
}

// As it is drawn, with all panels: for a talk, a page, or a question to others.
void RungWindow::saveWindow(glm::ivec2 window) {
    window_save_asked_ = false;
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(window.x) * static_cast<std::size_t>(window.y) *
                                     3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadPixels(0, 0, window.x, window.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    const std::ptrdiff_t row = std::ptrdiff_t(window.x) * 3;
    for (int y = 0; y < window.y / 2; ++y) // OpenGL's first row is the bottom one
        std::swap_ranges(pixels.begin() + y * row, pixels.begin() + (y + 1) * row,
                         pixels.begin() + (window.y - 1 - y) * row);
    Image image;
    image.width = window.x;
    image.height = window.y;
    image.channels = 3;
    image.color_space = ColorSpace::srgb;
    image.pixels = std::move(pixels);
    std::string file = info_.name + "_window.png";
    for (int i = 2; std::filesystem::exists(file); ++i)
        file = info_.name + "_window_" + std::to_string(i) + ".png";
    try {
        saveImage(file, image);
        print("wrote " + file); // not in the window, whose next picture would have it
    } catch (const std::runtime_error& error) {
        say(error.what());
    }
}

// The first of them: all are on the terminal, and a window full of them would hide the picture.
void RungWindow::showWarnings() {
    const std::vector<std::string> lines = stage_.takeWarnings();
    if (lines.empty()) return;
    show("warning: " + lines.front() + (lines.size() > 1 ? "\nand more, on the terminal" : ""));
}

void RungWindow::show(const std::string& message) {
    message_ = message;
    message_until_s_ = now() + 4 + 0.05 * static_cast<double>(message.size());
}

void RungWindow::say(const std::string& message) {
    show(message);
    print(message);
}

void RungWindow::print(const std::string& text) {
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
}

WindowState RungWindow::windowState() const {
    return {.preferences = {.panel = wish_.panel,
                            .strip = wish_.strip,
                            .panel_em = double(layout_.panel.isShown()
                                                   ? static_cast<float>(layout_.panel.size.x) / ui_->emPx()
                                                   : wish_.panel_em),
                            .text_size = double(state_.text_size),
                            .waits_for_display = state_.waits_for_display,
                            .shows_times = state_.shows_times},
            .rung = info_.name,
            .picture = layout_.picture.size,
            .frame = timeline_.frame(),
            .is_playing = timeline_.isPlaying(),
            .speed = timeline_.speed(),
            .loop = timeline_.loop(),
            .sets_a = stage_.sets(Stage::a),
            .sets_b = stage_.sets(Stage::b),
            .edits_b = stage_.edited() == Stage::b,
            .comparison = Comparison::mode_names[static_cast<std::size_t>(comparison_.mode)],
            .divider = comparison_.divider,
            .inspected = inspector_.selected(),
            .files = stage_.given()};
}

void RungWindow::adopt(const WindowState& state) {
    const std::string file = state_file_.string();
    if (!state.rung.empty() && state.rung != info_.name)
        throw std::runtime_error(file + ": is of " + state.rung +
                                 "; open that with it, or name another file");
    for (const FileOption& option : file_options)
        if (!(state.files.*option.file).empty() && !info_.takes.contains(option.name))
            throw std::runtime_error(file + ": files: " + info_.name + " takes no " +
                                     std::string(option.name) + "; take it out");
    try {
        stage_.applySets(Stage::a, state.sets_a);
        stage_.applySets(Stage::b, state.sets_b);
    } catch (const UsageError& error) {
        throw std::runtime_error(file + ": " + error.what());
    }
    stage_.edit(state.edits_b ? Stage::b : Stage::a);
    if (state.files != stage_.given() && state.files != RungFiles{} && stage_.given() == RungFiles{})
        stage_.load(state.files);
    timeline_.seek(state.frame);
    timeline_.play(state.is_playing);
    timeline_.setSpeed(state.speed);
    timeline_.setLoop(state.loop);
    const auto mode =
        std::find(std::begin(Comparison::mode_names), std::end(Comparison::mode_names), state.comparison);
    comparison_.mode = static_cast<Comparison::Mode>(mode - std::begin(Comparison::mode_names));
    comparison_.divider = state.divider;
    if (state.inspected) inspector_.select(state.inspected);
    history_ = History(stage_.state());
}

void RungWindow::leave() {
    const WindowState state = windowState();
    rememberPreferences(state.preferences);
    if (state_file_.empty()) return;
    const std::filesystem::path fresh = state_file_.string() + ".new"; // never half of a state
    std::ofstream file(fresh);
    file << windowStateJson(state);
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(fresh, state_file_, error);
    if (!file || error)
        throw std::runtime_error(state_file_.string() + ": cannot be written; name another file");
}

} // namespace gll
