// Compiling and linking shader programs, and again where their files change; setting uniforms.
#include "gl/program.hpp"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace gll {
namespace {

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
    throw source.firstComplaint(log.c_str());
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
        char buffer[1024] = {};
        glGetProgramInfoLog(id(), sizeof buffer, nullptr, buffer);
        std::string log = buffer;
        log.resize(log.find_last_not_of(" \t\r\n") + 1);
        throw ShaderError(name_, 0, "does not link: " + log);
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

void Program::rebuild(const ShaderSource& vertex, const ShaderSource& fragment) {
    Program rebuilt(name_, vertex, fragment);
    for (const auto* known : {&uniforms_, &former_uniforms_})
        for (const auto& [name, uniform] : *known) {
            Uniform& kept = rebuilt.former_uniforms_.emplace(name, uniform).first->second;
            kept.count = std::max(kept.count, uniform.count);
        }
    *this = std::move(rebuilt);
}

void Program::set(std::string_view uniform, const UniformValue& value) const {
    const auto found = uniforms_.find(uniform);
    const auto former = former_uniforms_.find(uniform);
    if (found == uniforms_.end() && former != former_uniforms_.end()) return;
    if (found == uniforms_.end())
        throw std::invalid_argument(name_ + ": no uniform named " + std::string(uniform) +
                                    " (misspelt, or not used by this variant)");
    const Uniform& known = found->second;
    const GLenum type = value_types[value.index()];
    const bool matches = type == known.type || (type == GL_INT && isSampler(known.type)) ||
                         (type == GL_INT && known.type == GL_BOOL);
    const std::size_t elements = elementCount(value);
    const GLint most = std::max(known.count, former == former_uniforms_.end() ? 0 : former->second.count);
    if (!matches || elements < 1 || elements > static_cast<std::size_t>(most))
        throw std::invalid_argument(name_ + ": uniform " + std::string(uniform) +
                                    " has another type or fewer elements in the shader");
    std::visit(Setter{known.location}, value); // OpenGL ignores elements beyond the end of an array
}

const Program& ShaderLibrary::program(const std::string& vertex_file, const std::string& fragment_file,
                                      const Defines& defines) {
    std::string key = vertex_file + " " + fragment_file;
    for (const Define& define : defines)
        key += " " + define.name + "=" + define.value;
    Entry& entry = programs_[key];
    if (!entry.program || entry.is_stale) build(entry, vertex_file, fragment_file, defines);
    return *entry.program;
}

void ShaderLibrary::build(Entry& entry, const std::string& vertex_file, const std::string& fragment_file,
                          const Defines& defines) {
    entry.is_stale = false;
    entry.asked_of.clear();
    try {
        const ShaderSource vertex = readShader(roots_, vertex_file, defines, &entry.asked_of);
        const ShaderSource fragment = readShader(roots_, fragment_file, defines, &entry.asked_of);
        entry.program ? entry.program->rebuild(vertex, fragment)
                      : void(entry.program.emplace(fragment_file, vertex, fragment));
        entry.made_of.clear();
        for (const ShaderSource* source : {&vertex, &fragment})
            for (const ShaderFile& file : source->files)
                entry.made_of.insert(file.path);
    } catch (const ShaderError& error) {
        if (!entry.program) throw;
        const bool was_there =
            std::any_of(error.tried.begin(), error.tried.end(),
                        [&](const std::filesystem::path& path) { return entry.made_of.contains(path); });
        if (!was_there) entry.error = error;
    }
}

bool ShaderLibrary::changed(const std::set<std::filesystem::path>& files) {
    bool found = false;
    for (auto& [key, entry] : programs_) {
        if (std::none_of(files.begin(), files.end(),
                         [&](const std::filesystem::path& file) { return entry.asked_of.contains(file); }))
            continue;
        entry.is_stale = found = true;
        entry.error.reset();
    }
    if (found) ++generation_;
    return found;
}

std::vector<ShaderError> ShaderLibrary::errors() const {
    std::vector<ShaderError> errors;
    for (const auto& [key, entry] : programs_)
        if (entry.error && std::none_of(errors.begin(), errors.end(), [&](const ShaderError& error) {
                return error.what() == std::string_view(entry.error->what());
            }))
            errors.push_back(*entry.error);
    return errors;
}

} // namespace gll
