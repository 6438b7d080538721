// Builds PNG files byte by byte, with correct checksums and uncompressed pixels: also such as no writer would
// make. After ISO/IEC 15948 (PNG) and RFC 1950/1951 (zlib, stored blocks).
#pragma once

#include <cstdint>
#include <string>

namespace gll::test {

inline std::string bigEndian32(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return bigEndian32(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian32(~crc);
}

// Rows: each a filter byte 0 and the row's samples; at most 65535 bytes. Colour types: 0 grey, 2 RGB, 3
// palette, 4 grey and alpha, 6 RGBA. Interlaced by Adam7, the rows are those of its passes.
inline std::string png(std::uint32_t width, std::uint32_t height, int bit_depth, int colour_type,
                       const std::string& rows, const std::string& chunks_before_rows = "",
                       bool interlaced = false) {
    std::uint32_t a = 1; // Adler-32
    std::uint32_t b = 0;
    for (const char c : rows) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto length = static_cast<std::uint32_t>(rows.size());
    std::string stored = "\x78\x01\x01";
    for (const std::uint32_t part : {length, ~length})
        for (const int shift : {0, 8})
            stored += static_cast<char>(part >> shift & 255);
    stored += rows + bigEndian32(b << 16 | a);
    std::string header = bigEndian32(width) + bigEndian32(height);
    header += static_cast<char>(bit_depth);
    header += static_cast<char>(colour_type);
    header += std::string(2, '\0') + (interlaced ? '\1' : '\0');
    return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + chunks_before_rows + pngChunk("IDAT", stored) +
           pngChunk("IEND", "");
}

} // namespace gll::test
