// Dear ImGui: set-up and shared widgets.
#include "window/ui.hpp"

#include "window/glfw_window.hpp"
#include "window/layout.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <filesystem>
#include <imgui.h>

namespace gll {
namespace {

constexpr float em_at_scale_1 = 16; // pixels
constexpr ImGuiPopupFlags any_popup = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;

// One window, one Dear ImGui: what its free functions share.
struct Shared {
    ImFont* regular = nullptr;
    ImFont* bold = nullptr;
    ImFont* mono = nullptr;
    bool close_popup = false; // in the frame that is drawn
};
Shared shared;

// fonts-dejavu-core; where it is not installed, the font that Dear ImGui brings along.
ImFont* loadFont(const char* file, float size_px) {
    // Latin, what formulas need of Greek, arrows and signs.
    static constexpr ImWchar glyphs[] = {0x20,   0xff,   0x3b1,  0x3c9,  0x2010, 0x2026, 0x2190, 0x21ff,
                                         0x2212, 0x2212, 0x2264, 0x2265, 0x25a0, 0x25ff, 0};
    const std::filesystem::path path = std::filesystem::path("/usr/share/fonts/truetype/dejavu") / file;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
        if (ImFont* font = atlas.AddFontFromFileTTF(path.c_str(), size_px, nullptr, glyphs)) return font;
    ImFontConfig config;
    config.SizePixels = size_px;
    return atlas.AddFontDefault(&config);
}

void setStyle(float em) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 0;
    style.WindowBorderSize = 0;
    style.FrameRounding = std::round(0.2F * em);
    style.GrabRounding = style.FrameRounding;
    style.WindowPadding = {0.6F * em, 0.5F * em};
    style.FramePadding = {0.4F * em, 0.18F * em};
    style.ItemSpacing = {0.5F * em, 0.3F * em};
    style.ItemInnerSpacing = {0.3F * em, 0.25F * em};
    style.CellPadding = {0.2F * em, 0.12F * em};
    style.IndentSpacing = em;
    style.ScrollbarSize = 0.8F * em;
    style.GrabMinSize = 0.45F * em;
    style.DisabledAlpha = 0.45F;
    style.Colors[ImGuiCol_WindowBg] = {0.11F, 0.115F, 0.125F, 1};
    style.Colors[ImGuiCol_PopupBg] = {0.16F, 0.165F, 0.18F, 0.97F};
    style.Colors[ImGuiCol_FrameBg] = {0.2F, 0.21F, 0.23F, 1};
    style.Colors[ImGuiCol_FrameBgHovered] = {0.27F, 0.29F, 0.32F, 1};
    style.Colors[ImGuiCol_FrameBgActive] = {0.3F, 0.33F, 0.37F, 1};
    style.Colors[ImGuiCol_SliderGrab] = {0.3F, 0.5F, 0.78F, 0.75F}; // the number shows through
    style.Colors[ImGuiCol_Header] = {0.19F, 0.205F, 0.23F, 1};
    style.Colors[ImGuiCol_HeaderHovered] = {0.26F, 0.3F, 0.36F, 1};
    style.Colors[ImGuiCol_HeaderActive] = {0.28F, 0.34F, 0.42F, 1};
    style.Colors[ImGuiCol_Button] = {0.23F, 0.26F, 0.31F, 1};
    style.Colors[ImGuiCol_ButtonHovered] = {0.29F, 0.36F, 0.46F, 1};
    style.Colors[ImGuiCol_ButtonActive] = {0.3F, 0.42F, 0.58F, 1};
    ImGui::GetStyle() = style;
}

ImVec2 units(glm::ivec2 pixels, float pixels_per_unit) {
    return {static_cast<float>(pixels.x) / pixels_per_unit, static_cast<float>(pixels.y) / pixels_per_unit};
}

} // namespace

Ui::Ui(const WindowContext& window) : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // no file is left where the program happens to be run
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui_ImplGlfw_InitForOpenGL(window.window(), true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    makeFonts(std::round(em_at_scale_1 * window.contentScale()), window.pixelsPerUnit());
}

