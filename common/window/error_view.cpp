// Errors by Dear ImGui.
#include "window/error_view.hpp"

#include "window/ui.hpp"

#include <algorithm>
#include <imgui.h>

namespace gll {
namespace {

constexpr std::size_t most_shown = 3;
constexpr ImU32 error_title_color = IM_COL32(255, 120, 110, 255);
constexpr ImU32 error_code_color = IM_COL32(250, 226, 180, 255);
constexpr ImU32 error_note_color = IM_COL32(190, 170, 170, 255);
constexpr ImU32 error_background = IM_COL32(46, 17, 19, 244);
constexpr ImU32 error_code_background = IM_COL32(24, 8, 10, 255);

void colored(ImU32 color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    wrappedText(text);
    ImGui::PopStyleColor();
}

// Where it is, what stands there, and what the compiler says.
void drawError(const ShaderError& error) {
    const float em = ImGui::GetFontSize();
    Ui::pushBold();
    const std::string place =
        error.file + (error.line > 0 ? ":" + std::to_string(error.line) : std::string());
    colored(error_title_color, place.empty() ? "The frame cannot be drawn" : place);
    Ui::popFont();
    const auto first = error.source_line.find_first_not_of(" \t");
    if (first != std::string::npos) {
        Ui::pushMono();
        const std::string code = error.source_line.substr(first);
        const ImVec2 low = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const ImVec2 size = ImGui::CalcTextSize(code.c_str(), nullptr, false, width - em);
        ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + width, low.y + size.y + 0.5F * em},
                                                  error_code_background, 0.2F * em);
        ImGui::SetCursorScreenPos({low.x + 0.5F * em, low.y + 0.25F * em});
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width - em);
        ImGui::PushStyleColor(ImGuiCol_Text, error_code_color);
        ImGui::TextUnformatted(code.c_str());
        ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
        ImGui::Dummy({0, 0.1F * em});
        Ui::popFont();
    }
    wrappedText(error.complaint);
}

} // namespace

void errorsOver(const Rectangle& picture, float pixels_per_unit, const std::vector<ShaderError>& errors,
                bool is_drawn) {
    if (errors.empty() || !picture.isShown()) return;
    const float em = ImGui::GetFontSize();
    const float room = static_cast<float>(picture.size.x) / pixels_per_unit;
    const float margin = std::min(0.6F * em, room / 10);
    ImGui::SetNextWindowPos({static_cast<float>(picture.corner.x) / pixels_per_unit + margin,
                             static_cast<float>(picture.corner.y) / pixels_per_unit + margin});
    ImGui::SetNextWindowSize({std::min(room - 2 * margin, 52 * em), 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, error_background);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.3F * em);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.9F * em, 0.7F * em});
    ImGui::Begin("##errors", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoSavedSettings);
    for (std::size_t i = 0; i < std::min(errors.size(), most_shown); ++i) {
        if (i > 0) ImGui::Separator();
        drawError(errors[i]);
    }
    if (errors.size() > most_shown)
        wrappedText("and " + std::to_string(errors.size() - most_shown) + " more, on the terminal");
    ImGui::Spacing();
    colored(error_note_color, is_drawn ? "The last good shader goes on until this is mended and saved."
                                       : "Nothing new is drawn until this is mended and saved.");
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

} // namespace gll
