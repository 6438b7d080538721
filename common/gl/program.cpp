// Reading, compiling and linking shader programs; setting uniforms.
#include "gl/program.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gll {
namespace {

constexpr int max_include_depth = 16;
constexpr std::uintmax_t max_shader_bytes = 1 << 20;
// Lines of file k are numbered from k times this: Mesa forgets the file number of a line marker in all but
// syntax errors, and with the file in the line number it is known all the same.
constexpr int line_stride = 100'000;

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    const auto last = text.find_last_not_of(" \t\r\n");
    return std::string(text.substr(first, last - first + 1));
}

// Puts one file and what it includes behind the other into the source.
class Preprocessor {
  public:
    Preprocessor(const std::vector<std::filesystem::path>& roots, const Defines& defines)
        : roots_(roots), defines_(defines) {}

    ShaderSource run(const std::string& file) {
        append(file, "", 0);
        return std::move(source_);
    }

  private:
    // The text of a file, and which file that is, however its name was spelt.
    std::pair<std::string, std::filesystem::path> read(const std::string& file,
                                                       const std::string& asked_from) {
        std::string tried;
        const std::string prefix = asked_from.empty() ? "" : asked_from + ": ";
        for (const std::filesystem::path& root : roots_) {
            const auto canonical_root = std::filesystem::weakly_canonical(root);
            const auto path = std::filesystem::weakly_canonical(root / file);
            const auto relative = path.lexically_relative(canonical_root);
            if (relative.empty() || *relative.begin() == "..")
                throw std::runtime_error(prefix + "\"" + file +
                                         "\" lies outside the shader folder; name files inside it");
            std::error_code error;
            if (std::filesystem::is_regular_file(path, error)) {
                if (std::filesystem::file_size(path) > max_shader_bytes)
                    throw std::runtime_error(path.string() + ": larger than 1 MiB, which no shader is");
                std::ifstream stream(path, std::ios::binary);
                std::ostringstream text;
                text << stream.rdbuf();
                if (stream.bad()) throw std::runtime_error(path.string() + ": cannot be read");
                return {text.str(), path};
            }
            tried += (tried.empty() ? "" : ", ") + path.string();
        }
        throw std::runtime_error(prefix + "shader file " + file + " not found; tried " + tried);
    }

    void append(const std::string& file, const std::string& asked_from, int depth) {
        const auto [text, path] = read(file, asked_from);
        if (!included_.insert(path).second) return;
        if (depth > max_include_depth)
            throw std::runtime_error(asked_from + ": includes go more than " +
                                     std::to_string(max_include_depth) + " deep");
        const auto number = static_cast<int>(source_.files.size());
        source_.files.push_back(file);
        if (depth > 0) markLine(number, 1);

        std::istringstream lines(text);
        std::string line;
        for (int line_number = 1; std::getline(lines, line); ++line_number) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            const std::string place = file + ":" + std::to_string(line_number);
            if (line_number >= line_stride)
                throw std::runtime_error(place + ": more lines than a shader has");
            const std::string statement = trimmed(line);
            if (statement.starts_with("#version")) {
                if (depth > 0) throw std::runtime_error(place + ": #version belongs into the stage alone");
                source_.text += line + "\n";
                for (const Define& define : defines_)
                    source_.text += "#define " + define.name + " " + define.value + "\n";
                markLine(number, line_number + 1);
            } else if (statement.starts_with("#include")) {
                append(includedFile(statement, place), place, depth + 1);
                markLine(number, line_number + 1);
            } else {
                source_.text += line + "\n";
            }
        }
    }

    void markLine(int file, int line) {
        source_.text +=
            "#line " + std::to_string(file * line_stride + line) + " " + std::to_string(file) + "\n";
    }

    static std::string includedFile(const std::string& statement, const std::string& place) {
        const auto open = statement.find('"');
        const auto close = statement.rfind('"');
        if (open == std::string::npos || close <= open + 1)
            throw std::runtime_error(place + ": write #include \"lib/name.glsl\"");
        return statement.substr(open + 1, close - open - 1);
    }

    const std::vector<std::filesystem::path>& roots_;
    const Defines& defines_;
    ShaderSource source_;
    std::set<std::filesystem::path> included_;
};

// The first complaint of a compiler's log, its "file number:line" or "file number(line)" turned into the
// file's name and its own line; see line_stride.
std::string firstComplaint(const std::string& log, const std::vector<std::string>& files) {
    std::istringstream lines(log);
    std::string line;
    while (std::getline(lines, line) && trimmed(line).empty()) {
    }
    line = trimmed(line);
    if (line.starts_with("ERROR: ")) line = line.substr(7);
    std::size_t file = 0;
    const char* end = line.data() + line.size();
    const auto [after_file, file_error] = std::from_chars(line.data(), end, file);
    if (file_error == std::errc() && after_file < end && (*after_file == ':' || *after_file == '(') &&
        file < files.size()) {
        int line_number = 0;
        const auto [after_line, line_error] = std::from_chars(after_file + 1, end, line_number);
        if (line_error == std::errc()) {
            if (const auto told = static_cast<std::size_t>(line_number / line_stride);
                line_number > 0 && told < files.size() && told > 0)
                file = told;
            line_number %= line_stride;
            std::string_view rest(after_line, static_cast<std::size_t>(end - after_line));
            while (!rest.empty() && std::string_view(" :()0123456789").find(rest.front()) != rest.npos)
                rest.remove_prefix(1); // a column, if any
            return files[file] + ":" + std::to_string(line_number) + ": " + std::string(rest);
        }
    }
    return (files.empty() ? std::string("shader") : files.front()) + ": " + line;
}

