// The bar, in Dear ImGui.
#include "window/timeline_bar.hpp"

#include "rung/frame.hpp"
#include "window/ui.hpp"

#include <algorithm>
#include <imgui.h>

namespace gll {
namespace {

void frameNumber(const char* label, int& frame, const char* help) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(3.4F * ImGui::GetFontSize());
    if (ImGui::InputInt(label, &frame, 0)) frame = std::clamp(frame, 1, max_frame);
    tooltip(help);
}

} // namespace

TimelineBar::Actions TimelineBar::draw(const Rectangle& place, float pixels_per_unit, Timeline& timeline,
                                       const RecordingState& recording) {
    Actions actions;
    if (timeline.loop() && !ImGui::GetIO().WantTextInput) range_ = *timeline.loop();
    nextWindowAt(place, pixels_per_unit);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {0.4F * ImGui::GetFontSize(), 0.25F * ImGui::GetFontSize()});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        {0.35F * ImGui::GetFontSize(), 0.25F * ImGui::GetFontSize()});
    ImGui::Begin("##timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const float em = ImGui::GetFontSize();
    const bool has_two_lines = ImGui::GetContentRegionAvail().y > 2 * ImGui::GetFrameHeight();
    if (ImGui::Button(timeline.isPlaying() ? "Pause" : "Play", {3.6F * em, 0}))
        timeline.play(!timeline.isPlaying());
    tooltip("Space");
    ImGui::SameLine();
    if (ImGui::Button("<")) timeline.step(-1);
    tooltip("Comma: one frame back");
    ImGui::SameLine();
    if (ImGui::Button(">")) timeline.step(1);
    tooltip("Period: one frame on");
    ImGui::SameLine();

    int frame = timeline.frame();
    const int first = timeline.loop() ? timeline.loop()->first : 1;
    while (scrub_end_ < frame && scrub_end_ < max_frame)
        scrub_end_ = std::min(2 * scrub_end_, max_frame);
    const int last = timeline.loop() ? timeline.loop()->last : scrub_end_;
    const float rest = has_two_lines ? 0 : 21.5F * em; // what is to the right of the slider
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - rest, 3 * em));
    if (ImGui::SliderInt("##frame", &frame, std::min(first, frame), std::max(last, frame), "frame %d"))
        timeline.seek(frame);
    tooltip("Any frame: frame N is always the same picture. Ctrl and click to type a number.");
    if (!has_two_lines) ImGui::SameLine();
    ImGui::SetNextItemWidth(3.6F * em);
    constexpr double speeds[] = {0.125, 0.25, 0.5, 1, 2, 4};
    constexpr const char* names[] = {"1/8", "1/4", "1/2", "1 \u00d7", "2 \u00d7", "4 \u00d7"};
    std::size_t chosen = 3;
    for (std::size_t i = 0; i < std::size(speeds); ++i)
        if (speeds[i] == timeline.speed()) chosen = i;
    if (beginCombo("##speed", names[chosen])) {
        for (std::size_t i = 0; i < std::size(speeds); ++i)
            if (ImGui::Selectable(names[i], i == chosen)) timeline.setSpeed(speeds[i]);
        ImGui::EndCombo();
    }
    tooltip("speed; 1: sixty frames a second");
    ImGui::SameLine();
    bool loops = timeline.loop().has_value();
    if (ImGui::Checkbox("Loop", &loops)) timeline.setLoop(loops ? std::optional(range_) : std::nullopt);
    tooltip("from the first of these frames to the last, over and over again");
    const Timeline::Loop before = range_;
    frameNumber("##first", range_.first, "the first frame of the loop, and of what is recorded");
    frameNumber("##last", range_.last, "the last frame of the loop, and of what is recorded");
    const bool is_edited = ImGui::GetIO().WantTextInput;
    if (!is_edited && range_.first > range_.last) std::swap(range_.first, range_.last);
    if (loops && !(before == range_) && range_.first <= range_.last) timeline.setLoop(range_);
    ImGui::SameLine();
    if (recording.is_recording) {
        const std::string label =
            "Cancel " + std::to_string(recording.done) + "/" + std::to_string(recording.of) + "###cancel";
        if (ImGui::Button(label.c_str())) actions.cancel_recording = true;
        tooltip("ends the recording, and keeps what is written: " + std::to_string(recording.done) + " of " +
                std::to_string(recording.of));
    } else {
        if (ImGui::Button("Record") && range_.first <= range_.last) actions.record = range_;
        tooltip("writes these frames as PNG files into a new folder, while the picture goes on");
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    return actions;
}

} // namespace gll
