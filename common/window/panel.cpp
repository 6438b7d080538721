// The panel, in Dear ImGui.
#include "window/panel.hpp"

#include "window/ui.hpp"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cstdio>
#include <imgui.h>
#include <map>

namespace gll {
namespace {

void numberWidget(Setting& setting) {
    // Ranges over several decades are dragged on a logarithmic scale.
    const bool wide = setting.min >= 0 && setting.max > 1000 * std::max(setting.min, 1e-2);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    if (setting.kind == Setting::Kind::integer) {
        int value = static_cast<int>(setting.value);
        if (ImGui::SliderInt("##value", &value, static_cast<int>(setting.min), static_cast<int>(setting.max),
                             "%d", flags))
            setting.value = value;
        return;
    }
    auto value = static_cast<float>(setting.value);
    if (ImGui::SliderFloat("##value", &value, static_cast<float>(setting.min),
                           static_cast<float>(setting.max), "%.4g", flags))
        setting.value = std::clamp(static_cast<double>(value), setting.min, setting.max);
}

void widget(Setting& setting) {
    switch (setting.kind) {
    case Setting::Kind::toggle: {
        bool on = setting.value != 0;
        if (ImGui::Checkbox("##value", &on)) setting.value = on ? 1 : 0;
        break;
    }
    case Setting::Kind::choice:
        if (beginCombo("##value", setting.text().c_str())) {
            for (std::size_t i = 0; i < setting.choices.size(); ++i) {
                const bool is_chosen = static_cast<double>(i) == setting.value;
                if (ImGui::Selectable(setting.choices[i].c_str(), is_chosen))
                    setting.value = static_cast<double>(i);
                if (is_chosen) ImGui::SetItemDefaultFocus();
            }
            ImGui::EndCombo();
        }
        break;
    case Setting::Kind::number:
    case Setting::Kind::integer:
        numberWidget(setting);
        break;
    }
}

std::string describe(const Setting& setting, const std::string& why_idle, double preset_value) {
    std::string text = setting.help + "\n--set " + setting.name + "=" + setting.text();
    if (!why_idle.empty()) text += "\nHas no effect now: " + why_idle + ".";
    if (setting.value != preset_value) {
        Setting before = setting;
        before.value = preset_value;
        text += "\nThe preset has " + before.text() + ".";
    }
    return text;
}

// "Shadow map (07)" for 07_shadow_map.
std::string ownerLabel(const std::string& owner) {
    const auto line = owner.find('_');
    if (line == std::string::npos) return owner;
    return labelOf(owner.substr(line + 1)) + " (" + owner.substr(0, line) + ")";
}

bool button(const char* label, bool is_enabled, const char* help) {
    ImGui::BeginDisabled(!is_enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    tooltip(help);
    return pressed;
}

std::vector<double> valuesOf(const Settings& settings) {
    std::vector<double> values;
    for (const Setting& setting : settings.all())
        values.push_back(setting.value);
    return values;
}

} // namespace

std::string labelOf(const std::string& name) {
    static const std::map<std::string, std::string> units = {
        {"ev", "(EV)"}, {"s", "(s)"}, {"deg", "(\u00b0)"}, {"px", "(px)"}, {"percent", "(%)"}};
    static const std::map<std::string, std::string> acronyms = {
        {"ssao", "SSAO"}, {"brdf", "BRDF"}, {"pcf", "PCF"}, {"hdr", "HDR"},
        {"aa", "AA"},     {"flip", "FLIP"}, {"v", "V"},     {"gbuffer", "G-buffer"}};
    std::string label;
    std::size_t begin = 0;
    while (begin <= name.size()) {
        const std::size_t end = std::min(name.find('_', begin), name.size());
        std::string word = name.substr(begin, end - begin);
        const bool is_last = end == name.size();
        if (const auto unit = units.find(word); is_last && begin > 0 && unit != units.end())
            word = unit->second;
        else if (const auto acronym = acronyms.find(word); acronym != acronyms.end())
            word = acronym->second;
        label += (label.empty() ? "" : " ") + word;
        begin = end + 1;
    }
    if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    return label;
}

Panel::Panel(std::string rung, Settings& settings) : rung_(std::move(rung)) {
    const std::vector<double> now = valuesOf(settings);
    for (const Settings::Preset& preset : settings.presets()) {
        settings.applyPreset(preset.name);
        presets_.push_back({preset.name, preset.help, valuesOf(settings)});
    }
    for (std::size_t i = 0; i < now.size(); ++i)
        settings.all()[i].value = now[i];
    choosePreset(now);
}

void Panel::choosePreset(const std::vector<double>& now) {
    std::ptrdiff_t most_alike = -1;
    for (std::size_t k = 0; k < presets_.size(); ++k) {
        std::ptrdiff_t alike = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            alike += now[i] == presets_[k].values[i] ? 1 : 0;
        if (alike <= most_alike) continue;
        most_alike = alike;
        preset_ = k;
    }
}

double Panel::presetValue(const Settings& settings, const Setting& setting) const {
    for (std::size_t i = 0; i < settings.all().size(); ++i)
        if (&settings.all()[i] == &setting) return presets_[preset_].values[i];
    return setting.default_value;
}

void Panel::presetsSection(Settings& settings, const PanelState& state, PanelActions& actions) {
    const std::vector<double> now = valuesOf(settings);
    if (state.edited != edited_) choosePreset(now); // another side's settings
    edited_ = state.edited;
    for (std::size_t k = 0; k < presets_.size(); ++k)
        if (now == presets_[k].values) preset_ = k;
    std::size_t changes = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
        changes += now[i] == presets_[preset_].values[i] ? 0 : 1;
    for (std::size_t i = 0; i < presets_.size(); ++i) {
        const bool is_in_use = i == preset_;
        if (i > 0) ImGui::SameLine();
        if (is_in_use) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_SliderGrab));
        if (ImGui::Button(presets_[i].name.c_str())) {
            settings.applyPreset(presets_[i].name);
            preset_ = i;
        }
        if (is_in_use) ImGui::PopStyleColor();
        tooltip("--preset " + presets_[i].name + ": " + presets_[i].help);
    }
    if (changes > 0) {
        ImGui::SameLine();
        ImGui::TextDisabled("%zu changed", changes);
        tooltip("They are marked. The arrow at the end of a line takes one back, the preset's button all.");
    }
    if (button("Undo", state.can_undo, "Ctrl+Z")) actions.undo = true;
    ImGui::SameLine();
    if (button("Redo", state.can_redo, "Ctrl+Y")) actions.redo = true;
    ImGui::SameLine();
    if (button("Compare", true,
               "C: with other settings, side by side; O: with the original ones; M: with the recommended"))
        actions.compare = true;
    ImGui::SameLine();
    if (button("Inspect", true, "I: what every pass leaves, pixel by pixel")) actions.inspect = true;
    ImGui::SameLine();
    if (button("Copy", true, "Ctrl+C: the command line that renders this very frame, for a shell"))
        actions.copy_command = true;
    ImGui::SameLine();
    if (button("Help", true, "F1: the keys, and what this rung is about")) actions.show_help = true;
}

