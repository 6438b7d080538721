// Convolution as a product of spectra, on pictures padded so that nothing wraps round into view.
#include "truth/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fftw3.h>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace gll::truth {
namespace {

constexpr double radius_in_sigmas = 6.5;
constexpr int max_radius_px = 4096;

using Spectrum = std::vector<std::complex<double>>;

// The next size whose only factors are 2, 3, 5 and 7, which FFTW is fast for.
int fastSize(int least) {
    for (int size = least;; ++size) {
        int rest = size;
        for (const int factor : {2, 3, 5, 7})
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1) return size;
    }
}

struct PlanDeleter {
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, PlanDeleter>;

// Transforms of one size there and back. FFTW_ESTIMATE leaves the arrays alone while planning.
class Fourier {
  public:
    Fourier(int width, int height)
        : width_(width), height_(height),
          values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
          spectrum_(static_cast<std::size_t>(width / 2 + 1) * static_cast<std::size_t>(height)),
          forward_(fftw_plan_dft_r2c_2d(height, width, values_.data(), fftw(), FFTW_ESTIMATE)),
          backward_(fftw_plan_dft_c2r_2d(height, width, fftw(), values_.data(), FFTW_ESTIMATE)) {
        if (!forward_ || !backward_) throw std::runtime_error("convolved: FFTW makes no plan of this size");
    }

    template <class Function> // the value at (x, y)
    Spectrum spectrumOf(const Function& value) {
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                at(x, y) = value(x, y);
        fftw_execute(forward_.get());
        return spectrum_;
    }
    // The inverse, which at(x, y) then has. FFTW scales it by the number of values.
    void invert(const Spectrum& spectrum) {
        spectrum_ = spectrum;
        fftw_execute(backward_.get());
        for (double& value : values_)
            value /= static_cast<double>(values_.size());
    }
    double& at(int x, int y) {
        return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)];
    }

  private:
    fftw_complex* fftw() {
        return reinterpret_cast<fftw_complex*>(spectrum_.data());
    } // as FFTW's manual has it

    int width_;
    int height_;
    std::vector<double> values_;
    Spectrum spectrum_;
    Plan forward_;
    Plan backward_;
};

// Convolves pictures of one size with one point spread function.
class Convolution {
  public:
    Convolution(int width, int height, const ScalarImage& point_spread, Edge edge)
        : width_(width), height_(height), edge_(edge), before_x_(point_spread.width / 2),
          before_y_(point_spread.height / 2), padded_width_(fastSize(width + point_spread.width - 1)),
          padded_height_(fastSize(height + point_spread.height - 1)), fourier_(padded_width_, padded_height_),
          // Its centre goes to (0, 0); what lies before that wraps round to the end.
          spread_(fourier_.spectrumOf([&](int x, int y) {
              const int i = (x + before_x_) % padded_width_;
              const int j = (y + before_y_) % padded_height_;
              return i < point_spread.width && j < point_spread.height ? point_spread.at(i, j) : 0.0;
          })) {}

    // `value` is the picture's at (x, y) inside it; `put` takes the results.
    template <class Value, class Put>
    void apply(const Value& value, const Put& put) {
        Spectrum spectrum = fourier_.spectrumOf([&](int x, int y) { return padded(value, x, y); });
        for (std::size_t i = 0; i < spectrum.size(); ++i)
            spectrum[i] *= spread_[i];
        fourier_.invert(spectrum);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                put(x, y, fourier_.at(x, y));
    }

  private:
    // The picture lies at the beginning. A result gathers from up to `size - 1 - before` pixels before it and
    // `before` behind it, so of what follows, the first `before` are still behind the picture, and all
    // others, through wrapping, before it.
    template <class Value>
    double padded(const Value& value, int x, int y) const {
        if (edge_ == Edge::zero) return x < width_ && y < height_ ? value(x, y) : 0.0;
        const auto inside = [&](int at, int size, int before, int padded) {
            const int place = at < size + before ? at : at - padded;
            if (edge_ == Edge::clamp) return std::clamp(place, 0, size - 1);
            const int folded = ((place % (2 * size)) + 2 * size) % (2 * size);
            return folded < size ? folded : 2 * size - 1 - folded;
        };
        return value(inside(x, width_, before_x_, padded_width_),
                     inside(y, height_, before_y_, padded_height_));
    }

    int width_;
    int height_;
    Edge edge_;
    int before_x_; // pixels of the point spread function before its centre
    int before_y_;
    int padded_width_;
    int padded_height_;
    Fourier fourier_;
    Spectrum spread_;
};

void requireFinite(const char* what, const ScalarImage& image) {
    if (image.pixels.empty())
        throw std::invalid_argument(std::string("convolved: the ") + what + " is empty");
    if (!std::all_of(image.pixels.begin(), image.pixels.end(), [](double v) { return std::isfinite(v); }))
        throw std::invalid_argument(std::string("convolved: the ") + what +
                                    " has values that are not finite, which would spread everywhere");
}

