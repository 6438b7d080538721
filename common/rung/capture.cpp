// Reading textures back and converting them for files.
#include "rung/capture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gll {
namespace {

// IEC 61966-2-1, the sRGB transfer function and its inverse; values in [0, 1].
float srgbEncoded(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}
float srgbDecoded(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

template <class T>
std::vector<T> readPixels(const Texture& texture, GLenum layout, GLenum type, int channels) {
    const auto width = static_cast<std::size_t>(texture.size().x);
    const auto height = static_cast<std::size_t>(texture.size().y);
    const std::size_t row = width * static_cast<std::size_t>(channels);
    std::vector<T> pixels(row * height);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, layout, type, pixels.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    for (std::size_t y = 0; y < height / 2; ++y) // OpenGL's first row is the bottom one
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * row));
    return pixels;
}

// Every pixel through a function of (value, channel) into an image with another number of channels.
template <class T, class Convert>
std::vector<T> converted(const Image& image, int channels, const Convert& convert) {
    const auto pixel_count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto from = static_cast<std::size_t>(image.channels);
    const auto to = static_cast<std::size_t>(channels);
    std::vector<T> result(pixel_count * to);
    std::visit(
        [&](const auto& pixels) {
            for (std::size_t i = 0; i < pixel_count; ++i)
                for (std::size_t c = 0; c < to; ++c) {
                    float value = 0; // a channel the image lacks
                    if (c < from)
                        value = static_cast<float>(pixels[i * from + c]);
                    else if (from == 1)
                        value = static_cast<float>(pixels[i]);
                    result[i * to + c] = convert(value, c);
                }
        },
        image.pixels);
    return result;
}

bool is8Bit(const Image& image) { return std::holds_alternative<std::vector<std::uint8_t>>(image.pixels); }

} // namespace

Image readTexture(const Texture& texture) {
    const FormatInfo info = formatInfo(texture.format());
    Image image;
    image.width = texture.size().x;
    image.height = texture.size().y;
    image.channels = info.channels;
    image.color_space = info.is_float                              ? ColorSpace::linear
                        : texture.format() == Format::srgb8_alpha8 ? ColorSpace::srgb
                                                                   : ColorSpace::data;
    if (info.type == GL_UNSIGNED_BYTE)
        image.pixels = readPixels<std::uint8_t>(texture, info.layout, GL_UNSIGNED_BYTE, info.channels);
    else
        image.pixels = readPixels<float>(texture, info.layout, GL_FLOAT, info.channels);
    return image;
}

Image forFile(const Image& image, const std::string& extension) {
    Image result;
    result.width = image.width;
    result.height = image.height;
    const bool bytes = is8Bit(image);
    if (extension == ".png") {
        result.color_space = image.color_space == ColorSpace::data ? ColorSpace::data : ColorSpace::srgb;
        result.channels = image.channels == 1 ? 1 : 3;
        const bool encode = image.color_space == ColorSpace::linear;
        result.pixels = converted<std::uint8_t>(image, result.channels, [&](float value, std::size_t) {
            if (bytes) return static_cast<std::uint8_t>(value);
            if (!(value > 0)) return std::uint8_t(0); // not-a-number too
            value = std::min(value, 1.0F);
            return static_cast<std::uint8_t>(std::lround((encode ? srgbEncoded(value) : value) * 255));
        });
        return result;
    }
    result.color_space = image.color_space == ColorSpace::data ? ColorSpace::data : ColorSpace::linear;
    result.channels = extension == ".hdr" ? 3 : image.channels;
    const bool decode = image.color_space == ColorSpace::srgb;
    result.pixels = converted<float>(image, result.channels, [&](float value, std::size_t channel) {
        if (bytes) value /= 255;
        return decode && channel < 3 ? srgbDecoded(value) : value;
    });
    return result;
}

bool isWritableImage(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".png" || extension == ".exr" || extension == ".hdr";
}

std::vector<std::string> targetNames(const std::vector<DrawnPass>& passes) {
    std::vector<std::string> names;
    for (const DrawnPass& pass : passes)
        for (const Attachment& attachment : pass.target->attachments())
            if (std::find(names.begin(), names.end(), attachment.name) == names.end())
                names.push_back(attachment.name);
    return names;
}

const Texture* findTarget(const std::vector<DrawnPass>& passes, const std::string& name) {
    for (const DrawnPass& pass : passes)
        for (const Attachment& attachment : pass.target->attachments())
            if (attachment.name == name) return &(*pass.target)[name];
    return nullptr;
}

} // namespace gll
