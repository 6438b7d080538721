// Where the numbers are from stands beside each rule.
#include "mutation/rules.hpp"

#include "frame_check/rule.hpp"
#include "measure/flip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace gll::test {
namespace {

constexpr int channels = 3;
constexpr double white = 255;
constexpr double most_yiq = 35215;

// Where the largest share of the pixels may fail, the difference that the next one has.
double differenceBeyond(const Pair& pair, double share) {
    std::vector<double> differences = pair.differences();
    const auto place =
        static_cast<std::size_t>(share * static_cast<double>(differences.size()) * (1 + 1e-12));
    std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(place),
                     differences.end(), std::greater<>());
    return differences[place];
}

double brightness(const std::uint8_t* color) {
    return 0.29889531 * color[0] + 0.58662247 * color[1] + 0.11448223 * color[2];
}

// Calls for the up to eight pixels around one; returns whether it lies at the edge of the frame.
template <class Call>
bool around(const Pair& pair, int x, int y, const Call& call) {
    for (int other_y = std::max(y - 1, 0); other_y <= std::min(y + 1, pair.height() - 1); ++other_y)
        for (int other_x = std::max(x - 1, 0); other_x <= std::min(x + 1, pair.width() - 1); ++other_x)
            if (other_x != x || other_y != y) call(other_x, other_y);
    return x == 0 || y == 0 || x == pair.width() - 1 || y == pair.height() - 1;
}

const std::uint8_t* colorAt(const Pair& pair, bool of_reference, int x, int y) {
    return of_reference ? pair.referenceAt(x, y) : pair.imageAt(x, y);
}

// Three or more of the pixels around have its very color; the edge of the frame counts as one.
bool isPartOfAnArea(const Pair& pair, bool of_reference, int x, int y) {
    const std::uint8_t* color = colorAt(pair, of_reference, x, y);
    int equal = 0;
    const bool at_edge = around(pair, x, y, [&](int other_x, int other_y) {
        equal += std::equal(color, color + channels, colorAt(pair, of_reference, other_x, other_y)) ? 1 : 0;
    });
    return equal + (at_edge ? 1 : 0) > 2;
}

// The pixels that differ, the worst first, by the index of the pixel.
std::vector<std::size_t> worstFirst(const Pair& pair, const std::vector<double>& by) {
    std::vector<std::size_t> order(pair.pixels());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::erase_if(order, [&](std::size_t i) { return by[i] == 0; });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return by[a] > by[b]; });
    return order;
}

// pixelmatch and odiff: a pixel differs where its distance is above 35215 threshold^2, and none may.
// pixelmatch leaves out those that look anti-aliased in either frame; odiff does so only where it is asked
// to.
double yiqThreshold(const Pair& pair, bool skips_antialiased) {
    std::vector<double> distances(pair.pixels());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const auto [y, x] = std::div(static_cast<int>(i), pair.width());
        distances[i] = yiqDistance(pair.referenceAt(x, y), pair.imageAt(x, y));
    }
    for (const std::size_t i : worstFirst(pair, distances)) {
        const auto [y, x] = std::div(static_cast<int>(i), pair.width());
        if (!skips_antialiased ||
            (!looksAntialiased(pair, true, x, y) && !looksAntialiased(pair, false, x, y)))
            return std::sqrt(distances[i] / most_yiq);
    }
    return 0;
}

double channelDifference(const double* one, const double* other) {
    double largest = 0;
    for (int c = 0; c < channels; ++c)
        largest = std::max(largest, std::abs(one[c] - other[c]));
    return largest / white;
}

// The mean of the pixels at most two away, which go on beyond the edges.
void meanAround(const Pair& pair, bool of_reference, int x, int y, double* mean) {
    std::fill(mean, mean + channels, 0.0);
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const std::uint8_t* color = colorAt(pair, of_reference, std::clamp(x + dx, 0, pair.width() - 1),
                                                std::clamp(y + dy, 0, pair.height() - 1));
            for (int c = 0; c < channels; ++c)
                mean[c] += color[c] / 25.0;
        }
}

// Filament's imagediff, the example of its README: each pixel is within 0.05 of the reference's or of one of
// those around that (which takes in its first clause, within 0.01 of the reference's), or its mean of 5x5 is
// within 0.02. The factor by which both would have to be wider.
double shiftOrBlur(const Pair& pair) {
    double factor = 0;
    for (const std::size_t i : worstFirst(pair, pair.differences())) {
        double here = pair.differences()[i] / 0.05;
        if (here <= factor) break; // so are all that follow
        const auto [y, x] = std::div(static_cast<int>(i), pair.width());
        double means[2][channels];
        meanAround(pair, true, x, y, means[0]);
        meanAround(pair, false, x, y, means[1]);
        here = std::min(here, channelDifference(means[0], means[1]) / 0.02);
        const std::uint8_t* color = pair.imageAt(x, y);
        around(pair, x, y, [&](int other_x, int other_y) {
            const std::uint8_t* other = pair.referenceAt(other_x, other_y);
            int largest = 0;
            for (int c = 0; c < channels; ++c)
                largest = std::max(largest, std::abs(color[c] - other[c]));
            here = std::min(here, largest / white / 0.05);
        });
        factor = std::max(factor, here);
    }
    return factor;
}

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

Pair::Pair(const Image& reference, const Image& image)
    : reference_(reference), image_(image), width_(image.width), height_(image.height) {
    for (const Image* one : {&reference, &image})
        if (one->width != width_ || one->height != height_ || one->channels != channels ||
            !std::holds_alternative<std::vector<std::uint8_t>>(one->pixels))
            throw std::invalid_argument("Pair: wants two frames of 8-bit RGB, of the same size");
    differences_.resize(pixels());
    for (std::size_t i = 0; i < differences_.size(); ++i) {
        const auto [y, x] = std::div(static_cast<int>(i), width_);
        int largest = 0;
        for (int c = 0; c < channels; ++c)
            largest = std::max(largest, std::abs(referenceAt(x, y)[c] - imageAt(x, y)[c]));
        differences_[i] = largest / white;
    }
}

