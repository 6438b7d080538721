// What a rung's settings offer, by its own --settings: no list of methods in a test may fall behind it.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gll::test {

// In the order of the setting. Throws std::runtime_error where the rung has no such setting, or one without
// choices.
std::vector<std::string> choicesOf(const std::filesystem::path& rung, const std::string& setting);

// Throws std::runtime_error for the first choice that is neither covered nor excused, and for what is covered
// or excused (a choice, and why it is left out) without being a choice, or both at once.
void requireCovered(const std::filesystem::path& rung, const std::string& setting,
                    const std::set<std::string>& covered,
                    const std::map<std::string, std::string>& excused = {});

// What a list of things with settings sets one of them to, for requireCovered().
template <class List>
std::set<std::string> valuesOf(const List& list, const std::string& setting) {
    std::set<std::string> values;
    for (const auto& one : list)
        if (const auto found = one.set.find(setting); found != one.set.end()) values.insert(found->second);
    return values;
}

} // namespace gll::test
