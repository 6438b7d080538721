// Budgets as text: on the command line, in what is printed, and between a window and the program that
// searches.
#include "budget/budget.hpp"

#include "process/process.hpp"
#include "rung/nearest.hpp"
#include "rung/usage_error.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace gll {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

struct Lines {
    std::string picked;
    std::string costs;
    std::string before;
    std::string not_needed;
};

Lines linesOf(const BudgetResult& result) {
    Lines lines;
    for (const auto& set : result.set)
        lines.picked += (lines.picked.empty() ? "--set " : " --set ") + set.first + "=" + set.second;
    if (lines.picked.empty()) lines.picked = "the settings as they are";
    lines.picked = "picked: " + lines.picked + "; " + kindName(result.budget.kind) + " at most " +
                   number(result.error) + " in " + std::to_string(result.views.size()) + " frames, where " +
                   number(result.budget.limit) + " is allowed";
    lines.costs = "costs: " + number(result.cost_cu) + " cu, " +
                  number(100 * result.cost_cu / result.best_cost_cu) + " % of the best setting's " +
                  number(result.best_cost_cu) + " (counted with " + result.counter + ")";
    lines.before = "before: " + number(result.present_cost_cu) + " cu, " +
                   number(100 * result.present_cost_cu / result.best_cost_cu) + " %; " +
                   kindName(result.budget.kind) + " at most " + number(result.present_error) + ", " +
                   (result.present_error > result.budget.limit ? "over" : "within") + " the budget";
    for (const std::string& name : result.not_needed)
        lines.not_needed += (lines.not_needed.empty() ? "" : ", ") + name;
    lines.not_needed = "not needed: " + (lines.not_needed.empty() ? "nothing" : lines.not_needed);
    return lines;
}

} // namespace

const char* kindName(Budget::Kind kind) {
    constexpr const char* names[] = {"flip", "rmse", "ev"};
    return names[static_cast<std::size_t>(kind)];
}

Budget parseBudget(const std::string& text) {
    const auto equals = std::min(text.find('='), text.size());
    const std::string given = text.substr(0, equals);
    Budget budget;
    bool known = false;
    std::vector<std::string> kinds;
    for (const Budget::Kind kind : {Budget::Kind::flip, Budget::Kind::rmse, Budget::Kind::ev}) {
        kinds.emplace_back(kindName(kind));
        if (given != kinds.back()) continue;
        budget.kind = kind;
        known = true;
    }
    const double most = budget.kind == Budget::Kind::ev ? 16 : 1;
    const char* const end = text.data() + text.size();
    const auto [stop, error] =
        std::from_chars(text.data() + std::min(equals + 1, text.size()), end, budget.limit);
    if (!known || error != std::errc() || stop != end || !(budget.limit > 0 && budget.limit <= most))
        throw UsageError("--budget " + text +
                         ": write flip=LIMIT or rmse=LIMIT, above 0 and at most 1, or ev=LIMIT, at most 16" +
                         (known ? "" : didYouMean(given, kinds)));
    return budget;
}

std::string budgetText(const BudgetResult& result) {
    const Lines lines = linesOf(result);
    return lines.picked + "\n" + lines.costs + "\n" + lines.before + "\n" + lines.not_needed + "\n";
}

std::string budgetJson(const BudgetResult& result, const RungInfo& info) {
    const Lines lines = linesOf(result);
    nlohmann::ordered_json json{{"rung", info.name},
                                {"kind", kindName(result.budget.kind)},
                                {"limit", result.budget.limit},
                                {"error_to_spend", result.error_to_spend},
                                {"error", result.error},
                                {"cost_cu", result.cost_cu},
                                {"best_cost_cu", result.best_cost_cu},
                                {"present_error", result.present_error},
                                {"present_cost_cu", result.present_cost_cu},
                                {"counter", result.counter},
                                {"combinations", result.combinations},
                                {"tried", result.tried},
                                {"set", nlohmann::json::object()},
                                {"best", nlohmann::json::object()},
                                {"picked", nlohmann::json::object()},
                                {"not_needed", result.not_needed},
                                {"lines", {lines.picked, lines.costs, lines.before, lines.not_needed}}};
    for (const glm::ivec3& view : result.views)
        json["views"].push_back({{"frame", view.x}, {"size", {view.y, view.z}}});
    for (const auto& [name, value] : result.set)
        json["set"][name] = value;
    for (const auto& [name, value] : result.best)
        json["best"][name] = value;
    for (const auto& [name, value] : result.picked)
        json["picked"][name] = value;
    return json.dump() + "\n";
}

Command budgetCommand(const Budget& budget, const FrameRequest& request, const std::string& context) {
    Command command = headlessCommand(request, context);
    command.arguments.insert(
        command.arguments.end(),
        {"--budget", std::string(kindName(budget.kind)) + "=" + number(budget.limit), "--json"});
    command.environment[progress_variable] = "1";
    return command;
}

BudgetAnswer budgetAnswer(const ProcessResult& result) {
    if (result.exit_code != 0) { // the last line is the error, those before it are warnings
        const std::string said = result.err.substr(0, result.err.find_last_not_of('\n') + 1);
        return {{}, said.substr(said.rfind('\n') + 1)};
    }
    const nlohmann::json json = nlohmann::json::parse(result.out);
    BudgetAnswer answer;
    for (const auto& [name, value] : json.at("set").items())
        answer.set.emplace_back(name, value);
    for (const std::string line : json.at("lines"))
        answer.text += (answer.text.empty() ? "" : "\n") + line;
    return answer;
}

} // namespace gll
