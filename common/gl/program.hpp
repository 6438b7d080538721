// Shader programs from files: includes, variants by definitions, errors that name the file and line, and
// uniforms that are checked by name and type.
#pragma once

#include "gl/handle.hpp"

#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gll {

using UniformValue =
    std::variant<float, int, glm::ivec2, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4,
                 std::vector<float>, std::vector<glm::vec3>, std::vector<glm::vec4>>;

// One "#define name value" put after the #version line of every stage.
struct Define {
    std::string name;
    std::string value;
};
using Defines = std::vector<Define>;

inline Defines operator+(Defines left, const Defines& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

// A shader stage after its includes were put in. Line markers count files by their place in this list, and
// lines from 100,000 times that.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files; // names relative to the shader root
};

// Reads a stage and puts in what it includes: #include "lib/x.glsl" is looked up under the same roots, a file
// is put in once, at most 16 deep, and never from outside its root. Throws std::runtime_error "file:line:
// what", and for a file that is not there every path tried.
ShaderSource readShader(const std::vector<std::filesystem::path>& roots, const std::string& file,
                        const Defines& defines = {});

// A linked vertex + fragment program.
class Program {
  public:
    // Throws std::runtime_error with the compiler's first complaint as "file:line: what".
    Program(std::string name, const ShaderSource& vertex, const ShaderSource& fragment);

    const std::string& name() const { return name_; }
    GLuint id() const { return handle_.id(); }

    struct Uniform {
        GLint location = -1;
        GLenum type = 0;
        GLint count = 1; // elements, where it is an array
    };
    // Every active uniform, samplers included, by name (an array by its name without [0]).
    const std::map<std::string, Uniform, std::less<>>& uniforms() const { return uniforms_; }

    // Sets a uniform of the program, which must be in use. Throws std::invalid_argument where the program has
    // no such uniform, or one of another type.
    void set(std::string_view uniform, const UniformValue& value) const;

  private:
    static void destroy(GLuint id) { glDeleteProgram(id); }

    std::string name_;
    Handle<destroy> handle_;
    std::map<std::string, Uniform, std::less<>> uniforms_;
};

// The programs of one rung, compiled when first asked for and kept: a setting that selects a variant costs a
// compilation once.
class ShaderLibrary {
  public:
    explicit ShaderLibrary(std::vector<std::filesystem::path> roots) : roots_(std::move(roots)) {}

    // The program of a vertex and a fragment file (paths relative to a root, such as "lib/fullscreen.vert").
    const Program& program(const std::string& vertex_file, const std::string& fragment_file,
                           const Defines& defines = {});

    // As above, with the vertex stage of every full-screen pass.
    const Program& fullScreen(const std::string& fragment_file, const Defines& defines = {}) {
        return program("lib/fullscreen.vert", fragment_file, defines);
    }

  private:
    std::vector<std::filesystem::path> roots_;
    std::map<std::string, std::unique_ptr<Program>> programs_;
};

} // namespace gll
