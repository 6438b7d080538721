// An OpenGL 3.3 core context to render in, whoever provides it. Everything is drawn into the project's own
// framebuffers, so that all of them show the same pixels.
#pragma once

#include "gl/gl.hpp"

#include <memory>
#include <optional>

namespace gll {

class Context {
  public:
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    virtual ~Context() = default;

    virtual const char* kind() const = 0; // "window", "osmesa" or "egl"
    const GlInfo& info() const { return info_; }
    DebugLog& debugLog() { return *debug_log_; }

  protected:
    // To be called once, when the new context is current.
    void load(GLADloadfunc get_function) {
        info_ = loadGl(get_function);
        debug_log_.emplace();
    }

  private:
    GlInfo info_;
    std::optional<DebugLog> debug_log_;
};

// Off-screen contexts, current for the calling thread until destroyed. Throw std::runtime_error saying what
// is missing and which package has it.
//
// OSMesa: Mesa's software rasteriser, opened when first used; the library need not be there otherwise.
std::unique_ptr<Context> makeOsmesaContext();
// EGL without a surface: on a GPU where there is one (LIBGL_ALWAYS_SOFTWARE=1 forbids that), else in
// software.
std::unique_ptr<Context> makeEglContext();

// headless: OSMesa, or EGL where that is not installed.
enum class ContextKind { window, headless, osmesa, egl };

// The context of any kind but a window. Throws as above.
std::unique_ptr<Context> makeHeadlessContext(ContextKind kind = ContextKind::headless);

} // namespace gll
