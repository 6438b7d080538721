// Comparing two 8-bit pictures: how many pixels differ and by how much, and the rule that goldens are held
// to.
#pragma once

#include "io/image.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gll::test {

// Measured on this ladder's kind of frames (58 shader mutants, three Mesa versions): a real bug moves many
// pixels by few codes, another Mesa moves few pixels by one code. So differing pixels are counted, and a few
// along edges may differ by more; but not by much, for then a pixel shows something else. A processor without
// AVX moves the worst of them by 8 codes.
constexpr std::size_t tolerated_differing_in = 200;  // one pixel in so many: 0.5 %
constexpr std::size_t tolerated_exceeding_in = 9600; // one pixel in so many: 8 of 320x240
constexpr int small_difference = 2;                  // codes of 255, the largest of a pixel's channels
constexpr int largest_tolerated = 16;                // codes: twice what was measured

struct PixelDifference {
    int x = 0;
    int y = 0;
    int codes = 0; // of 255, the largest of its channels'
};

struct Comparison {
    int width = 0;
    int height = 0;
    bool comparable = false;                // same size and channels, both 8-bit
    std::vector<PixelDifference> differing; // the worst first
    std::size_t exceeding = 0;              // of them, those by more than small_difference

    bool identical() const { return comparable && differing.empty(); }
    // At most 0.5 % of the pixels differ, at most one in 9600 by more than 2 codes, and none by more than 16.
    bool tolerable() const;
    // "12 of 76800 pixels differ (0.016 %), 3 by more than 2 codes, the worst by 9"
    std::string summary() const;
    // The worst pixels, and a map of the frame in letters: '.' one code, ':' two, '+' to 8, '*' to 32, '#'
    // more.
    std::string map() const;
};

Comparison compare(const Image& reference, const Image& image);

// The differences, 32 times as bright, grey where the pictures cannot be compared.
Image amplifiedDifference(const Image& reference, const Image& image);

// FNV-1a, 64 bits, of width, height and channels (four bytes each, low first) and then the pixels' bytes;
// sixteen hexadecimal digits. Not against an adversary: it only names a picture.
std::string pixelHash(const Image& image);

} // namespace gll::test