// Name, value, and an arrow that takes a change back.
void Panel::row(Setting& setting, double preset_value, const std::string& why_idle) {
    ImGui::PushID(setting.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool is_changed = setting.value != preset_value;
    ImGui::BeginDisabled(!why_idle.empty());
    ImGui::AlignTextToFramePadding();
    if (is_changed) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 196, 92, 255));
    ImGui::TextUnformatted(labelOf(setting.name).c_str());
    if (is_changed) ImGui::PopStyleColor();
    ImGui::EndDisabled(); // a tooltip would be as faint
    tooltip(describe(setting, why_idle, preset_value));
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::BeginDisabled(!why_idle.empty());
    widget(setting);
    ImGui::EndDisabled();
    tooltip(describe(setting, why_idle, preset_value));
    ImGui::TableNextColumn();
    if (is_changed) {
        const bool has_arrow = ImGui::GetFont()->FindGlyphNoFallback(0x21ba) != nullptr;
        if (ImGui::Button(has_arrow ? "\u21ba" : "<")) setting.value = preset_value;
        tooltip("takes this change back");
    }
    ImGui::PopID();
}

void Panel::table(const char* name, const std::vector<Setting*>& shown, const Settings& settings) {
    if (!ImGui::BeginTable(name, 3, ImGuiTableFlags_NoSavedSettings)) return;
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.46F);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.54F);
    ImGui::TableSetupColumn("back", ImGuiTableColumnFlags_WidthFixed, 1.7F * em);
    for (Setting* setting : shown)
        row(*setting, presetValue(settings, *setting), settings.whyIdle(*setting));
    ImGui::EndTable();
}

void Panel::settingsSection(Settings& settings) {
    for (const auto group :
         {Setting::Group::method, Setting::Group::look, Setting::Group::tone, Setting::Group::camera}) {
        std::vector<Setting*> own;
        std::vector<std::pair<std::string, std::vector<Setting*>>> owned; // by the rung that teaches them
        for (Setting& setting : settings.all()) {
            if (setting.group != group) continue;
            const bool is_own =
                setting.owner.empty() || setting.owner == rung_ || group == Setting::Group::tone;
            if (is_own) {
                own.push_back(&setting);
                continue;
            }
            const auto of_owner = std::find_if(owned.begin(), owned.end(),
                                               [&](const auto& one) { return one.first == setting.owner; });
            if (of_owner != owned.end())
                of_owner->second.push_back(&setting);
            else
                owned.push_back({setting.owner, {&setting}});
        }
        const std::string name = labelOf(group_names[static_cast<std::size_t>(group)]);
        const bool opens = group != Setting::Group::camera;
        ImGui::SetNextItemOpen(opens, ImGuiCond_Once);
        if (!own.empty() && ImGui::CollapsingHeader(name.c_str())) table(name.c_str(), own, settings);
        for (const auto& [owner, shown] : owned)
            if (ImGui::CollapsingHeader(ownerLabel(owner).c_str())) table(owner.c_str(), shown, settings);
    }
}

