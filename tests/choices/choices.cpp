// Reads the rungs' sources for comparisons with a text, and fails for one that no setting has as a choice: a
// method misspelt there would never be drawn. Choice's own check (settings.hpp) sees only what is executed.
// Usage: choices TUTORIALS RUNG...
#include "support/process.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>

namespace {
namespace fs = std::filesystem;

// The choices of each setting of all rungs.
std::map<std::string, std::set<std::string>> choicesOf(const std::vector<std::string>& rungs) {
    std::map<std::string, std::set<std::string>> choices;
    for (const std::string& rung : rungs) {
        const auto listed =
            nlohmann::json::parse(gll::test::runToSuccess({rung, {"--settings", "--json"}}).out);
        for (const auto& setting : listed.at("settings"))
            if (setting.contains("choices"))
                for (const std::string choice : setting.at("choices"))
                    choices[setting.at("name")].insert(choice);
    }
    return choices;
}

int check(const fs::path& tutorials, const std::vector<std::string>& rungs) {
    const auto choices = choicesOf(rungs);
    std::set<std::string> all;
    for (const auto& [name, its] : choices)
        all.insert(its.begin(), its.end());
    const std::regex comparison(R"((\w+)(\.name\(\))?\s*[=!]=\s*"([^"]*)\")");
    const std::regex definition("[A-Z_0-9]+"); // the name of one in a shader
    int found = 0;
    int wrong = 0;
    for (const auto& entry : fs::recursive_directory_iterator(tutorials)) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        std::ifstream file(entry.path());
        const std::string source(std::istreambuf_iterator<char>(file), {});
        for (std::sregex_iterator match(source.begin(), source.end(), comparison), end; match != end;
             ++match) {
            const std::string text = (*match)[3];
            if (std::regex_match(text, definition)) continue;
            ++found;
            // Most handles are named as their setting; what is compared with another must be some choice.
            const auto setting = choices.find((*match)[1]);
            if ((setting == choices.end() ? all : setting->second).contains(text)) continue;
            std::printf("%s:%td: \"%s\" is no choice of %s\n", entry.path().c_str(),
                        1 + std::count(source.begin(), source.begin() + match->position(), '\n'),
                        text.c_str(), setting == choices.end() ? "any setting" : setting->first.c_str());
            ++wrong;
        }
    }
    std::printf("%d comparisons with a choice, %d of them with none there is\n", found, wrong);
    return wrong == 0 && found > 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 3) throw std::runtime_error("name the folder of the rungs' sources, and their programs");
        return check(argv[1], {argv + 2, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "choices: error: %s\n", error.what());
        return 2;
    }
}
