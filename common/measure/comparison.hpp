// How many pixels of a frame differ from its reference, by how much, and where; and a name for its pixels.
#pragma once

#include "io/image.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace gll::measure {

// A code is one step of an 8-bit display value, 1/255. Linear light is measured in the same steps of the
// value that a display would be sent: up to 1 as sRGB encodes it, and beyond, where a display has no value,
// by the logarithm that goes on from there as steeply, so that one code is 0.9 % of such light. Samples that
// differ by less than a code differ by 1; those of which only one is a number, or infinite, by the most.
inline constexpr int most_codes = 255;

struct PixelDifference {
    int x = 0; // from the left
    int y = 0; // from the top
    int codes = 0;

    bool operator==(const PixelDifference&) const = default;
};

// A pixel differs by what the channel that differs most does.
struct Comparison {
    static constexpr std::size_t most_worst = 10;
    static constexpr int map_columns = 64;

    int width = 0;
    int height = 0;
    std::string incomparable;                         // why the two cannot be compared; else empty
    std::array<std::size_t, most_codes + 1> pixels{}; // how many differ by so many codes
    std::vector<PixelDifference> worst;               // at most ten, the worst first, then by row
    double rmse = 0;                                  // over all channels, of display values: a code is 1/255
    std::vector<int> cells;                           // the most codes of each cell of map()

    bool comparable() const { return incomparable.empty(); }
    bool identical() const { return comparable() && differing() == 0; }
    std::size_t total() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    std::size_t differing() const { return comparable() ? total() - pixels[0] : 0; }
    std::size_t differingByMoreThan(int codes) const;
    int largest() const { return worst.empty() ? 0 : worst.front().codes; }
    // "12 of 76800 pixels differ (0.016 %), 3 by more than 2 codes, the worst by 9 at (5,7)"
    std::string summary() const;
    // The worst pixels, and the frame in letters: '.' one code, ':' two, '+' to 8, '*' to 32, '#' more.
    std::string map() const;
};

// Sizes, channels, depth of samples and color space have to be the same, or the two are incomparable.
Comparison compare(const Image& reference, const Image& image);

// FNV-1a, 64 bits, of width, height and channels (four bytes each, low first) and then the pixels' bytes, of
// floats four each, low first; sixteen hexadecimal digits. Not against an adversary: it only names a picture.
std::string pixelHash(const Image& image);

} // namespace gll::measure