void deleteShader(GLuint id) { glDeleteShader(id); }
using Shader = Handle<deleteShader>;

Shader compile(GLenum stage, const ShaderSource& source) {
    Shader shader(glCreateShader(stage));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    GLint length = 0;
    glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
    throw std::runtime_error(firstComplaint(log.c_str(), source.files));
}

bool isSampler(GLenum type) {
    return type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_SHADOW || type == GL_INT_SAMPLER_2D ||
           type == GL_UNSIGNED_INT_SAMPLER_2D || type == GL_SAMPLER_CUBE;
}

// Sets a uniform from each type that UniformValue can hold; says which GLSL type that is.
struct Setter {
    GLint location;

    void operator()(float v) const { glUniform1f(location, v); }
    void operator()(int v) const { glUniform1i(location, v); }
    void operator()(glm::ivec2 v) const { glUniform2i(location, v.x, v.y); }
    void operator()(glm::vec2 v) const { glUniform2f(location, v.x, v.y); }
    void operator()(glm::vec3 v) const { glUniform3f(location, v.x, v.y, v.z); }
    void operator()(glm::vec4 v) const { glUniform4f(location, v.x, v.y, v.z, v.w); }
    void operator()(const glm::mat3& v) const {
        glUniformMatrix3fv(location, 1, GL_FALSE, glm::value_ptr(v));
    }
    void operator()(const glm::mat4& v) const {
        glUniformMatrix4fv(location, 1, GL_FALSE, glm::value_ptr(v));
    }
    void operator()(const std::vector<float>& v) const {
        glUniform1fv(location, static_cast<GLsizei>(v.size()), v.data());
    }
    void operator()(const std::vector<glm::vec3>& v) const {
        glUniform3fv(location, static_cast<GLsizei>(v.size()), glm::value_ptr(v.front()));
    }
    void operator()(const std::vector<glm::vec4>& v) const {
        glUniform4fv(location, static_cast<GLsizei>(v.size()), glm::value_ptr(v.front()));
    }
};

// In the order of UniformValue's alternatives.
constexpr GLenum value_types[] = {GL_FLOAT,      GL_INT,        GL_INT_VEC2,   GL_FLOAT_VEC2,
                                  GL_FLOAT_VEC3, GL_FLOAT_VEC4, GL_FLOAT_MAT3, GL_FLOAT_MAT4,
                                  GL_FLOAT,      GL_FLOAT_VEC3, GL_FLOAT_VEC4};
static_assert(std::size(value_types) == std::variant_size_v<UniformValue>);

std::size_t elementCount(const UniformValue& value) {
    return std::visit(
        [](const auto& v) -> std::size_t {
            if constexpr (requires { v.front(); })
                return v.size();
            else
                return 1;
        },
        value);
}

} // namespace

ShaderSource readShader(const std::vector<std::filesystem::path>& roots, const std::string& file,
                        const Defines& defines) {
    return Preprocessor(roots, defines).run(file);
}

Program::Program(std::string name, const ShaderSource& vertex, const ShaderSource& fragment)
    : name_(std::move(name)), handle_(glCreateProgram()) {
    const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex);
    const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
    glAttachShader(id(), vertex_shader.id());
    glAttachShader(id(), fragment_shader.id());
    glLinkProgram(id());
    glDetachShader(id(), vertex_shader.id());
    glDetachShader(id(), fragment_shader.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        char log[1024] = {};
        glGetProgramInfoLog(id(), sizeof log, nullptr, log);
        throw std::runtime_error(name_ + ": does not link: " + trimmed(log));
    }
    GLint count = 0;
    glGetProgramiv(id(), GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        char uniform_name[256] = {};
        Uniform uniform;
        glGetActiveUniform(id(), static_cast<GLuint>(i), sizeof uniform_name, nullptr, &uniform.count,
                           &uniform.type, uniform_name);
        uniform.location = glGetUniformLocation(id(), uniform_name);
        std::string key = uniform_name;
        if (key.ends_with("[0]")) key.resize(key.size() - 3);
        uniforms_.emplace(std::move(key), uniform);
    }
}

void Program::set(std::string_view uniform, const UniformValue& value) const {
    const auto found = uniforms_.find(uniform);
    if (found == uniforms_.end())
        throw std::invalid_argument(name_ + ": no uniform named " + std::string(uniform) +
                                    " (misspelt, or not used by this variant)");
    const Uniform& known = found->second;
    const GLenum type = value_types[value.index()];
    const bool matches = type == known.type || (type == GL_INT && isSampler(known.type)) ||
                         (type == GL_INT && known.type == GL_BOOL);
    const std::size_t elements = elementCount(value);
    if (!matches || elements < 1 || elements > static_cast<std::size_t>(known.count))
        throw std::invalid_argument(name_ + ": uniform " + std::string(uniform) +
                                    " has another type or fewer elements in the shader");
    std::visit(Setter{known.location}, value);
}

const Program& ShaderLibrary::program(const std::string& vertex_file, const std::string& fragment_file,
                                      const Defines& defines) {
    std::string key = vertex_file + " " + fragment_file;
    for (const Define& define : defines)
        key += " " + define.name + "=" + define.value;
    std::unique_ptr<Program>& program = programs_[key];
    if (!program)
        program = std::make_unique<Program>(fragment_file, readShader(roots_, vertex_file, defines),
                                            readShader(roots_, fragment_file, defines));
    return *program;
}

} // namespace gll
