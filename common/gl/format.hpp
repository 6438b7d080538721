// The pixel formats the ladder renders to and samples from, and what is worth knowing of each.
#pragma once

#include <glad/gl.h>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gll {

enum class Format {
    r8,
    rg8,
    rgba8,
    srgb8_alpha8, // sRGB-encoded in memory, linear in the shader
    rgb10_a2,
    r16,
    rg16,
    rgba16,
    r11f_g11f_b10f,
    r16f,
    rg16f,
    rgb16f, // for sampling only: OpenGL 3.3 does not promise it as a render target
    rgba16f,
    r32f,
    rg32f,
    rgba32f,
    depth16,
    depth24,
    depth32f,
};

struct FormatInfo {
    const char* name;
    GLenum internal; // glTexImage2D's internalformat
    GLenum layout;   // glTexImage2D's and glReadPixels' format
    GLenum type;     // a transfer type that loses nothing, or GL_FLOAT
    int channels;    // as read back
    int bytes;       // per pixel in memory, as declared
    bool is_float;   // holds values outside [0, 1]
    bool is_depth;
};

constexpr FormatInfo formatInfo(Format format) {
    switch (format) {
    case Format::r8:
        return {"r8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, 1, false, false};
    case Format::rg8:
        return {"rg8", GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2, 2, false, false};
    case Format::rgba8:
        return {"rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, false, false};
    case Format::srgb8_alpha8:
        return {"srgb8_alpha8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, false, false};
    case Format::rgb10_a2:
        return {"rgb10_a2", GL_RGB10_A2, GL_RGBA, GL_FLOAT, 4, 4, false, false};
    case Format::r16:
        return {"r16", GL_R16, GL_RED, GL_FLOAT, 1, 2, false, false};
    case Format::rg16:
        return {"rg16", GL_RG16, GL_RG, GL_FLOAT, 2, 4, false, false};
    case Format::rgba16:
        return {"rgba16", GL_RGBA16, GL_RGBA, GL_FLOAT, 4, 8, false, false};
    case Format::r11f_g11f_b10f:
        return {"r11f_g11f_b10f", GL_R11F_G11F_B10F, GL_RGB, GL_FLOAT, 3, 4, true, false};
    case Format::r16f:
        return {"r16f", GL_R16F, GL_RED, GL_FLOAT, 1, 2, true, false};
    case Format::rg16f:
        return {"rg16f", GL_RG16F, GL_RG, GL_FLOAT, 2, 4, true, false};
    case Format::rgb16f:
        return {"rgb16f", GL_RGB16F, GL_RGB, GL_FLOAT, 3, 6, true, false};
    case Format::rgba16f:
        return {"rgba16f", GL_RGBA16F, GL_RGBA, GL_FLOAT, 4, 8, true, false};
    case Format::r32f:
        return {"r32f", GL_R32F, GL_RED, GL_FLOAT, 1, 4, true, false};
    case Format::rg32f:
        return {"rg32f", GL_RG32F, GL_RG, GL_FLOAT, 2, 8, true, false};
    case Format::rgba32f:
        return {"rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16, true, false};
    case Format::depth16:
        return {"depth16", GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 2, false, true};
    case Format::depth24:
        return {"depth24", GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4, false, true};
    case Format::depth32f:
        return {"depth32f", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4, false, true};
    }
    return {};
}

// The format with that FormatInfo::name. Throws std::invalid_argument where there is none.
inline Format formatNamed(std::string_view name) {
    for (int i = 0; i <= static_cast<int>(Format::depth32f); ++i)
        if (const auto format = static_cast<Format>(i); formatInfo(format).name == name) return format;
    throw std::invalid_argument("there is no format " + std::string(name));
}

} // namespace gll
