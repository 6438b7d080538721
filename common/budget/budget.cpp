// Searching: each setting's choices alone first, then their combinations from the cheapest on, until one
// stays within the budget in every frame looked at.
#include "budget/budget.hpp"

#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "process/process.hpp"
#include "rung/nearest.hpp"
#include "rung/usage_error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>
#include <unistd.h>

namespace gll {
namespace {

using Sets = BudgetResult::Sets;

// The part of the budget that may be spent on the frames looked at, so that others, which differ a little
// more, stay within it. In frames of the ladder's scenes that were not looked at, pictures differed by up to
// a seventh more than in the worst that was; exposures, where samples were taken at random, by up to 2.4
// times as much.
double shareToSpend(Budget::Kind kind) { return kind == Budget::Kind::ev ? 0.4 : 0.85; }

// The animations of the ladder repeat, or have shown what they have, after 16 s.
constexpr int frames_to_cover = 960;
constexpr int most_frames = 5;

// Costs closer than this part of the best setting's are the same: then fewer bytes decide, and then the
// smaller error. Instructions repeat; times do not.
double sameCost(const std::string& counter) {
    return counter == "perf" || counter == "callgrind" ? 0.0025 : 0.02;
}

std::string spelled(const std::pair<std::string, std::string>& set) { return set.first + "=" + set.second; }

// What a frame is judged by.
struct Seen {
    measure::ColorImage display_light;
    double exposure_ev = 0;
};

struct View {
    int frame = 1;
    glm::ivec2 size{1};
    Seen best; // with every dial at its first value
};

// What a frame costs, in all or in one pass, per pixel of the frame.
struct Cost {
    double cu = 0;
    double bytes = 0;     // written and read
    unsigned program = 0; // of a pass
};
using PassCosts = std::map<std::string, Cost>;

Cost sumOf(const PassCosts& passes) {
    Cost sum;
    for (const auto& [name, cost] : passes) {
        sum.cu += cost.cu;
        sum.bytes += cost.bytes;
    }
    return sum;
}

// One dial's values, what each adds alone, and which are left.
struct DialValue {
    std::string text;
    double error = 0;      // alone, over all views; of a dropped one, in the view that dropped it
    bool dropped = false;  // over the limit by itself
    PassCosts passes = {}; // of the frame with this value alone
};
struct MeasuredDial {
    std::string setting;
    std::vector<DialValue> values = {}; // best first
    std::string present = {};
};

using Picks = std::vector<std::size_t>; // for each dial the index of its value

struct Interrupted {};

class Search {
  public:
    Search(Renderer& renderer, const FrameRequest& request, const Budget& budget,
           const std::string& counter_kind, const RungInfo& info, Settings& settings,
           const BudgetProgress& progress, const std::function<bool()>& interrupted)
        : renderer_(renderer), request_(request), budget_(budget), counter_kind_(counter_kind), info_(info),
          settings_(settings), progress_(progress), interrupted_(interrupted),
          limit_(shareToSpend(budget.kind) * budget.limit) {}

    std::optional<BudgetResult> run() {
        prepareDials();
        prepareViews();
        measureAlone();
        measureCosts();
        const std::optional<Picks> found = cheapest();
        if (!found || interrupted_()) return std::nullopt;
        return result(*found);
    }

  private:
    void prepareDials() {
        if (settings_.dials().empty())
            throw UsageError("--budget: " + info_.name + " has no settings that trade accuracy for cost");
        for (const Settings::Dial& dial : settings_.dials()) {
            const Setting& setting = settings_.at(dial.setting);
            MeasuredDial measured{.setting = dial.setting, .present = setting.text()};
            if (dial.values.empty())
                for (int value = static_cast<int>(setting.value); value >= static_cast<int>(setting.min);
                     --value)
                    measured.values.push_back({.text = std::to_string(value)});
            else
                for (const std::string& value : dial.values)
                    measured.values.push_back({.text = value});
            dials_.push_back(std::move(measured));
        }
        for (const std::string& set : renderer_.implied())
            settings_.set(set);
        implied_ = renderer_.implied();
    }