Ui::~Ui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Ui::makeFonts(float em_px, float pixels_per_unit) {
    em_px_ = em_px;
    pixels_per_unit_ = pixels_per_unit;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    shared.regular = loadFont("DejaVuSans.ttf", em_px * 0.88F);
    shared.bold = loadFont("DejaVuSans-Bold.ttf", em_px * 0.88F);
    shared.mono = loadFont("DejaVuSansMono.ttf", em_px * 0.82F);
    io.FontGlobalScale = 1 / pixels_per_unit; // drawn in pixels, laid out in units
    setStyle(em_px / pixels_per_unit);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Ui::setWish(float wish) {
    const float em_px = std::round(em_at_scale_1 * window_.contentScale() * std::clamp(wish, 0.5F, 3.0F));
    const float pixels_per_unit = window_.pixelsPerUnit();
    if (em_px != em_px_ || pixels_per_unit != pixels_per_unit_) makeFonts(em_px, pixels_per_unit);
}

void Ui::begin(float wish) {
    setWish(wish);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Ui::end() {
    shared.close_popup = false;
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Ui::hasMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Ui::hasKeyboard() const { return ImGui::GetIO().WantTextInput || ImGui::GetIO().NavVisible; }

bool Ui::isTyping() const { return ImGui::GetIO().WantTextInput; }

void Ui::keepCursor(bool is_kept) {
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    flags = is_kept ? flags | ImGuiConfigFlags_NoMouseCursorChange
                    : flags & ~ImGuiConfigFlags_NoMouseCursorChange;
}

bool Ui::isPopupOpen() { return ImGui::IsPopupOpen("", any_popup); }

bool Ui::closePopup() { return shared.close_popup = isPopupOpen(); }

bool Ui::leavePanel() {
    if (!hasKeyboard()) return false;
    ImGui::SetWindowFocus(nullptr);
    return true;
}

void Ui::pushBold() { ImGui::PushFont(shared.bold); }
void Ui::pushMono() { ImGui::PushFont(shared.mono); }
void Ui::popFont() { ImGui::PopFont(); }

void nextWindowAt(const Rectangle& rectangle, float pixels_per_unit) {
    ImGui::SetNextWindowPos(units(rectangle.corner, pixels_per_unit));
    ImGui::SetNextWindowSize(units(rectangle.size, pixels_per_unit));
}

void tooltip(std::string_view text) {
    constexpr double delay_s = 0.4;
    static ImVec2 rested_on(-1, -1); // the corner of a widget, which tells it from all others
    static double rested_since_s = 0;
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    const ImVec2 low = ImGui::GetItemRectMin();
    if (low.x != rested_on.x || low.y != rested_on.y) {
        rested_on = low;
        rested_since_s = ImGui::GetTime();
    }
    if (ImGui::GetTime() - rested_since_s < delay_s) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x + 0.3F * em;
    const float room = display.x - right - 2 * padding.x;
    const bool beside = room > 12 * em;
    const float wrap = std::max(std::min(26 * em, beside ? room : display.x - 2 * padding.x), 1.0F);
    const ImVec2 text_size = ImGui::CalcTextSize(text.data(), text.data() + text.size(), false, wrap);
    const ImVec2 size(text_size.x + 2 * padding.x, text_size.y + 2 * padding.y);
    ImVec2 place(right, low.y);
    if (!beside) {
        place = {low.x, ImGui::GetItemRectMax().y + 0.3F * em};
        if (place.y + size.y > display.y) place.y = low.y - 0.3F * em - size.y;
    }
    place.x = std::clamp(place.x, 0.0F, std::max(display.x - size.x, 0.0F));
    place.y = std::clamp(place.y, 0.0F, std::max(display.y - size.y, 0.0F));
    ImGui::SetNextWindowPos(place);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(padding.x + wrap);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool beginCombo(const char* label, const char* chosen) {
    if (!ImGui::BeginCombo(label, chosen, ImGuiComboFlags_HeightLarge)) return false;
    if (shared.close_popup) ImGui::CloseCurrentPopup();
    return true;
}

void wrappedText(std::string_view text) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
}

void messageOver(const Rectangle& place, float pixels_per_unit, const std::string& text) {
    const ImVec2 low = units(place.corner, pixels_per_unit);
    const ImVec2 extent = units(place.size, pixels_per_unit);
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const float margin = 0.5F * ImGui::GetFontSize();
    const float wrap = std::max(extent.x - 2 * (margin + padding.x), 1.0F);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 at(low.x + margin + padding.x, low.y + extent.y - margin - padding.y - size.y);
    ImDrawList& over = *ImGui::GetForegroundDrawList();
    over.AddRectFilled({at.x - padding.x, at.y - padding.y},
                       {at.x + size.x + padding.x, at.y + size.y + padding.y},
                       ImGui::GetColorU32(ImGuiCol_PopupBg), ImGui::GetStyle().FrameRounding);
    over.AddText(nullptr, 0, at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str(), nullptr, wrap);
}

} // namespace gll
