// Framebuffers: completeness, lookup, resizing and its failures.
#include "gl_test.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

using FramebufferTest = GlTest;

TEST_F(FramebufferTest, everyRenderableFormatMakesACompleteTarget) {
    for (const Format format :
         {Format::r8, Format::rg8, Format::rgba8, Format::srgb8_alpha8, Format::rgb10_a2, Format::r16,
          Format::rg16, Format::r11f_g11f_b10f, Format::r16f, Format::rg16f, Format::rgba16f, Format::r32f,
          Format::rg32f, Format::rgba32f, Format::depth16, Format::depth24, Format::depth32f}) {
        EXPECT_NO_THROW(Framebuffer({{"only", format}}, {3, 5})) << formatInfo(format).name;
        EXPECT_EQ(formatNamed(formatInfo(format).name), format);
    }
    EXPECT_EQ(messageOf<std::invalid_argument>([] { formatNamed("rgba17"); }), "there is no format rgba17");
}

TEST_F(FramebufferTest, whatIsNotCompleteSaysWhichAttachmentsItHas) {
    const std::string message = messageOf<std::runtime_error>([] { Framebuffer({}, {3, 5}); });
    EXPECT_EQ(message, "framebuffer (3x5): no attachment");
}

TEST_F(FramebufferTest, moreColoursThanTheContextHasAreAnError) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &most);
    std::vector<Attachment> attachments;
    for (int i = 0; i < most; ++i)
        attachments.push_back({std::to_string(i), Format::r8});
    EXPECT_NO_THROW(Framebuffer(attachments, {1, 1}));
    attachments.push_back({"too_many", Format::r8});
    EXPECT_CONTAINS(messageOf<std::runtime_error>([&] { Framebuffer(attachments, {1, 1}); }), "too_many");
}

TEST_F(FramebufferTest, aSecondDepthAttachmentIsAnError) {
    EXPECT_CONTAINS(messageOf<std::runtime_error>([] {
                        Framebuffer({{"a", Format::depth24}, {"b", Format::depth24}}, {1, 1});
                    }),
                    "depth");
}

TEST_F(FramebufferTest, attachmentsAreFoundByNameAndByLocation) {
    const Framebuffer target({{"depth", Format::depth24}, {"a", Format::rgba16f}, {"b", Format::r8}}, {2, 2});
    EXPECT_EQ(target.colorCount(), 2);
    EXPECT_TRUE(target.hasDepth());
    EXPECT_EQ(&target["a"], &target.color(0));
    EXPECT_EQ(&target["b"], &target.color(1));
    EXPECT_EQ(&target["depth"], &target.depth());
    EXPECT_EQ(target["b"].format(), Format::r8);
    EXPECT_EQ(target.attachments().back().name, "depth");
    EXPECT_EQ(&target.texture(2), &target.depth());
}

TEST_F(FramebufferTest, anAttachmentThatIsNotThereIsAnErrorWithItsName) {
    const Framebuffer target({{"a"}}, {2, 2});
    EXPECT_FALSE(target.hasDepth());
    EXPECT_EQ(messageOf<std::out_of_range>([&] { target["b"]; }), "framebuffer: no attachment named b");
    EXPECT_EQ(messageOf<std::out_of_range>([&] { target.color(1); }), "framebuffer: no colour attachment 1");
    EXPECT_THROW(target.color(-1), std::out_of_range);
    EXPECT_THROW(target.depth(), std::out_of_range);
}

TEST_F(FramebufferTest, resizeMakesEveryAttachmentAnewAndTheSameSizeKeepsThem) {
    Framebuffer target({{"a"}, {"depth", Format::depth24}}, {2, 2});
    const GLuint before = target.color().id();
    target.resize({2, 2});
    EXPECT_EQ(target.color().id(), before);
    target.resize({5, 3});
    EXPECT_EQ(target.size(), glm::ivec2(5, 3));
    EXPECT_EQ(target.color().size(), glm::ivec2(5, 3));
    EXPECT_EQ(target.depth().size(), glm::ivec2(5, 3));
    const Program program = makeProgram(full_screen_vertex, flat_fragment);
    draw(target, {.program = program, .uniforms = {{"flat_color", glm::vec4(1)}}});
    EXPECT_EQ(pixelOf(target.color(), 4, 2), glm::vec4(1));
}

TEST_F(FramebufferTest, remakeMakesAnewOnlyWhatDiffers) {
    Framebuffer target;
    EXPECT_EQ(target.colorCount(), 0);
    EXPECT_FALSE(target.hasDepth());
    const std::vector<Attachment> depth_first = {{"depth", Format::depth24}, {"a", Format::rgba8}};
    target.remake(depth_first, {2, 2});
    const GLuint before = target.color().id();
    target.remake(depth_first, {2, 2});
    EXPECT_EQ(target.color().id(), before);
    const auto isMadeAnew = [&](const Attachment& a, glm::ivec2 size) {
        target.remake(depth_first, {2, 2});
        const GLuint old = target.color().id();
        target.remake({{"depth", Format::depth24}, a}, size);
        EXPECT_EQ(target.attachments()[0], a);
        EXPECT_EQ(target.size(), size);
        return target.color().id() != old;
    };
    EXPECT_FALSE(isMadeAnew({"a", Format::rgba8}, {2, 2}));
    EXPECT_TRUE(isMadeAnew({"a", Format::rgba8}, {2, 3}));
    EXPECT_TRUE(isMadeAnew({"b", Format::rgba8}, {2, 2}));
    EXPECT_TRUE(isMadeAnew({"a", Format::rgb10_a2}, {2, 2}));
    EXPECT_TRUE(isMadeAnew({"a", Format::rgba8, Filter::nearest}, {2, 2}));
    EXPECT_TRUE(isMadeAnew({.name = "a", .format = Format::rgba8, .wrap = Wrap::repeat}, {2, 2}));
    EXPECT_TRUE(isMadeAnew({.name = "a", .format = Format::rgba8, .mipmapped = true}, {2, 2}));
    EXPECT_EQ(target.color().description().levels, 2);
}

TEST_F(FramebufferTest, aResizeThatFailsLeavesTheFramebufferAsItWas) {
    Framebuffer target({{"a"}, {"depth", Format::depth24}}, {2, 2});
    for (int i = 0; i < 2; ++i) { // the second must not be taken for done
        EXPECT_THROW(target.resize({0, 7}), std::runtime_error);
        EXPECT_THROW(target.resize({1 << 20, 7}), std::runtime_error);
    }
    EXPECT_EQ(target.size(), glm::ivec2(2, 2));
    GLint bound = -1;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(bound, 0);
    const Program program = makeProgram(full_screen_vertex, flat_fragment);
    draw(target, {.program = program, .uniforms = {{"flat_color", glm::vec4(1)}}});
    EXPECT_EQ(pixelOf(target.color(), 1, 1), glm::vec4(1));
}

} // namespace
} // namespace gll::test
