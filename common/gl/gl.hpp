// What stands before any other OpenGL call: loading the functions, asking who renders, hearing of errors.
#pragma once

#include <glad/gl.h>
#include <string>
#include <string_view>
#include <vector>

namespace gll {

// The context's own answers. is_software: a rasteriser on the CPU, whose timer queries mean nothing.
struct GlInfo {
    std::string renderer;
    std::string version;
    bool is_software = false;
};

// Loads OpenGL 3.3 core for the current context. Throws std::runtime_error where the context offers less.
GlInfo loadGl(GLADloadfunc get_function);

// Collects what KHR_debug reports as an error for the context that is current at construction, and falls back
// to glGetError where the extension is missing. It must outlive the context's last call: keep the two
// together.
class DebugLog {
  public:
    DebugLog();
    DebugLog(const DebugLog&) = delete;
    DebugLog& operator=(const DebugLog&) = delete;

    // Throws std::runtime_error "where: message" if an error was reported since the last call, and forgets
    // it.
    void check(std::string_view where);

  private:
    std::vector<std::string> errors_;
};

} // namespace gll