void requireMixture(const GaussianMixture& mixture) {
    double shares = 0;
    for (const GaussianMixture::Part& part : mixture.parts) {
        shares += part.share;
        if (!(part.sigma_px > 0) || !std::isfinite(part.sigma_px))
            throw std::invalid_argument("a Gaussian's sigma is " + std::to_string(part.sigma_px) +
                                        " pixels, give a positive one");
    }
    if (!(std::abs(shares - 1) < 1e-9))
        throw std::invalid_argument("the Gaussians' shares add up to " + std::to_string(shares) +
                                    ", make it 1");
}

} // namespace

ScalarImage convolved(const ScalarImage& image, const ScalarImage& point_spread, Edge edge) {
    requireFinite("picture", image);
    requireFinite("point spread function", point_spread);
    Convolution convolution(image.width, image.height, point_spread, edge);
    ScalarImage result(image.width, image.height);
    convolution.apply([&](int x, int y) { return image.at(x, y); },
                      [&](int x, int y, double value) { result.at(x, y) = value; });
    return result;
}

ColorImage convolved(const ColorImage& image, const ScalarImage& point_spread, Edge edge) {
    measure::requireComparable("convolved", image, image);
    requireFinite("point spread function", point_spread);
    Convolution convolution(image.width, image.height, point_spread, edge);
    ColorImage result(image.width, image.height);
    for (int c = 0; c < 3; ++c)
        convolution.apply([&](int x, int y) { return image.at(x, y)[c]; },
                          [&](int x, int y, double value) { result.at(x, y)[c] = value; });
    return result;
}

Moments moments(const ScalarImage& response) {
    Moments result;
    for (const double value : response.pixels)
        result.sum += value;
    if (result.sum == 0 || !std::isfinite(result.sum))
        throw std::invalid_argument("moments: the response's sum is " + std::to_string(result.sum) +
                                    ", it has no centre");
    const auto mean = [&](const auto& function) {
        double sum = 0;
        for (int y = 0; y < response.height; ++y)
            for (int x = 0; x < response.width; ++x)
                sum += function(x, y) * response.at(x, y);
        return sum / result.sum;
    };
    result.mean_x_px = mean([](int x, int) { return double(x); });
    result.mean_y_px = mean([](int, int y) { return double(y); });
    result.variance_x_px2 = mean([&](int x, int) { return std::pow(x - result.mean_x_px, 2); });
    result.variance_y_px2 = mean([&](int, int y) { return std::pow(y - result.mean_y_px, 2); });
    return result;
}

double GaussianMixture::variance_px2() const {
    return std::transform_reduce(parts.begin(), parts.end(), 0.0, std::plus<>(),
                                 [](const Part& part) { return part.share * part.sigma_px * part.sigma_px; });
}

GaussianMixture matched(GaussianMixture mixture, double variance_px2) {
    requireMixture(mixture);
    if (!(variance_px2 > 0) || !std::isfinite(variance_px2))
        throw std::invalid_argument("matched: a variance of " + std::to_string(variance_px2) +
                                    " pixels^2, give a positive one");
    const double scale = std::sqrt(variance_px2 / mixture.variance_px2());
    for (GaussianMixture::Part& part : mixture.parts)
        part.sigma_px *= scale;
    return mixture;
}

ScalarImage pointSpread(const GaussianMixture& mixture) {
    requireMixture(mixture);
    double widest_px = 0;
    for (const GaussianMixture::Part& part : mixture.parts)
        widest_px = std::max(widest_px, part.sigma_px);
    if (radius_in_sigmas * widest_px > max_radius_px)
        throw std::invalid_argument("pointSpread: a sigma of " + std::to_string(widest_px) +
                                    " pixels is too wide, the radius goes to 4096");
    const int radius = std::max(1, static_cast<int>(std::ceil(radius_in_sigmas * widest_px)));
    ScalarImage result(2 * radius + 1, 2 * radius + 1);
    for (const GaussianMixture::Part& part : mixture.parts) {
        // Each part is normalised by itself, as the product of two sums, so that its share is exact.
        std::vector<double> row;
        for (int x = -radius; x <= radius; ++x)
            row.push_back(std::exp(-x * x / (2 * part.sigma_px * part.sigma_px)));
        const double sum = std::accumulate(row.begin(), row.end(), 0.0);
        for (int y = 0; y < result.height; ++y)
            for (int x = 0; x < result.width; ++x)
                result.at(x, y) += part.share * row[static_cast<std::size_t>(x)] / sum *
                                   row[static_cast<std::size_t>(y)] / sum;
    }
    return result;
}

} // namespace gll::truth
