// A texture, two-dimensional or the six sides of a cube, with its sampling state.
#pragma once

#include "gl/format.hpp"
#include "gl/handle.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace gll {

enum class Filter { nearest, linear, trilinear }; // trilinear: linear within and between mip levels
enum class Wrap {
    clamp_to_edge,
    repeat,
    mirrored_repeat,
    border_one
}; // border_one: outside reads 1 (for depth: "farthest")

struct TextureDescription {
    glm::ivec2 size{1, 1}; // texels, both at least 1
    Format format = Format::rgba8;
    Filter filter = Filter::linear;
    bool nearest_magnified = false; // whatever the filter, texels larger than pixels are squares
    Wrap wrap_x = Wrap::clamp_to_edge;
    Wrap wrap_y = Wrap::clamp_to_edge;
    int levels = 1;             // mip levels allocated; levelCount(size) for all of them
    bool compare_depth = false; // sampled as sampler2DShadow: reference <= stored gives 1
    float anisotropy = 1.0F;    // above 1 where GL_EXT_texture_filter_anisotropic is offered, else ignored
    // Sides of a cube, of this size each and square: sampled as samplerCube, by a direction. Pixels hold +x,
    // -x, +y, -y, +z, -z one after the other, each with its row t = 0 first (OpenGL 3.3, table 3.21).
    bool is_cube = false;
};

// How many mip levels a texture of this size has down to 1x1: floor(log2(longest side)) + 1.
int levelCount(glm::ivec2 size);

class Texture {
  public:
    Texture() = default; // no texture: id() is 0
    explicit Texture(const TextureDescription& description);
    // Level 0 from pixels, bottom row first, as many channels as pixels.size() / texels says (1 to 4);
    // further levels, where described, are generated. Throws std::invalid_argument where the count does not
    // divide.
    Texture(const TextureDescription& description, std::span<const std::uint8_t> pixels);
    Texture(const TextureDescription& description, std::span<const float> pixels);

    GLuint id() const { return handle_.id(); }
    GLenum target() const { return description_.is_cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D; }
    int sides() const { return description_.is_cube ? 6 : 1; }
    glm::ivec2 size() const { return description_.size; }
    Format format() const { return description_.format; }
    const TextureDescription& description() const { return description_; }

    // Fills levels 1 and up from level 0 by the driver's filter. For frames that must be right at sizes other
    // than powers of two, reduce by a pass instead.
    void generateMipmaps() const;

    // Replaces one mip level, bottom row first, in as many channels as the count says (1 to 4): for levels
    // that are more than the average of the one before. Throws std::invalid_argument where the count does not
    // divide.
    void setLevel(int level, std::span<const float> pixels) const;

    // Overwrites one texel of level 0 of a colour texture, counted from the bottom left, with value in every
    // channel: for tests of what one bad pixel does. Throws std::out_of_range where the texture has no such
    // texel, and of a cube always.
    void setTexel(glm::ivec2 texel, float value) const;

  private:
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    void allocate(GLenum layout, GLenum type, const void* pixels);
    void upload(std::size_t count, GLenum type, const void* pixels);

    TextureDescription description_;
    Handle<destroy> handle_;
};

} // namespace gll
