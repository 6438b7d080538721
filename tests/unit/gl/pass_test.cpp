// Passes: what one statement draws, and that no pass changes what another one draws.
#include "gl_test.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

constexpr const char* mesh_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
)";

Mesh triangles(const std::vector<glm::vec3>& corners, std::span<const std::uint32_t> indices = {}) {
    return Mesh({.vertices = std::as_bytes(std::span(corners)),
                 .vertex_stride_bytes = sizeof(glm::vec3),
                 .attributes = {{0, 3, 0}},
                 .indices = indices});
}

// Covers the target at a depth; seen from its back where front is false.
Mesh coveringTriangle(float z, bool front = true) {
    if (front) return triangles({{-1, -1, z}, {3, -1, z}, {-1, 3, z}});
    return triangles({{-1, -1, z}, {-1, 3, z}, {3, -1, z}});
}

class PassTest : public GlTest {
  protected:
    Program flat = makeProgram(full_screen_vertex, flat_fragment);
    Program flat_mesh = makeProgram(mesh_vertex, flat_fragment);
    glm::vec4 red{1, 0, 0, 1};
    glm::vec4 green{0, 1, 0, 1};
    std::vector<UniformSetting> paint_red = {{"flat_color", red}};
    std::vector<UniformSetting> paint_green = {{"flat_color", green}};
};

TEST_F(PassTest, aUniformOrSamplerThatIsNotGivenIsAnError) {
    const Framebuffer target({{"out"}}, {2, 2});
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { draw(target, {.program = flat}); }),
              "test program: uniform flat_color was not set: give it a value where the pass is drawn");
    const Program sampling = makeProgram(full_screen_vertex, R"(#version 330 core
in vec2 uv;
uniform sampler2D source;
out vec4 color;
void main() { color = texture(source, uv); }
)");
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { draw(target, {.program = sampling}); }),
              "test program: uniform source was not set: give it a value where the pass is drawn");
    EXPECT_CONTAINS(
        messageOf<std::invalid_argument>([&] {
            draw(target, {.program = flat, .uniforms = {{"flat_color", red}, {"no_such_color", red}}});
        }),
        "no uniform named no_such_color");
}

