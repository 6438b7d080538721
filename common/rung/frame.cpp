// Drawing a pass and telling whoever listens.
#include "rung/frame.hpp"

namespace gll {

void Frame::pass(const std::string& name, const Framebuffer& target, const Pass& pass) {
    if (observer_ != nullptr) observer_->before(name);
    drawPass(name, target, pass, full_screen_triangle_);
    passes_.push_back({name, &target, bytesPerPixel(target, pass), pass.program.id()});
    if (observer_ != nullptr) observer_->after(passes_.back());
}

} // namespace gll
