// Constants and names are those of Andersson et al. 2020, and of 2021 where exposures and tone are concerned.
#include "measure/flip.hpp"

#include "measure/color.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace gll::measure {
namespace {

using Taps = std::vector<double>; // an odd number of weights, the middle one at the pixel itself

// The contrast sensitivity of the opponent channels as sums of Gaussians; in space
// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
constexpr double b_achromatic = 0.0047;
constexpr double b_red_green = 0.0053;
constexpr double a1_blue_yellow = 34.1;
constexpr double b1_blue_yellow = 0.04; // the widest
constexpr double a2_blue_yellow = 13.5;
constexpr double b2_blue_yellow = 0.025;

// The exponents and the knee of the error's curve, and the feature filters' width.
constexpr double q_c = 0.7;
constexpr double p_c = 0.4;
constexpr double p_t = 0.95;
constexpr double feature_width_deg = 0.082; // from the peak to the trough of the eye's edge detector
constexpr double q_f = 0.5;

// HDR-FLIP's tone curve: Narkowicz's fit with his exposure of 0.6 taken back.
constexpr double k0 = 0.6 * 0.6 * 2.51;
constexpr double k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43;
constexpr double k4 = 0.6 * 0.59;
constexpr double k5 = 0.14;
constexpr double exposed_to = 0.85; // display light that the largest and the median luminance become

double tone(double x) { return std::clamp((k0 * x + k1) * x / ((k3 * x + k4) * x + k5), 0.0, 1.0); }

// The light that tone() makes t of.
double toneInverse(double t) {
    const double p = (k1 - k4 * t) / (k0 - k3 * t) / 2;
    return -p + std::sqrt(p * p + k5 * t / (k0 - k3 * t));
}

Taps gaussian(double sigma_px, int radius) {
    Taps taps;
    for (int x = -radius; x <= radius; ++x)
        taps.push_back(std::exp(-x * x / (2 * sigma_px * sigma_px)));
    return taps;
}

double sum(const Taps& taps) { return std::accumulate(taps.begin(), taps.end(), 0.0); }

Taps scaled(Taps taps, double factor) {
    for (double& tap : taps)
        tap *= factor;
    return taps;
}

Taps normalized(const Taps& taps) { return scaled(taps, 1 / sum(taps)); }

// Without the outer weights that, against the middle one, would change nothing that is printed.
Taps trimmed(Taps taps) {
    constexpr double negligible = 1e-12;
    while (taps.size() > 1 && taps.front() < negligible * taps[taps.size() / 2]) {
        taps.erase(taps.begin());
        taps.pop_back();
    }
    return taps;
}

// Positive weights to the sum 1 and negative ones to -1, so that a step from black to white is an edge of 1.
Taps balanced(Taps taps) {
    double positive = 0;
    double negative = 0;
    for (const double tap : taps)
        (tap > 0 ? positive : negative) += std::abs(tap);
    for (double& tap : taps)
        tap /= tap > 0 ? positive : negative;
    return taps;
}

// All filters of one viewing distance. Each is a product of one in x and one in y, or a sum of two such, as
// they come from Gaussians; and as one factor is positive, so is normalising.
struct Filters {
    Taps achromatic;
    Taps red_green;
    std::array<Taps, 2> blue_yellow_down; // the two Gaussians; their shares are in these
    std::array<Taps, 2> blue_yellow_across;
    Taps feature_smooth;
    Taps feature_edge;  // first derivative
    Taps feature_point; // second derivative

    explicit Filters(double pixels_per_degree) {
        const auto sigmaPx = [&](double b) {
            return std::sqrt(b / 2) / std::numbers::pi * pixels_per_degree;
        };
        const int radius = static_cast<int>(std::ceil(3 * sigmaPx(b1_blue_yellow)));
        achromatic = normalized(trimmed(gaussian(sigmaPx(b_achromatic), radius)));
        red_green = normalized(trimmed(gaussian(sigmaPx(b_red_green), radius)));
        const Taps wide = gaussian(sigmaPx(b1_blue_yellow), radius);
        const Taps narrow = gaussian(sigmaPx(b2_blue_yellow), radius);
        const double wide_share = a1_blue_yellow / std::sqrt(b1_blue_yellow);
        const double narrow_share = a2_blue_yellow / std::sqrt(b2_blue_yellow);
        const double whole = wide_share * sum(wide) * sum(wide) + narrow_share * sum(narrow) * sum(narrow);
        blue_yellow_across = {wide, narrow};
        blue_yellow_down = {scaled(wide, wide_share / whole), scaled(narrow, narrow_share / whole)};

        const double sigma = feature_width_deg / 2 * pixels_per_degree;
        const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
        feature_smooth = gaussian(sigma, feature_radius);
        feature_edge = feature_smooth;
        feature_point = feature_smooth;
        for (int x = -feature_radius; x <= feature_radius; ++x) {
            const auto i = static_cast<std::size_t>(x + feature_radius);
            feature_edge[i] *= -x;
            feature_point[i] *= x * x / (sigma * sigma) - 1;
        }
        feature_smooth = normalized(feature_smooth);
        feature_edge = balanced(feature_edge);
        feature_point = balanced(feature_point);
    }
};

// One channel of a picture, row after row.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;

