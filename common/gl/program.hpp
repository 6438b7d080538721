// Shader programs: variants by definitions, uniforms that are checked by name and type, and building anew,
// in place, what was made from files that have changed.
#pragma once

#include "gl/handle.hpp"
#include "gl/shader_source.hpp"

#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gll {

using UniformValue =
    std::variant<float, int, glm::ivec2, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4,
                 std::vector<float>, std::vector<glm::vec3>, std::vector<glm::vec4>>;

// A linked vertex + fragment program.
class Program {
  public:
    // Throws ShaderError with the compiler's first complaint.
    Program(std::string name, const ShaderSource& vertex, const ShaderSource& fragment);

    // Makes it from other sources, or throws as above and stays what it was. Uniforms, and ends of arrays,
    // that these sources do not use and the former ones did may still be set, to no effect: who edits a
    // shader while it runs need not touch what draws with it.
    void rebuild(const ShaderSource& vertex, const ShaderSource& fragment);

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
    std::map<std::string, Uniform, std::less<>> former_uniforms_; // of what it was before it was rebuilt
};

// The programs of one rung, compiled when first asked for and kept: a setting that selects a variant costs a
// compilation once.
class ShaderLibrary {
  public:
    explicit ShaderLibrary(std::vector<std::filesystem::path> roots) : roots_(std::move(roots)) {}

    // The program of a vertex and a fragment file (paths relative to a root, such as "lib/fullscreen.vert").
    // Valid as long as the library, also where it is rebuilt. Throws ShaderError where there is no such
    // program yet.
    const Program& program(const std::string& vertex_file, const std::string& fragment_file,
                           const Defines& defines = {});

    // As above, with the vertex stage of every full-screen pass.
    const Program& fullScreen(const std::string& fragment_file, const Defines& defines = {}) {
        return program("lib/fullscreen.vert", fragment_file, defines);
    }

    // Has the programs that were made from any of these files (canonical paths) rebuilt when they are next
    // asked for. One that cannot be goes on as it last was, and why is among errors(); not where a file that
    // it was made from is gone, as while an editor saves, which is waited for. Says whether there are such
    // programs.
    bool changed(const std::set<std::filesystem::path>& files);

    // Why programs are not as their files have them, each error once.
    std::vector<ShaderError> errors() const;

    // How often changed() found programs. What keeps something that shaders drew makes it anew where this
    // differs.
    int generation() const { return generation_; }

    const std::vector<std::filesystem::path>& roots() const { return roots_; }

  private:
    struct Entry {
        std::optional<Program> program;           // as it was last made; none: it never could be
        std::set<std::filesystem::path> made_of;  // files of that
        std::set<std::filesystem::path> asked_of; // files read, or sought, when it was last tried
        bool is_stale = true;
        std::optional<ShaderError> error;
    };
    void build(Entry& entry, const std::string& vertex_file, const std::string& fragment_file,
               const Defines& defines);

    std::vector<std::filesystem::path> roots_;
    std::map<std::string, Entry> programs_;
    int generation_ = 0;
};

} // namespace gll
