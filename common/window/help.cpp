// Reading a page's beginning, and showing it.
#include "window/help.hpp"

#include "window/ui.hpp"

#include <algorithm>
#include <fstream>
#include <imgui.h>
#include <sstream>
#include <stdexcept>

namespace gll {
namespace {

constexpr const char* keys[][2] = {
    {"Space", "play, pause"},
    {". ,", "one frame on, back"},
    {"Drag", "turn the camera, move the divider or the panel's edge"},
    {"Wheel", "zoom"},
    {"R", "the scripted camera again"},
    {"P", "write this frame and its command line"},
    {"Ctrl+C", "copy the command line of this frame"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo (Ctrl+Shift+Z, too)"},
    {"H", "hide the panel, show it"},
    {"I", "look into every target: click one, drag, wheel, point at a pixel"},
    {"C, O, M", "compare: two settings, with the original ones, the recommended"},
    {"B, X, N", "comparing: edit the other, swap, show differently"},
    {"F2", "to the panel: arrows, Space, Tab; Esc goes back"},
    {"Ctrl + - 0", "size of text"},
    {"Save a shader", "the next frame is drawn with it"},
    {"Shift+P", "write a picture of the whole window"},
    {"F11", "full screen"},
    {"F1", "this, and away again"},
    {"Esc", "back a step: a list, the panel, a target, comparing; else quit"}};

// Without the marks of a line of Markdown.
std::string plain(const std::string& line) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '*' || line[i] == '`') continue;
        if (line[i] == '!' && i + 1 < line.size() && line[i + 1] == '[') { // a picture
            const auto end = line.find(')', i);
            i = end == std::string::npos ? line.size() : end;
            continue;
        }
        if (line[i] == '[') continue;
        if (line[i] == ']' && i + 1 < line.size() && line[i + 1] == '(') { // where a link leads
            const auto end = line.find(')', i);
            i = end == std::string::npos ? line.size() : end;
            continue;
        }
        text += line[i];
    }
    return text;
}

} // namespace

std::vector<Paragraph> firstSection(const std::string& markdown) {
    std::istringstream lines(markdown);
    std::vector<Paragraph> paragraphs;
    int sections = 0;
    bool in_code = false;
    bool goes_on = false; // the last paragraph
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ")) {
            if (++sections == 2) break;
            paragraphs.push_back({plain(line.substr(3)), true});
            goes_on = false;
            continue;
        }
        const bool is_fence = line.starts_with("```");
        if (is_fence) in_code = !in_code;
        const bool is_left_out =
            is_fence || in_code || line.starts_with("# ") || line.starts_with("|") || line.starts_with("<");
        const std::string words = is_left_out ? "" : plain(line);
        const bool is_empty = words.find_first_not_of(" \t\r") == std::string::npos;
        if (!is_empty && goes_on) paragraphs.back().text += " " + words;
        if (!is_empty && !goes_on) paragraphs.push_back({words});
        goes_on = !is_empty;
    }
    return paragraphs;
}

Help::Help(const Resources& resources, const std::string& rung) : title_(rung) {
    try {
        std::ifstream file(resources.find(std::filesystem::path("tutorials") / rung / "README.md"));
        std::ostringstream text;
        text << file.rdbuf();
        about_ = firstSection(text.str());
    } catch (const std::runtime_error&) {
        about_ = {{"The rung's page, tutorials/" + rung + "/README.md, is not beside this program."}};
    }
}

void Help::draw(const Rectangle& picture, float pixels_per_unit) {
    if (!visible) return;
    const float em = ImGui::GetFontSize();
    const ImVec2 low(static_cast<float>(picture.corner.x) / pixels_per_unit,
                     static_cast<float>(picture.corner.y) / pixels_per_unit);
    const ImVec2 room(static_cast<float>(picture.size.x) / pixels_per_unit,
                      static_cast<float>(picture.size.y) / pixels_per_unit);
    const ImVec2 size(std::min(44 * em, room.x), std::min(40 * em, room.y));
    ImGui::SetNextWindowPos({low.x + (room.x - size.x) / 2, low.y + (room.y - size.y) / 2});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {1.2F * em, em});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4F * em);
    ImGui::SetNextWindowBgAlpha(0.96F);
    ImGui::Begin("##help", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    Ui::pushBold();
    ImGui::TextUnformatted(title_.c_str());
    Ui::popFont();
    ImGui::SameLine(ImGui::GetWindowWidth() - 5.5F * em);
    if (ImGui::Button("Close", {4.2F * em, 0})) visible = false;
    ImGui::Spacing();
    for (const Paragraph& paragraph : about_) {
        if (paragraph.is_heading) Ui::pushBold();
        wrappedText(paragraph.text);
        if (paragraph.is_heading) Ui::popFont();
        ImGui::Dummy({0, 0.2F * em});
    }
    ImGui::Separator();
    ImGui::Spacing();
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 9 * em);
        ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
        for (const auto& [key, does] : keys) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            Ui::pushBold();
            ImGui::TextUnformatted(key);
            Ui::popFont();
            ImGui::TableNextColumn();
            wrappedText(does);
        }
        ImGui::EndTable();
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace gll
