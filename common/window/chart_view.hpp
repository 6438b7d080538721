// A rung's charts in the panel: where the present settings stand among what was measured, and a click that
// takes those of a point.
#pragma once

#include "rung/resources.hpp"
#include "window/chart_points.hpp"
#include "window/cost_probe.hpp"

#include <string>
#include <vector>

namespace gll {

class ChartView {
  public:
    // Reads the charts. Where there are none, or they are no charts, draw() says so. Settings are those of
    // the rung, and come back as they were.
    ChartView(const Resources& resources, const std::string& rung, Settings& settings);

    // What the chart that is shown asks to be counted; nothing where it is not about cost.
    std::vector<std::vector<std::string>> wanted() const;

    // As wide as there is room, in Dear ImGui's present window. points: the costs of wanted(), present: of
    // the present settings, as far as they are known; is_counting: whether they will be. Returns KEY=VALUE of
    // what is to be set for the point that was chosen; empty where none was.
    std::vector<std::string> draw(const Settings& settings, const std::optional<CostProbe::Costs>& points,
                                  const std::optional<CostProbe::Costs>& present, bool is_counting);

  private:
    std::string rung_;
    std::vector<Chart> charts_;
    std::string why_none_; // or why not all
    std::size_t shown_ = 0;
};

} // namespace gll