void Panel::chartSection(Settings& settings, const PanelState& state) {
    if (!chart_) chart_.emplace(Resources(), rung_, settings);
    for (const std::string& set :
         chart_->draw(settings, state.point_costs, state.present_costs, state.shows_times))
        settings.set(set);
    chart_points_ = chart_->wanted();
}

void Panel::budgetSection(const PanelState& state, PanelActions& actions) {
    if (state.searching_s > 0) {
        ImGui::Text("searching, %.0f s", state.searching_s);
        ImGui::SameLine();
        actions.stop_search = ImGui::Button("Stop");
        wrappedText(state.search_progress);
        return;
    }
    // A rung that meters no exposure refuses a budget of it.
    const bool meters = std::any_of(state.readings.begin(), state.readings.end(),
                                    [](const Reading& reading) { return reading.is_exposure; });
    const float em = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(5 * em);
    if (beginCombo("##error", kindName(budget_.kind))) {
        for (const Budget::Kind kind : {Budget::Kind::flip, Budget::Kind::rmse, Budget::Kind::ev})
            if ((kind != Budget::Kind::ev || meters) &&
                ImGui::Selectable(kindName(kind), kind == budget_.kind))
                budget_.kind = kind;
        ImGui::EndCombo();
    }
    tooltip("flip: mean difference as the eye sees it; rmse: of display values, both 0 to 1" +
            std::string(meters ? "; ev: of the exposure, stops" : ""));
    ImGui::SameLine();
    ImGui::TextUnformatted("at most");
    ImGui::SameLine();
    auto limit = static_cast<float>(budget_.limit);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##limit", &limit, 0.001F, 1, "%.3g",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
        budget_.limit = limit;
    tooltip("how far the frame may be from that of the most accurate settings");
    if (ImGui::Button("Find the cheapest settings")) actions.search = budget_;
    tooltip("Takes some seconds, while the picture goes on.");
    if (state.has_found && ImGui::Button("Take what was found")) actions.take_found = true;
    if (!state.search_answer.empty()) wrappedText(state.search_answer);
}

void Panel::timesSection(const PanelState& state, PanelActions& actions) {
    bool waits = state.waits_for_display;
    if (ImGui::Checkbox("Wait for the display", &waits)) actions.wait_for_display = waits;
    tooltip("Vertical sync: no more frames than the display shows.");
    bool shows = state.shows_times;
    if (ImGui::Checkbox("Show times", &shows)) actions.show_times = shows;
    tooltip("Off, a window that stands still is the same picture at every moment.");
    float size = state.text_size;
    ImGui::SetNextItemWidth(-8 * ImGui::GetFontSize());
    ImGui::SliderFloat("Size of text", &size, 0.5F, 3, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    // Taken when let go: a panel that grows under the mouse cannot be aimed at.
    static float held = 1;
    if (ImGui::IsItemActive()) held = size;
    if (ImGui::IsItemDeactivatedAfterEdit()) actions.text_size = held;
    tooltip("Ctrl and plus, minus or 0.");
    if (ImGui::BeginTable("times", 2, ImGuiTableFlags_NoSavedSettings)) {
        for (const PassTime& pass : state.shows_times ? state.pass_times : std::vector<PassTime>()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.3f ms", pass.time_ms);
        }
        ImGui::EndTable();
    }
    wrappedText(state.renderer);
}

PanelActions Panel::draw(const Rectangle& place, float pixels_per_unit, Settings& settings,
                         const PanelState& state) {
    PanelActions actions;
    nextWindowAt(place, pixels_per_unit);
    if (focus_) ImGui::SetNextWindowFocus();
    focus_ = false;
    ImGui::Begin("##panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    Ui::pushBold();
    ImGui::TextUnformatted(state.edited.empty() ? rung_.c_str() : (rung_ + "  " + state.edited).c_str());
    Ui::popFont();
    ImGui::SameLine();
    std::string line = "frame " + std::to_string(state.frame);
    char times[64];
    std::snprintf(times, sizeof times, ", %.0f fps", state.shown_per_s);
    line += !state.is_playing ? ", paused" : state.shows_times ? times : "";
    std::snprintf(times, sizeof times, ", %s%.1f ms", state.is_gpu_time ? "GPU " : "", state.frame_time_ms);
    if (state.shows_times) line += times;
    ImGui::TextDisabled("%s", line.c_str());
    for (const Reading& reading : state.readings)
        ImGui::Text("%s %.4g %s", labelOf(reading.name).c_str(), reading.value, reading.unit.c_str());
    presetsSection(settings, state, actions);
    ImGui::Separator();
    ImGui::BeginChild("##sections", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    settingsSection(settings);
    chart_points_.clear();
    if (ImGui::CollapsingHeader("Chart")) chartSection(settings, state);
    if (!settings.dials().empty() && ImGui::CollapsingHeader("Budget")) budgetSection(state, actions);
    pass_times_open_ = ImGui::CollapsingHeader("Window and times");
    if (pass_times_open_) timesSection(state, actions);
    ImGui::EndChild();
    ImGui::End();
    return actions;
}

} // namespace gll
