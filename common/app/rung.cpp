// Rendering a frame of a rung and checking it for OpenGL errors.
#include "app/rung.hpp"

namespace gll {

Renderer::Renderer(Context& context, const RungInfo& info, const RungFiles& given)
    : context_(context), shaders_(resources_.shaderRoots()),
      rung_(info.make(RungResources{shaders_, resources_, given})) {
    context_.debugLog().check("OpenGL, making the rung's resources");
}

const std::vector<DrawnPass>& Renderer::render(int number, glm::ivec2 size, PassObserver* observer) {
    presented_.resize(size);
    Frame frame(number, presented_, triangle_, observer);
    rung_->render(frame);
    context_.debugLog().check("OpenGL, frame " + std::to_string(number));
    passes_ = frame.passes();
    return passes_;
}

} // namespace gll
