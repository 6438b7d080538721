// Builds a JPEG of 8x8 pixels by hand, all coefficients zero: every sample is 128. After ITU-T T.81.
#pragma once

#include <string>

namespace gll::test {

inline std::string jpegSegment(int marker, const std::string& data) {
    const std::size_t length = data.size() + 2;
    return std::string("\xff") + static_cast<char>(marker) + static_cast<char>(length >> 8) +
           static_cast<char>(length & 255) + data;
}

// Everything up to the end marker; `frame` is the kind of frame, 0xc0 the baseline.
inline std::string jpegWithoutEnd(int components, const std::string& first_segments = "", int frame = 0xc0) {
    using namespace std::string_literals;
    std::string frame_components;
    std::string scan_components;
    for (int i = 1; i <= components; ++i) {
        frame_components += static_cast<char>(i) + "\x11\x00"s;
        scan_components += static_cast<char>(i) + "\x00"s;
    }
    const std::string count(1, static_cast<char>(components));
    const std::string code_of_zero = "\x01"s + std::string(15, '\0') + "\0"s; // one code, '0'
    // Two codes '0' for each block, filled up with ones.
    const char blocks = static_cast<char>(0xff >> 2 * components);
    return "\xff\xd8"s + first_segments + jpegSegment(0xdb, "\0"s + std::string(64, '\x01')) +
           jpegSegment(frame, "\x08\x00\x08\x00\x08"s + count + frame_components) +
           jpegSegment(0xc4, "\x00"s + code_of_zero) + jpegSegment(0xc4, "\x10"s + code_of_zero) +
           jpegSegment(0xda, count + scan_components + "\x00\x3f\x00"s) + blocks;
}
inline std::string jpeg(int components, const std::string& first_segments = "") {
    return jpegWithoutEnd(components, first_segments) + "\xff\xd9";
}

} // namespace gll::test
