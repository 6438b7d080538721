// The bloom pyramid in double, written from its sources and not from the shaders.
#pragma once

#include "io/image.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gll::truth {

// Linear RGB in double; the rows' order does not matter, for every filter is symmetric.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> pixels;

    Plane() = default;
    Plane(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    glm::dvec3& at(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
    const glm::dvec3& at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
    // The nearest texel inside.
    const glm::dvec3& clamped(int x, int y) const {
        return at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    }
    // GL_LINEAR with GL_CLAMP_TO_EDGE at a place in texels; the first texel's centre is (0.5, 0.5).
    glm::dvec3 sample(double x, double y) const {
        const double left = std::floor(x - 0.5);
        const double top = std::floor(y - 0.5);
        const double fx = x - 0.5 - left;
        const double fy = y - 0.5 - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        return (clamped(i, j) * (1 - fx) + clamped(i + 1, j) * fx) * (1 - fy) +
               (clamped(i, j + 1) * (1 - fx) + clamped(i + 1, j + 1) * fx) * fy;
    }
};

// A plane of the size from a function of the place in the source, in texels of the source.
template <class Function>
Plane resampled(const Plane& source, int width, int height, const Function& function) {
    Plane result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.at(x, y) = function((x + 0.5) * source.width / width, (y + 0.5) * source.height / height);
    return result;
}

inline double luminance(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// smoothstep over threshold +- knee
inline double brightCurve(double luma, double at, double half_width) {
    if (half_width <= 0) return luma > at ? 1 : 0;
    const double t = std::clamp((luma - (at - half_width)) / (2 * half_width), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Jimenez 2014: the five boxes of the 13 taps, each the mean of four bilinear fetches; each weighs its share
// times 1 / (1 + luminance), and what they sum up to is divided by the weights.
inline glm::dvec3 partialKaris(const Plane& hdr, double x, double y, double at, double half_width) {
    glm::dvec3 sum(0);
    double weights = 0;
    for (const auto& [dx, dy, share] :
         {std::tuple(0, 0, 0.5), {-1, -1, 0.125}, {1, -1, 0.125}, {-1, 1, 0.125}, {1, 1, 0.125}}) {
        glm::dvec3 box(0);
        for (const double v : {-1.0, 1.0})
            for (const double u : {-1.0, 1.0})
                box += hdr.sample(x + dx + u, y + dy + v) / 4.0;
        const double weight = share / (1 + luminance(box));
        sum += box * weight * brightCurve(luminance(box), at, half_width);
        weights += weight;
    }
    return sum / weights;
}

// Throws std::invalid_argument for a Karis weight that is not here.
inline Plane bright(const Plane& hdr, int width, int height, const std::string& karis, double at,
                    double half_width) {
    return resampled(hdr, width, height, [&](double x, double y) {
        if (karis == "partial") return partialKaris(hdr, x, y, at, half_width);
        if (karis == "none" || karis == "average") {
            const glm::dvec3 mean = hdr.sample(x, y);
            const double luma = luminance(mean);
            return mean * brightCurve(luma, at, half_width) / (karis == "average" ? 1 + luma : 1);
        }
        if (karis != "texel") throw std::invalid_argument("there is no reference for karis=" + karis);
        const int i = static_cast<int>(std::floor(x - 0.5));
        const int j = static_cast<int>(std::floor(y - 0.5));
        glm::dvec3 sum(0);
        double weights = 0;
        for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const glm::dvec3 texel = hdr.clamped(i + dx, j + dy);
            const double luma = luminance(texel);
            const double share_x = 1 - std::abs(x - 0.5 - i - dx);
            const double share_y = 1 - std::abs(y - 0.5 - j - dy);
            sum += texel * share_x * share_y * brightCurve(luma, at, half_width) / (1 + luma);
            weights += share_x * share_y / (1 + luma);
        }
        return sum / weights;
    });
}

// A filter as a list of bilinear taps: offsets in texels, weight.
struct Tap {
    double x, y, weight;
};

// Throws std::invalid_argument for one that is not here.
inline std::vector<Tap> tapsOf(const std::string& filter) {
    std::vector<Tap> taps;
    const auto square = [&](double distance, double weight) { // the four corners of a square
        for (const double y : {-distance, distance})
            for (const double x : {-distance, distance})
                taps.push_back({x, y, weight});
    };
    const auto cross = [&](double distance, double weight) {
        for (const double d : {-distance, distance}) {
            taps.push_back({d, 0, weight});
            taps.push_back({0, d, weight});
        }
    };
    if (filter == "5tap") {
        taps = {{0, 0, 1 / 2.0}};
        square(1, 1 / 8.0);
    } else if (filter == "13tap") { // methods of Jimenez 2014: sums of five boxes
        taps = {{0, 0, 1 / 8.0}};
        square(1, 1 / 8.0);
        cross(2, 1 / 16.0);
        square(2, 1 / 32.0);
    } else if (filter == "13tap_as_printed") { // the boxes' shared taps counted twice, at half the distances
        taps = {{0, 0, 0.125}};
        square(0.5, 0.125);
        for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}}) {
            taps.push_back({2 * x, 2 * y, 1 / 16.0}); // its corner, and the edges beside it
            taps.push_back({2 * x, 0, 1 / 16.0});
            taps.push_back({0, 2 * y, 1 / 16.0});
        }
    } else if (filter == "dual up") { // Bjorge 2015, with half a texel as his halfpixel
        square(0.5, 2 / 12.0);
        cross(1, 1 / 12.0);
    } else if (filter == "4tap") {
        square(0.75, 1 / 4.0);
    } else if (filter == "tent") {
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                taps.push_back({double(x), double(y), (2 - std::abs(x)) * (2 - std::abs(y)) / 16.0});
    } else if (filter == "4tap up") {
        square(0.5, 1 / 4.0);
    } else if (filter == "box" || filter == "bilinear") {
        taps = {{0, 0, 1}};
    } else {
        throw std::invalid_argument("there is no reference for the filter " + filter);
    }
    return taps;
}

