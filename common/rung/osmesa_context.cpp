// OSMesa behind the Context interface. The library is opened by name, out of the way of other OpenGL
// libraries whose functions have the same names.
#include "rung/context.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace gll {
namespace {

// From GL/osmesa.h, which cannot be included here: it brings GL/gl.h, and that clashes with the loader's
// header.
constexpr int OSMESA_FORMAT = 0x22;
constexpr int OSMESA_DEPTH_BITS = 0x30;
constexpr int OSMESA_STENCIL_BITS = 0x31;
constexpr int OSMESA_PROFILE = 0x33;
constexpr int OSMESA_CORE_PROFILE = 0x34;
constexpr int OSMESA_CONTEXT_MAJOR_VERSION = 0x36;
constexpr int OSMESA_CONTEXT_MINOR_VERSION = 0x37;
constexpr int OSMESA_RGBA = 0x1908;

using OsmesaContextHandle = struct OsmesaContextData*;

struct Osmesa {
    OsmesaContextHandle (*create)(const int* attributes, OsmesaContextHandle share) = nullptr;
    void (*destroy)(OsmesaContextHandle) = nullptr;
    unsigned char (*makeCurrent)(OsmesaContextHandle, void* buffer, unsigned type, int width,
                                 int height) = nullptr;
    GLADloadfunc getProcAddress = nullptr;
};

Osmesa openOsmesa() {
    // The library stays open for the process's life: its threads and compiled shaders outlive a context.
    void* library = nullptr;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
        if (library == nullptr) library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        throw std::runtime_error("OSMesa: libOSMesa.so.8 is not installed (Debian package libosmesa6); "
                                 "--context egl renders the same frame");
    const auto load = [library](auto& function, const char* name) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
        if (function == nullptr)
            throw std::runtime_error(std::string("OSMesa: the library has no function ") + name);
    };
    Osmesa osmesa;
    load(osmesa.create, "OSMesaCreateContextAttribs");
    load(osmesa.destroy, "OSMesaDestroyContext");
    load(osmesa.makeCurrent, "OSMesaMakeCurrent");
    load(osmesa.getProcAddress, "OSMesaGetProcAddress");
    return osmesa;
}

class OsmesaContext final : public Context {
  public:
    OsmesaContext() {
        setenv("GALLIUM_DRIVER", "llvmpipe", 0); // the one whose frames are checked; a user's choice stands
        osmesa_ = openOsmesa();
        constexpr int attributes[] = {OSMESA_FORMAT,
                                      OSMESA_RGBA,
                                      OSMESA_DEPTH_BITS,
                                      24,
                                      OSMESA_STENCIL_BITS,
                                      8,
                                      OSMESA_PROFILE,
                                      OSMESA_CORE_PROFILE,
                                      OSMESA_CONTEXT_MAJOR_VERSION,
                                      3,
                                      OSMESA_CONTEXT_MINOR_VERSION,
                                      3,
                                      0};
        context_ = osmesa_.create(attributes, nullptr);
        if (context_ == nullptr) throw std::runtime_error("OSMesa: no OpenGL 3.3 core context to be had");
        if (osmesa_.makeCurrent(context_, pixel_, GL_UNSIGNED_BYTE, 1, 1) == 0) {
            osmesa_.destroy(context_);
            throw std::runtime_error("OSMesa: the context could not be made current");
        }
        try {
            load(osmesa_.getProcAddress);
        } catch (...) {
            osmesa_.destroy(context_);
            throw;
        }
    }
    ~OsmesaContext() override { osmesa_.destroy(context_); }
    const char* kind() const override { return "osmesa"; }

  private:
    Osmesa osmesa_;
    OsmesaContextHandle context_ = nullptr;
    unsigned char pixel_[4] = {}; // the default framebuffer, which nothing draws to
};

} // namespace

std::unique_ptr<Context> makeOsmesaContext() { return std::make_unique<OsmesaContext>(); }

} // namespace gll
