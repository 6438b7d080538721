// The panel, in Dear ImGui.
#include "window/panel.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace gll {
namespace {

void numberWidget(Setting& setting) {
    // Ranges over several decades are dragged on a logarithmic scale.
    const bool wide = setting.min >= 0 && setting.max > 1000 * std::max(setting.min, 1e-2);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    if (setting.kind == Setting::Kind::integer) {
        int value = static_cast<int>(setting.value);
        if (ImGui::SliderInt(setting.name.c_str(), &value, static_cast<int>(setting.min),
                             static_cast<int>(setting.max), "%d", flags))
            setting.value = value;
        return;
    }
    auto value = static_cast<float>(setting.value);
    if (ImGui::SliderFloat(setting.name.c_str(), &value, static_cast<float>(setting.min),
                           static_cast<float>(setting.max), "%.3g", flags))
        setting.value = std::clamp(static_cast<double>(value), setting.min, setting.max);
}

constexpr ImGuiPopupFlags any_popup = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;

} // namespace

// As ImGui's, but Esc closes it.
bool Panel::beginCombo(const char* label, const char* chosen) const {
    if (!ImGui::BeginCombo(label, chosen)) return false;
    if (close_popup_) ImGui::CloseCurrentPopup();
    return true;
}

// Of the widget before it, where the mouse is over that: beside the panel where there is room, else below or
// above the widget; never beyond the window, where ImGui's own would end.
void Panel::tooltip(const std::string& text) const {
    if (!ImGui::IsItemHovered()) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec2 padding = style.WindowPadding;
    const float gap = style.ItemSpacing.y;
    const float panel_right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x;
    const float room = display.x - panel_right - gap - 2 * padding.x;
    const bool beside = room > 150 * scale_;
    const float wrap = std::max(std::min(260 * scale_, beside ? room : display.x - 2 * padding.x), 1.0F);
    const ImVec2 text_size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 size(text_size.x + 2 * padding.x, text_size.y + 2 * padding.y);
    ImVec2 place(panel_right + gap, ImGui::GetItemRectMin().y);
    if (!beside) {
        place = {ImGui::GetMousePos().x, ImGui::GetItemRectMax().y + gap};
        if (place.y + size.y > display.y) place.y = ImGui::GetItemRectMin().y - gap - size.y;
    }
    place.x = std::clamp(place.x, 0.0F, std::max(display.x - size.x, 0.0F));
    place.y = std::clamp(place.y, 0.0F, std::max(display.y - size.y, 0.0F));
    ImGui::SetNextWindowPos(place);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(padding.x + wrap);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void Panel::widget(Setting& setting) {
    switch (setting.kind) {
    case Setting::Kind::toggle: {
        bool on = setting.value != 0;
        if (ImGui::Checkbox(setting.name.c_str(), &on)) setting.value = on ? 1 : 0;
        break;
    }
    case Setting::Kind::choice:
        if (beginCombo(setting.name.c_str(), setting.text().c_str())) {
            for (std::size_t i = 0; i < setting.choices.size(); ++i)
                if (ImGui::Selectable(setting.choices[i].c_str(), static_cast<double>(i) == setting.value))
                    setting.value = static_cast<double>(i);
            ImGui::EndCombo();
        }
        break;
    case Setting::Kind::number:
    case Setting::Kind::integer:
        numberWidget(setting);
        break;
    }
    tooltip(setting.help);
}

void Panel::settingsSection(Settings& settings) {
    if (ImGui::Button("reset")) settings.reset();
    tooltip("every setting as it is by default");
    for (const Settings::Preset& preset : settings.presets()) {
        ImGui::SameLine();
        if (ImGui::Button(preset.name.c_str())) settings.applyPreset(preset.name);
        tooltip(preset.help);
    }
    for (Setting& setting : settings.all())
        widget(setting);
}

namespace {

void keysSection() {
    for (const char* line :
         {"Space   pause, go on", ". ,     one frame on, back", "drag    orbit, or the divider",
          "wheel   zoom", "R       the scripted camera", "P       write this frame", "H       hide the panel",
          "Esc     close a list, or quit"})
        ImGui::TextUnformatted(line);
}

} // namespace

Panel::Panel(GLFWwindow* window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // no file is left where the program happens to be run
    float scale_y = 1;
    glfwGetWindowContentScale(window, &scale_, &scale_y);
    scale_ = std::clamp(scale_, 1.0F, 4.0F);
    ImFontConfig font;
    font.SizePixels = 13 * scale_;
    io.Fonts->AddFontDefault(&font);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale_);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Panel::~Panel() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

bool Panel::hasMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Panel::hasKeyboard() const { return ImGui::GetIO().WantTextInput; }

bool Panel::closePopup() {
    close_popup_ = visible && ImGui::IsPopupOpen("", any_popup);
    return close_popup_;
}

// At the bottom, where it moves nothing, and over all else.
void Panel::messageLine(const std::string& text) const {
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float wrap = std::max(display.x - 2 * (8 + padding.x), 1.0F);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 place(8 + padding.x, display.y - 8 - padding.y - size.y);
    ImDrawList& over = *ImGui::GetForegroundDrawList();
    over.AddRectFilled({place.x - padding.x, place.y - padding.y},
                       {place.x + size.x + padding.x, place.y + size.y + padding.y},
                       ImGui::GetColorU32(ImGuiCol_PopupBg));
    over.AddText(nullptr, 0, place, ImGui::GetColorU32(ImGuiCol_Text), text.c_str(), nullptr, wrap);
}

void Panel::wrappedText(const std::string& text) const {
    if (text.empty()) return;
    ImGui::PushTextWrapPos(230 * scale_);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

void Panel::budgetSection(const PanelState& state) {
    if (state.searching_s > 0) {
        ImGui::Text("searching, %.0f s", state.searching_s);
        ImGui::SameLine();
        stop_asked = ImGui::Button("stop");
        return;
    }
    // A rung that meters no exposure refuses a budget of it.
    const bool meters = std::any_of(state.readings.begin(), state.readings.end(),
                                    [](const Reading& reading) { return reading.is_exposure; });
    if (beginCombo("error", kindName(budget_.kind))) {
        for (const Budget::Kind kind : {Budget::Kind::flip, Budget::Kind::rmse, Budget::Kind::ev})
            if ((kind != Budget::Kind::ev || meters) &&
                ImGui::Selectable(kindName(kind), kind == budget_.kind))
                budget_.kind = kind;
        ImGui::EndCombo();
    }
    tooltip("flip: mean difference as the eye sees it; rmse: of display values, both 0 to 1" +
            std::string(meters ? "; ev: of the exposure, stops" : ""));
    auto limit = static_cast<float>(budget_.limit);
    if (ImGui::SliderFloat("at most", &limit, 0.001F, 1, "%.3g",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
        budget_.limit = limit;
    tooltip("how far the frame may be from that of the most accurate settings");
    if (ImGui::Button("find the cheapest settings")) search_asked = budget_;
    tooltip("takes some seconds, while the picture goes on; what is found is set");
    if (state.can_undo) {
        ImGui::SameLine();
        undo_asked = ImGui::Button("undo");
        tooltip("the settings as they were before the search");
    }
    wrappedText(state.search_answer);
}

void Panel::draw(Settings& settings, const PanelState& state) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    search_asked.reset();
    stop_asked = undo_asked = false;
    if (visible) {
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        const float widest = std::max(display.x - 16, 1.0F);
        const float highest = std::max(display.y - 16, 1.0F);
        ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
        ImGui::SetNextWindowSizeConstraints({std::min(200 * scale_, widest), 0}, {widest, highest});
        ImGui::SetNextWindowBgAlpha(0.72F);
        ImGui::Begin("settings (H hides)", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
        ImGui::PushItemWidth(140 * scale_);
        ImGui::Text("frame %d%s, %.2f ms", state.frame, state.paused ? " (paused)" : "", state.frame_time_ms);
        for (const Reading& reading : state.readings)
            ImGui::Text("%s %.4g %s", reading.name.c_str(), reading.value, reading.unit.c_str());
        // In a small window the list would hide the picture: there it starts closed.
        ImGui::SetNextItemOpen(display.x > 560 * scale_, ImGuiCond_Once);
        if (ImGui::CollapsingHeader("settings", ImGuiTreeNodeFlags_DefaultOpen)) settingsSection(settings);
        if (!settings.dials().empty() && ImGui::CollapsingHeader("budget")) budgetSection(state);
        pass_times_open_ = ImGui::CollapsingHeader("pass times");
        if (pass_times_open_) {
            for (const PassTime& pass : state.pass_times)
                ImGui::Text("%-12s %8.3f ms", pass.name.c_str(), pass.time_ms);
            ImGui::TextUnformatted(state.renderer.c_str());
        }
        if (ImGui::CollapsingHeader("keys")) keysSection();
        ImGui::PopItemWidth();
        ImGui::End();
        if (!state.message.empty()) messageLine(state.message);
    }
    close_popup_ = false;
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace gll
