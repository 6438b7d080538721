// The bar and the labels, in Dear ImGui.
#include "window/compare_bar.hpp"

#include "window/panel.hpp"
#include "window/ui.hpp"

#include <algorithm>
#include <cstdio>
#include <imgui.h>

namespace gll {
namespace {

bool chosenButton(const char* label, bool is_chosen) {
    if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_SliderGrab));
    const bool pressed = ImGui::Button(label);
    if (is_chosen) ImGui::PopStyleColor();
    return pressed;
}

std::string errorText(const Comparison& comparison, bool is_short) {
    const auto& measured = comparison.measured();
    if (!measured) return "measuring";
    char words[96];
    if (is_short)
        std::snprintf(words, sizeof words, "FLIP %.4f", measured->flip);
    else
        std::snprintf(words, sizeof words, "FLIP %.4f, RMSE %.4f, %.1f %% of pixels", measured->flip,
                      measured->rmse, 100.0 * measured->pixels / std::max(measured->of, 1));
    return words;
}

std::string costText(const Stage& stage, const std::optional<CostProbe::Costs>& costs) {
    char words[96];
    if (costs && costs->cu.size() == 2)
        std::snprintf(words, sizeof words, "A %.2f, B %.2f cu", costs->cu[0], costs->cu[1]);
    else
        std::snprintf(words, sizeof words, "A %.1f ms, B %.1f ms", stage.timeMs(Stage::a),
                      stage.timeMs(Stage::b));
    return words;
}

void number(const std::string& text) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s", text.c_str());
    tooltip(
        "How far B is from A, of what the display is sent: FLIP (0 to 1, as the eye sees it), the root mean "
        "squared difference (0 to 1), and how many pixels differ at all. Then what each costs: the "
        "time it took, or, once counted beside the window, copies of a frame (cu).");
}

void exchangeButtons(Stage& stage) {
    ImGui::SameLine();
    if (ImGui::Button("Swap")) stage.swap();
    tooltip("X: A takes B's settings, and B takes A's");
    ImGui::SameLine();
    const bool edits_a = stage.edited() == Stage::a;
    if (ImGui::Button(edits_a ? "Copy A to B" : "Copy B to A"))
        stage.copy(stage.edited(), edits_a ? Stage::b : Stage::a);
}

// At most three, so that a label stays one.
std::string label(const Stage& stage, int side) {
    const std::vector<std::string> differences = stage.differences(side);
    std::string text = side == Stage::a ? "A" : "B";
    for (std::size_t i = 0; i < std::min<std::size_t>(differences.size(), 3); ++i)
        text += (i == 0 ? ":  " : ", ") + differences[i];
    if (differences.size() > 3) text += ", and " + std::to_string(differences.size() - 3) + " more";
    return text;
}

// right: x is where it ends.
void pill(float x, float y, const std::string& text, bool right, float most_width) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float width = std::min(size.x, std::max(most_width - 1.2F * em, 1.0F));
    const ImVec2 low(right ? x - width - 0.8F * em : x + 0.4F * em, y + 0.4F * em);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({low.x - 0.3F * em, low.y - 0.15F * em},
                       {low.x + width + 0.3F * em, low.y + size.y + 0.15F * em}, IM_COL32(0, 0, 0, 170),
                       0.3F * em);
    const ImVec4 clip(low.x, low.y, low.x + width, low.y + size.y);
    list.AddText(ImGui::GetFont(), em, low, IM_COL32(255, 255, 255, 255), text.c_str(), nullptr, 0, &clip);
}

} // namespace

void drawCompareBar(const Rectangle& place, float pixels_per_unit, Stage& stage, Comparison& comparison,
                    const std::optional<CostProbe::Costs>& costs, bool shows_times) {
    const float em = ImGui::GetFontSize();
    nextWindowAt(place, pixels_per_unit);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.4F * em, 0.25F * em});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.3F * em, 0.25F * em});
    ImGui::Begin("##compare", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    const bool has_two_lines = ImGui::GetContentRegionAvail().y > 2 * ImGui::GetFrameHeight();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Edit");
    for (const int side : {Stage::a, Stage::b}) {
        ImGui::SameLine();
        if (chosenButton(side == Stage::a ? "A##edit" : "B##edit", stage.edited() == side)) stage.edit(side);
        tooltip("B: which of the two the panel sets, and P and Ctrl+C mean");
    }
    ImGui::SameLine();
    if (ImGui::Button("Off")) comparison.mode = Comparison::Mode::off;
    tooltip("C");
    const bool has_room = ImGui::GetWindowWidth() > 50 * em;
    if (has_two_lines || has_room) exchangeButtons(stage); // else X will do
    if (has_two_lines) number(errorText(comparison, true));
    for (const auto mode : {Comparison::Mode::divider, Comparison::Mode::blink, Comparison::Mode::difference,
                            Comparison::Mode::flip}) {
        if (!has_two_lines || mode != Comparison::Mode::divider)
            ImGui::SameLine(0, mode == Comparison::Mode::divider ? em : 0.15F * em);
        const std::string name = labelOf(Comparison::mode_names[static_cast<std::size_t>(mode)]);
        if (chosenButton(name.c_str(), comparison.mode == mode)) comparison.mode = mode;
        tooltip(mode == Comparison::Mode::divider
                    ? "A to the left of a line that can be dragged, B to the right"
                : mode == Comparison::Mode::blink ? "A and B in turns: what differs moves"
                : mode == Comparison::Mode::difference
                    ? "what is sent to the display, B less A, 16 times as much"
                    : "where the eye sees a difference when A and B alternate: black none, pale yellow most");
    }
    if (!has_two_lines) number(errorText(comparison, !has_room));
    if (shows_times) number(costText(stage, costs));
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void drawCompareLabels(const Rectangle& picture, float pixels_per_unit, const Stage& stage,
                       const Comparison& comparison, double now_s) {
    const float left = static_cast<float>(picture.corner.x) / pixels_per_unit;
    const float top = static_cast<float>(picture.corner.y) / pixels_per_unit;
    const float width = static_cast<float>(picture.size.x) / pixels_per_unit;
    if (comparison.mode == Comparison::Mode::divider) {
        const float at = width * static_cast<float>(comparison.divider);
        pill(left, top, label(stage, Stage::a), false, at);
        pill(left + width, top, label(stage, Stage::b), true, width - at);
        const float bottom = top + static_cast<float>(picture.size.y) / pixels_per_unit;
        ImGui::GetBackgroundDrawList()->AddLine({left + at, top}, {left + at, bottom},
                                                IM_COL32(255, 255, 255, 200), 1.5F);
    } else if (comparison.mode == Comparison::Mode::blink) {
        pill(left, top, label(stage, Comparison::showsB(now_s) ? Stage::b : Stage::a), false, width);
    } else if (comparison.mode == Comparison::Mode::difference) {
        pill(left, top, "16 x |B - A|", false, width);
    } else if (comparison.mode == Comparison::Mode::flip) {
        const auto& measured = comparison.measured();
        pill(left, top,
             measured ? "FLIP of frame " + std::to_string(measured->frame)
                      : std::string("FLIP is being measured"),
             false, width);
    }
}

} // namespace gll
