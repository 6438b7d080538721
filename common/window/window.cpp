// The window's loop: rendering, presenting, and what the panels ask for.
#include "window/window.hpp"

#include "rung/capture.hpp"
#include "rung/usage_error.hpp"
#include "window/compare_bar.hpp"
#include "window/error_view.hpp"
#include "window/rung_window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>

namespace gll {
namespace {

constexpr glm::ivec2 usual_window(1280, 720);

// A framebuffer's pixels, from a column on, in as wide a place of the window.
void blit(const Framebuffer& from, int first_column, const Rectangle& place, glm::ivec2 window) {
    const int bottom = window.y - place.corner.y - place.size.y;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glDisable(GL_FRAMEBUFFER_SRGB); // the frame is encoded already
    glDisable(GL_SCISSOR_TEST);
    glBlitFramebuffer(first_column, 0, first_column + place.size.x, place.size.y, place.corner.x, bottom,
                      place.corner.x + place.size.x, bottom + place.size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

// Said at once, and not after an hour in the window.
void requireWritable(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw std::runtime_error(file.string() + ": is a folder; name a file for --window-state");
    if (!std::filesystem::is_directory(folder, error))
        throw std::runtime_error(folder.string() +
                                 ": there is no such folder; make it, or name another file for "
                                 "--window-state");
}

// Tells both, in this order.
class Both final : public PassObserver {
  public:
    std::function<void()> at_first; // called before the first pass
    PassObserver* first = nullptr;
    PassObserver* second = nullptr;

    void before(const std::string& pass) override {
        if (at_first) std::exchange(at_first, nullptr)();
        if (first != nullptr) first->before(pass);
        if (second != nullptr) second->before(pass);
    }
    void after(const DrawnPass& pass) override {
        if (first != nullptr) first->after(pass);
        if (second != nullptr) second->after(pass);
    }
};

} // namespace

RungWindow::RungWindow(const FrameRequest& request, const WindowRequest& wished, const RungInfo& info,
                       Settings& settings)
    : info_(info), settings_(settings), state_file_(wished.state_file),
      context_(info.name + " - GL Ladder", usual_window), stage_(context_, info, settings, request.files),
      timeline_(request.first_frame), timer_(context_.info().is_software), panel_(info.name, settings),
      help_(Resources(), info.name), history_(stage_.state()) {
    listen();
    ui_.emplace(context_);
    WindowState state;
    std::error_code error;
    if (!state_file_.empty()) requireWritable(state_file_);
    const bool has_state = !state_file_.empty() && std::filesystem::exists(state_file_, error);
    if (has_state) state = readWindowState(state_file_);
    const WindowPreferences preferences = has_state ? state.preferences : rememberedPreferences();
    wish_.panel = preferences.panel || !has_state; // hidden for good, it would not be found again
    wish_.strip = preferences.strip && has_state;
    wish_.panel_em = static_cast<float>(preferences.panel_em);
    setTextSize(preferences.text_size);
    ui_->setWish(state_.text_size);
    state_.waits_for_display = preferences.waits_for_display;
    state_.shows_times = preferences.shows_times;
    glfwSwapInterval(state_.waits_for_display ? 1 : 0);
    if (has_state) adopt(state);
    if (has_state && request.preset != FrameRequest().preset) settings_.applyPreset(request.preset);
    if (wished.is_frame_given) timeline_.seek(request.first_frame);
    for (const std::string& set : request.sets)
        settings_.set(set);
    if (wished.picture)
        setPictureSize(*wished.picture);
    else if (has_state && state.picture.x > 0)
        setPictureSize(state.picture);
    else
        context_.resize(usual_window); // as large as the display's scale makes all else
    state_.renderer = context_.info().renderer;
    showWarnings();
}

void RungWindow::loop() {
    while (glfwWindowShouldClose(context_.window()) == GLFW_FALSE) {
        const glm::ivec2 size = context_.sizePx();
        if (size.x < 1 || size.y < 1 || glfwGetWindowAttrib(context_.window(), GLFW_ICONIFIED) != 0) {
            glfwWaitEvents(); // minimised: nothing to draw until it is back
            continue;
        }
        const double start_s = now();
        timeline_.advance(start_s);
        wish_.bar = comparison_.mode != Comparison::Mode::off;
        layout_ = layOut(size, ui_->emPx(), wish_);
        render();
        present(size);
        if (save_asked_) save();
        // Where the display does not hold the loop to its rate (no vertical sync), wait for events instead of
        // spinning. They wake it: where nothing moves, a few looks a second are for what comes from
        // elsewhere, such as a saved shader.
        const bool is_moving = timeline_.isPlaying() || comparison_.mode == Comparison::Mode::blink;
        const double rest_s = (is_moving ? 1.0 / frames_per_second : 0.1) - (now() - start_s);
        if (state_.waits_for_display && rest_s > 1e-3)
            glfwWaitEventsTimeout(rest_s);
        else
            glfwPollEvents();
    }
    leave();
}

void RungWindow::render() {
    const int frame = timeline_.frame();
    const bool strip = layout_.strip.isShown();
    const bool times = strip || (layout_.panel.isShown() && panel_.wantsPassTimes());
    const bool again = (times && timeline_.isPlaying()) || (strip && inspector_.wantsFrame()) ||
                       (times && state_.pass_times.empty()) || times != timed_ || strip != observed_;
    prepare();
    const int side = stage_.edited();
    if (isComparing()) {
        stage_.shareCamera();
        stage_.render(side == Stage::a ? Stage::b : Stage::a, frame, layout_.picture.size, nullptr, false);
    }
    Both both;
    // Not before a frame that is there already: its times would be gone.
    if (times) both.at_first = [&] { state_.pass_times = timer_.begin(); };
    if (times) both.first = &timer_;
    if (strip) {
        both.second = &inspector_;
        // What fits between the strip's lines of text.
        const float height = static_cast<float>(layout_.strip.size.y) - 5 * ui_->emPx();
        inspector_.begin(stage_.renderer(side), glm::ivec2(glm::vec2(1.6F * height, height)));
    }
    const bool is_rendered =
        stage_.render(side, frame, layout_.picture.size, times || strip ? &both : nullptr, again);
    if (!is_rendered) return;
    if (strip) inspector_.end();
    timed_ = times;
    observed_ = strip;
    state_.frame = frame;
    state_.frame_time_ms = stage_.timeMs(side);
    state_.is_gpu_time = times && !context_.info().is_software && !state_.pass_times.empty();
    if (state_.is_gpu_time) {
        state_.frame_time_ms = 0; // of the frame before, in the GPU's own time
        for (const PassTime& pass : state_.pass_times)
            state_.frame_time_ms += pass.time_ms;
    }
    readings_are_current_ = false;
    state_.shown_per_s += 0.15 * (1 / std::max(now() - last_rendered_s_, 1e-4) - state_.shown_per_s);
    last_rendered_s_ = now();
    showWarnings();
}

// What is to be seen is ready to be rendered; where it cannot be, such as for a file that is gone, A goes on.
void RungWindow::prepare() {
    try {
        stage_.prepare(stage_.edited());
        if (isComparing()) stage_.prepare(stage_.edited() == Stage::a ? Stage::b : Stage::a);
    } catch (const std::exception& error) {
        say(error.what());
        comparison_.mode = Comparison::Mode::off;
        stage_.edit(Stage::a);
    }
}

void RungWindow::present(glm::ivec2 window) {
    try {
        presentPictures(window);
    } catch (const std::exception& error) { // such as a shader of the window's own that is being edited
        say(error.what());
        inspector_.select(std::nullopt);
        comparison_.mode = Comparison::Mode::off;
        presentPictures(window);
    }
    const int side = stage_.edited();
    state_.is_playing = timeline_.isPlaying();
    if (layout_.panel.isShown() && !readings_are_current_ && stage_.isDrawn(side)) {
        state_.readings = stage_.renderer(side).readings(); // waits for the frame: only for who looks
        readings_are_current_ = true;
    }
    state_.searching_s = search_ ? now() - search_start_s_ : 0;
    if (search_) state_.search_progress = search_->lastErrorLine();
    state_.has_found = std::any_of(found_.begin(), found_.end(), [&](const auto& one) {
        return settings_.at(one.first).text() != one.second;
    });
    state_.edited = !isComparing() ? "" : side == Stage::a ? "A" : "B";
    const bool is_held = glfwGetMouseButton(context_.window(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    const History::State stage = stage_.state();
    history_.observe(stage, now(), is_held);
    state_.can_undo = history_.canUndo(stage);
    state_.can_redo = history_.canRedo(stage);
    ui_->begin(state_.text_size);
    drawPanels();
    drawMessages();
    ui_->end();
    if (window_save_asked_) saveWindow(window);
    attendSearch();
    context_.debugLog().check("OpenGL, presenting");
    glfwSwapBuffers(context_.window());
}

void RungWindow::presentPictures(glm::ivec2 window) {
    const Rectangle& picture = layout_.picture;
    Renderer& edited = stage_.renderer(stage_.edited());
    if (isInspecting()) inspector_.look(edited, picture, cursorPx());
    const Framebuffer* compared = nullptr;
    if (isComparing() && !isInspecting()) {
        Renderer& a = stage_.renderer(Stage::a);
        Renderer& b = stage_.renderer(Stage::b);
        const History::State key = {double(stage_.renderedCount(Stage::a)),
                                    double(stage_.renderedCount(Stage::b))};
        comparison_.measure(a, b, state_.frame, key, now());
        compared = comparison_.picture(a, b);
        if (state_.shows_times)
            compared_costs_.ask(shownFrame(), {stage_.sets(Stage::a), stage_.sets(Stage::b)},
                                headlessContext(), now());
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, window.x, window.y);
    if (isInspecting()) {
        glClearColor(0.07F, 0.07F, 0.07F, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        if (inspector_.lookedAt().isShown()) blit(inspector_.looked(), 0, inspector_.lookedAt(), window);
    } else if (compared != nullptr) {
        blit(*compared, 0, picture, window);
    } else if (isComparing() && comparison_.mode == Comparison::Mode::divider) {
        const int at = static_cast<int>(std::lround(comparison_.divider * picture.size.x));
        blit(stage_.renderer(Stage::a).presented(), 0, {picture.corner, {at, picture.size.y}}, window);
        blit(stage_.renderer(Stage::b).presented(), at,
             {{picture.corner.x + at, picture.corner.y}, {picture.size.x - at, picture.size.y}}, window);
    } else if (isComparing()) {
        const int side = Comparison::showsB(now()) ? Stage::b : Stage::a;
        blit(stage_.renderer(side).presented(), 0, picture, window);
    } else {
        blit(edited.presented(), 0, picture, window);
    }
}

// Costs are per pixel, and hardly depend on the frame's size: a small one takes little from the picture that
// goes on.
void RungWindow::askChartCosts() {
    if (!state_.shows_times || panel_.chartPoints().empty()) return;
    FrameRequest request = shownFrame();
    request.size = {320, 240};
    request.first_frame = request.last_frame = 1; // none before it to be rendered
    point_costs_.ask(request, panel_.chartPoints(), headlessContext(), now());
    if (point_costs_.costs()) present_costs_.ask(request, {settings_.changed()}, headlessContext(), now());
}

void RungWindow::drawPanels() {
    const float pixels_per_unit = context_.pixelsPerUnit();
    if (layout_.panel.isShown()) {
        state_.point_costs = state_.shows_times ? point_costs_.costs() : std::nullopt;
        state_.present_costs = state_.shows_times ? present_costs_.costs() : std::nullopt;
        attend(panel_.draw(layout_.panel, pixels_per_unit, settings_, state_));
        askChartCosts();
    }
    if (layout_.bar.isShown())
        drawCompareBar(layout_.bar, pixels_per_unit, stage_, comparison_,
                       state_.shows_times ? compared_costs_.costs() : std::nullopt, state_.shows_times);
    if (isComparing() && !isInspecting())
        drawCompareLabels(layout_.picture, pixels_per_unit, stage_, comparison_, now());
    if (layout_.timeline.isShown()) {
        const RecordingState recording{recorder_.isRecording(),
                                       recorder_.isRecording() ? recorder_.done() : 0, recorder_.of()};
        const auto asked = timeline_bar_.draw(layout_.timeline, pixels_per_unit, timeline_, recording);
        if (asked.record) record(*asked.record);
        if (asked.cancel_recording) recorder_.cancel();
    }
    if (isInspecting()) inspector_.drawBar(layout_.picture, pixels_per_unit, ui_->emPx());
    if (layout_.strip.isShown())
        inspector_.drawStrip(layout_.strip, pixels_per_unit,
                             state_.shows_times ? state_.pass_times : std::vector<PassTime>(), probe());
    help_.draw(layout_.picture, pixels_per_unit);
}

// Of the picture that is under the cursor.
std::string RungWindow::probe() const {
    int side = stage_.edited();
    if (isComparing() && comparison_.mode == Comparison::Mode::divider)
        side = cursorOnWidth() < comparison_.divider ? Stage::a : Stage::b;
    else if (isComparing() && comparison_.mode == Comparison::Mode::blink)
        side = Comparison::showsB(now()) ? Stage::b : Stage::a;
    const char* name = !isComparing() ? "frame" : side == Stage::a ? "A, frame" : "B, frame";
    return inspector_.probe(name, stage_.renderer(side).presented(), pictureTexel());
}

void RungWindow::drawMessages() {
    if (const auto said = recorder_.poll()) say(*said);
    int side = stage_.edited();
    const int other = side == Stage::a ? Stage::b : Stage::a;
    if (isComparing() && (stage_.errors(side).empty() || !stage_.isDrawn(other))) side = other;
    errorsOver(layout_.picture, context_.pixelsPerUnit(), stage_.errors(side), stage_.isDrawn(side));
    if (now() < message_until_s_) messageOver(layout_.picture, context_.pixelsPerUnit(), message_);
}

void RungWindow::attend(const PanelActions& asked) {
    if (asked.undo) undo();
    if (asked.redo) redo();
    if (asked.copy_command) copyCommand();
    if (asked.show_help) help_.visible = !help_.visible;
    if (asked.compare) compareKey(GLFW_KEY_C);
    if (asked.inspect) wish_.strip = !wish_.strip;
    if (asked.text_size) setTextSize(double(*asked.text_size));
    if (asked.stop_search) search_.reset();
    if (asked.search) startSearch(*asked.search);
    if (asked.take_found)
        for (const auto& [name, value] : found_)
            settings_.set(name, value);
    if (asked.show_times) state_.shows_times = *asked.show_times;
    if (asked.wait_for_display) {
        state_.waits_for_display = *asked.wait_for_display;
        glfwSwapInterval(state_.waits_for_display ? 1 : 0);
    }
}

// Searches within a budget in a process of its own.
void RungWindow::attendSearch() {
    if (!search_) return;
    const std::optional<ProcessResult> result = search_->poll();
    if (!result) return;
    search_.reset();
    const BudgetAnswer answer = budgetAnswer(*result);
    found_ = answer.set;
    state_.search_answer = answer.text;
    print(answer.text);
}

void RungWindow::startSearch(const Budget& budget) {
    try {
        search_.emplace(budgetCommand(budget, shownFrame(), headlessContext()));
        search_start_s_ = now();
        state_.search_answer.clear();
        state_.search_progress.clear();
        found_.clear();
    } catch (const std::runtime_error& error) {
        state_.search_answer = error.what(); // as for a frame that cannot be saved
    }
}

void RungWindow::undo() {
    if (const auto state = history_.undo(stage_.state())) stage_.setState(*state);
}

void RungWindow::redo() {
    if (const auto state = history_.redo(stage_.state())) stage_.setState(*state);
}

void RungWindow::setTextSize(double size) {
    state_.text_size = static_cast<float>(std::clamp(size, 0.5, 3.0));
}

void RungWindow::setPictureSize(glm::ivec2 picture) {
    wish_.bar = comparison_.mode != Comparison::Mode::off;
    const glm::vec2 size = glm::vec2(windowFor(picture, ui_->emPx(), wish_)) / context_.pixelsPerUnit();
    glfwSetWindowSize(context_.window(), static_cast<int>(std::lround(size.x)),
                      static_cast<int>(std::lround(size.y)));
}

const char* RungWindow::headlessContext() const { return context_.info().is_software ? "" : "egl"; }

int runWindow(const FrameRequest& request, const WindowRequest& wished, const RungInfo& info,
              Settings& settings) {
    request.applyTo(settings);
    RungWindow(request, wished, info, settings).loop();
    return 0;
}

} // namespace gll
