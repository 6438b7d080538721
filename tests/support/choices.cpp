// The choices that rungs list, and what tests have of them.
#include "support/choices.hpp"

#include "support/process.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gll::test {

std::vector<std::string> choicesOf(const std::filesystem::path& rung, const std::string& setting) {
    const auto listed = nlohmann::json::parse(runToSuccess({rung, {"--settings", "--json"}}).out);
    for (const auto& one : listed.at("settings"))
        if (one.at("name") == setting && one.contains("choices")) return one.at("choices");
    throw std::runtime_error(rung.filename().string() + " has no setting " + setting + " with choices");
}

void requireCovered(const std::filesystem::path& rung, const std::string& setting,
                    const std::set<std::string>& covered, const std::map<std::string, std::string>& excused) {
    const std::vector<std::string> choices = choicesOf(rung, setting);
    const auto fail = [&](const std::string& choice, const std::string& why) {
        throw std::runtime_error(rung.filename().string() + ", " + setting + "=" + choice + ": " + why);
    };
    const auto isChoice = [&](const std::string& choice) {
        return std::find(choices.begin(), choices.end(), choice) != choices.end();
    };
    for (const std::string& choice : choices)
        if (!covered.contains(choice) && !excused.contains(choice))
            fail(choice, "is not covered here; add it, or excuse it with a reason");
    for (const std::string& choice : covered)
        if (!isChoice(choice)) fail(choice, "is covered here, and no such choice");
    for (const auto& [choice, reason] : excused)
        if (!isChoice(choice) || covered.contains(choice))
            fail(choice, "is excused here, and covered, or no such choice");
}

} // namespace gll::test
