// The rules by which others decide whether two frames are the same, from their published definitions, beside
// our own. Each is a measure of two frames and a setting that it must not exceed, so that all can be tried at
// the same number of false alarms.
#pragma once

#include "io/image.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gll::test {

// Two frames of 8-bit RGB and the same size, and what several rules ask of them, found out once. Throws
// std::invalid_argument where they are not.
class Pair {
  public:
    Pair(const Image& reference, const Image& image);

    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t pixels() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }
    const Image& reference() const { return reference_; }
    const Image& image() const { return image_; }
    // Three codes.
    const std::uint8_t* referenceAt(int x, int y) const { return at(reference_, x, y); }
    const std::uint8_t* imageAt(int x, int y) const { return at(image_, x, y); }

    // The largest difference of a pixel's channels, of 1, by pixel.
    const std::vector<double>& differences() const { return differences_; }
    // FLIP by pixel, sorted, the smallest first.
    const std::vector<double>& sortedFlip() const;

  private:
    const std::uint8_t* at(const Image& image, int x, int y) const;

    const Image& reference_;
    const Image& image_;
    int width_;
    int height_;
    std::vector<double> differences_;
    mutable std::vector<double> flip_;
};

struct NamedRule {
    std::string name;
    std::string published;                      // its setting, in words
    std::string knob;                           // what is turned, for the setting of equal alarms
    double setting = 0;                         // the published value of the knob
    std::function<double(const Pair&)> measure; // the smallest value of the knob at which the two pass
};

// Ours first.
std::vector<NamedRule> namedRules();

// The parts that are worth a test of their own.

// The distance of two colors in YIQ, of 35215 at most: Kotsarenko and Ramos 2010, "Measuring perceived color
// difference using YIQ NTSC transmission color space in mobile applications".
double yiqDistance(const std::uint8_t* one, const std::uint8_t* other);
// Whether a pixel of the first image looks anti-aliased, with a look at the other: Vysniauskas 2009,
// "Anti-aliased pixel and intensity slope detector", as pixelmatch has it.
bool looksAntialiased(const Pair& pair, bool of_reference, int x, int y);
// The value below which lies a share of the sum of all values, each weighed by itself. Sorted, the smallest
// first.
double weightedPercentile(const std::vector<double>& sorted, double share);

} // namespace gll::test
