// Telling heights from normals, and making the one into the other.
#include "height_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <variant>

namespace gll::gbuffer {

bool looksLikeNormalMap(const Image& image) {
    const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.pixels);
    if (bytes == nullptr || image.channels < 3) return false;
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixels = bytes->size() / channels;
    std::size_t directions = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* c = bytes->data() + i * channels;
        const glm::vec3 n = glm::vec3(c[0], c[1], c[2]) / 127.0F - 128.0F / 127.0F;
        const bool is_grey = std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) < 16;
        if (!is_grey && n.z > 0.0F && std::abs(glm::length(n) - 1.0F) < 0.2F) ++directions;
    }
    return pixels > 0 && directions * 10 >= pixels * 9;
}

std::vector<std::uint8_t> normalsFromHeights(const Image& image, int channel, float scale) {
    const auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
    const int from = image.channels < 3 ? 0 : std::min(channel, image.channels - 1);
    const auto height = [&](int x, int y) {
        x = (x + image.width) % image.width;
        y = (y + image.height) % image.height;
        return static_cast<float>(
                   bytes[static_cast<std::size_t>((y * image.width + x) * image.channels + from)]) /
               255.0F * scale;
    };
    std::vector<std::uint8_t> normals;
    normals.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 normal =
                glm::normalize(glm::vec3((height(x - 1, y) - height(x + 1, y)) / 2.0F,
                                         (height(x, y + 1) - height(x, y - 1)) / 2.0F, // up the image
                                         1.0F));
            for (int c = 0; c < 3; ++c)
                normals.push_back(static_cast<std::uint8_t>(std::lround(normal[c] * 127.0F + 128.0F)));
        }
    return normals;
}

} // namespace gll::gbuffer
