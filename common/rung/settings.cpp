// Declaring, parsing and listing settings.
#include "rung/settings.hpp"

#include "rung/nearest.hpp"
#include "rung/usage_error.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace gll {
namespace {

std::string shortest(double value) {
    char buffer[32];
    // A million as 1000000, not 1e+06.
    const bool whole = value == std::floor(value) && std::abs(value) < 1e9;
    const auto result = whole ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                              : std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, result.ptr};
}

std::string capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::isalnum(c) ? std::toupper(c) : '_');
    });
    return text;
}

double parseNumber(const Setting& setting, std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = setting.kind != Setting::Kind::integer || value == std::floor(value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || !whole ||
        value < setting.min || value > setting.max)
        throw UsageError("setting " + setting.name + ": \"" + std::string(text) + "\" is not " +
                         (setting.kind == Setting::Kind::integer ? "a whole number" : "a number") + " from " +
                         shortest(setting.min) + " to " + shortest(setting.max));
    return value;
}

double parseToggle(const Setting& setting, std::string_view text) {
    for (const std::string_view yes : {"on", "true", "yes", "1"})
        if (text == yes) return 1;
    for (const std::string_view no : {"off", "false", "no", "0"})
        if (text == no) return 0;
    throw UsageError("setting " + setting.name + ": \"" + std::string(text) + "\" is neither on nor off");
}

double parseChoice(const Setting& setting, std::string_view text) {
    const auto found = std::find(setting.choices.begin(), setting.choices.end(), text);
    if (found == setting.choices.end())
        throw UsageError("setting " + setting.name + ": \"" + std::string(text) + "\" is not one of " +
                         joined(setting.choices) + didYouMean(text, setting.choices));
    return static_cast<double>(found - setting.choices.begin());
}

} // namespace

std::string Setting::text() const {
    switch (kind) {
    case Kind::toggle:
        return value != 0 ? "on" : "off";
    case Kind::choice:
        return choices[static_cast<std::size_t>(value)];
    case Kind::number:
    case Kind::integer:
        break;
    }
    return shortest(value);
}

bool Choice::operator==(std::string_view choice) const {
    const std::vector<std::string>& choices = setting_->choices;
    if (std::find(choices.begin(), choices.end(), choice) == choices.end())
        throw std::logic_error("setting " + setting_->name + " is compared with \"" + std::string(choice) +
                               "\", which is not one of " + joined(choices) + didYouMean(choice, choices));
    return name() == choice;
}

Defines Choice::defines() const {
    const std::string name = capitals(setting_->name);
    Defines defines;
    for (std::size_t i = 0; i < setting_->choices.size(); ++i)
        defines.push_back({name + "_" + capitals(setting_->choices[i]), std::to_string(i)});
    defines.push_back({name, std::to_string(static_cast<int>(setting_->value))});
    return defines;
}

Setting& Settings::add(Setting setting) {
    setting.value = setting.default_value;
    return settings_.emplace_back(std::move(setting));
}

Number Settings::number(std::string name, double default_value, double min, double max, std::string help) {
    return Number(add({std::move(name), std::move(help), Setting::Kind::number, default_value, min, max}));
}

Integer Settings::integer(std::string name, int default_value, int min, int max, std::string help) {
    return Integer(add({std::move(name), std::move(help), Setting::Kind::integer, double(default_value),
                        double(min), double(max)}));
}

Toggle Settings::toggle(std::string name, bool default_value, std::string help) {
    return Toggle(
        add({std::move(name), std::move(help), Setting::Kind::toggle, default_value ? 1.0 : 0.0, 0, 1}));
}

Choice Settings::choice(std::string name, std::string_view default_value, std::vector<std::string> choices,
                        std::string help) {
    Setting setting{std::move(name), std::move(help), Setting::Kind::choice};
    setting.max = static_cast<double>(choices.size()) - 1;
    setting.choices = std::move(choices);
    setting.default_value = parseChoice(setting, default_value);
    return Choice(add(std::move(setting)));
}

void Settings::shared(std::string_view owner, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        at(name).owner = owner;
}

