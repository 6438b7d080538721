// Which cases are missing, by the rung's settings.
#include "complete/complete.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

namespace gll::test {
namespace {
namespace fs = std::filesystem;

std::string text(const nlohmann::json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    return value.dump();
}

// What the cases set each setting to, those that leave it alone not counted.
std::map<std::string, std::set<std::string>> shownValues(const nlohmann::json& listed,
                                                         const std::vector<frame_check::Case>& cases) {
    std::map<std::string, std::set<std::string>> shown;
    for (const frame_check::Case& golden : cases) {
        std::map<std::string, std::string> values;
        for (const auto& preset : listed.at("presets"))
            if (preset.at("name") == golden.settings.value("preset", "original"))
                for (const auto& value : preset.at("values"))
                    values[value.at(0)] = value.at(1);
        if (golden.settings.contains("set"))
            for (const auto& [name, value] : golden.settings.at("set").items())
                values[name] = text(value);
        for (const auto& [name, value] : values)
            shown[name].insert(value);
    }
    return shown;
}

bool isDefault(const nlohmann::json& setting, const std::string& value) {
    const auto& usual = setting.at("default");
    return usual.is_number() ? std::stod(value) == usual.get<double>() : text(usual) == value;
}

} // namespace

Excuses readExcuses(const fs::path& json_file, const std::string& rung) {
    try {
        std::ifstream stream(json_file);
        const auto json = nlohmann::json::parse(stream);
        return json.contains(rung) ? json.at(rung).get<Excuses>() : Excuses{};
    } catch (const std::exception& error) {
        throw std::runtime_error(json_file.string() + ": " + error.what());
    }
}

std::vector<std::string> missingCases(const nlohmann::json& listed,
                                      const std::vector<frame_check::Case>& cases, const Excuses& excuses) {
    const std::string rung = listed.at("rung");
    const auto shown = shownValues(listed, cases);
    std::map<std::string, std::string> missing; // by what an excuse would call it, a setting to bless it with
    for (const auto& setting : listed.at("settings")) {
        const std::string name = setting.at("name");
        const auto found = shown.find(name);
        const std::set<std::string> values = found == shown.end() ? std::set<std::string>{} : found->second;
        if (setting.contains("choices") && setting.value("owner", rung) == rung) {
            for (const std::string choice : setting.at("choices"))
                if (!isDefault(setting, choice) && !values.contains(choice))
                    missing[name + "=" + choice] = name + "=" + choice;
            continue;
        }
        bool is_shown = false;
        for (const std::string& value : values)
            is_shown = is_shown || !isDefault(setting, value);
        if (!is_shown) missing[name] = name + "=(not " + text(setting.at("default")) + ")";
    }
    std::vector<std::string> sentences;
    for (const auto& [name, set] : missing)
        if (!excuses.contains(name))
            sentences.push_back(name +
                                " failed: there is no case with it; look at the frame, then tests/bless " +
                                rung + " CASE --set '" + set + "'");
    for (const auto& [name, reason] : excuses)
        if (!missing.contains(name))
            sentences.push_back(name + " failed: excused, but a case shows it, or there is no such setting");
    return sentences;
}

std::vector<std::string> ungroupedCases(const std::string& rung,
                                        const std::vector<frame_check::Case>& cases) {
    std::vector<std::string> sentences;
    for (const frame_check::Case& golden : cases)
        if (std::none_of(golden.blessed.begin(), golden.blessed.end(),
                         [](const frame_check::Blessing& blessing) { return blessing.targets.is_object(); }))
            sentences.push_back(golden.name +
                                " failed: its intermediate targets are not noted, so that a report "
                                "cannot say where it differs first; tests/bless " +
                                rung + " " + golden.name);
    return sentences;
}

} // namespace gll::test
