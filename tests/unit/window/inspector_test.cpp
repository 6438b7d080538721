// What the inspector shows of a target, pixel by pixel.
#include "../gl/gl_test.hpp"
#include "window/inspector.hpp"

#include <limits>

namespace gll::test {
namespace {

constexpr int side_px = 8;

// Draws a target of half floats, overwrites some of its pixels, and then draws over it in a second pass.
class TargetRung final : public Rung {
  public:
    void render(Frame& frame) override {
        draw(frame, "first", glm::vec4(0.18F, 0.18F, 0.18F, 1));
        draw(frame, "second", glm::vec4(1, 0, 0, 1));
        frame.pass("present", frame.presented(),
                   {.program = program_, .uniforms = {{"flat_color", glm::vec4(0.5F)}}});
    }
    const Framebuffer& target() const { return target_; }

  private:
    void draw(Frame& frame, const std::string& pass, glm::vec4 color) {
        frame.pass(pass, target_,
                   {.program = program_,
                    .uniforms = {{"flat_color", color}},
                    .depth_test = DepthTest::less,
                    .clear_depth = 1.0F});
    }
    Framebuffer target_{{{.name = "hdr"}, {.name = "depth", .format = Format::depth24}}, {side_px, side_px}};
    Program program_ = makeProgram(full_screen_vertex, flat_fragment);
};

// Puts values that are no light into the target, right after the first pass.
class Spoiler final : public PassObserver {
  public:
    explicit Spoiler(Inspector& inspector) : inspector_(inspector) {}
    void after(const DrawnPass& pass) override {
        if (pass.name == "first") {
            pass.target->color().setTexel({1, 1}, std::numeric_limits<float>::quiet_NaN());
            pass.target->color().setTexel({6, 6}, std::numeric_limits<float>::infinity());
            pass.target->color().setTexel({1, 6}, 0.72F);
        }
        inspector_.after(pass);
    }

  private:
    Inspector& inspector_;
};

class InspectorTest : public GlTest {
  protected:
    // The target after a pass, in a place of as many pixels as it has texels, under no bar.
    void look(const PassTarget& target) {
        inspector.select(target);
        for (int i = 0; i < 2; ++i) { // the first makes room for the thumbnails
            inspector.begin(renderer, {4, 4});
            Spoiler spoiler(inspector);
            renderer.render(1, {side_px, side_px}, &spoiler);
            inspector.end();
        }
        inspector.look(renderer, {{0, 0}, {side_px, side_px}}, {0, 0});
    }
    glm::vec3 pixel(int x, int y) const { return glm::vec3(pixelOf(inspector.looked().color(), x, y)); }

    RungInfo info{.name = "00_target", .summary = "", .make = [](const RungResources&) {
                      return std::make_unique<TargetRung>();
                  }};
    Renderer renderer{*context, info, {}};
    Inspector inspector;
};

TEST_F(InspectorTest, aTargetIsShownAsItsPassLeftIt) {
    look({"first", "hdr"});
    const float gray = 118.0F / 255; // 0.18 in sRGB
    EXPECT_NEAR(pixel(3, 3).r, gray, 0.005F);
    EXPECT_NEAR(pixel(3, 3).b, gray, 0.005F);
    look({"second", "hdr"});
    EXPECT_NEAR(pixel(3, 3).r, 1, 0.005F);
    EXPECT_NEAR(pixel(3, 3).b, 0, 0.005F);
    look({"present", "frame"}); // as it is sent to the display, and not encoded again
    EXPECT_NEAR(pixel(3, 3).r, 0.5F, 0.005F);
}

TEST_F(InspectorTest, whatIsNoLightStandsOut) {
    look({"first", "hdr"});
    EXPECT_EQ(pixel(1, 1), glm::vec3(1, 0, 1));
    EXPECT_NEAR(pixel(6, 6).g, 0.6F, 0.01F);
    EXPECT_EQ(pixel(6, 6).r, 1);
    EXPECT_NEAR(pixel(1, 6).g, 220.0F / 255, 0.01F); // two stops above: 0.72 in sRGB
}

TEST_F(InspectorTest, aTargetThatIsNotDrawnIsNotLookedInto) {
    look({"third", "hdr"});
    EXPECT_TRUE(inspector.isInspecting());
    EXPECT_FALSE(inspector.lookedAt().isShown());
    inspector.select(std::nullopt);
    EXPECT_FALSE(inspector.isInspecting());
}

TEST_F(InspectorTest, aPixelIsReadWhereTheCursorIs) {
    look({"first", "hdr"});
    inspector.look(renderer, {{0, 0}, {side_px, side_px}}, {1.5, 6.5}); // from the top left
    EXPECT_TRUE(inspector.probe("frame", renderer.presented(), std::nullopt).starts_with("hdr 1,6:  nan"))
        << inspector.probe("frame", renderer.presented(), std::nullopt);
    inspector.look(renderer, {{0, 0}, {side_px, side_px}}, {100, 100});
    EXPECT_EQ(inspector.probe("frame", renderer.presented(), std::nullopt), "");
    inspector.select(std::nullopt);
    const std::string picture = inspector.probe("frame", renderer.presented(), glm::ivec2(0, side_px - 1));
    EXPECT_TRUE(picture.starts_with("frame 0,0:  0.50196")) << picture;
    EXPECT_EQ(inspector.probe("frame", renderer.presented(), std::nullopt), "");
}

TEST_F(InspectorTest, zoomKeepsWhatIsUnderTheCursor) {
    look({"first", "hdr"});
    const glm::dvec2 cursor(1.5, 6.5); // over the pixel that is no number
    inspector.zoom(5, cursor);
    inspector.look(renderer, {{0, 0}, {side_px, side_px}}, cursor);
    EXPECT_EQ(pixel(1, 1), glm::vec3(1, 0, 1));
    EXPECT_EQ(pixel(2, 2), glm::vec3(1, 0, 1)); // three times as large now
    inspector.drag({3, 0});
    inspector.look(renderer, {{0, 0}, {side_px, side_px}}, cursor);
    EXPECT_EQ(pixel(4, 1), glm::vec3(1, 0, 1)); // moved along to the right
    EXPECT_NE(pixel(1, 1), glm::vec3(1, 0, 1));
}

} // namespace
} // namespace gll::test
