// What frames cost, counted by this program run a second time while the window goes on.
#pragma once

#include "rung/request.hpp"

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gll {

class CostProbe {
  public:
    struct Costs {
        std::vector<double> cu; // copies, of each of the settings; see tutorials/MEASURING.md
        std::string counter;    // what they were counted with
    };

    CostProbe() = default;
    ~CostProbe() { cancel(); }
    CostProbe(const CostProbe&) = delete;
    CostProbe& operator=(const CostProbe&) = delete;

    // Once a loop: the request's frame with each of these settings in place of its own. Counting begins once
    // they have been asked for unchanged for a while, whatever the frame's number, and ends where they
    // change.
    void ask(const FrameRequest& request, const std::vector<std::vector<std::string>>& settings,
             const std::string& context, double now_s);
    // Of what was asked for last; nothing as long as they are not known, or where they cannot be counted.
    const std::optional<Costs>& costs() const { return costs_; }

  private:
    void cancel();

    std::vector<std::vector<std::string>> asked_;
    glm::ivec2 asked_size_{0};
    double asked_since_s_ = 0;
    bool is_begun_ = false; // for what is asked
    std::shared_ptr<std::atomic<bool>> is_cancelled_;
    std::future<std::optional<Costs>> running_;
    std::optional<Costs> costs_;
};

} // namespace gll