    const double* row(int y) const {
        return values.data() +
               static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width);
    }
};

// Twice as many columns at a time where the processor can; each in the same order, so that no bit changes.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GLL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define GLL_WIDE
#endif

// Four columns at once, in the vectors that compilers for this project have.
using Four = double __attribute__((vector_size(32)));
using FourBits = std::uint64_t __attribute__((vector_size(32)));
#define GLL_INLINE inline __attribute__((always_inline)) // so that it is compiled for its caller's processor

template <class To, class From>
GLL_INLINE void castBits(const From& from, To& to) {
    static_assert(sizeof to == sizeof from);
    std::memcpy(&to, &from, sizeof to);
}

// out = one where the mask is set, else other. A comparison of Fours makes such a mask.
template <class Mask>
GLL_INLINE void choose(const Mask& mask, const Four& one, const Four& other, Four& out) {
    FourBits bits;
    FourBits ones;
    FourBits others;
    castBits(mask, bits);
    castBits(one, ones);
    castBits(other, others);
    castBits((ones & bits) | (others & ~bits), out);
}

// Doubles of 2^52 and more hold whole numbers in their low bits.
constexpr double two_52 = 4503599627370496.0;

// x to the power y for normal x > 0 and |y log2(x)| < 1000, to 1e-11 of itself: exp2(y log2(x)), both by
// their series, the logarithm's in (m - 1) / (m + 1).
GLL_INLINE void power(const Four& x, const Four& y, Four& out) {
    FourBits bits;
    castBits(x, bits);
    Four exponent;
    castBits((bits >> 52) | std::bit_cast<std::uint64_t>(two_52), exponent);
    exponent -= two_52 + 1023;
    Four mantissa; // from 1 to 2, then from sqrt(1/2) to sqrt(2)
    castBits((bits & 0x000f'ffff'ffff'ffffU) | 0x3ff0'0000'0000'0000U, mantissa);
    const auto is_large = mantissa > std::numbers::sqrt2;
    choose(is_large, exponent + 1, exponent, exponent);
    choose(is_large, mantissa * 0.5, mantissa, mantissa);
    const Four s = (mantissa - 1) / (mantissa + 1);
    const Four s2 = s * s;
    Four series = s2 * (1 / 15.0) + 1 / 13.0;
    for (const double divisor : {11.0, 9.0, 7.0, 5.0, 3.0, 1.0})
        series = series * s2 + 1 / divisor;
    const Four power = y * (exponent + series * s * (2 * std::numbers::log2e));

    const Four shifted = power + 1.5 * two_52; // rounded to a whole number, which is in the low bits
    const Four whole = shifted - 1.5 * two_52;
    const Four z = (power - whole) * std::numbers::ln2;
    Four exponential = z * (1 / 11.0) + 1;
    for (const double divisor : {10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0})
        exponential = exponential * (z * (1 / divisor)) + 1;
    castBits(shifted, bits);
    Four scale;
    castBits((bits << 52) + 0x3ff0'0000'0000'0000U, scale);
    out = exponential * scale;
}

// Of 0 to 1, CIELAB's: the cube root, by three of Halley's steps from a straight line, and below a knee a
// line itself. The steps make less than 1e-14 of the line's error of at most 0.4.
GLL_INLINE void labCurve(const Four& t, Four& out) {
    constexpr double delta = 6 / 29.0;
    Four root = 0.29 + 0.74 * t;
    for (int step = 0; step < 3; ++step) {
        const Four cube = root * root * root;
        root *= (cube + 2 * t) / (2 * cube + t);
    }
    choose(t > delta * delta * delta, root, t * (1 / (3 * delta * delta)) + 4 / 29.0, out);
}

GLL_INLINE void clampUnit(const Four& x, Four& out) {
    const Four zero = {};
    choose(x < 0, zero, x, out);
    choose(out > 1, zero + 1, out, out);
}

GLL_INLINE void load(const double* from, Four& four) { std::memcpy(&four, from, sizeof four); }
GLL_INLINE void store(const Four& four, double* to) { std::memcpy(to, &four, sizeof four); }

// Whole Fours for so many columns.
std::size_t padded(std::size_t columns) { return (columns + 3) / 4 * 4; }

// out[x] = sum over k of taps[k] * rows[k][x]. Columns go in blocks that stay in registers over all taps.
GLL_WIDE void weigh(const Taps& taps, const double* const* rows, int width, double* out) {
    constexpr int block = 16;
    int x = 0;
    for (; x + block <= width; x += block) {
        Four sums[block / 4] = {};
        for (std::size_t k = 0; k < taps.size(); ++k)
            for (int i = 0; i < block / 4; ++i) {
                Four values;
                std::memcpy(&values, rows[k] + x + 4 * i, sizeof values);
                sums[i] += taps[k] * values;
            }
        std::memcpy(out + x, sums, sizeof sums);
    }
    for (; x < width; ++x) {
        out[x] = 0;
        for (std::size_t k = 0; k < taps.size(); ++k)
            out[x] += taps[k] * rows[k][x];
    }
}

// Filters single rows of one picture; holds what it needs in between, so that no row allocates.
class RowFilter {
  public:
    // Row y of the plane through taps in y; what across() works on.
    void down(const Plane& plane, int y, const Taps& taps) {
        const int radius = static_cast<int>(taps.size() / 2);
        rows_.resize(taps.size());
        for (int k = -radius; k <= radius; ++k)
            rows_[static_cast<std::size_t>(k + radius)] = plane.row(y + k);
        width_ = plane.width;
        smoothed_.resize(static_cast<std::size_t>(width_));
        weigh(taps, rows_.data(), width_, smoothed_.data());
    }
    // That row through taps in x.
    void across(const Taps& taps, std::vector<double>& out) {
        const std::size_t radius = taps.size() / 2;
        padded_.assign(radius, smoothed_.front());
        padded_.insert(padded_.end(), smoothed_.begin(), smoothed_.end());
        padded_.insert(padded_.end(), radius, smoothed_.back());
        rows_.resize(taps.size());
        for (std::size_t k = 0; k < taps.size(); ++k)
            rows_[k] = padded_.data() + k;
        out.resize(padded(smoothed_.size()));
        weigh(taps, rows_.data(), width_, out.data());
    }

  private:
    int width_ = 0;
    std::vector<const double*> rows_;
    std::vector<double> smoothed_;
    std::vector<double> padded_;
};

// One picture in YyCxCz, the linear version of CIELAB that light is blurred in.
struct Opponent {
    Plane yy, cx, cz;
};

// To XYZ in units of the white's.
glm::dmat3 relativeXyzFromRgb() {
    const glm::dvec3 white = xyzFromBt709() * glm::dvec3(1);
    glm::dmat3 matrix = xyzFromBt709();
    for (int column = 0; column < 3; ++column)
        matrix[column] /= white;
    return matrix;
}

Opponent opponentOf(const ColorImage& display_light) {
    Opponent result;
    for (Plane* plane : {&result.yy, &result.cx, &result.cz}) {
        plane->width = display_light.width;
        plane->height = display_light.height;
        plane->values.reserve(display_light.pixels.size());
    }
    const glm::dmat3 relative_xyz = relativeXyzFromRgb();
    for (const glm::dvec3& light : display_light.pixels) {
        const glm::dvec3 xyz = relative_xyz * glm::clamp(light, 0.0, 1.0);
        result.yy.values.push_back(116 * xyz.y - 16);
        result.cx.values.push_back(500 * (xyz.x - xyz.y));
        result.cz.values.push_back(200 * (xyz.y - xyz.z));
    }
    return result;
}

// CIELAB with Hunt's adjustment: chroma fades with lightness.
glm::dvec3 huntLab(const glm::dvec3& display_light) {
    const glm::dvec3 lab = cieLab(display_light);
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// HyAB (Abasi et al. 2020): city blocks in lightness, a straight line in chroma.
double hyab(const glm::dvec3& one, const glm::dvec3& other) {
    return std::abs(one.x - other.x) + std::hypot(one.y - other.y, one.z - other.z);
}

// Both of a row's results for one picture, in whole Fours: blurred colours in CIELAB with Hunt's adjustment,
// and how much of an edge and of a point it has.
struct Row {
    std::vector<double> lightness;
    std::vector<double> hunt_a;
    std::vector<double> hunt_b;
    std::vector<double> edge;
    std::vector<double> point;
};

// The blurred channels of a row, in whole Fours. Of the blue-yellow one two parts that are to be added.
struct BlurredRow {
    std::vector<double> yy, cx, cz, cz_narrow;
};

// huntLab() of blurred colours.
GLL_WIDE void toHuntLab(const BlurredRow& blurred, const glm::dmat3& xyz_from_rgb,
                        const glm::dmat3& rgb_from_xyz, Row& row) {
    for (std::size_t x = 0; x < row.lightness.size(); x += 4) {
        Four yy;
        Four cx;
        Four cz;
        Four cz_narrow;
        load(&blurred.yy[x], yy);
        load(&blurred.cx[x], cx);
        load(&blurred.cz[x], cz);
        load(&blurred.cz_narrow[x], cz_narrow);
        const Four y = (yy + 16) * (1 / 116.0);
        const Four xyz[3] = {y + cx * (1 / 500.0), y, y - (cz + cz_narrow) * (1 / 200.0)};
        Four rgb[3];
        for (int i = 0; i < 3; ++i)
            clampUnit(xyz[0] * rgb_from_xyz[0][i] + xyz[1] * rgb_from_xyz[1][i] + xyz[2] * rgb_from_xyz[2][i],
                      rgb[i]);
        Four curve[3];
        for (int i = 0; i < 3; ++i)
            labCurve(rgb[0] * xyz_from_rgb[0][i] + rgb[1] * xyz_from_rgb[1][i] + rgb[2] * xyz_from_rgb[2][i],
                     curve[i]);
        const Four lightness = 116 * curve[1] - 16;
        store(lightness, &row.lightness[x]);
        store(0.01 * lightness * (500 * (curve[0] - curve[1])), &row.hunt_a[x]);
        store(0.01 * lightness * (200 * (curve[1] - curve[2])), &row.hunt_b[x]);
    }
}

// The length of a gradient by its parts, of a channel in [0, 116].
GLL_WIDE void lengths(const std::vector<double>& across, const std::vector<double>& down,
                      std::vector<double>& out) {
    for (std::size_t x = 0; x < out.size(); ++x)
        out[x] = std::sqrt(across[x] * across[x] + down[x] * down[x]) / 116;
}

class RowAnalysis {
  public:
    RowAnalysis(const Opponent& opponent, const Filters& filters)
        : opponent_(opponent), filters_(filters), xyz_from_rgb_(relativeXyzFromRgb()),
          rgb_from_xyz_(glm::inverse(xyz_from_rgb_)) {
        for (std::vector<double>* values :
             {&row_.lightness, &row_.hunt_a, &row_.hunt_b, &row_.edge, &row_.point})
            values->resize(padded(static_cast<std::size_t>(opponent.yy.width)));
    }

    const Row& analyse(int y) {
        filter_.down(opponent_.yy, y, filters_.achromatic);
        filter_.across(filters_.achromatic, blurred_.yy);
        filter_.down(opponent_.cx, y, filters_.red_green);
        filter_.across(filters_.red_green, blurred_.cx);
        filter_.down(opponent_.cz, y, filters_.blue_yellow_down[0]);
        filter_.across(filters_.blue_yellow_across[0], blurred_.cz);
        filter_.down(opponent_.cz, y, filters_.blue_yellow_down[1]);
        filter_.across(filters_.blue_yellow_across[1], blurred_.cz_narrow);
        toHuntLab(blurred_, xyz_from_rgb_, rgb_from_xyz_, row_);
        // Features are those of the achromatic channel in [0, 1], that is (Yy + 16) / 116; of a sum of
        // weights that is 0 the constant does not matter. The gradient is that of a derivative in x and the
        // same in y.
        filter_.down(opponent_.yy, y, filters_.feature_smooth);
        filter_.across(filters_.feature_edge, edge_across_);
        filter_.across(filters_.feature_point, point_across_);
        filter_.down(opponent_.yy, y, filters_.feature_edge);
        filter_.across(filters_.feature_smooth, down_);
        lengths(edge_across_, down_, row_.edge);
        filter_.down(opponent_.yy, y, filters_.feature_point);
        filter_.across(filters_.feature_smooth, down_);
        lengths(point_across_, down_, row_.point);
        return row_;
    }

  private:
    const Opponent& opponent_;
    const Filters& filters_;
    glm::dmat3 xyz_from_rgb_; // XYZ in units of the white's
    glm::dmat3 rgb_from_xyz_;
    RowFilter filter_;
    BlurredRow blurred_;
    std::vector<double> edge_across_, point_across_, down_;
    Row row_;
};

// The error of a row's pixels, into whole Fours; c_max is the largest distance of two colours, to q_c.
GLL_WIDE void errorsBetween(const Row& one, const Row& other, double c_max, std::vector<double>& out) {
    const double knee = p_c * c_max;
    const Four zero = {};
    const auto sizeOf = [](const Four& x, Four& size) { choose(x < 0, -x, x, size); };
    const auto difference = [&](const std::vector<double>& ones, const std::vector<double>& others,
                                std::size_t x, Four& result) {
        Four subtracted;
        load(&ones[x], result);
        load(&others[x], subtracted);
        result -= subtracted;
    };
    for (std::size_t x = 0; x < out.size(); x += 4) {
        Four lightness;
        Four a;
        Four b;
        Four edge;
        Four point;
        difference(one.lightness, other.lightness, x, lightness);
        difference(one.hunt_a, other.hunt_a, x, a);
        difference(one.hunt_b, other.hunt_b, x, b);
        difference(one.edge, other.edge, x, edge);
        difference(one.point, other.point, x, point);
        sizeOf(lightness, lightness);
        sizeOf(edge, edge);
        sizeOf(point, point);
        Four chroma = a * a + b * b;
        for (int i = 0; i < 4; ++i)
            chroma[i] = std::sqrt(chroma[i]);
        const Four hyab = lightness + chroma;
        const auto is_seen = hyab > 1e-100;
        Four distance;
        choose(is_seen, hyab, zero + 1, distance);
        power(distance, zero + q_c, distance);
        Four color_error;
        choose(distance < knee, distance * (p_t / knee),
               p_t + (distance - knee) * ((1 - p_t) / (c_max - knee)), color_error);
        Four feature;
        choose(edge > point, edge, point, feature);
        feature *= 1 / std::numbers::sqrt2;
        static_assert(q_f == 0.5);
        for (int i = 0; i < 4; ++i)
            feature[i] = std::sqrt(feature[i]);
        Four error;
        power(color_error, 1 - feature, error);
        Four unseen; // 0 to a power above 0, and else 1
        choose(feature < 1, zero, zero + 1, unseen);
        choose(is_seen, error, unseen, error);
        clampUnit(error, error);
        store(error, &out[x]);
    }
}

Filters filtersFor(double pixels_per_degree) {
    if (!(pixels_per_degree >= least_pixels_per_degree && pixels_per_degree <= most_pixels_per_degree))
        throw std::invalid_argument("flip: " + std::to_string(pixels_per_degree) +
                                    " pixels per degree, give 1 to 1000");
    return Filters(pixels_per_degree);
}

ScalarImage flipWith(const Filters& filters, const ColorImage& display_light,
                     const ColorImage& reference_display_light, const Rows& rows) {
    const Opponent opponent = opponentOf(display_light);
    const Opponent reference_opponent = opponentOf(reference_display_light);
    RowAnalysis analysis(opponent, filters);
    RowAnalysis reference_analysis(reference_opponent, filters);
    // The largest distance in the RGB cube is that of green and blue.
    const double c_max = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), q_c);
    ScalarImage map(display_light.width, display_light.height);
    std::vector<double> errors(padded(static_cast<std::size_t>(map.width)));
    for (int y = std::max(rows.first, 0); y <= std::min(rows.last, map.height - 1); ++y) {
        errorsBetween(analysis.analyse(y), reference_analysis.analyse(y), c_max, errors);
        std::copy_n(errors.begin(), map.width, &map.at(0, y));
    }
    return map;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

ColorImage exposed(const ColorImage& linear_image, double exposure_ev) {
    ColorImage result = linear_image;
    const double factor = std::exp2(exposure_ev);
    for (glm::dvec3& color : result.pixels)
        for (int c = 0; c < 3; ++c)
            color[c] = tone(std::max(color[c], 0.0) * factor);
    return result;
}

ScalarImage hdrFlipOf(const ColorImage& linear_image, const ColorImage& linear_reference,
                      const Exposures& exposures, double pixels_per_degree,
                      const std::function<void(int, int)>& progress, const Rows& rows) {
    const Filters filters = filtersFor(pixels_per_degree);
    ScalarImage result(linear_image.width, linear_image.height);
    for (int i = 0; i < exposures.count; ++i) {
        if (progress) progress(i, exposures.count);
        const double exposure_ev = exposures.at(i);
        const ScalarImage map = flipWith(filters, exposed(linear_image, exposure_ev),
                                         exposed(linear_reference, exposure_ev), rows);
        for (std::size_t p = 0; p < map.pixels.size(); ++p)
            result.pixels[p] = std::max(result.pixels[p], map.pixels[p]);
    }
    return result;
}

} // namespace

ScalarImage flip(const ColorImage& display_light, const ColorImage& reference_display_light,
                 double pixels_per_degree, const Rows& rows) {
    requireComparable("flip", display_light, reference_display_light);
    return flipWith(filtersFor(pixels_per_degree), display_light, reference_display_light, rows);
}

double Exposures::at(int i) const {
    return count > 1 ? start_ev + (stop_ev - start_ev) * i / (count - 1) : start_ev;
}

Exposures flipExposures(const ColorImage& linear_reference) {
    requireComparable("flipExposures", linear_reference, linear_reference);
    std::vector<double> luminances;
    luminances.reserve(linear_reference.pixels.size());
    for (const glm::dvec3& color : linear_reference.pixels)
        luminances.push_back(luminance709(glm::max(color, 0.0)));
    const double largest = *std::max_element(luminances.begin(), luminances.end());
    if (largest <= 0) return {};
    double middle = median(luminances);
    if (middle <= 0) {
        std::erase_if(luminances, [](double luminance) { return luminance <= 0; });
        middle = median(luminances);
    }
    const double light = toneInverse(exposed_to); // both ends have this one
    Exposures result{std::log2(light / largest), std::log2(light / middle), 2};
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop_ev - result.start_ev)));
    return result;
}