    // The frames asked for, or, where that is one, it and others of the animation. And one in other, odd
    // sizes and shapes: a window may be dragged to any, and a tall one shows other parts of the scene.
    void prepareViews() {
        const FrameRequest& request = request_;
        const bool several = request.isSequence();
        const int last =
            several ? request.last_frame : std::min(request.first_frame + frames_to_cover, max_frame);
        const int count = std::min(most_frames, last - request.first_frame + 1);
        const int parts = several ? count - 1 : most_frames; // a sequence is looked at to its end
        std::vector<int> numbers;
        for (int i = 0; i < count; ++i)
            numbers.push_back(request.first_frame +
                              static_cast<int>(std::int64_t(last - request.first_frame) * i / parts));
        for (const int number : numbers)
            addView(number, request.size);
        const glm::ivec2 half = request.size / 4 * 2 + 1;
        for (const glm::ivec2 size : {glm::ivec2(half.x, request.size.y), {request.size.x, half.y}, half})
            addView(request.first_frame, size);
    }

    // A frame that looks like one that is there already has nothing to add.
    void addView(int number, glm::ivec2 size) {
        progress_("the best settings, frame " + std::to_string(number));
        apply(Picks(dials_.size(), 0));
        View view{number, size, see(number, size)};
        for (const View& other : views_)
            if (other.size == size && other.best.display_light.pixels == view.best.display_light.pixels &&
                other.best.exposure_ev == view.best.exposure_ev)
                return;
        views_.push_back(std::move(view));
    }

    void apply(const Picks& choice) {
        for (std::size_t d = 0; d < dials_.size(); ++d)
            settings_.set(dials_[d].setting, dials_[d].values[choice[d]].text);
    }

    Seen see(int number, glm::ivec2 size) {
        if (interrupted_()) throw Interrupted();
        renderer_.render(number, size);
        Seen seen;
        if (budget_.kind == Budget::Kind::ev) {
            const std::vector<Reading> readings = renderer_.readings();
            const auto found = std::find_if(readings.begin(), readings.end(),
                                            [](const Reading& reading) { return reading.is_exposure; });
            if (found == readings.end())
                throw UsageError("--budget ev: " + info_.name + " meters no exposure; write flip= or rmse=");
            seen.exposure_ev = found->value;
            return seen;
        }
        const Image image = renderer_.image();
        seen.display_light =
            budget_.kind == Budget::Kind::flip ? measure::linearColor(image) : measure::displayColor(image);
        return seen;
    }

    // How far off a view is as the settings are now, in the budget's unit.
    double error(const View& view) {
        const Seen seen = see(view.frame, view.size);
        switch (budget_.kind) {
        case Budget::Kind::ev:
            return std::abs(seen.exposure_ev - view.best.exposure_ev);
        case Budget::Kind::rmse:
            return measure::rmse(seen.display_light, view.best.display_light);
        case Budget::Kind::flip:
            break;
        }
        if (seen.display_light.pixels == view.best.display_light.pixels) return 0;
        return measure::summary(measure::flip(seen.display_light, view.best.display_light)).mean;
    }

    // The largest error over all views, or the first that is over the limit. Views that said no come first
    // the next time.
    double worstError(const Picks& choice) {
        apply(choice);
        double worst = 0;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const double here = error(views_[i]);
            worst = std::max(worst, std::isfinite(here) ? here : HUGE_VAL);
            if (worst > limit_) {
                std::rotate(views_.begin(), views_.begin() + static_cast<std::ptrdiff_t>(i),
                            views_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
                break;
            }
        }
        return worst;
    }

