// Which headless context serves.
#include "rung/context.hpp"

#include <stdexcept>
#include <string>

namespace gll {

std::unique_ptr<Context> makeHeadlessContext(ContextKind kind) {
    if (kind == ContextKind::egl) return makeEglContext();
    if (kind == ContextKind::osmesa) return makeOsmesaContext();
    try {
        return makeOsmesaContext();
    } catch (const std::runtime_error& osmesa_error) {
        try {
            return makeEglContext();
        } catch (const std::runtime_error& egl_error) {
            throw std::runtime_error(std::string(osmesa_error.what()) + "; " + egl_error.what());
        }
    }
}

} // namespace gll
