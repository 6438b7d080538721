// Counting in a thread that waits for the second process.
#include "window/cost_probe.hpp"

#include "budget/pass_costs.hpp"

#include <chrono>
#include <stdexcept>

namespace gll {
namespace {

std::optional<CostProbe::Costs> count(FrameRequest request,
                                      const std::vector<std::vector<std::string>>& settings,
                                      const std::string& context, const std::atomic<bool>& is_cancelled) {
    try {
        request.sets.clear();
        const auto counted =
            countPasses(request, settings, context, "auto", [&] { return is_cancelled.load(); });
        if (!counted) return {};
        CostProbe::Costs costs{.cu = {}, .counter = counted->counter};
        for (const PassCosts& passes : counted->of_settings)
            costs.cu.push_back(sumOf(passes).cu);
        return costs;
    } catch (const std::exception&) {
        return {}; // no second process, no counter, no room for its file: the window goes on without
    }
}

} // namespace

void CostProbe::cancel() {
    if (is_cancelled_) *is_cancelled_ = true;
    if (running_.valid()) running_.wait(); // as long as it takes to end a process
    running_ = {};
}

void CostProbe::ask(const FrameRequest& request, const std::vector<std::vector<std::string>>& settings,
                    const std::string& context, double now_s) {
    constexpr double settled_s = 1.5;
    if (settings != asked_ || request.size != asked_size_) {
        cancel();
        costs_.reset();
        asked_ = settings;
        asked_size_ = request.size;
        asked_since_s_ = now_s;
        is_begun_ = false;
    }
    if (running_.valid() && running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        costs_ = running_.get();
    if (is_begun_ || now_s - asked_since_s_ < settled_s) return;
    is_begun_ = true;
    is_cancelled_ = std::make_shared<std::atomic<bool>>(false);
    running_ = std::async(std::launch::async, [request, settings, context, cancelled = is_cancelled_] {
        return count(request, settings, context, *cancelled);
    });
}

} // namespace gll