const std::uint8_t* Pair::at(const Image& image, int x, int y) const {
    const auto index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    return std::get<std::vector<std::uint8_t>>(image.pixels).data() + channels * index;
}

const std::vector<double>& Pair::sortedFlip() const {
    if (flip_.empty()) {
        flip_ = measure::flipMap(image_, reference_).pixels;
        std::sort(flip_.begin(), flip_.end());
    }
    return flip_;
}

double yiqDistance(const std::uint8_t* one, const std::uint8_t* other) {
    const double r = one[0] - other[0];
    const double g = one[1] - other[1];
    const double b = one[2] - other[2];
    const double y = 0.29889531 * r + 0.58662247 * g + 0.11448223 * b;
    const double i = 0.59597799 * r - 0.27417610 * g - 0.32180189 * b;
    const double q = 0.21147017 * r - 0.52261711 * g + 0.31114694 * b;
    return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q;
}

bool looksAntialiased(const Pair& pair, bool of_reference, int x, int y) {
    struct Place {
        int x = 0;
        int y = 0;
        double difference = 0;
    };
    const double here = brightness(colorAt(pair, of_reference, x, y));
    Place darkest;
    Place brightest;
    int equal = 0;
    const bool at_edge = around(pair, x, y, [&](int other_x, int other_y) {
        const double difference = brightness(colorAt(pair, of_reference, other_x, other_y)) - here;
        equal += difference == 0 ? 1 : 0;
        if (difference < darkest.difference) darkest = {other_x, other_y, difference};
        if (difference > brightest.difference) brightest = {other_x, other_y, difference};
    });
    if (equal + (at_edge ? 1 : 0) > 2) return false;                        // a part of an area itself
    if (darkest.difference == 0 || brightest.difference == 0) return false; // between nothing
    const auto is_area = [&](const Place& place) {
        return isPartOfAnArea(pair, true, place.x, place.y) && isPartOfAnArea(pair, false, place.x, place.y);
    };
    return is_area(darkest) || is_area(brightest);
}

double weightedPercentile(const std::vector<double>& sorted, double share) {
    const double wanted = share * std::accumulate(sorted.begin(), sorted.end(), 0.0);
    double sum = 0;
    for (const double value : sorted) {
        sum += value;
        if (sum >= wanted && value > 0) return value;
    }
    return 0;
}

std::vector<NamedRule> namedRules() {
    return {
        {"**frame_check**, `count`",
         "0.5 % of the pixels differ, one in 9600 by more than 2 codes, none by more than 16", "", 0,
         [](const Pair& pair) {
             const frame_check::Measurement measurement{.comparison =
                                                            measure::compare(pair.reference(), pair.image())};
             return frame_check::satisfies(frame_check::Rule{}, measurement) ? 0.0 : 1.0;
         }},
        {"frame_check, `exact`", "no pixel differs", "", 0,
         [](const Pair& pair) { return differenceBeyond(pair, 0); }},
        // Blender, tests/python/modules/render_report.py: fail_threshold = 0.016, fail_percent = 1, handed to
        // OpenImageIO's comparison, which counts pixels of which a channel differs by more.
        {"[Blender](https://projects.blender.org/blender/blender), OpenImageIO's `idiff`",
         "-fail 0.016 -failpercent 1", "-fail", 0.016,
         [](const Pair& pair) { return differenceBeyond(pair, 0.01); }},
        // Filament, tools/diffimg/README.md: maxAbsDiff 0.01, maxFailingPixelsFraction 0.05. Without a
        // configuration, both are 0: `exact`.
        {"[Filament](https://github.com/google/filament), `diffimg`",
         "maxAbsDiff 0.01, maxFailingPixelsFraction 0.05", "maxAbsDiff", 0.01,
         [](const Pair& pair) { return differenceBeyond(pair, 0.05); }},
        // Filament, libs/imagediff/README.md.
        {"Filament, `imagediff` with shift and blur",
         "0.05, also one pixel away, or 0.02 of the means of 5x5", "both, times", 1, shiftOrBlur},
        // pixelmatch's README: threshold 0.1, includeAA false.
        {"[pixelmatch](https://github.com/mapbox/pixelmatch)", "threshold 0.1, anti-aliased pixels left out",
         "threshold", 0.1, [](const Pair& pair) { return yiqThreshold(pair, true); }},
        // odiff --help: threshold 0.1, --antialiasing off.
        {"[odiff](https://github.com/dmtrKovalenko/odiff)", "threshold 0.1", "threshold", 0.1,
         [](const Pair& pair) { return yiqThreshold(pair, false); }},
        // wgpu has no usual setting: tests/src/image.rs recommends [0.01, 0.1]. Of its deferred-rendering
        // example: Mean(0.02).
        {"[wgpu](https://github.com/gfx-rs/wgpu), deferred rendering", "mean of FLIP 0.02", "mean", 0.02,
         [](const Pair& pair) { return meanOf(pair.sortedFlip()); }},
        // Of its example bunnymark, for "very small differences": Mean(0.05) and Percentile {0.99, 0.37}.
        {"wgpu, bunnymark", "mean of FLIP 0.05, and the 99th percentile, weighed by FLIP, 0.37",
         "both, times", 1,
         [](const Pair& pair) {
             const std::vector<double>& flip = pair.sortedFlip();
             return std::max(meanOf(flip) / 0.05, weightedPercentile(flip, 0.99) / 0.37);
         }},
    };
}

} // namespace gll::test
