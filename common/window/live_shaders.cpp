// Rendering with shaders that somebody is editing.
#include "window/live_shaders.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

namespace gll {

void LiveShaders::attempt(const std::function<void()>& render) {
    frame_error_.reset();
    try {
        render();
    } catch (const ShaderError& error) {
        frame_error_ = error;
    } catch (const std::bad_alloc&) {
        frame_error_ = ShaderError("", 0, "out of memory; make the window smaller, or ask for less");
    } catch (const std::exception& error) {
        frame_error_ = ShaderError("", 0, error.what());
    }
    tell();
}

std::vector<ShaderError> LiveShaders::errors() const {
    std::vector<ShaderError> errors = shaders_.errors();
    if (frame_error_) errors.insert(errors.begin(), *frame_error_);
    return errors;
}

void LiveShaders::tell() {
    std::vector<std::string> now;
    for (const ShaderError& error : errors())
        now.emplace_back(error.what());
    for (const std::string& text : now)
        if (std::find(told_.begin(), told_.end(), text) == told_.end())
            std::fprintf(stderr, "%s: error: %s\n", program_.c_str(), text.c_str());
    if (now.empty() && !told_.empty()) {
        std::printf("mended: the picture is as the shaders have it again\n");
        std::fflush(stdout);
    }
    told_ = std::move(now);
}

} // namespace gll
