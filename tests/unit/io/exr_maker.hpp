// Builds uncompressed EXR files byte by byte: also such as no writer would make. After "OpenEXR File Layout"
// (openexr.com): scan lines or tiles, with or without levels, one part or several.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gll::test {

inline std::string littleEndian(std::uint64_t value, int bytes) {
    std::string result;
    for (int i = 0; i < bytes; ++i)
        result += static_cast<char>(value >> 8 * i & 255);
    return result;
}
inline std::string int32Bytes(int value) { return littleEndian(static_cast<std::uint32_t>(value), 4); }
inline std::string floatBytes(float value) { return littleEndian(std::bit_cast<std::uint32_t>(value), 4); }

inline std::string exrAttribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + littleEndian(value.size(), 4) + value;
}

using ExrWindow = std::array<int, 4>; // left, top, right, bottom; the last two inside

struct ExrPart {
    ExrWindow data = {0, 0, 0, 0};
    ExrWindow display = {0, 0, 0, 0};
    std::vector<std::string> channels = {"B", "G", "R"}; // in alphabetical order
    std::function<float(const std::string& channel, int x, int y)> value = [](auto&&...) { return 1.0F; };
    std::string more;      // further attributes
    int tile = 0;          // the side of tiles, 0 for scan lines
    bool levels = false;   // of tiles: halved down to one pixel, all of them 9 but for the finest
    std::string name = ""; // of one part among several
    std::string type = ""; // instead of what the tiles make it
    int channel_type = 2;  // 0 uint, 1 half, 2 float; pixels are written as float
    int sampling = 1;      // of every channel
    ExrPart& sized(int width, int height) {
        data = display = {0, 0, width - 1, height - 1};
        return *this;
    }

    struct Chunk {
        std::string place, pixels;
    };
    std::vector<Chunk> chunks() const {
        const int width = data[2] - data[0] + 1;
        const int height = data[3] - data[1] + 1;
        std::vector<Chunk> result;
        const auto add = [&](const std::string& place, int left, int top, int w, int h, bool finest) {
            std::string pixels;
            for (int y = top; y < top + h; ++y)
                for (const std::string& channel : channels)
                    for (int x = left; x < left + w; ++x)
                        pixels += floatBytes(finest ? value(channel, data[0] + x, data[1] + y) : 9.0F);
            result.push_back({place, pixels});
        };
        if (tile == 0) {
            for (int y = 0; y < height; ++y)
                add(int32Bytes(data[1] + y), 0, y, width, 1, true);
            return result;
        }
        for (int level = 0;; ++level) {
            const int w = std::max(width >> level, 1);
            const int h = std::max(height >> level, 1);
            for (int y = 0; y < h; y += tile)
                for (int x = 0; x < w; x += tile)
                    add(int32Bytes(x / tile) + int32Bytes(y / tile) + int32Bytes(level) + int32Bytes(level),
                        x, y, std::min(tile, w - x), std::min(tile, h - y), level == 0);
            if (!levels || (w == 1 && h == 1)) return result;
        }
    }

    std::string header(bool among_several) const {
        std::string list;
        for (const std::string& channel : channels)
            list += channel + '\0' + int32Bytes(channel_type) + std::string(4, '\0') + int32Bytes(sampling) +
                    int32Bytes(sampling);
        const auto window = [](const ExrWindow& edges) {
            std::string bytes;
            for (const int edge : edges)
                bytes += int32Bytes(edge);
            return bytes;
        };
        std::string bytes = more + exrAttribute("channels", "chlist", list + '\0') +
                            exrAttribute("compression", "compression", std::string(1, '\0')) +
                            exrAttribute("dataWindow", "box2i", window(data)) +
                            exrAttribute("displayWindow", "box2i", window(display)) +
                            exrAttribute("lineOrder", "lineOrder", std::string(1, '\0'));
        if (more.find("pixelAspectRatio") == std::string::npos)
            bytes += exrAttribute("pixelAspectRatio", "float", floatBytes(1));
        bytes += exrAttribute("screenWindowCenter", "v2f", floatBytes(0) + floatBytes(0)) +
                 exrAttribute("screenWindowWidth", "float", floatBytes(1));
        if (tile > 0)
            bytes += exrAttribute("tiles", "tiledesc",
                                  int32Bytes(tile) + int32Bytes(tile) + (levels ? '\1' : '\0'));
        if (among_several)
            bytes += exrAttribute("name", "string", name) +
                     exrAttribute("type", "string",
                                  !type.empty() ? type
                                  : tile > 0    ? "tiledimage"
                                                : "scanlineimage") +
                     exrAttribute("chunkCount", "int", int32Bytes(static_cast<int>(chunks().size())));
        return bytes + '\0';
    }
};

// One part makes a plain file; `flags` are added to its version.
inline std::string exr(const std::vector<ExrPart>& parts, std::uint32_t flags = 0) {
    const bool several = parts.size() > 1;
    if (several) flags |= 0x1000;
    if (!several && parts[0].tile > 0) flags |= 0x200;
    std::string bytes = "\x76\x2f\x31\x01" + littleEndian(2 | flags, 4);
    for (const ExrPart& part : parts)
        bytes += part.header(several);
    if (several) bytes += '\0';

    std::string chunks;
    std::string offsets;
    std::size_t count = 0;
    for (const ExrPart& part : parts)
        count += part.chunks().size();
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (const ExrPart::Chunk& chunk : parts[i].chunks()) {
            offsets += littleEndian(bytes.size() + count * 8 + chunks.size(), 8);
            chunks += (several ? int32Bytes(static_cast<int>(i)) : "") + chunk.place +
                      littleEndian(chunk.pixels.size(), 4) + chunk.pixels;
        }
    return bytes + offsets + chunks;
}

} // namespace gll::test
