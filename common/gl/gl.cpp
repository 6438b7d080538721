// Loading OpenGL 3.3 through glad, and the debug log.
#include "gl/gl.hpp"

#include <stdexcept>

namespace gll {
namespace {

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

const char* errorName(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an unknown OpenGL error";
    }
}

void GLAD_API_PTR onMessage(GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                            const void* user) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return; // what does not compile is a ShaderError already
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
    auto* errors = static_cast<std::vector<std::string>*>(const_cast<void*>(user));
    if (errors->size() < 16)
        errors->emplace_back(message); // the first few tell; a storm must not fill memory
}

} // namespace

GlInfo loadGl(GLADloadfunc get_function) {
    const int version = gladLoadGL(get_function);
    if (version == 0) throw std::runtime_error("OpenGL: the functions could not be loaded");
    GlInfo info{.renderer = glString(GL_RENDERER), .version = glString(GL_VERSION)};
    if (version < GLAD_MAKE_VERSION(3, 3))
        throw std::runtime_error("OpenGL: 3.3 core is needed, and this context offers " + info.version);
    for (const char* name : {"llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer"})
        if (info.renderer.find(name) != std::string::npos) info.is_software = true;
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); // what is read at the edge of a side is a mean across it
    return info;
}

DebugLog::DebugLog() {
    if (!GLAD_GL_KHR_debug) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // so that the message belongs to the pass that caused it
    glDebugMessageCallback(onMessage, &errors_);
}

void DebugLog::check(std::string_view where) {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        if (errors_.empty()) errors_.emplace_back(errorName(error));
    if (errors_.empty()) return;
    std::string message = std::string(where) + ": " + errors_.front();
    errors_.clear();
    while (!message.empty() && (message.back() == '\n' || message.back() == ' '))
        message.pop_back();
    throw std::runtime_error(message);
}

} // namespace gll
