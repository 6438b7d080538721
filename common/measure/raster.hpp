// Pictures as the measurements take them: pixels in double, made from the images that files hold.
// Row 0 is the top; the order matters to nothing here.
#pragma once

#include "io/image.hpp"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace gll::measure {

template <class Pixel>
struct Raster {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;

    Raster() = default;
    // Throws std::invalid_argument unless both sides are 1 or more.
    Raster(int w, int h, const Pixel& value = Pixel(0));
    Pixel& at(int x, int y) { return pixels[index(x, y)]; }
    const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

using ColorImage = Raster<glm::dvec3>; // RGB, BT.709 primaries
using ScalarImage = Raster<double>;

// The image's colours as linear light: sRGB is decoded (IEC 61966-2-1), linear stays as it is. Grey becomes
// R = G = B; alpha is left out. Throws std::invalid_argument for ColorSpace::data.
ColorImage linearColor(const Image& image);

// The image's colours as display values in [0, 1]: sRGB stays as it is, linear light is clamped to [0, 1] and
// encoded. Otherwise as linearColor().
ColorImage displayColor(const Image& image);

// The image's alpha in [0, 1]; 1 everywhere where it has none.
ScalarImage alpha(const Image& image);

// Throws std::runtime_error "name: pixel (x, y): red is nan, what to do" at the first sample that is infinite
// or not a number.
void requireFinite(const Image& image, const std::string& name);

// Throws std::invalid_argument "what: 3x2 and 4x2 pixels, ..." where the pictures' sizes differ or are 0, and
// "what: pixel (x, y) is not finite" where a colour is infinite or not a number: no mean can hide one.
void requireComparable(const char* what, const ColorImage& one, const ColorImage& other);

} // namespace gll::measure
