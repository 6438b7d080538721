// The window's parts: nothing over the picture, nothing lost, at any size and scale.
#include "window/layout.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace gll::test {
namespace {

int area(const Rectangle& rectangle) { return rectangle.size.x * rectangle.size.y; }

bool overlap(const Rectangle& a, const Rectangle& b) {
    if (!a.isShown() || !b.isShown()) return false;
    return a.corner.x < b.corner.x + b.size.x && b.corner.x < a.corner.x + a.size.x &&
           a.corner.y < b.corner.y + b.size.y && b.corner.y < a.corner.y + a.size.y;
}

TEST(LayoutTest, thePartsFillTheWindowAndNoneLiesOverAnother) {
    for (const float em : {16.0F, 24.0F, 48.0F})
        for (const glm::ivec2 window :
             {glm::ivec2(1280, 720), glm::ivec2(800, 600), glm::ivec2(480, 360), glm::ivec2(300, 900),
              glm::ivec2(900, 60), glm::ivec2(3840, 2160), glm::ivec2(3, 2), glm::ivec2(1, 1)})
            for (const bool strip : {false, true})
                for (const float panel_em : {1.0F, 22.0F, 500.0F}) {
                    const Layout layout =
                        layOut(window, em, {.panel_em = panel_em, .strip = strip, .strip_em = 9});
                    const std::vector<Rectangle> parts = {layout.panel, layout.picture, layout.strip,
                                                          layout.timeline};
                    int sum = 0;
                    for (std::size_t i = 0; i < parts.size(); ++i) {
                        sum += area(parts[i]);
                        for (std::size_t j = 0; j < i; ++j)
                            EXPECT_FALSE(overlap(parts[i], parts[j]));
                    }
                    EXPECT_EQ(sum, window.x * window.y);
                    EXPECT_TRUE(layout.picture.isShown());
                    EXPECT_GE(layout.picture.size.x, 0.39F * static_cast<float>(window.x));
                    EXPECT_GE(2 * layout.picture.size.y, window.y);
                }
}

TEST(LayoutTest, aHiddenPanelLeavesThePictureAll) {
    const Layout layout = layOut({1280, 720}, 16, {.panel = false, .strip = true});
    EXPECT_EQ(layout.picture, (Rectangle{{0, 0}, {1280, 720}}));
    EXPECT_FALSE(layout.panel.isShown() || layout.strip.isShown() || layout.timeline.isShown());
}

TEST(LayoutTest, thePictureHasTheSizeThatTheWindowIsMadeFor) {
    for (const float em : {16.0F, 32.0F})
        for (const glm::ivec2 picture : {glm::ivec2(480, 360), glm::ivec2(640, 480), glm::ivec2(1001, 777)})
            for (const LayoutWish& wish :
                 {LayoutWish{}, LayoutWish{.bar = true}, LayoutWish{.strip = true, .strip_em = 8}}) {
                if (wish.strip && picture.y < 480) continue; // too low for a strip
                EXPECT_EQ(layOut(windowFor(picture, em, wish), em, wish).picture.size, picture);
            }
}

TEST(LayoutTest, barsHaveTwoLinesWhereThePictureIsNarrow) {
    const LayoutWish wish{.bar = true};
    const Layout wide = layOut({1280, 720}, 16, wish);
    const Layout narrow = layOut({800, 600}, 16, wish);
    EXPECT_EQ(wide.timeline.size.y, 32);
    EXPECT_EQ(wide.bar.size.y, 32);
    EXPECT_EQ(narrow.timeline.size.y, 64);
    EXPECT_EQ(narrow.bar.size.y, 64);
}

} // namespace
} // namespace gll::test