    // The largest error over all views of the settings that the search began with.
    double presentError() {
        for (const MeasuredDial& dial : dials_)
            settings_.set(dial.setting, dial.present);
        double worst = 0;
        for (const View& view : views_) {
            const double here = error(view);
            worst = std::max(worst, std::isfinite(here) ? here : HUGE_VAL);
        }
        return worst;
    }

    void measureAlone() {
        Picks choice(dials_.size(), 0);
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            for (std::size_t v = 1; v < dials_[d].values.size(); ++v) {
                DialValue& value = dials_[d].values[v];
                progress_("errors of each setting: " + dials_[d].setting + "=" + value.text);
                choice[d] = v;
                value.error = worstError(choice);
                value.dropped = value.error > limit_;
            }
            choice[d] = 0;
        }
    }

    // What each pass of some frames costs, of this program run again: the best settings, then changes to
    // them.
    std::vector<PassCosts> passCosts(const std::vector<Sets>& changes) {
        progress_("costs of " + std::to_string(changes.size()) + " settings");
        std::string lines;
        for (const Sets& change : changes) {
            nlohmann::json line{{"cost", "passes"}};
            const auto add = [&](const std::string& name, const std::string& value) {
                line["set"].push_back(name + "=" + value);
            };
            for (const MeasuredDial& dial : dials_)
                add(dial.setting, dial.values[0].text);
            for (const std::string& set : implied_)
                line["set"].push_back(set);
            for (const auto& [name, value] : change)
                add(name, value);
            lines += line.dump() + "\n";
        }
        std::istringstream printed(again(lines));
        std::vector<PassCosts> costs;
        for (std::string text; std::getline(printed, text);) {
            const nlohmann::json report = nlohmann::json::parse(text);
            counter_ = report.at("counter");
            PassCosts& passes = costs.emplace_back();
            const double pixels =
                report.at("size").at(0).get<double>() * report.at("size").at(1).get<double>();
            for (const auto& pass : report.at("passes")) {
                const double drawn =
                    pass.at("size").at(0).get<double>() * pass.at("size").at(1).get<double>();
                passes[pass.at("name")] = {pass.at("cu"),
                                           pass.at("bytes_per_pixel").get<double>() * drawn / pixels,
                                           pass.at("program")};
            }
        }
        return costs;
    }

    // What this program prints for a batch of frames, with the options it has now.
    std::string again(const std::string& batch) const {
        std::string file = (std::filesystem::temp_directory_path() / "gl-ladder-XXXXXX").string();
        const int handle = mkstemp(file.data());
        if (handle < 0) throw std::runtime_error(file + ": cannot be written; costs are measured through it");
        struct Removed {
            std::string name;
            ~Removed() { unlink(name.c_str()); }
        } const removed{file};
        const bool whole = write(handle, batch.data(), batch.size()) == static_cast<ssize_t>(batch.size());
        close(handle);
        if (!whole) throw std::runtime_error(file + ": cannot be written; make room there");

        FrameRequest request = request_;
        request.out.clear(); // nothing is written twice
        Command command = headlessCommand(request, renderer_.context().kind());
        command.arguments.insert(command.arguments.end(),
                                 {"--batch", file, "--json", "--counter", counter_kind_});
        Process process(command);
        std::optional<ProcessResult> result;
        while (!(result = process.poll())) {
            if (interrupted_()) throw Interrupted();
            usleep(20'000);
        }
        if (result->exit_code != 0)
            throw std::runtime_error("measuring costs failed: " +
                                     result->err.substr(0, result->err.find('\n')));
        return result->out;
    }

    void measureCosts() {
        std::vector<Sets> changes{{}};
        for (const MeasuredDial& dial : dials_)
            for (std::size_t v = 1; v < dial.values.size(); ++v)
                if (!dial.values[v].dropped) changes.push_back({{dial.setting, dial.values[v].text}});
        Sets& present = changes.emplace_back();
        for (const MeasuredDial& dial : dials_)
            present.emplace_back(dial.setting, dial.present);
        const auto costs = passCosts(changes);
        best_passes_ = costs.at(0);
        present_passes_ = costs.back();
        std::size_t next = 1;
        for (MeasuredDial& dial : dials_)
            for (std::size_t v = 1; v < dial.values.size(); ++v)
                if (!dial.values[v].dropped) dial.values[v].passes = costs.at(next++);
    }

    // A pass that any of the values leaves out is left out; else what each value changes of it adds up. The
    // same shaders on the same formats cost the same, whatever the noise of measuring says.
    Cost predictedCost(const Picks& picks) const {
        PassCosts passes = best_passes_;
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            if (picks[d] == 0) continue;
            const PassCosts& alone = dials_[d].values[picks[d]].passes;
            for (const auto& [name, best] : best_passes_) {
                const auto with = alone.find(name);
                if (with == alone.end()) {
                    passes.erase(name);
                } else if (const auto pass = passes.find(name); pass != passes.end()) {
                    if (with->second.program == best.program && with->second.bytes == best.bytes) continue;
                    pass->second.cu += with->second.cu - best.cu;
                    pass->second.bytes += with->second.bytes - best.bytes;
                }
            }
            for (const auto& [name, cost] : alone)
                if (!best_passes_.contains(name)) passes[name] = cost;
        }
        return sumOf(passes);
    }

