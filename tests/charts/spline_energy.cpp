// The passes' weights written from their definition (areas and heights of B-splines), and applied backwards:
// from what each texel gives to the picture to what each pixel of the scene gives to it.
#include "charts/spline_energy.hpp"

#include "04_pyramid_bloom/spline_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gll::charts {
namespace {

int mirrored(int texel, int size) {
    const int folded = ((texel % (2 * size)) + 2 * size) % (2 * size);
    return folded < size ? folded : 2 * size - 1 - folded;
}

// The B-spline of degree 1 or 3, and the part of its area that lies left of x.
double spline(int degree, double x) {
    const double a = std::abs(x);
    if (degree == 1) return std::max(1 - a, 0.0);
    if (a < 1) return 2.0 / 3 - a * a * (1 - a / 2);
    const double outer = std::max(2 - a, 0.0);
    return outer * outer * outer / 6;
}
double splineArea(int degree, double x) {
    const double outer = std::max((degree + 1) / 2.0 - std::abs(x), 0.0);
    const double inner = std::max(1 - std::abs(x), 0.0);
    const auto fourth = [](double y) { return y * y * y * y; };
    const double tail = degree == 1 ? outer * outer / 2 : (fourth(outer) - 4 * fourth(inner)) / 24;
    return x < 0 ? tail : 1 - tail;
}

// given[k]: what texel k of a side gives to the picture. Returned: what the texels of the larger side give,
// of which each texel k takes the mean under a spline: each texel counts by the part of its area that lies
// over the texel, or by its height in the texel's middle.
std::vector<double> beforeHalving(const std::vector<double>& given, int larger_side, int degree,
                                  bool by_height) {
    std::vector<double> result(static_cast<std::size_t>(larger_side));
    const double ratio = larger_side / static_cast<double>(given.size());
    const double reach = (degree + 1) / 2.0 * ratio;
    for (std::size_t k = 0; k < given.size(); ++k) {
        const double centre = (static_cast<double>(k) + 0.5) * ratio;
        for (int t = static_cast<int>(std::floor(centre - reach)); t < centre + reach; ++t) {
            const double weight = by_height ? spline(degree, (t + 0.5 - centre) / ratio) / ratio
                                            : splineArea(degree, (t + 1 - centre) / ratio) -
                                                  splineArea(degree, (t - centre) / ratio);
            result[static_cast<std::size_t>(mirrored(t, larger_side))] += given[k] * weight;
        }
    }
    return result;
}

// The same where each texel k reads a spline through a smaller side's texels.
std::vector<double> beforeEnlarging(const std::vector<double>& given, int smaller_side, int degree) {
    std::vector<double> result(static_cast<std::size_t>(smaller_side));
    for (std::size_t k = 0; k < given.size(); ++k) {
        const double place =
            (static_cast<double>(k) + 0.5) * smaller_side / static_cast<double>(given.size()) - 0.5;
        for (int t = static_cast<int>(std::floor(place)) - 1; t <= std::floor(place) + 2; ++t)
            result[static_cast<std::size_t>(mirrored(t, smaller_side))] +=
                given[k] * spline(degree, place - t);
    }
    return result;
}

// A side and what each halving makes of it: the frame's, that of level 0, of level 1 ...
std::vector<int> sidesOf(int side_px, int levels) {
    std::vector<int> sides = {side_px};
    for (int i = 0; i < levels; ++i)
        sides.push_back((sides.back() + 1) / 2);
    return sides;
}

// How a frame is weighed, which its shorter side decides.
struct Weighing {
    bool small; // enlarged at the end by a spline
    bool large; // the bright pass takes the linear spline's heights for its areas

    bool operator==(const Weighing&) const = default;
};

Weighing weighingFor(int shorter_side_px) {
    return {shorter_side_px < pyramid_bloom::smallest_large_px,
            shorter_side_px >= pyramid_bloom::smallest_with_heights_px};
}

SplineShares sharesOf(int side_px, int levels, const Weighing& weighing) {
    const std::vector<int> sides = sidesOf(side_px, levels);
    const auto side = [&](int i) { return sides[static_cast<std::size_t>(i)]; };
    // Up: the picture from level 0, which is sides[1], that from level 1 and so on.
    std::vector<double> given(static_cast<std::size_t>(side_px), 1.0);
    given = beforeEnlarging(given, side(1), weighing.small ? 3 : 1);
    SplineShares shares;
    for (int level = 1; level < levels; ++level) {
        given = beforeEnlarging(given, side(level + 1), 3);
        std::vector<double> share = given;
        for (int i = level; i >= 0; --i)
            share = beforeHalving(share, side(i), i == 0 ? 1 : 3, i == 0 && weighing.large);
        shares.push_back(share);
    }
    return shares;
}

} // namespace

SplineShares splineShares(int side_px, int shorter_side_px, int levels) {
    return sharesOf(side_px, levels, weighingFor(shorter_side_px));
}

double splineLight(const SplineShares& across, const SplineShares& down, int x, int y) {
    double sum = 0;
    for (std::size_t level = 0; level < across.size(); ++level)
        sum += across[level][static_cast<std::size_t>(x)] * down[level][static_cast<std::size_t>(y)];
    return sum / static_cast<double>(across.size());
}

double largestSplineEnergyError(int levels, int largest_side_px) {
    double largest = 0;
    for (int shorter = 2; shorter <= largest_side_px; ++shorter) {
        // Frames that are weighed alike: none of their sides is shorter than the first shorter one.
        const Weighing weighing = weighingFor(shorter);
        if (shorter > 2 && weighing == weighingFor(shorter - 1)) continue;
        // Of each level the least and the most that arrives from any place of any side: no product of two is
        // beyond theirs.
        std::vector<double> least(static_cast<std::size_t>(levels - 1),
                                  std::numeric_limits<double>::infinity());
        std::vector<double> most(least.size(), 0);
        for (int side = shorter; side <= largest_side_px; ++side) {
            const SplineShares shares = sharesOf(side, levels, weighing);
            for (std::size_t i = 0; i < shares.size(); ++i) {
                const auto [low, high] = std::minmax_element(shares[i].begin(), shares[i].end());
                least[i] = std::min(least[i], *low);
                most[i] = std::max(most[i], *high);
            }
        }
        double low = 0;
        double high = 0;
        for (std::size_t i = 0; i < least.size(); ++i) {
            low += least[i] * least[i] / static_cast<double>(least.size());
            high += most[i] * most[i] / static_cast<double>(least.size());
        }
        largest = std::max({largest, 1 - low, high - 1});
    }
    return largest;
}

} // namespace gll::charts
