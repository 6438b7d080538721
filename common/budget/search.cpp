// Searching: each setting's choices alone first, then their combinations from the cheapest on, until one
// stays within the budget in every frame looked at.
#include "budget/budget.hpp"

#include "budget/pass_costs.hpp"
#include "measure/errors.hpp"
#include "measure/flip.hpp"
#include "rung/usage_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

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

    // What each pass of some frames costs: the best settings, then changes to them.
    std::vector<PassCosts> passCosts(const std::vector<Sets>& changes) {
        progress_("costs of " + std::to_string(changes.size()) + " settings");
        std::vector<std::vector<std::string>> settings;
        for (const Sets& change : changes) {
            std::vector<std::string>& sets = settings.emplace_back();
            for (const MeasuredDial& dial : dials_)
                sets.push_back(dial.setting + "=" + dial.values[0].text);
            sets.insert(sets.end(), implied_.begin(), implied_.end());
            for (const auto& [name, value] : change)
                sets.push_back(name + "=" + value);
        }
        const auto costs =
            countPasses(request_, settings, renderer_.context().kind(), counter_kind_, interrupted_);
        if (!costs) throw Interrupted();
        counter_ = costs->counter;
        return costs->of_settings;
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
        BudgetResult result{
            .budget = budget_, .error_to_spend = limit_, .error = error_, .present_error = presentError()};
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

} // namespace

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

} // namespace gll
