// A picture from a file in place of a rung's scene, for trying a method on frames of one's own.
#pragma once

#include "app/frame.hpp"
#include "app/resources.hpp"

#include <filesystem>
#include <optional>

namespace gll {

class SceneImage {
  public:
    // Where the path is empty there is no picture. Throws std::runtime_error as loadImage() does.
    SceneImage(ShaderLibrary& shaders, const std::filesystem::path& path);

    explicit operator bool() const { return picture_.has_value(); }

    // Draws the picture's linear light over the whole target: pixel by pixel where the sizes agree, else
    // scaled to cover it about the middle, its proportions kept.
    void draw(Frame& frame, const std::string& pass, const Framebuffer& target) const;

  private:
    ShaderLibrary& shaders_;
    std::optional<Texture> picture_;
};

} // namespace gll
