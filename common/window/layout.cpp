// Dividing the window.
#include "window/layout.hpp"

#include <algorithm>
#include <cmath>

namespace gll {
namespace {

constexpr float lowest_strip_em = 8; // lower, and there is no room for pictures between the words

int pixels(float ems, float em) { return static_cast<int>(std::lround(ems * em)); }

float lines(int picture_width, float em) {
    return static_cast<float>(picture_width) < narrow_picture_em * em ? 2.0F : 1.0F;
}

} // namespace

Layout layOut(glm::ivec2 window, float em, const LayoutWish& wish) {
    Layout layout;
    layout.picture = {{0, 0}, window};
    if (!wish.panel) return layout; // all of it goes with the panel
    const int widest = static_cast<int>(static_cast<float>(window.x) * widest_panel);
    const int narrowest = pixels(narrowest_panel_em, em);
    if (widest < narrowest) return layout;
    const int panel = std::clamp(pixels(wish.panel_em, em), narrowest, widest);
    layout.panel = {{0, 0}, {panel, window.y}};
    layout.picture = {{panel, 0}, {window.x - panel, window.y}};
    const auto takeFromBelow = [&](int height) {
        layout.picture.size.y -= height;
        return Rectangle{{panel, layout.picture.corner.y + layout.picture.size.y},
                         {layout.picture.size.x, height}};
    };
    const float of_lines = lines(layout.picture.size.x, em);
    const int bar = pixels(of_lines * wish.timeline_em, em);
    if (window.y < 3 * bar) return layout;
    layout.timeline = takeFromBelow(bar);
    const int above = pixels(of_lines * wish.bar_em, em);
    if (wish.bar && layout.picture.size.y > 3 * above) {
        layout.bar = {layout.picture.corner, {layout.picture.size.x, above}};
        layout.picture.corner.y += above;
        layout.picture.size.y -= above;
    }
    const int tallest = layout.picture.size.y - (window.y + 1) / 2;
    if (wish.strip && tallest >= pixels(lowest_strip_em, em))
        layout.strip =
            takeFromBelow(std::clamp(pixels(wish.strip_em, em), pixels(lowest_strip_em, em), tallest));
    return layout;
}

glm::ivec2 windowFor(glm::ivec2 picture, float em, const LayoutWish& wish) {
    if (!wish.panel) return picture;
    glm::ivec2 size = picture;
    size.x += pixels(std::max(wish.panel_em, narrowest_panel_em), em);
    const float of_lines = lines(picture.x, em);
    size.y += pixels(of_lines * wish.timeline_em, em);
    if (wish.strip) size.y += pixels(wish.strip_em, em);
    if (wish.bar) size.y += pixels(of_lines * wish.bar_em, em);
    return size;
}

} // namespace gll
