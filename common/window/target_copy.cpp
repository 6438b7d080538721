// Copying by blits, which need framebuffers, and reading texels with their bits.
#include "window/target_copy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace gll {
namespace {

// Bound for reading, with one level of a texture as its attachment; what was bound before is bound again.
class ReadFramebuffer {
  public:
    ReadFramebuffer(const Texture& texture, int level) {
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_before_);
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_before_);
        glGenFramebuffers(1, &id_);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
        const bool is_depth = formatInfo(texture.format()).is_depth;
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                               GL_TEXTURE_2D, texture.id(), level);
        glReadBuffer(is_depth ? GL_NONE : GL_COLOR_ATTACHMENT0);
    }
    ~ReadFramebuffer() {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_before_));
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_before_));
        glDeleteFramebuffers(1, &id_);
    }
    ReadFramebuffer(const ReadFramebuffer&) = delete;
    ReadFramebuffer& operator=(const ReadFramebuffer&) = delete;

  private:
    GLuint id_ = 0;
    GLint read_before_ = 0;
    GLint draw_before_ = 0;
};

// How a texel's bits are read: as words of a type, or as one that packs all channels.
struct Words {
    GLenum type;
    int bytes;
    int count;
};

Words wordsOf(const FormatInfo& info, Format format) {
    switch (format) {
    case Format::rgb10_a2:
        return {GL_UNSIGNED_INT_2_10_10_10_REV, 4, 1};
    case Format::r11f_g11f_b10f:
        return {GL_UNSIGNED_INT_10F_11F_11F_REV, 4, 1};
    case Format::depth16:
    case Format::r16:
    case Format::rg16:
    case Format::rgba16:
        return {GL_UNSIGNED_SHORT, 2, info.channels};
    case Format::r16f:
    case Format::rg16f:
    case Format::rgb16f:
    case Format::rgba16f:
        return {GL_HALF_FLOAT, 2, info.channels};
    case Format::depth24:
        return {GL_UNSIGNED_INT, 4, 1}; // in its upper 24 bits
    case Format::r8:
    case Format::rg8:
    case Format::rgba8:
    case Format::srgb8_alpha8:
        return {GL_UNSIGNED_BYTE, 1, info.channels};
    default:
        return {GL_FLOAT, 4, info.channels};
    }
}

float encodedSrgb(float linear) { // IEC 61966-2-1
    if (!(linear > 0)) return 0;
    linear = std::min(linear, 1.0F);
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float decodedSrgb(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

std::string number(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

} // namespace

void TargetCopy::take(const Texture& texture, int level) {
    const glm::ivec2 size(std::max(texture.size().x >> level, 1), std::max(texture.size().y >> level, 1));
    // No promise that rgb16f can be drawn to, and what is read from it has no alpha.
    const Format format = texture.format() == Format::rgb16f ? Format::rgba16f : texture.format();
    copy_.remake({{.name = "copy", .format = format, .filter = Filter::nearest}}, size);
    const ReadFramebuffer from(texture, level);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, copy_.id());
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_SCISSOR_TEST);
    const bool is_depth = formatInfo(format).is_depth;
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y,
                      is_depth ? GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

TargetCopy::Contents TargetCopy::contents() const {
    Contents contents;
    const FormatInfo info = format();
    if (!info.is_float && !info.is_depth) return contents;
    const auto channels = static_cast<std::size_t>(info.channels);
    std::vector<float> pixels(static_cast<std::size_t>(size().x) * static_cast<std::size_t>(size().y) *
                              channels);
    glBindTexture(GL_TEXTURE_2D, texture().id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, info.layout, GL_FLOAT, pixels.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    if (info.is_depth) {
        float nearest = 1;
        float farthest = 0;
        for (const float depth : pixels) {
            nearest = std::min(nearest, depth);
            if (depth < 1) farthest = std::max(farthest, depth);
        }
        if (nearest < 1) contents = {.nearest = nearest, .farthest = farthest};
        return contents;
    }
    for (std::size_t i = 0; i < pixels.size(); i += channels) {
        bool no_number = false;
        bool infinite = false;
        for (std::size_t c = 0; c < channels; ++c) {
            no_number = no_number || std::isnan(pixels[i + c]);
            infinite = infinite || std::isinf(pixels[i + c]);
        }
        contents.no_number += no_number ? 1 : 0;
        contents.infinite += infinite && !no_number ? 1 : 0;
    }
    return contents;
}

Texel readTexel(const Texture& texture, glm::ivec2 place) {
    if (place.x < 0 || place.y < 0 || place.x >= texture.size().x || place.y >= texture.size().y)
        throw std::out_of_range("there is no texel " + std::to_string(place.x) + "," +
                                std::to_string(place.y));
    const FormatInfo info = formatInfo(texture.format());
    const ReadFramebuffer from(texture, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    Texel texel;
    texel.channels = info.channels;
    glReadPixels(place.x, place.y, 1, 1, info.layout, GL_FLOAT, texel.value.data());
    const Words words = wordsOf(info, texture.format());
    std::array<std::uint8_t, 16> bytes{};
    glReadPixels(place.x, place.y, 1, 1, info.layout, words.type, bytes.data());
    for (int i = 0; i < words.count; ++i) {
        if (i > 0) texel.bits += ' ';
        for (int k = words.bytes - 1; k >= 0; --k) { // little-endian, as every machine with OpenGL here is
            char two[3];
            std::snprintf(two, sizeof two, "%02x", bytes[static_cast<std::size_t>(i * words.bytes + k)]);
            texel.bits += two;
        }
    }
    return texel;
}

std::string describe(const Texel& texel, bool is_light, bool is_display) {
    std::string text;
    for (int c = 0; c < texel.channels; ++c)
        text += (c > 0 ? "  " : "") + number("%.5g", texel.value[static_cast<std::size_t>(c)]);
    const auto& v = texel.value;
    if ((is_light || is_display) && texel.channels >= 3) {
        const auto light = [&](float value) { return is_display ? decodedSrgb(value) : value; };
        const double luminance =
            0.2126 * double(light(v[0])) + 0.7152 * double(light(v[1])) + 0.0722 * double(light(v[2]));
        if (std::isfinite(luminance) && luminance > 0)
            text += "   " + number("%+.2f", std::log2(luminance / 0.18)) + " stops";
        text += "   code";
        for (std::size_t c = 0; c < 3; ++c)
            text += " " + number("%.0f", 255 * double(is_display ? v[c] : encodedSrgb(v[c])));
    }
    return text + "   0x " + texel.bits;
}

} // namespace gll
