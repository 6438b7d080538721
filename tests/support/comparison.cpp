// Counting differing pixels.
#include "support/comparison.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace gll::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes* bytesOf(const Image& image) { return std::get_if<Bytes>(&image.pixels); }

bool areComparable(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels && bytesOf(a) != nullptr &&
           bytesOf(b) != nullptr;
}

char letter(int codes) {
    if (codes == 0) return ' ';
    if (codes == 1) return '.';
    if (codes == 2) return ':';
    if (codes <= 8) return '+';
    return codes <= 32 ? '*' : '#';
}

} // namespace

bool Comparison::tolerable() const {
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return comparable && differing.size() * tolerated_differing_in <= pixels &&
           exceeding * tolerated_exceeding_in <= pixels &&
           (differing.empty() || differing.front().codes <= largest_tolerated);
}

std::string Comparison::summary() const {
    if (!comparable) return "another size, or another number of channels";
    const double pixels = double(width) * double(height);
    char text[160];
    std::snprintf(text, sizeof text,
                  "%zu of %.0f pixels differ (%.3f %%), %zu by more than %d codes, the worst by %d",
                  differing.size(), pixels, 100 * static_cast<double>(differing.size()) / pixels, exceeding,
                  small_difference, differing.empty() ? 0 : differing.front().codes);
    return text;
}

std::string Comparison::map() const {
    if (!comparable || differing.empty()) return "";
    constexpr std::size_t shown_pixels = 8;
    constexpr int columns = 64;
    std::string text = "worst:";
    for (std::size_t i = 0; i < std::min(shown_pixels, differing.size()); ++i)
        text += " (" + std::to_string(differing[i].x) + "," + std::to_string(differing[i].y) + ") by " +
                std::to_string(differing[i].codes);
    text += "\n";
    const int map_width = std::min(columns, width);
    // A letter is twice as high as it is wide.
    const int map_height = std::clamp(map_width * height / (2 * width), 1, height);
    std::vector<int> cells(static_cast<std::size_t>(map_width) * static_cast<std::size_t>(map_height), 0);
    for (const PixelDifference& pixel : differing) {
        int& cell = cells[static_cast<std::size_t>(pixel.y * map_height / height * map_width +
                                                   pixel.x * map_width / width)];
        cell = std::max(cell, pixel.codes);
    }
    for (std::size_t y = 0; y < static_cast<std::size_t>(map_height); ++y) {
        text += "|";
        for (std::size_t x = 0; x < static_cast<std::size_t>(map_width); ++x)
            text += letter(cells[y * static_cast<std::size_t>(map_width) + x]);
        text += "|\n";
    }
    return text;
}

Comparison compare(const Image& reference, const Image& image) {
    Comparison result;
    result.width = image.width;
    result.height = image.height;
    result.comparable = areComparable(reference, image);
    if (!result.comparable) return result;
    const Bytes& a = *bytesOf(reference);
    const Bytes& b = *bytesOf(image);
    std::size_t at = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            int codes = 0;
            for (int channel = 0; channel < image.channels; ++channel, ++at)
                codes = std::max(codes, std::abs(int(a[at]) - int(b[at])));
            if (codes == 0) continue;
            result.differing.push_back({x, y, codes});
            if (codes > small_difference) ++result.exceeding;
        }
    std::stable_sort(result.differing.begin(), result.differing.end(),
                     [](const auto& one, const auto& other) { return one.codes > other.codes; });
    return result;
}

Image amplifiedDifference(const Image& reference, const Image& image) {
    constexpr int amplification = 32;
    Image result = image;
    Bytes pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                     static_cast<std::size_t>(image.channels),
                 128);
    if (areComparable(reference, image))
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<std::uint8_t>(std::min(
                255, std::abs(int((*bytesOf(reference))[i]) - int((*bytesOf(image))[i])) * amplification));
    result.pixels = std::move(pixels);
    return result;
}

std::string pixelHash(const Image& image) {
    std::uint64_t hash = 0xcbf29ce484222325; // the offset basis and prime of FNV-1a, Fowler, Noll and Vo
    const auto add = [&hash](std::uint8_t byte) { hash = (hash ^ byte) * 0x100000001b3; };
    for (const int number : {image.width, image.height, image.channels})
        for (int shift = 0; shift < 32; shift += 8)
            add(static_cast<std::uint8_t>(static_cast<unsigned>(number) >> shift));
    if (const Bytes* bytes = bytesOf(image))
        for (const std::uint8_t byte : *bytes)
            add(byte);
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace gll::test
