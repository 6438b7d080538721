// Finds the library behind openimageio.hpp: in the folders that were linked into this program as its run
// path.
#include "io/openimageio.hpp"

#include <dlfcn.h>
#include <stdexcept>

namespace gll {

const OpenImageIo& openImageIo() {
    static const OpenImageIo& functions = []() -> const OpenImageIo& {
        // Never closed: the libraries behind it have threads of their own.
        void* const library = dlopen(GLLADDER_OPENIMAGEIO, RTLD_NOW | RTLD_LOCAL);
        const void* const symbol = library == nullptr ? nullptr : dlsym(library, "gll_openimageio");
        if (symbol == nullptr)
            throw std::runtime_error(
                "OpenImageIO cannot be loaded, build or install this program again with it (" +
                std::string(dlerror()) + ")");
        return *static_cast<const OpenImageIo*>(symbol);
    }();
    return functions;
}

} // namespace gll
