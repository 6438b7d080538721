// Pictures from images: each sample in double, decoded or encoded once.
#include "measure/raster.hpp"

#include "measure/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace gll::measure {
namespace {

constexpr int byte_values = 256;

std::string place(int x, int y) { return "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")"; }

void requireColor(const Image& image) {
    if (image.color_space == ColorSpace::data)
        throw std::invalid_argument("this image holds data, give one that holds colours");
}

// A picture from the samples of each pixel; `samples` turns one byte or float of the image into a number.
template <class Function>
ColorImage colors(const Image& image, const Function& number) {
    ColorImage result(image.width, image.height);
    const auto channels = static_cast<std::size_t>(image.channels);
    const bool grey = image.channels < 3;
    std::visit(
        [&](const auto& samples) {
            for (std::size_t i = 0; i < result.pixels.size(); ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    result.pixels[i][static_cast<int>(c)] = number(samples[i * channels + (grey ? 0 : c)]);
        },
        image.pixels);
    return result;
}

// The function of floats, and a table of it for bytes: power functions for millions of samples take seconds.
template <class Function>
struct ByTable {
    explicit ByTable(Function f) : function(f) {
        for (int code = 0; code < byte_values; ++code)
            table[static_cast<std::size_t>(code)] = function(code / 255.0);
    }
    double operator()(std::uint8_t code) const { return table[code]; }
    double operator()(float value) const { return function(value); }

    Function function;
    std::array<double, byte_values> table{};
};

} // namespace

template <class Pixel>
Raster<Pixel>::Raster(int w, int h, const Pixel& value) : width(w), height(h) {
    if (w < 1 || h < 1)
        throw std::invalid_argument("a picture of " + std::to_string(w) + "x" + std::to_string(h) +
                                    " pixels, make both sides 1 or more");
    pixels.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value);
}
template struct Raster<double>;
template struct Raster<glm::dvec3>;

ColorImage linearColor(const Image& image) {
    requireColor(image);
    if (image.color_space == ColorSpace::srgb) return colors(image, ByTable(srgbDecoded));
    return colors(image, ByTable([](double value) { return value; }));
}

ColorImage displayColor(const Image& image) {
    requireColor(image);
    if (image.color_space == ColorSpace::srgb)
        return colors(image, ByTable([](double value) { return value; }));
    return colors(image, ByTable([](double value) { return srgbEncoded(std::clamp(value, 0.0, 1.0)); }));
}

ScalarImage alpha(const Image& image) {
    ScalarImage result(image.width, image.height, 1);
    if (image.channels != 2 && image.channels != 4) return result;
    const auto channels = static_cast<std::size_t>(image.channels);
    const bool bytes = std::holds_alternative<std::vector<std::uint8_t>>(image.pixels);
    std::visit(
        [&](const auto& samples) {
            for (std::size_t i = 0; i < result.pixels.size(); ++i)
                result.pixels[i] = samples[i * channels + channels - 1] / (bytes ? 255.0 : 1.0);
        },
        image.pixels);
    return result;
}

void requireFinite(const Image& image, const std::string& name) {
    const auto* samples = std::get_if<std::vector<float>>(&image.pixels);
    if (samples == nullptr) return;
    const auto bad =
        std::find_if_not(samples->begin(), samples->end(), [](float v) { return std::isfinite(v); });
    if (bad == samples->end()) return;
    const auto at = static_cast<int>((bad - samples->begin()) / image.channels);
    const auto channel = static_cast<std::size_t>((bad - samples->begin()) % image.channels);
    constexpr const char* color_names[] = {"red", "green", "blue", "alpha"};
    constexpr const char* grey_names[] = {"grey", "alpha"};
    throw std::runtime_error(name + ": " + place(at % image.width, at / image.width) + ": " +
                             (image.channels < 3 ? grey_names[channel] : color_names[channel]) + " is " +
                             (std::isnan(*bad) ? "nan" : "infinite") +
                             ", mend what rendered it: no error can be computed from that");
}

void requireComparable(const char* what, const ColorImage& one, const ColorImage& other) {
    const auto size = [](const ColorImage& image) {
        return std::to_string(image.width) + "x" + std::to_string(image.height);
    };
    if (one.width != other.width || one.height != other.height || one.pixels.empty())
        throw std::invalid_argument(std::string(what) + ": " + size(one) + " and " + size(other) +
                                    " pixels, give two pictures of one size");
    for (const ColorImage* image : {&one, &other}) {
        const auto bad = std::find_if(image->pixels.begin(), image->pixels.end(), [](const glm::dvec3& c) {
            return !(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
        });
        if (bad == image->pixels.end()) continue;
        const auto at = static_cast<int>(bad - image->pixels.begin());
        throw std::invalid_argument(std::string(what) + ": " + place(at % image->width, at / image->width) +
                                    " is not finite, look for such pixels first");
    }
}

} // namespace gll::measure
