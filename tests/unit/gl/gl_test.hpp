// What tests of OpenGL objects share: a context of their own, programs from text, pixels to look at.
#pragma once

#include "gl/pass.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace gll::test {

inline constexpr const char* full_screen_vertex = R"(#version 330 core
out vec2 uv;
void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* flat_fragment = R"(#version 330 core
uniform vec4 flat_color;
out vec4 color;
void main() { color = flat_color; }
)";

inline Program makeProgram(const std::string& vertex, const std::string& fragment) {
    return Program("test program", ShaderSource{vertex, {{"test.vert"}}},
                   ShaderSource{fragment, {{"test.frag"}}});
}

// A pixel of the texture, counted from the bottom left as OpenGL does; channels it lacks are 0. 8-bit values
// come as value / 255.
inline glm::vec4 pixelOf(const Texture& texture, int x, int y) {
    const Image image = readTexture(texture);
    const int row = image.height - 1 - y;
    const auto first = static_cast<std::size_t>((row * image.width + x) * image.channels);
    glm::vec4 value(0);
    std::visit(
        [&]<class T>(const std::vector<T>& pixels) {
            for (int c = 0; c < image.channels; ++c)
                value[c] = static_cast<float>(pixels.at(first + static_cast<std::size_t>(c))) /
                           (sizeof(T) == 1 ? 255.0F : 1.0F);
        },
        image.pixels);
    return value;
}

// A test in an OSMesa context of its own; an OpenGL error that the test itself did not expect fails it.
class GlTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("left behind by the test")); }

    void draw(const Framebuffer& target, const Pass& pass) { drawPass("test", target, pass, triangle); }

    std::unique_ptr<Context> context = makeHeadlessContext();
    Mesh triangle = Mesh::fullScreenTriangle();
};

} // namespace gll::test
