// Where the picture is in the window, and what is beside it: nothing lies over the picture.
#pragma once

#include <glm/vec2.hpp>

namespace gll {

// From the top left, in pixels of the window.
struct Rectangle {
    glm::ivec2 corner{0};
    glm::ivec2 size{0}; // 0 in both: not shown

    bool isShown() const { return size.x > 0 && size.y > 0; }
    bool contains(glm::dvec2 place) const {
        return place.x >= corner.x && place.y >= corner.y && place.x < corner.x + size.x &&
               place.y < corner.y + size.y;
    }
    bool operator==(const Rectangle&) const = default;
};

inline constexpr float narrowest_panel_em = 15;
inline constexpr float widest_panel = 0.6F; // of the window's width
// Under a picture that is narrower, and above it, bars have two lines: in one there is no room for all of
// them.
inline constexpr float narrow_picture_em = 38;

// What a person wants shown, in ems: the height of a line of text.
struct LayoutWish {
    bool panel = true;
    float panel_em = 22;
    bool strip = false; // of the passes' targets
    float strip_em = 11;
    float timeline_em = 2; // of one line
    bool bar = false;      // above the picture
    float bar_em = 2;      // of one line
};

struct Layout {
    Rectangle panel; // at the left, over the whole height
    Rectangle bar;   // above the picture
    Rectangle picture;
    Rectangle strip;    // under the picture
    Rectangle timeline; // at the bottom
};

// window: its size, at least 1x1. em: pixels. The picture keeps at least 40 % of the window's width and half
// of its height; what does not fit beside that is narrower, or not shown.
Layout layOut(glm::ivec2 window, float em, const LayoutWish& wish);

// The size of the window in which the picture has that size.
glm::ivec2 windowFor(glm::ivec2 picture, float em, const LayoutWish& wish);

} // namespace gll
