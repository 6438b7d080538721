// EGL without any surface behind the Context interface: a GPU's device where there is one, else Mesa's
// software.
#include "rung/context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gll {
namespace {

bool has(const char* extensions, std::string_view name) {
    std::string_view rest = extensions == nullptr ? "" : extensions;
    while (!rest.empty()) {
        const auto end = rest.find(' ');
        if (rest.substr(0, end) == name) return true;
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    return false;
}

template <class Function>
Function eglFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool softwareOnly() {
    const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value != nullptr && std::string_view(value) != "0" && std::string_view(value) != "";
}

// The displays worth trying, best first: hardware devices, then the surfaceless platform of Mesa, then any
// device.
std::vector<EGLDisplay> candidates() {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto get_display = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr)
        throw std::runtime_error("EGL: no platform displays here; a newer EGL is needed");
    std::vector<EGLDisplay> hardware;
    std::vector<EGLDisplay> software;
    if (has(client, "EGL_EXT_platform_device") &&
        (has(client, "EGL_EXT_device_enumeration") || has(client, "EGL_EXT_device_base"))) {
        const auto query_devices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
        const auto query_string = eglFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
        EGLDeviceEXT devices[16] = {};
        EGLint count = 0;
        if (query_devices != nullptr && query_devices(16, devices, &count) == EGL_TRUE)
            for (EGLint i = 0; i < count; ++i) {
                const bool is_software =
                    query_string != nullptr &&
                    has(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
                (is_software ? software : hardware)
                    .push_back(get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
            }
    }
    std::vector<EGLDisplay> all;
    if (!softwareOnly()) all = hardware;
    if (has(client, "EGL_MESA_platform_surfaceless"))
        all.push_back(get_display(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY),
                                  nullptr));
    all.insert(all.end(), software.begin(), software.end());
    return all;
}

class EglContext final : public Context {
  public:
    EglContext() {
        if (softwareOnly()) setenv("GALLIUM_DRIVER", "llvmpipe", 0);
        std::string reason = "no display";
        for (const EGLDisplay display : candidates()) {
            if (display == EGL_NO_DISPLAY) continue;
            try {
                open(display);
                return;
            } catch (const std::runtime_error& error) {
                reason = error.what();
            }
        }
        throw std::runtime_error("EGL: no OpenGL 3.3 core context to be had (" + reason +
                                 "); Debian packages libegl1 and libgl1-mesa-dri provide one");
    }
    ~EglContext() override { close(); }
    const char* kind() const override { return "egl"; }

  private:
    void open(EGLDisplay display) {
        if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
            throw std::runtime_error("a display does not initialise");
        display_ = display;
        try {
            create();
        } catch (...) {
            close();
            throw;
        }
    }

    void create() {
        if (!has(eglQueryString(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
            throw std::runtime_error("a display needs a surface");
        constexpr EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                                EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
            eglChooseConfig(display_, config_attributes, &config, 1, &count) != EGL_TRUE || count < 1)
            throw std::runtime_error("a display offers no desktop OpenGL");
        constexpr EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("a display offers no OpenGL 3.3 core");
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw std::runtime_error("a context could not be made current");
        load(eglGetProcAddress);
    }

    void close() {
        if (display_ == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        eglTerminate(display_);
        context_ = EGL_NO_CONTEXT;
        display_ = EGL_NO_DISPLAY;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<Context> makeEglContext() { return std::make_unique<EglContext>(); }

} // namespace gll
