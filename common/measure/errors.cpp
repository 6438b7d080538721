// Sums over pixels in double, and the checks that make them mean something.
#include "measure/errors.hpp"

#include "measure/color.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace gll::measure {
namespace {

// The mean over pixels of a function of both pictures' colours there.
template <class Function>
double meanOver(const ColorImage& image, const ColorImage& reference, const Function& function) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        sum += function(image.pixels[i], reference.pixels[i]);
    return sum / static_cast<double>(image.pixels.size());
}

double sumOf(const glm::dvec3& color) { return color.r + color.g + color.b; }

void requirePositive(const char* what, double value) {
    if (!(value > 0) || !std::isfinite(value))
        throw std::invalid_argument(std::string(what) + " is " + std::to_string(value) +
                                    ", give a positive number");
}

double positiveLuminance(const glm::dvec3& color) { return std::max(luminance709(color), 0.0); }

int residue(int value, int period) { return ((value % period) + period) % period; }

void requireWholePeriod(const std::vector<glm::ivec2>& shifts_px, int period_px) {
    std::set<int> columns;
    std::set<int> rows;
    std::set<std::pair<int, int>> places;
    for (const glm::ivec2& shift : shifts_px) {
        columns.insert(residue(shift.x, period_px));
        rows.insert(residue(shift.y, period_px));
        places.emplace(residue(shift.x, period_px), residue(shift.y, period_px));
    }
    const auto whole = static_cast<std::size_t>(period_px);
    const bool across = columns.size() == whole;
    const bool down = rows.size() == whole;
    if (places.size() != shifts_px.size() || places.size() != columns.size() * rows.size() ||
        !(across || columns.size() == 1) || !(down || rows.size() == 1) || !(across || down))
        throw std::invalid_argument("shiftVariance: the " + std::to_string(shifts_px.size()) +
                                    " shifts do not run once over a period of " + std::to_string(period_px) +
                                    " pixels, give every place of it in x, in y or in both");
}

} // namespace

double rmse(const ColorImage& image, const ColorImage& reference) {
    requireComparable("rmse", image, reference);
    return std::sqrt(meanOver(image, reference, [](const glm::dvec3& x, const glm::dvec3& r) {
        return sumOf((x - r) * (x - r)) / 3;
    }));
}

double psnrDb(double display_rmse) {
    if (!(display_rmse >= 0)) throw std::invalid_argument("psnrDb: an RMSE is not negative");
    return display_rmse > 0 ? -20 * std::log10(display_rmse) : std::numeric_limits<double>::infinity();
}

double relativeRmse(const ColorImage& image, const ColorImage& reference, double e) {
    requireComparable("relativeRmse", image, reference);
    requirePositive("relativeRmse: e", e);
    return std::sqrt(meanOver(image, reference, [e](const glm::dvec3& x, const glm::dvec3& r) {
        return sumOf((x - r) * (x - r) / (r * r + e)) / 3;
    }));
}

double log2RmseEv(const ColorImage& image, const ColorImage& reference, double e) {
    requireComparable("log2RmseEv", image, reference);
    requirePositive("log2RmseEv: e", e);
    return std::sqrt(meanOver(image, reference, [e](const glm::dvec3& x, const glm::dvec3& r) {
        const double difference_ev = std::log2((e + positiveLuminance(x)) / (e + positiveLuminance(r)));
        return difference_ev * difference_ev;
    }));
}

double energyRatio(const ColorImage& image, const ColorImage& reference) {
    requireComparable("energyRatio", image, reference);
    double sum = 0;
    double reference_sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        sum += sumOf(image.pixels[i]);
        reference_sum += sumOf(reference.pixels[i]);
    }
    if (reference_sum == 0) return sum == 0 ? 1 : std::numeric_limits<double>::infinity();
    return sum / reference_sum;
}

double logAverage(const ColorImage& linear_image, double d) {
    requireComparable("logAverage", linear_image, linear_image);
    requirePositive("logAverage: d", d);
    return std::exp(meanOver(linear_image, linear_image, [d](const glm::dvec3& color, const glm::dvec3&) {
        return std::log(d + positiveLuminance(color));
    }));
}

double evError(double measured, double truth) {
    requirePositive("evError: the measured value", measured);
    requirePositive("evError: the truth", truth);
    return std::log2(measured / truth);
}

ShiftVariance shiftVariance(const std::vector<ColorImage>& responses,
                            const std::vector<glm::ivec2>& shifts_px, int period_px) {
    if (responses.empty() || responses.size() != shifts_px.size())
        throw std::invalid_argument("shiftVariance: " + std::to_string(responses.size()) + " responses and " +
                                    std::to_string(shifts_px.size()) + " shifts, give one for each");
    if (period_px < 1) throw std::invalid_argument("shiftVariance: the period must be 1 pixel or more");
    for (const ColorImage& response : responses)
        requireComparable("shiftVariance", response, responses.front());
    requireWholePeriod(shifts_px, period_px);

    // Moved back, response i covers [-shift, size - shift); the window is what all of them cover.
    glm::ivec2 low = -shifts_px.front();
    glm::ivec2 high = glm::ivec2(responses.front().width, responses.front().height) - shifts_px.front();
    for (const glm::ivec2& shift : shifts_px) {
        low = glm::max(low, -shift);
        high = glm::min(high, glm::ivec2(responses.front().width, responses.front().height) - shift);
    }
    if (low.x >= high.x || low.y >= high.y)
        throw std::invalid_argument("shiftVariance: moved by their shifts, the responses share no pixel");

    ColorImage mean(high.x - low.x, high.y - low.y);
    const auto number = static_cast<double>(responses.size());
    const auto forEach = [&](std::size_t i, const auto& function) {
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                function(mean.at(x - low.x, y - low.y),
                         responses[i].at(x + shifts_px[i].x, y + shifts_px[i].y));
    };
    for (std::size_t i = 0; i < responses.size(); ++i)
        forEach(i, [number](glm::dvec3& of_mean, const glm::dvec3& of_response) {
            of_mean += of_response / number;
        });
    double total = 0;
    for (const glm::dvec3& color : mean.pixels)
        total += sumOf(glm::abs(color));
    if (total == 0) throw std::invalid_argument("shiftVariance: the responses' mean is black");

    ShiftVariance result;
    for (std::size_t i = 0; i < responses.size(); ++i) {
        double deviation = 0;
        forEach(i, [&deviation](const glm::dvec3& of_mean, const glm::dvec3& of_response) {
            deviation += sumOf(glm::abs(of_response - of_mean));
        });
        result.mean += deviation / total / number;
        result.largest = std::max(result.largest, deviation / total);
    }
    return result;
}

} // namespace gll::measure
