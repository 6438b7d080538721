// The bar above two compared pictures: which is edited, how they are shown, and how far apart they are.
#pragma once

#include "window/comparison.hpp"
#include "window/cost_probe.hpp"
#include "window/layout.hpp"
#include "window/stage.hpp"

namespace gll {

void drawCompareBar(const Rectangle& place, float pixels_per_unit, Stage& stage, Comparison& comparison,
                    const std::optional<CostProbe::Costs>& costs, bool shows_times);

// "A: tone_map=clamp" and "B: tone_map=agx" in the picture's upper corners, or of the one that is shown. In
// the middle of the picture's width where nothing tells them apart. divider_px: of the picture's width.
void drawCompareLabels(const Rectangle& picture, float pixels_per_unit, const Stage& stage,
                       const Comparison& comparison, double now_s);

} // namespace gll