    double errorAlone(const Picks& choice, std::size_t d) const { return dials_[d].values[choice[d]].error; }

    std::optional<Picks> cheapest() {
        struct Candidate {
            Picks choice;
            double cost = 0; // in steps of what is the same
            double bytes = 0;
            double error = 0;
        };
        std::vector<Candidate> candidates;
        const double step = sameCost(counter_) * predictedCost(Picks(dials_.size(), 0)).cu;
        combinations_ = 1;
        for (const MeasuredDial& dial : dials_)
            combinations_ *= static_cast<int>(dial.values.size());
        Picks choice(dials_.size(), 0);
        const auto isDropped = [&] {
            for (std::size_t d = 0; d < dials_.size(); ++d)
                if (dials_[d].values[choice[d]].dropped) return true;
            return false;
        };
        const auto next = [&] {
            for (std::size_t d = 0; d < dials_.size(); ++d) {
                if (++choice[d] < dials_[d].values.size()) return true;
                choice[d] = 0;
            }
            return false;
        };
        do {
            if (isDropped()) continue;
            double sum = 0;
            for (std::size_t d = 0; d < dials_.size(); ++d)
                sum += errorAlone(choice, d);
            const Cost cost = predictedCost(choice);
            candidates.push_back({choice, std::round(cost.cu / step), std::round(cost.bytes * 16), sum});
        } while (next());
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& one, const Candidate& other) {
                             return std::tuple(one.cost, one.bytes, one.error) <
                                    std::tuple(other.cost, other.bytes, other.error);
                         });

