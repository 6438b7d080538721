// A picture from a file in place of a rung's scene, for trying a method on frames of one's own.
#pragma once

#include "rung/rung.hpp"

#include <optional>

namespace gll {

class SceneImage {
  public:
    // The picture given as --image; without it there is none. Throws std::runtime_error as loadImage() does.
    explicit SceneImage(const RungResources& resources);

    explicit operator bool() const { return picture_.has_value(); }

    // Draws the picture's linear light over the whole target: pixel by pixel where the sizes agree, else
    // scaled to cover it about the middle, its proportions kept. A rung that makes more of it than one colour
    // names a fragment file of its own, which includes lib/image.glsl, and what that needs.
    void draw(Frame& frame, const std::string& pass, const Framebuffer& target,
              const std::string& fragment_file = "lib/image.frag", const Defines& defines = {},
              const std::vector<UniformSetting>& uniforms = {}) const;

  private:
    ShaderLibrary& shaders_;
    std::optional<Texture> picture_;
};

} // namespace gll
