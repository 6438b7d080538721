// Counting differing pixels.
#include "measure/comparison.hpp"

#include "measure/color.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace gll::measure {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

constexpr int small_difference = 2; // codes, for people: what another version of a driver does

std::string kindOf(const Image& image) {
    const bool bytes = std::holds_alternative<Bytes>(image.pixels);
    const char* space = image.color_space == ColorSpace::linear ? "linear light" : "display values";
    return std::to_string(image.width) + "x" + std::to_string(image.height) + ", " +
           std::to_string(image.channels) + (image.channels == 1 ? " channel" : " channels") + " of " +
           (bytes ? "8-bit " : "float ") + space;
}

// Of linear light, in codes.
double codeOf(float light) {
    // The slope of sRGB's curve at 1: 1.055 / 2.4.
    constexpr double slope = 1.055 / 2.4;
    const double x = std::abs(static_cast<double>(light));
    const double code = most_codes * (x <= 1 ? srgbEncoded(x) : 1 + slope * std::log(x));
    return light < 0 ? -code : code;
}

// How far two samples of a kind are apart, in codes; exactly 0 where they are the same.
struct ByteDistance {
    double operator()(std::uint8_t a, std::uint8_t b) const { return std::abs(int(a) - int(b)); }
};
struct FloatDistance {
    bool is_linear;
    double operator()(float a, float b) const {
        if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
        if (!std::isfinite(a) || !std::isfinite(b)) return most_codes;
        return is_linear ? std::abs(codeOf(a) - codeOf(b)) : most_codes * std::abs(double(a) - double(b));
    }
};

// A letter is twice as high as it is wide.
int mapWidth(const Comparison& result) { return std::min(Comparison::map_columns, result.width); }
int mapHeight(const Comparison& result) {
    return std::clamp(mapWidth(result) * result.height / (2 * result.width), 1, result.height);
}

bool isWorse(const PixelDifference& one, const PixelDifference& other) { return one.codes > other.codes; }

template <class Samples, class Distance>
void count(const Samples& a, const Samples& b, int channels, const Distance& distance, Comparison& result) {
    const int columns = mapWidth(result);
    const int rows = mapHeight(result);
    result.cells.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    const std::size_t row_samples =
        static_cast<std::size_t>(result.width) * static_cast<std::size_t>(channels);
    double squares = 0;
    for (int y = 0; y < result.height; ++y) {
        std::size_t at = static_cast<std::size_t>(y) * row_samples;
        if (std::memcmp(&a[at], &b[at], row_samples * sizeof a[0]) == 0) {
            result.pixels[0] += static_cast<std::size_t>(result.width);
            continue;
        }
        for (int x = 0; x < result.width; ++x) {
            double largest = 0;
            for (int channel = 0; channel < channels; ++channel, ++at) {
                const double codes = distance(a[at], b[at]);
                squares += codes * codes;
                largest = std::max(largest, codes);
            }
            const int codes = static_cast<int>(std::min<double>(std::ceil(largest), most_codes));
            ++result.pixels[static_cast<std::size_t>(codes)];
            if (codes == 0) continue;
            int& cell = result.cells[static_cast<std::size_t>(y * rows / result.height * columns +
                                                              x * columns / result.width)];
            cell = std::max(cell, codes);
            const PixelDifference pixel{x, y, codes};
            if (result.worst.size() == Comparison::most_worst) {
                if (!isWorse(pixel, result.worst.back())) continue;
                result.worst.pop_back();
            }
            result.worst.insert(std::upper_bound(result.worst.begin(), result.worst.end(), pixel, isWorse),
                                pixel);
        }
    }
    result.rmse = std::sqrt(squares / static_cast<double>(a.size())) / most_codes;
}

char letter(int codes) {
    if (codes == 0) return ' ';
    if (codes == 1) return '.';
    if (codes == 2) return ':';
    if (codes <= 8) return '+';
    return codes <= 32 ? '*' : '#';
}

} // namespace

std::size_t Comparison::differingByMoreThan(int codes) const {
    std::size_t count = 0;
    for (auto i = static_cast<std::size_t>(codes) + 1; i < pixels.size(); ++i)
        count += pixels[i];
    return count;
}

std::string Comparison::summary() const {
    if (!comparable()) return incomparable;
    if (identical()) return "no pixel differs";
    char text[200];
    std::snprintf(text, sizeof text,
                  "%zu of %zu pixels differ (%.3f %%), %zu by more than %d codes, the worst by %d at (%d,%d)",
                  differing(), total(), 100 * double(differing()) / double(total()),
                  differingByMoreThan(small_difference), small_difference, largest(), worst.front().x,
                  worst.front().y);
    return text;
}

std::string Comparison::map() const {
    if (!comparable() || identical()) return "";
    std::string text = "worst:";
    for (const PixelDifference& pixel : worst)
        text += " (" + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + ") by " +
                std::to_string(pixel.codes);
    text += "\n";
    const auto columns = static_cast<std::size_t>(mapWidth(*this));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i % columns == 0) text += "|";
        text += letter(cells[i]);
        if (i % columns == columns - 1) text += "|\n";
    }
    return text;
}

Comparison compare(const Image& reference, const Image& image) {
    Comparison result;
    result.width = image.width;
    result.height = image.height;
    if (const std::string here = kindOf(image), there = kindOf(reference); here != there) {
        result.incomparable = "is " + here + ", the reference is " + there;
        return result;
    }
    if (const auto* bytes = std::get_if<Bytes>(&image.pixels))
        count(std::get<Bytes>(reference.pixels), *bytes, image.channels, ByteDistance{}, result);
    else
        count(std::get<Floats>(reference.pixels), std::get<Floats>(image.pixels), image.channels,
              FloatDistance{image.color_space == ColorSpace::linear}, result);
    return result;
}

std::string pixelHash(const Image& image) {
    std::uint64_t hash = 0xcbf29ce484222325; // the offset basis and prime of FNV-1a, Fowler, Noll and Vo
    const auto add = [&hash](std::uint8_t byte) { hash = (hash ^ byte) * 0x100000001b3; };
    const auto addFour = [&add](std::uint32_t number) {
        for (int shift = 0; shift < 32; shift += 8)
            add(static_cast<std::uint8_t>(number >> shift));
    };
    for (const int number : {image.width, image.height, image.channels})
        addFour(static_cast<std::uint32_t>(number));
    if (const auto* bytes = std::get_if<Bytes>(&image.pixels))
        for (const std::uint8_t byte : *bytes)
            add(byte);
    else
        for (const float sample : std::get<Floats>(image.pixels))
            addFour(std::bit_cast<std::uint32_t>(sample));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace gll::measure
