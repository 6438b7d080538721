// The order of lights that blending adds up: half floats forget what is less than half of their last place.
#include "unit/gl/gl_test.hpp"

#include <cmath>
#include <cstdio>

namespace gll::test {
namespace {

class BlendOrder : public GlTest {
  protected:
    // 256 faint lights and one of 1 into one pixel, by blending.
    double added(double faint, bool faint_first, Format format) {
        const Framebuffer target({{"sum", format}}, {1, 1});
        const auto add = [&](double light, int times) {
            draw(target, {.program = program,
                          .uniforms = {{"flat_color", glm::vec4(static_cast<float>(light))}},
                          .instances = times,
                          .blend = Blend::add});
        };
        draw(target, {.program = program, .uniforms = {{"flat_color", glm::vec4(0)}}});
        if (faint_first) add(faint, 256);
        add(1, 1);
        if (!faint_first) add(faint, 256);
        return pixelOf(target.color(), 0, 0).r;
    }
    // What is lost with the bright light first.
    double lost(double faint, Format format) {
        const double last = added(faint, true, format);
        EXPECT_NEAR(last, 1 + 256 * faint, 1.0 / 1024)
            << "faint lights first are exact but for the last store";
        const double difference = last - added(faint, false, format);
        std::printf("256 lights of 2^%.0f and one of 1: with the bright one first %.4g less, of %.4g\n",
                    std::log2(faint), difference, 256 * faint);
        return difference;
    }

    Program program = makeProgram(full_screen_vertex, flat_fragment);
};

TEST_F(BlendOrder, changesNothingWhereEveryLightIsAWholeStepOfTheSum) {
    EXPECT_EQ(lost(std::exp2(-9), Format::rgba16f), 0); // between 1 and 2 a half float has steps of 2^-10
    EXPECT_EQ(lost(std::exp2(-10), Format::rgba16f), 0);
}

TEST_F(BlendOrder, losesEveryLightBelowHalfAStepThatComesAfterTheBrightOne) {
    EXPECT_EQ(lost(std::exp2(-12), Format::rgba16f), 256 * std::exp2(-12))
        << "known to be bad, and now is not: say so on the page";
    EXPECT_EQ(lost(std::exp2(-12), Format::rgba32f), 0) << "32 bits have steps of 2^-23";
}

} // namespace
} // namespace gll::test
