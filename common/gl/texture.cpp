// Texture allocation, upload and sampling state.
#include "gl/texture.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace gll {
namespace {

GLint wrapMode(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return GL_REPEAT;
    case Wrap::mirrored_repeat:
        return GL_MIRRORED_REPEAT;
    case Wrap::border_one:
        return GL_CLAMP_TO_BORDER;
    case Wrap::clamp_to_edge:
        break;
    }
    return GL_CLAMP_TO_EDGE;
}

// OpenGL's name for pixels of as many channels as count values make of a size.
GLenum layoutOf(std::size_t count, glm::ivec2 size) {
    constexpr GLenum layouts[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const auto texels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const std::size_t channels = texels == 0 ? 0 : count / texels;
    if (channels < 1 || channels > 4 || channels * texels != count)
        throw std::invalid_argument("texture: " + std::to_string(count) + " values do not fill " +
                                    std::to_string(texels) + " texels of 1 to 4 channels");
    return layouts[channels - 1];
}

GLenum sideTarget(GLenum target, int side) {
    return target == GL_TEXTURE_CUBE_MAP ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(side)
                                         : target;
}

// Where a side's pixels, bytes or floats, begin; null where there are none.
const void* sideOf(const void* pixels, int side, glm::ivec2 size, GLenum layout, GLenum type) {
    if (pixels == nullptr) return nullptr;
    const std::size_t channels = layout == GL_RED ? 1 : layout == GL_RG ? 2 : layout == GL_RGB ? 3 : 4;
    const std::size_t bytes = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * channels *
                              (type == GL_FLOAT ? sizeof(float) : 1);
    return static_cast<const std::byte*>(pixels) + static_cast<std::size_t>(side) * bytes;
}

glm::ivec2 levelSize(glm::ivec2 size, int level) {
    return {std::max(size.x >> level, 1), std::max(size.y >> level, 1)};
}

} // namespace

int levelCount(glm::ivec2 size) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({size.x, size.y, 1}))));
}

Texture::Texture(const TextureDescription& description) : description_(description) {
    const FormatInfo info = formatInfo(description.format);
    allocate(info.layout, info.type, nullptr);
}

Texture::Texture(const TextureDescription& description, std::span<const std::uint8_t> pixels)
    : description_(description) {
    upload(pixels.size(), GL_UNSIGNED_BYTE, pixels.data());
}

Texture::Texture(const TextureDescription& description, std::span<const float> pixels)
    : description_(description) {
    upload(pixels.size(), GL_FLOAT, pixels.data());
}

void Texture::upload(std::size_t count, GLenum type, const void* pixels) {
    allocate(layoutOf(count, description_.size * glm::ivec2(sides(), 1)), type, pixels);
    if (description_.levels > 1) generateMipmaps();
}

void Texture::allocate(GLenum layout, GLenum type, const void* pixels) {
    const FormatInfo info = formatInfo(description_.format);
    const glm::ivec2 size = description_.size;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (description_.is_cube) glGetIntegerv(GL_MAX_CUBE_MAP_TEXTURE_SIZE, &largest);
    if (description_.is_cube && size.x != size.y)
        throw std::invalid_argument("texture: the sides of a cube are squares");
    if (size.x < 1 || size.y < 1 || size.x > largest || size.y > largest)
        throw std::runtime_error("texture: " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                                 " is outside 1x1 to " + std::to_string(largest) + "x" +
                                 std::to_string(largest));
    GLuint id = 0;
    glGenTextures(1, &id);
    handle_ = Handle<destroy>(id);
    glBindTexture(target(), id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < description_.levels; ++level) {
        const glm::ivec2 extent = levelSize(size, level);
        for (int side = 0; side < sides(); ++side)
            glTexImage2D(sideTarget(target(), side), level, static_cast<GLint>(info.internal), extent.x,
                         extent.y, 0, layout, type,
                         level == 0 ? sideOf(pixels, side, extent, layout, type) : nullptr);
    }

    const bool nearest = description_.filter == Filter::nearest;
    const bool mipmapped = description_.filter == Filter::trilinear;
    const auto set = [this](GLenum name, GLint value) { glTexParameteri(target(), name, value); };
    set(GL_TEXTURE_MAX_LEVEL, description_.levels - 1);
    set(GL_TEXTURE_MAG_FILTER, nearest || description_.nearest_magnified ? GL_NEAREST : GL_LINEAR);
    set(GL_TEXTURE_MIN_FILTER, nearest ? GL_NEAREST : mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, wrapMode(description_.wrap_x));
    set(GL_TEXTURE_WRAP_T, wrapMode(description_.wrap_y));
    if (description_.wrap_x == Wrap::border_one || description_.wrap_y == Wrap::border_one) {
        constexpr GLfloat ones[] = {1, 1, 1, 1};
        glTexParameterfv(target(), GL_TEXTURE_BORDER_COLOR, ones);
    }
    if (description_.compare_depth) {
        set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        set(GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    if (description_.anisotropy > 1.0F && GLAD_GL_EXT_texture_filter_anisotropic)
        glTexParameterf(target(), GL_TEXTURE_MAX_ANISOTROPY_EXT, description_.anisotropy);
    glBindTexture(target(), 0);
}

void Texture::generateMipmaps() const {
    glBindTexture(target(), id());
    glGenerateMipmap(target());
    glBindTexture(target(), 0);
}

void Texture::setLevel(int level, std::span<const float> pixels) const {
    if (level < 0 || level >= description_.levels)
        throw std::invalid_argument("texture: no level " + std::to_string(level));
    const glm::ivec2 extent = levelSize(description_.size, level);
    const GLenum layout = layoutOf(pixels.size(), extent * glm::ivec2(sides(), 1));
    glBindTexture(target(), id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int side = 0; side < sides(); ++side)
        glTexSubImage2D(sideTarget(target(), side), level, 0, 0, extent.x, extent.y, layout, GL_FLOAT,
                        sideOf(pixels.data(), side, extent, layout, GL_FLOAT));
    glBindTexture(target(), 0);
}

void Texture::setTexel(glm::ivec2 texel, float value) const {
    if (description_.is_cube || texel.x < 0 || texel.y < 0 || texel.x >= size().x || texel.y >= size().y)
        throw std::out_of_range("texture: no texel (" + std::to_string(texel.x) + "," +
                                std::to_string(texel.y) + ")");
    const float values[] = {value, value, value, value};
    glBindTexture(GL_TEXTURE_2D, id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, texel.x, texel.y, 1, 1, formatInfo(format()).layout, GL_FLOAT, values);
    glBindTexture(GL_TEXTURE_2D, 0);
}

} // namespace gll
