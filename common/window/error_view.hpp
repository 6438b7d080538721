// What is wrong with shaders, over the picture that goes on as it last was.
#pragma once

#include "gl/shader_source.hpp"
#include "window/layout.hpp"

#include <vector>

namespace gll {

// At the top of the picture, as far as there is room. Nothing where there are no errors. is_drawn: whether
// the frame could be drawn all the same.
void errorsOver(const Rectangle& picture, float pixels_per_unit, const std::vector<ShaderError>& errors,
                bool is_drawn);

} // namespace gll