inline Plane filtered(const Plane& source, int width, int height, const std::string& filter) {
    const std::vector<Tap> taps = tapsOf(filter);
    return resampled(source, width, height, [&](double x, double y) {
        glm::dvec3 sum(0);
        for (const Tap& tap : taps)
            sum += source.sample(x + tap.x, y + tap.y) * tap.weight;
        return sum;
    });
}

inline Plane added(Plane left, const Plane& right) {
    for (std::size_t i = 0; i < left.pixels.size(); ++i)
        left.pixels[i] += right.pixels[i];
    return left;
}

inline std::string upName(const std::string& filter) {
    return filter == "4tap" || filter == "dual" ? filter + " up" : filter;
}

// The first three channels, as they are stored.
inline Plane planeOf(const Image& image) {
    Plane plane(image.width, image.height);
    const auto channels = static_cast<std::size_t>(image.channels);
    std::visit(
        [&](const auto& values) {
            for (std::size_t i = 0; i < plane.pixels.size(); ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    plane.pixels[i][static_cast<int>(c)] = values.at(i * channels + c);
        },
        image.pixels);
    return plane;
}

// The sum of (-1)^k (n choose k) (x + n/2 - k)^power over what is positive in the brackets, over power!. With
// n = degree + 1 it is a B-spline where power = degree, and the area left of x where power = n (Schoenberg
// 1946).
inline double truncatedPowers(int n, int power, double x) {
    double sum = 0;
    double coefficient = 1;
    for (int k = 0; k <= n; ++k) {
        sum += coefficient * std::pow(std::max(x + n / 2.0 - k, 0.0), power);
        coefficient *= -double(n - k) / (k + 1);
    }
    return sum / std::tgamma(power + 1);
}

// What a target texel takes from which source texels along one axis. Beyond the edges lies the mirror image.
using AxisWeights = std::vector<std::vector<std::pair<int, double>>>;

template <class Weight> // of a source texel's left edge and a target texel's centre, in source texels
AxisWeights axisWeights(int source, int target, double reach, const Weight& weight) {
    AxisWeights weights(static_cast<std::size_t>(target));
    for (int i = 0; i < target; ++i) {
        const double centre = (i + 0.5) * source / target;
        for (int texel = static_cast<int>(std::floor(centre - reach)); texel < centre + reach; ++texel) {
            const int place = (texel % (2 * source) + 2 * source) % (2 * source);
            weights[static_cast<std::size_t>(i)].emplace_back(std::min(place, 2 * source - 1 - place),
                                                              weight(texel, centre));
        }
    }
    return weights;
}

template <class Weights> // of source and target length
Plane weighed(const Plane& source, int width, int height, const Weights& weights) {
    const AxisWeights across = weights(source.width, width);
    const AxisWeights up = weights(source.height, height);
    Plane result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const auto& [j, weight_y] : up[static_cast<std::size_t>(y)])
                for (const auto& [i, weight_x] : across[static_cast<std::size_t>(x)])
                    result.at(x, y) += source.at(i, j) * (weight_x * weight_y);
    return result;
}

// Each source texel counts by the part of the target texel's spline that lies over it; or, in large sources,
// by the height of a linear spline of two texels a step.
inline Plane splineDown(const Plane& source, int width, int height, int degree) {
    const bool by_height = degree == 1 && std::min(source.width, source.height) >= 128;
    return weighed(source, width, height, [&](int from, int to) {
        const double ratio = double(from) / to;
        return axisWeights(from, to, (degree + 1) / 2.0 * ratio, [&](int texel, double centre) {
            if (by_height) return truncatedPowers(degree + 1, degree, (texel + 0.5 - centre) / ratio) / ratio;
            const auto area = [&](double edge) {
                return truncatedPowers(degree + 1, degree + 1, (edge - centre) / ratio);
            };
            return area(texel + 1) - area(texel);
        });
    });
}

// The cubic spline whose coefficients are the source's texels.
inline Plane splineUp(const Plane& source, int width, int height) {
    return weighed(source, width, height, [](int from, int to) {
        return axisWeights(from, to, 2.5, [](int texel, double centre) {
            return truncatedPowers(4, 3, centre - texel - 0.5);
        });
    });
}

// Nine literal taps of the Gaussian along one axis, radius texels apart.
inline Plane blurred(const Plane& source, double radius, bool along_x) {
    constexpr double weights[] = {0.2270270270, 0.1945945946, 0.1216216216, 0.0540540541, 0.0162162162};
    return resampled(source, source.width, source.height, [&](double x, double y) {
        glm::dvec3 sum(0);
        for (int k = -4; k <= 4; ++k)
            sum += source.sample(x + (along_x ? k * radius : 0), y + (along_x ? 0 : k * radius)) *
                   weights[std::abs(k)];
        return sum;
    });
}

} // namespace gll::truth