HdrFlip hdrFlip(const ColorImage& linear_image, const ColorImage& linear_reference, double pixels_per_degree,
                const std::function<void(int, int)>& progress) {
    requireComparable("hdrFlip", linear_image, linear_reference);
    const Exposures exposures = flipExposures(linear_reference);
    return {hdrFlipOf(linear_image, linear_reference, exposures, pixels_per_degree, progress, {}), exposures};
}

ScalarImage hdrFlip(const ColorImage& linear_image, const ColorImage& linear_reference,
                    const Exposures& exposures, double pixels_per_degree, const Rows& rows) {
    requireComparable("hdrFlip", linear_image, linear_reference);
    return hdrFlipOf(linear_image, linear_reference, exposures, pixels_per_degree, {}, rows);
}

int flipReachPx(double pixels_per_degree) {
    const Filters filters = filtersFor(pixels_per_degree);
    return static_cast<int>(std::max(filters.blue_yellow_across[0].size(), filters.feature_edge.size()) / 2);
}

FlipSummary summary(const ScalarImage& map) {
    if (map.pixels.empty()) throw std::invalid_argument("summary: an empty map");
    std::vector<double> sorted = map.pixels;
    std::sort(sorted.begin(), sorted.end());
    const double total = sum(sorted);
    FlipSummary result{total / static_cast<double>(sorted.size()), 0, sorted.back()};
    double below = 0;
    for (const double error : sorted) {
        below += error;
        if (below < total / 2) continue;
        result.weighted_median = error;
        break;
    }
    return result;
}

Image heatMap(const ScalarImage& map) {
    const std::array<glm::dvec3, 5> colors = {
        {{0, 0, 0}, {0.28, 0.10, 0.55}, {0.80, 0.18, 0.36}, {1, 0.65, 0.20}, {1, 1, 0.80}}};
    Image image;
    image.width = map.width;
    image.height = map.height;
    image.channels = 3;
    image.color_space = ColorSpace::srgb;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * map.pixels.size());
    for (const double error : map.pixels) {
        const double place = std::clamp(error, 0.0, 1.0) * (colors.size() - 1);
        const auto from = std::min(static_cast<std::size_t>(place), colors.size() - 2);
        const glm::dvec3 color = glm::mix(colors[from], colors[from + 1], place - static_cast<double>(from));
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * color[c])));
    }
    image.pixels = std::move(bytes);
    return image;
}

} // namespace gll::measure
