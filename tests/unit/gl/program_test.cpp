// Uniforms of a program: every type arrives, and what does not fit is refused by name.
#include "gl_test.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

constexpr const char* uniforms_fragment = R"(#version 330 core
uniform float a_float;
uniform int an_int;
uniform bool a_bool;
uniform ivec2 an_ivec2;
uniform vec2 a_vec2;
uniform vec3 a_vec3;
uniform vec4 a_vec4;
uniform mat3 a_mat3;
uniform mat4 a_mat4;
uniform float floats[3];
uniform vec3 vec3s[2];
uniform vec4 vec4s[2];
uniform sampler2D a_sampler;
uniform float unused;
out vec4 color;
void main() {
    bool right = a_float == 1.5 && an_int == -2 && a_bool && an_ivec2 == ivec2(3, -4) && a_vec2 == vec2(5, 6) &&
        a_vec3 == vec3(7, 8, 9) && a_vec4 == vec4(10, 11, 12, 13) && a_mat3[1] == vec3(14, 15, 16) &&
        a_mat4[2] == vec4(17, 18, 19, 20) && floats[0] == 21.0 && floats[1] == 22.0 && floats[2] == 23.0 &&
        vec3s[1] == vec3(24, 25, 26) && vec4s[1] == vec4(27, 28, 29, 30) && vec4s[0] == vec4(0) &&
        vec3s[0] == vec3(0) && texture(a_sampler, vec2(0.5)).r == 1.0;
    color = vec4(right ? 1.0 : 0.0);
}
)";

class ProgramTest : public GlTest {
  protected:
    std::string errorOf(std::string_view name, const UniformValue& value) {
        glUseProgram(program.id());
        const std::string message = messageOf<std::invalid_argument>([&] { program.set(name, value); });
        glUseProgram(0);
        return message;
    }
    Program program = makeProgram(full_screen_vertex, uniforms_fragment);
};

TEST_F(ProgramTest, everyTypeOfUniformArrives) {
    glm::mat3 mat3(0);
    mat3[1] = {14, 15, 16};
    glm::mat4 mat4(0);
    mat4[2] = {17, 18, 19, 20};
    constexpr std::uint8_t white[] = {255};
    const Texture texture({.format = Format::r8}, white);
    const Framebuffer target({{"out", Format::r8}}, {1, 1});
    draw(target, {.program = program,
                  .inputs = {{"a_sampler", texture}},
                  .uniforms = {{"a_float", 1.5F},
                               {"an_int", -2},
                               {"a_bool", 1},
                               {"an_ivec2", glm::ivec2(3, -4)},
                               {"a_vec2", glm::vec2(5, 6)},
                               {"a_vec3", glm::vec3(7, 8, 9)},
                               {"a_vec4", glm::vec4(10, 11, 12, 13)},
                               {"a_mat3", mat3},
                               {"a_mat4", mat4},
                               {"floats", std::vector<float>{21, 22, 23}},
                               {"vec3s", std::vector<glm::vec3>{glm::vec3(0), {24, 25, 26}}},
                               {"vec4s", std::vector<glm::vec4>{glm::vec4(0), {27, 28, 29, 30}}}}});
    EXPECT_EQ(pixelOf(target.color(), 0, 0).r, 1.0F);
}

TEST_F(ProgramTest, uniformsAreListedWithoutWhatTheCompilerRemovedAndArraysByTheirName) {
    EXPECT_FALSE(program.uniforms().contains("unused"));
    ASSERT_TRUE(program.uniforms().contains("floats"));
    EXPECT_EQ(program.uniforms().at("floats").count, 3);
    EXPECT_EQ(program.uniforms().size(), 13U);
}

TEST_F(ProgramTest, anUnknownUniformIsNamedInTheError) {
    EXPECT_EQ(errorOf("a_flaot", 1.0F),
              "test program: no uniform named a_flaot (misspelt, or not used by this variant)");
    EXPECT_CONTAINS(errorOf("unused", 1.0F), "no uniform named unused");
    EXPECT_CONTAINS(errorOf("floats[0]", 1.0F), "no uniform named floats[0]");
}

TEST_F(ProgramTest, aValueOfAnotherTypeIsAnError) {
    const std::string wrong = " has another type or fewer elements in the shader";
    EXPECT_EQ(errorOf("a_float", 1), "test program: uniform a_float" + wrong);
    EXPECT_EQ(errorOf("an_int", 1.0F), "test program: uniform an_int" + wrong);
    EXPECT_EQ(errorOf("a_vec3", glm::vec4(1)), "test program: uniform a_vec3" + wrong);
    EXPECT_EQ(errorOf("a_mat4", glm::mat3(1)), "test program: uniform a_mat4" + wrong);
    EXPECT_EQ(errorOf("a_sampler", 1.0F), "test program: uniform a_sampler" + wrong);
    EXPECT_EQ(errorOf("vec3s", std::vector<glm::vec4>(2)), "test program: uniform vec3s" + wrong);
    EXPECT_EQ(errorOf("a_vec2", glm::ivec2(1)), "test program: uniform a_vec2" + wrong);
}

TEST_F(ProgramTest, anArrayTakesItsLengthOrLessAndNeverMoreOrNothing) {
    EXPECT_EQ(errorOf("floats", std::vector<float>(3)), "");
    EXPECT_EQ(errorOf("floats", std::vector<float>(1)), "");
    EXPECT_NE(errorOf("floats", std::vector<float>(4)), "");
    EXPECT_NE(errorOf("floats", std::vector<float>()), "");
    EXPECT_NE(errorOf("a_vec3", std::vector<glm::vec3>(2)), "");
}

} // namespace
} // namespace gll::test