TEST_F(PassTest, ofAPartAPassTakesWhatItsProgramUses) {
    const Framebuffer target({{"out"}}, {2, 2});
    draw(target,
         {.program = flat,
          .part = ShaderPart{.inputs = {{"source", target.color()}}, .uniforms = {{"flat_color", red}}} +
                  ShaderPart{.uniforms = {{"no_such_color", green}}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
}

TEST_F(PassTest, ofAPartsListAPassTakesAsManyElementsAsItsProgramUses) {
    const Framebuffer target({{"out"}}, {2, 2});
    const Program first_of_list = makeProgram(full_screen_vertex, R"(#version 330 core
uniform vec4 colors[3];
out vec4 color;
void main() { color = colors[0] + colors[1]; }
)");
    draw(target, {.program = first_of_list,
                  .part = {.uniforms = {{"colors", std::vector<glm::vec4>{red, glm::vec4(0), green}}}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
}

TEST_F(PassTest, aViewportIsDrawnToAndNoOtherPixel) {
    const Framebuffer target({{"out"}}, {4, 2});
    draw(
        target,
        {.program = flat, .uniforms = paint_red, .clear_color = green, .viewport = Viewport{{1, 0}, {2, 1}}});
    for (const int x : {0, 1, 2, 3})
        for (const int y : {0, 1})
            EXPECT_EQ(pixelOf(target.color(), x, y), y == 0 && (x == 1 || x == 2) ? red : green)
                << x << ' ' << y;
}

TEST_F(PassTest, aValueGivenInAnEarlierPassDoesNotCountAsGivenInThis) {
    const Framebuffer target({{"out"}}, {2, 2});
    draw(target, {.program = flat, .uniforms = paint_red});
    EXPECT_THROW(draw(target, {.program = flat}), std::invalid_argument);
}

TEST_F(PassTest, aPassThatFailedLeavesNothingBehind) {
    const Framebuffer target({{"out"}}, {2, 2});
    for (int i = 0; i < 200; ++i) // more than a stack of debug groups holds
        EXPECT_THROW(draw(target, {.program = flat}), std::invalid_argument);
    GLint value = -1;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &value);
    EXPECT_EQ(value, 0);
    glGetIntegerv(GL_CURRENT_PROGRAM, &value);
    EXPECT_EQ(value, 0);
    if (GLAD_GL_KHR_debug) {
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &value);
        EXPECT_EQ(value, 1);
    }
    draw(target, {.program = flat, .uniforms = paint_red});
    EXPECT_NO_THROW(context->debugLog().check("after failed passes"));
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
}

TEST_F(PassTest, aPassDrawsTheSameAfterOneThatSetsEveryState) {
    // The same second pass, in a target of its own, alone and after a pass that turns everything on; the two
    // differ where any of blending, culling, depth test, polygon offset, clears, sRGB or viewport leaks.
    const std::vector<Attachment> attachments = {{"out", Format::srgb8_alpha8}, {"depth", Format::depth24}};
    const Framebuffer noisy(attachments, {5, 3});
    const Mesh near_front = coveringTriangle(-0.5F);
    const Mesh back = coveringTriangle(0.0F, false); // culled if culling leaks
    const Pass plain{.program = flat_mesh,
                     .uniforms = {{"flat_color", glm::vec4(0.25F, 0.5F, 0.75F, 0.5F)}},
                     .mesh = &back};
    const Pass with_depth{.program = flat_mesh,
                          .uniforms = {{"flat_color", green}},
                          .mesh = &near_front,
                          .depth_test = DepthTest::less,
                          .clear_color = red,
                          .clear_depth = 1.0F};
    const Pass everything{.program = flat_mesh,
                          .uniforms = paint_red,
                          .mesh = &near_front,
                          .depth_test = DepthTest::less_equal,
                          .cull = Cull::back,
                          .blend = Blend::add,
                          .srgb_encode = true,
                          .polygon_offset = glm::vec2(4, 1000),
                          .clear_color = glm::vec4(1),
                          .clear_depth = 0.25F};
    for (const Pass* second : {&plain, &with_depth}) {
        const Framebuffer alone(attachments, {4, 4});
        const Framebuffer after(attachments, {4, 4});
        for (const Framebuffer* target : {&alone, &after}) {
            draw(*target, {.program = flat, .uniforms = paint_green, .clear_depth = 1.0F});
            if (target == &after) draw(noisy, everything);
            draw(*target, *second);
        }
        for (const char* name : {"out", "depth"})
            EXPECT_EQ(readTexture(alone[name]).pixels, readTexture(after[name]).pixels) << name;
    }
}

TEST_F(PassTest, blendAddAddsAndReplaceReplacesAlphaToo) {
    const Framebuffer target({{"out", Format::rgba32f}}, {1, 1});
    const glm::vec4 first(1, 2, 3, 0.5F);
    const glm::vec4 second(0.5F, 0.25F, 8, 0.25F);
    draw(target, {.program = flat, .uniforms = {{"flat_color", first}}});
    draw(target, {.program = flat, .uniforms = {{"flat_color", second}}, .blend = Blend::add});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), first + second);
    draw(target, {.program = flat, .uniforms = {{"flat_color", second}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), second);
}

TEST_F(PassTest, cullBackDrawsFrontsOnly) {
    const Framebuffer target({{"out"}}, {1, 1});
    const Mesh front = coveringTriangle(0);
    const Mesh back = coveringTriangle(0, false);
    Pass pass{.program = flat_mesh, .uniforms = paint_red, .cull = Cull::back, .clear_color = green};
    pass.mesh = &back;
    draw(target, pass);
    EXPECT_EQ(pixelOf(target.color(), 0, 0), green);
    pass.mesh = &front;
    draw(target, pass);
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
}

TEST_F(PassTest, lessEqualPassesWhereLessDoesNotAndOffDoesNotWriteDepth) {
    const Framebuffer target({{"out"}, {"depth", Format::depth32f}}, {1, 1});
    const Mesh middle = coveringTriangle(0); // depth 0.5
    const auto colorAfter = [&](DepthTest test) {
        draw(target, {.program = flat_mesh,
                      .uniforms = paint_red,
                      .mesh = &middle,
                      .depth_test = DepthTest::less,
                      .clear_color = green,
                      .clear_depth = 1.0F});
        EXPECT_EQ(pixelOf(target.depth(), 0, 0).r, 0.5F);
        draw(target, {.program = flat_mesh, .uniforms = paint_green, .mesh = &middle, .depth_test = test});
        return pixelOf(target.color(), 0, 0);
    };
    EXPECT_EQ(colorAfter(DepthTest::less), red);
    EXPECT_EQ(colorAfter(DepthTest::less_equal), green);
    EXPECT_EQ(colorAfter(DepthTest::off), green);
    const Mesh nearer = coveringTriangle(-0.5F);
    draw(target, {.program = flat_mesh, .uniforms = paint_red, .mesh = &nearer});
    EXPECT_EQ(pixelOf(target.depth(), 0, 0).r, 0.5F);
}

TEST_F(PassTest, polygonOffsetPushesDepthAway) {
    const Framebuffer target({{"out"}, {"depth", Format::depth24}}, {1, 1});
    const Mesh middle = coveringTriangle(0);
    Pass pass{.program = flat_mesh,
              .uniforms = paint_red,
              .mesh = &middle,
              .depth_test = DepthTest::less,
              .polygon_offset = glm::vec2(0, 4096),
              .clear_depth = 1.0F};
    draw(target, pass);
    // A unit is the smallest difference the implementation tells apart for sure: llvmpipe says 2^-23.
    EXPECT_GE(pixelOf(target.depth(), 0, 0).r, 0.5F + 4095 / 16777216.0F);
    EXPECT_LE(pixelOf(target.depth(), 0, 0).r, 0.5F + 4097 / 4194304.0F);
    pass.polygon_offset.reset();
    draw(target, pass);
    EXPECT_NEAR(pixelOf(target.depth(), 0, 0).r, 0.5F, 2e-7F);
}

TEST_F(PassTest, aPassOfAnotherSizeCoversItsTargetExactly) {
    const Framebuffer large({{"out"}}, {7, 5});
    const Framebuffer small({{"out"}}, {2, 3});
    draw(small, {.program = flat, .uniforms = paint_green});
    draw(large, {.program = flat, .uniforms = paint_red});
    draw(small, {.program = flat, .uniforms = paint_red});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x)
            EXPECT_EQ(pixelOf(large.color(), x, y), red);
    EXPECT_EQ(pixelOf(small.color(), 1, 2), red);
}

TEST_F(PassTest, clearFillsEveryColourAttachmentAndWithoutItContentsStay) {
    const Framebuffer target({{"a", Format::rgba16f}, {"b", Format::rg8}, {"c", Format::r32f}}, {3, 2});
    const Program nowhere =
        makeProgram(R"(#version 330 core
void main() { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); }
)",
                    "#version 330 core\nout vec4 color;\nvoid main() { color = vec4(1); }\n");
    draw(target, {.program = nowhere, .clear_color = glm::vec4(0.25F, 1, 3, 4)});
    draw(target, {.program = nowhere});
    EXPECT_EQ(pixelOf(target["a"], 2, 1), glm::vec4(0.25F, 1, 3, 4));
    EXPECT_NEAR(pixelOf(target["b"], 2, 1).r, 0.25F, 1 / 255.0F);
    EXPECT_EQ(pixelOf(target["b"], 2, 1).g, 1);
    EXPECT_EQ(pixelOf(target["c"], 2, 1).r, 0.25F);
}

