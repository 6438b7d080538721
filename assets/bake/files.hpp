// What bake writes: text, 8-bit images and Radiance pictures, without dates or anything else that varies.
// Every failure throws std::runtime_error with the path and what to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace bake {

/// Rows from the top, `channels` values a texel.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> values;

    Picture(int width_px, int height_px, int channel_count);
    /// Stores `color` (channel values in [0, 1], clamped, rounded) at column x of row y.
    void set(int x, int y, const glm::dvec3& color);
    void set(int x, int y, double grey);
};

/// Linear light in [0, 1] to the sRGB encoding, IEC 61966-2-1.
double srgbEncode(double linear);
glm::dvec3 srgbEncode(const glm::dvec3& linear);

/// A unit normal as a colour: (128, 128, 255) is flat, +y up (the OpenGL convention).
glm::dvec3 normalColor(const glm::dvec3& normal);

void writeText(const std::filesystem::path& path, const std::string& text);
void writePng(const std::filesystem::path& path, const Picture& picture);
void writeJpeg(const std::filesystem::path& path, const Picture& picture, int quality);
/// Radiance RGBE: three floats a texel, rows from the top.
void writeHdr(const std::filesystem::path& path, int width, int height, const std::vector<float>& rgb);

/// Calls `row(y)` for every y in [0, rows) from two threads. The rows must not depend on each other.
void forEachRow(int rows, const std::function<void(int)>& row);

} // namespace bake