void Settings::role(Setting::Role role, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        at(name).role = role;
}

void Settings::group(Setting::Group group, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        at(name).group = group;
}

void Settings::needs(std::initializer_list<std::string_view> names, const Setting::Need& need) {
    for (const auto& [other, values] : need) {
        Setting& needed = at(other);
        for (const std::string& value : values)
            set(other, value); // as for presets: one that does not fit fails at every start
        needed.value = needed.default_value;
    }
    for (const std::string_view name : names)
        at(name).needs.push_back(need);
}

std::string Settings::whyIdle(const Setting& setting) const {
    for (const Setting::Need& need : setting.needs) {
        std::string only_with;
        std::string why_others;
        bool is_met = false;
        for (const auto& [other, values] : need) {
            const Setting& needed = at(other);
            only_with +=
                (only_with.empty() ? "only with " : ", or ") + other + " = " + joined(values, " or ");
            if (std::find(values.begin(), values.end(), needed.text()) == values.end()) continue;
            const std::string why = whyIdle(needed);
            if (why.empty()) is_met = true;
            if (why_others.empty()) why_others = why;
        }
        if (!is_met) return why_others.empty() ? only_with : why_others;
    }
    return {};
}

void Settings::preset(Preset preset) {
    const Preset& added = presets_.emplace_back(std::move(preset));
    applyPreset(
        added.name); // so that a preset which does not fit its settings fails at every start, not when used
    reset();
}

void Settings::dial(Dial dial) {
    for (const std::string& value : dial.values)
        set(dial.setting, value); // as for presets: one that does not fit fails at every start
    Setting& setting = at(dial.setting);
    if (dial.values.empty() && setting.kind != Setting::Kind::integer)
        throw UsageError("dial " + dial.setting + ": only an integer's values need not be named");
    setting.value = setting.default_value;
    dials_.push_back(std::move(dial));
}

Setting& Settings::at(std::string_view name) {
    return const_cast<Setting&>(std::as_const(*this).at(name)); // which this may change
}

const Setting& Settings::at(std::string_view name) const {
    std::vector<std::string> names;
    for (const Setting& setting : settings_) {
        if (setting.name == name) return setting;
        names.push_back(setting.name);
    }
    throw UsageError("unknown setting \"" + std::string(name) + "\"; --settings lists them" +
                     didYouMean(name, names));
}

void Settings::set(std::string_view name, std::string_view value) {
    Setting& setting = at(name);
    switch (setting.kind) {
    case Setting::Kind::number:
    case Setting::Kind::integer:
        setting.value = parseNumber(setting, value);
        break;
    case Setting::Kind::toggle:
        setting.value = parseToggle(setting, value);
        break;
    case Setting::Kind::choice:
        setting.value = parseChoice(setting, value);
        break;
    }
}

void Settings::set(std::string_view key_equals_value) {
    const auto equals = key_equals_value.find('=');
    if (equals == std::string_view::npos)
        throw UsageError("--set " + std::string(key_equals_value) + ": write KEY=VALUE");
    set(key_equals_value.substr(0, equals), key_equals_value.substr(equals + 1));
}

void Settings::applyPreset(std::string_view name) {
    if (name == "seed") name = "original"; // its former name, in scripts and batches that people have
    std::vector<std::string> names;
    for (const Preset& preset : presets_) {
        names.push_back(preset.name);
        if (preset.name != name) continue;
        reset();
        for (const auto& [key, value] : preset.values)
            set(key, value);
        return;
    }
    throw UsageError("unknown preset \"" + std::string(name) + "\"; there is " + joined(names) +
                     didYouMean(name, names));
}

void Settings::reset() {
    for (Setting& setting : settings_)
        setting.value = setting.default_value;
}

std::vector<std::string> Settings::changed() const {
    std::vector<std::string> words;
    for (const Setting& setting : settings_)
        if (setting.value != setting.default_value) words.push_back(setting.name + "=" + setting.text());
    return words;
}

std::string Settings::commandLine() const {
    std::string text;
    for (const std::string& word : changed())
        text += (text.empty() ? "--set " : " --set ") + word;
    return text;
}

} // namespace gll