TEST_F(PassTest, outputsGoToTheAttachmentsInTheirOrderWhereverDepthStandsAmongThem) {
    const Framebuffer target(
        {{"first", Format::rgba8}, {"depth", Format::depth16}, {"second", Format::rgba16f}}, {2, 2});
    const Program two = makeProgram(full_screen_vertex, R"(#version 330 core
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() {
    first = vec4(0.0, 1.0, 0.0, 1.0);
    second = vec4(5.0, 6.0, 7.0, 8.0);
}
)");
    draw(target, {.program = two});
    EXPECT_EQ(pixelOf(target["first"], 1, 1), green);
    EXPECT_EQ(pixelOf(target["second"], 1, 1), glm::vec4(5, 6, 7, 8));
}

TEST_F(PassTest, severalInputsReachTheirOwnSamplers) {
    constexpr std::uint8_t bytes[] = {255, 0};
    const Texture one({.format = Format::r8}, std::span(bytes).subspan(0, 1));
    const Texture zero({.format = Format::r8}, std::span(bytes).subspan(1, 1));
    const Program two = makeProgram(full_screen_vertex, R"(#version 330 core
uniform sampler2D a;
uniform sampler2D b;
out vec4 color;
void main() { color = vec4(texture(a, vec2(0.5)).r, texture(b, vec2(0.5)).r, 0.0, 1.0); }
)");
    const Framebuffer target({{"out"}}, {1, 1});
    draw(target, {.program = two, .inputs = {{"a", one}, {"b", zero}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
    draw(target, {.program = two, .inputs = {{"b", one}, {"a", zero}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), green);
}

// Draws of one pass, each into its own half of a target two pixels wide.
class DrawsTest : public PassTest {
  protected:
    Mesh left = triangles({{-1, -1, 0}, {0, -1, 0}, {-1, 3, 0}, {0, -1, 0}, {0, 3, 0}, {-1, 3, 0}});
    Mesh right = triangles({{0, -1, 0}, {1, -1, 0}, {0, 3, 0}, {1, -1, 0}, {1, 3, 0}, {0, 3, 0}});
    Framebuffer target{{{"out"}}, {2, 1}};
};

TEST_F(DrawsTest, everyDrawHasItsOwnUniformsOverThoseOfThePass) {
    draw(target,
         {.program = flat_mesh,
          .draws = {{.mesh = left, .uniforms = paint_red}, {.mesh = right, .uniforms = paint_green}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
    EXPECT_EQ(pixelOf(target.color(), 1, 0), green);
}

TEST_F(DrawsTest, aDrawSeesThePassesOwnValueWhateverTheDrawBeforeSet) {
    draw(target, {.program = flat_mesh,
                  .uniforms = paint_green,
                  .draws = {{.mesh = left, .uniforms = paint_red}, {.mesh = right}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
    EXPECT_EQ(pixelOf(target.color(), 1, 0), green);
}

TEST_F(DrawsTest, aUniformThatOnlyTheDrawBeforeHadIsMissing) {
    EXPECT_EQ(messageOf<std::invalid_argument>([&] {
                  draw(target, {.program = flat_mesh,
                                .draws = {{.mesh = left, .uniforms = paint_red}, {.mesh = right}}});
              }),
              "test program: uniform flat_color was not set: give it a value where the pass is drawn");
}

TEST_F(DrawsTest, aDrawMayBeAPartOfItsMesh) {
    const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    std::vector<glm::vec3> corners = {{-1, -1, 0}, {0, -1, 0}, {-1, 3, 0}, {0, -1, 0}, {0, 3, 0}, {-1, 3, 0}};
    for (const glm::vec3 corner : {glm::vec3(0, -1, 0), glm::vec3(1, -1, 0), glm::vec3(0, 3, 0),
                                   glm::vec3(1, -1, 0), glm::vec3(1, 3, 0), glm::vec3(0, 3, 0)})
        corners.push_back(corner);
    const Mesh both = triangles(corners, indices);
    draw(target, {.program = flat_mesh,
                  .draws = {{.mesh = both, .uniforms = paint_red, .first_index = 0, .index_count = 6},
                            {.mesh = both, .uniforms = paint_green, .first_index = 6}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0), red);
    EXPECT_EQ(pixelOf(target.color(), 1, 0), green);
}

TEST_F(PassTest, bytesPerPixelCountsWhatTheFormatsDeclare) {
    const Framebuffer target({{"out", Format::rgba16f}, {"depth", Format::depth24}}, {4, 4});
    const Framebuffer half({{"half", Format::rgba16f}}, {2, 2});
    EXPECT_DOUBLE_EQ(bytesPerPixel(target, {.program = flat}), 8);
    EXPECT_DOUBLE_EQ(bytesPerPixel(target, {.program = flat, .blend = Blend::add}), 16);
    EXPECT_DOUBLE_EQ(bytesPerPixel(target, {.program = flat, .depth_test = DepthTest::less}), 16);
    EXPECT_DOUBLE_EQ(
        bytesPerPixel(target, {.program = flat, .inputs = {{"a", half.color()}, {"again", half.color()}}}),
        8 + 2);
}

} // namespace
} // namespace gll::test
