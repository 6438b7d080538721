// Whether a rung's golden cases show all its settings: what no frame shows can change unnoticed.
#pragma once

#include "frame_check/suite.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gll::test {

// By setting, or by "setting=choice", the reason why no case shows it.
using Excuses = std::map<std::string, std::string>;

// Of that rung, from a file {"NN_name": {"setting": "reason"}}. Throws std::runtime_error where it is wrong.
Excuses readExcuses(const std::filesystem::path& json_file, const std::string& rung);

// A sentence for each case that is missing. listed: what the rung prints for --settings --json. Asked for is
// a case for every choice of a setting but its default, and one off its default for every toggle and number.
// Of settings that another rung owns one choice will do, since that rung's goldens show the others. An excuse
// that is not needed is said too.
std::vector<std::string> missingCases(const nlohmann::json& listed,
                                      const std::vector<frame_check::Case>& cases, const Excuses& excuses);

// A sentence for each case of whose frame no blessing notes the intermediate targets.
std::vector<std::string> ungroupedCases(const std::string& rung, const std::vector<frame_check::Case>& cases);

} // namespace gll::test
