// Rendering a frame of a rung, checking it for OpenGL errors, and saying what its files made it warn of.
#include "rung/rung.hpp"

#include "rung/capture.hpp"

#include <cstdio>

namespace gll {

Renderer::Renderer(Context& context, const RungInfo& info, const RungFiles& given)
    : context_(context), name_(info.name), shaders_(resources_.shaderRoots()),
      rung_(info.make(RungResources{shaders_, resources_, given, warnings_})) {
    context_.debugLog().check("OpenGL, making the rung's resources");
    sayWarnings();
}

const std::vector<DrawnPass>& Renderer::render(int number, glm::ivec2 size, PassObserver* observer) {
    presented_.resize(size);
    Frame frame(number, presented_, triangle_, observer);
    rung_->render(frame);
    context_.debugLog().check("OpenGL, frame " + std::to_string(number));
    sayWarnings(); // files may be read when they are first needed
    passes_ = frame.passes();
    return passes_;
}

Image Renderer::image(const Texture& target) const {
    Image image = readTexture(target);
    if (&target == &presented_.color()) image.color_space = ColorSpace::srgb; // what a display is sent
    return image;
}

void Renderer::sayWarnings() {
    for (std::string& line : warnings_.take()) {
        std::fprintf(stderr, "%s: warning: %s\n", name_.c_str(), line.c_str());
        said_.push_back(std::move(line));
    }
}

} // namespace gll