        // excerpt: cheapest
        std::vector<Picks> failed;
        for (const Candidate& candidate : candidates) {
            // Where every choice is at least as bad as in a combination that failed, this one fails too.
            const bool hopeless = std::any_of(failed.begin(), failed.end(), [&](const Picks& worse) {
                for (std::size_t d = 0; d < dials_.size(); ++d)
                    if (errorAlone(candidate.choice, d) < errorAlone(worse, d)) return false;
                return true;
            });
            if (hopeless) continue;
            ++tried_;
            progress_("combination " + std::to_string(tried_) + " of at most " +
                      std::to_string(candidates.size()));
            error_ = worstError(candidate.choice);
            if (error_ <= limit_) return candidate.choice;
            failed.push_back(candidate.choice);
        }
        // end excerpt
        return std::nullopt; // never: the best settings' error is 0
    }

    // A dial that makes no difference beside the others stays where it was.
    void keepPresent(Picks& found) {
        for (std::size_t d = 0; d < dials_.size(); ++d)
            for (std::size_t v = 0; v < dials_[d].values.size(); ++v) {
                if (dials_[d].values[v].text != dials_[d].present || v == found[d] ||
                    dials_[d].values[v].dropped)
                    continue;
                Picks other = found;
                other[d] = v;
                const Cost cost = predictedCost(other);
                const Cost least = predictedCost(found);
                if (cost.cu > (1 + sameCost(counter_)) * least.cu || cost.bytes > least.bytes) continue;
                const double other_error = worstError(other);
                if (other_error > error_) continue;
                found = other;
                error_ = other_error;
            }
    }

    BudgetResult result(Picks found) {
        keepPresent(found);
        BudgetResult result{.budget = budget_, .error = error_, .present_error = presentError()};
        for (std::size_t d = 0; d < dials_.size(); ++d) {
            const MeasuredDial& dial = dials_[d];
            const std::string& best = dial.values[0].text;
            const std::string& picked = dial.values[found[d]].text;
            result.best.push_back({dial.setting, best});
            result.picked.push_back({dial.setting, picked});
            if (picked != dial.present) result.set.push_back({dial.setting, picked});
            if (picked == best || isIdle(found, d)) continue;
            const Setting& setting = settings_.at(dial.setting);
            if (setting.kind == Setting::Kind::toggle)
                result.not_needed.push_back(dial.setting);
            else if (setting.kind == Setting::Kind::integer)
                result.not_needed.push_back(dial.setting + " above " + picked);
            else
                result.not_needed.push_back(dial.setting + "=" + best + " (" + picked + " will do)");
        }
        for (const std::string& set : implied_) {
            const auto equals = set.find('=');
            const std::pair pinned(set.substr(0, equals), set.substr(equals + 1));
            result.best.push_back(pinned);
            result.picked.push_back(pinned);
            if (!result.set.empty()) result.set.push_back(pinned);
        }
        result.best_cost_cu = sumOf(best_passes_).cu;
        result.cost_cu = predictedCost(found).cu;
        result.present_cost_cu = result.set.empty() ? result.cost_cu : sumOf(present_passes_).cu;
        result.counter = counter_;
        for (const View& view : views_)
            result.views.emplace_back(view.frame, view.size);
        result.combinations = combinations_;
        result.tried = tried_;
        apply(found);
        return result;
    }

    // Whether a dial's passes are not even drawn with the others as they are.
    bool isIdle(const Picks& found, std::size_t d) const {
        Picks other = found;
        other[d] = 0;
        const Cost one = predictedCost(other);
        const Cost two = predictedCost(found);
        return one.cu == two.cu && one.bytes == two.bytes;
    }

    Renderer& renderer_;
    const FrameRequest& request_;
    const Budget& budget_;
    const std::string& counter_kind_;
    const RungInfo& info_;
    Settings& settings_;
    const BudgetProgress& progress_;
    const std::function<bool()>& interrupted_;
    double limit_;
    std::vector<std::string> implied_;
    std::vector<MeasuredDial> dials_;
    std::vector<View> views_;
    PassCosts best_passes_;
    PassCosts present_passes_;
    std::string counter_;
    double error_ = 0;
    int combinations_ = 0;
    int tried_ = 0;
};

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
        lines.picked += (lines.picked.empty() ? "--set " : " --set ") + spelled(set);
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

std::optional<BudgetResult> searchBudget(Renderer& renderer, const FrameRequest& request,
                                         const Budget& budget, const std::string& counter,
                                         const RungInfo& info, Settings& settings,
                                         const BudgetProgress& progress,
                                         const std::function<bool()>& interrupted) {
    try {
        return Search(renderer, request, budget, counter, info, settings, progress, interrupted).run();
    } catch (const Interrupted&) {
        return std::nullopt;
    }
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
                                {"error_to_spend", shareToSpend(result.budget.kind) * result.budget.limit},
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
