// The arithmetic of Gaussian kernels, in double, and the passes of a blur.
#include "gaussian_blur.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gll::gaussian_bloom {
namespace {

// Row 12 of Pascal's triangle without its two outermost numbers a side, over 4070: 924, 792, 495, 220, 66.
// Rounded as they are always printed.
constexpr std::array nine_weights = {0.227027, 0.1945946, 0.1216216, 0.054054, 0.016216};

// Quantiles of the normal distribution at 0.5, 0.7 and 0.9, as printed.
constexpr std::array quantiles = {0.0, 0.524, 1.282};
constexpr double importance_sigma = 2.5; // texels at half resolution
constexpr int importance_pairs = 5;

// What one target pixel of half the resolution takes from the full one, pixels squared: its centre lies on a
// corner of four pixels, and a texel of its offsets is two of theirs.
double halvingVariance(const BlurTaps& taps) {
    double sum = 0;
    for (std::size_t i = 0; i < taps.offsets.size(); ++i) {
        const double offset = 2.0 * taps.offsets[i];
        const double share = offset + 0.5 - std::floor(offset + 0.5);
        sum += (i == 0 ? 1 : 2) * taps.weights[i] * (offset * offset + share * (1 - share));
    }
    return sum;
}

// Of pairs of half-resolution passes, pixels squared, the mean of both directions. The first pass along the
// row halves the resolution, and along the column it takes the mean of two pixels; the linear fetch that
// doubles the result adds 1/4 * 3/4 of a texel squared.
double halfResolutionVariance(const BlurTaps& taps, int pairs) {
    const double across = halvingVariance(taps) + 4 * (pairs - 1) * variance(taps);
    const double up = 0.25 + 4 * pairs * variance(taps);
    return 0.5 * (across + up) + 0.75;
}

// The factor in [0, most] for which a rising function of it reaches the value; most where it does not.
template <class Function>
double solve(double value, double most, const Function& function) {
    double low = 0;
    double high = most;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (function(middle) < value ? low : high) = middle;
    }
    return high;
}

BlurPlan pingPong(const BlurRequest& request) {
    if (request.sigma <= 0) return {.taps = nineTaps(), .pairs = request.iterations};
    const double wanted = request.sigma * request.sigma;
    const double pairs = std::ceil(wanted / variance(nineTaps()));
    const int count = static_cast<int>(std::clamp(pairs, 1.0, double(most_pairs)));
    const double distance = solve(wanted / count, 1, [](double d) { return variance(nineTaps(d)); });
    return {.taps = nineTaps(distance), .pairs = count};
}

BlurPlan importance(const BlurRequest& request) {
    if (request.sigma <= 0)
        return {.taps = importanceTaps(importance_sigma, request.corrected_offsets),
                .pairs = request.iterations,
                .half_resolution = true};
    const double wanted = request.sigma * request.sigma;
    const double pairs =
        std::ceil((wanted - 1) / (4 * importance_sigma * importance_sigma)); // a texel is two pixels
    const int count = std::clamp(static_cast<int>(pairs), importance_pairs, most_pairs);
    const double sigma = solve(wanted, 2 * importance_sigma, [count](double s) {
        return halfResolutionVariance(importanceTaps(s, true), count);
    });
    return {.taps = importanceTaps(sigma, true), .pairs = count, .half_resolution = true};
}

} // namespace

// excerpt: kernel_of
std::vector<double> kernelOf(const BlurTaps& taps) {
    std::vector<double> kernel(static_cast<std::size_t>(std::ceil(taps.offsets.back())) + 2, 0.0);
    for (std::size_t i = 0; i < taps.offsets.size(); ++i) {
        const double offset = taps.offsets[i];
        const auto texel = static_cast<std::size_t>(offset);
        const double share = offset - static_cast<double>(texel); // of the texel beyond
        // Between the middle and its neighbour, the fetches of both sides reach the middle.
        kernel[texel] += taps.weights[i] * (1 - share) * (texel == 0 && i > 0 ? 2 : 1);
        kernel[texel + 1] += taps.weights[i] * share;
    }
    return kernel;
}
// end excerpt

double variance(const std::vector<double>& kernel) {
    double sum = 0;
    for (std::size_t i = 1; i < kernel.size(); ++i)
        sum += 2 * kernel[i] * static_cast<double>(i * i);
    return sum;
}

double variance(const BlurTaps& taps) { return variance(kernelOf(taps)); }

// excerpt: gaussian_kernel
std::vector<double> gaussianKernel(double sigma) {
    std::vector<double> kernel = {1};
    double sum = 1;
    for (double x = 1; x <= std::ceil(4 * sigma); ++x) {
        kernel.push_back(std::exp(-0.5 * (x / sigma) * (x / sigma)));
        sum += 2 * kernel.back();
    }
    for (double& weight : kernel)
        weight /= sum;
    return kernel;
}
// end excerpt

// excerpt: merged_taps
BlurTaps mergedTaps(const std::vector<double>& kernel) {
    BlurTaps taps = {.offsets = {0}, .weights = {static_cast<float>(kernel.at(0))}};
    for (std::size_t i = 1; i < kernel.size(); i += 2) {
        const double near = kernel[i];
        const double far = i + 1 < kernel.size() ? kernel[i + 1] : 0;
        const double both = near + far;
        if (both <= 0) continue; // too small to be a number
        taps.offsets.push_back(static_cast<float>(static_cast<double>(i) + far / both));
        taps.weights.push_back(static_cast<float>(both));
    }
    return taps;
}
// end excerpt

BlurTaps nineTaps(double distance) {
    BlurTaps taps;
    for (std::size_t i = 0; i < nine_weights.size(); ++i) {
        taps.offsets.push_back(static_cast<float>(static_cast<double>(i) * distance));
        taps.weights.push_back(static_cast<float>(nine_weights[i]));
    }
    return taps;
}

// excerpt: importance_taps
BlurTaps importanceTaps(double sigma, bool corrected) {
    double quantile_variance = 0;
    for (const double quantile : quantiles)
        quantile_variance += 2.0 / 5 * quantile * quantile;
    const double stretch = corrected ? 1 / std::sqrt(quantile_variance) : 1;
    BlurTaps taps;
    for (const double quantile : quantiles) {
        taps.offsets.push_back(static_cast<float>(quantile * sigma * stretch));
        taps.weights.push_back(1.0F / 5);
    }
    return taps;
}
// end excerpt

// excerpt: plan
BlurPlan planBlur(const BlurRequest& request) {
    if (request.method == "ping_pong_9tap") return pingPong(request);
    if (request.method == "ping_pong_5fetch") {
        BlurPlan plan = pingPong(request);
        plan.taps = mergedTaps(kernelOf(plan.taps));
        return plan;
    }
    if (request.method == "half_resolution_5tap") return importance(request);
    if (request.method == "mipmap")
        return {.taps = mergedTaps(gaussianKernel(0)), .pairs = 0, .half_resolution = true};
    if (request.method == "wide_gaussian") {
        // Its own width: what five pairs of half-resolution passes are meant to add up to, 11.2 pixels.
        const double own_sigma = 2 * importance_sigma * std::sqrt(importance_pairs);
        return {.taps = mergedTaps(gaussianKernel(request.sigma > 0 ? request.sigma : own_sigma))};
    }
    throw std::invalid_argument("blur: there is no method " + std::string(request.method));
}
// end excerpt

double sigmaOf(const BlurPlan& plan) {
    return std::sqrt(plan.half_resolution ? halfResolutionVariance(plan.taps, plan.pairs)
                                          : plan.pairs * variance(plan.taps));
}

// excerpt: passes
const Texture& GaussianBlur::draw(Frame& frame, ShaderLibrary& shaders, const Texture& bright,
                                  const BlurPlan& plan) {
    const glm::ivec2 size = plan.half_resolution ? glm::max(frame.size() / 2, 1) : frame.size();
    across_.remake({{"across", bright.format()}}, size);
    blurred_.remake({{"blurred", bright.format()}}, size);
    const glm::vec2 texel = 1.0F / glm::vec2(size);
    const glm::vec2 along_row(texel.x, 0);
    const glm::vec2 along_column =
        plan.vertical_steps_sideways ? glm::vec2(texel.y, 0) : glm::vec2(0, texel.y);
    // Bad values are stopped where they come in and along every column: what gets into a pass along a row,
    // the next one stops. Doing so in every pass would cost half as much again.
    const auto program = [&](const Defines& guard) -> const Program& {
        return shaders.fullScreen("03_gaussian_bloom/blur.frag",
                                  guard + Defines{{"TAPS", std::to_string(plan.taps.count())}});
    };
    const Program& guarded = program(plan.guard);
    const Program& unguarded = program({{"UNGUARDED", "1"}});
    const auto pass = [&](const std::string& name, const Framebuffer& target, const Texture& source,
                          glm::vec2 step, const Program& blur) {
        frame.pass(name, target,
                   {.program = blur,
                    .inputs = {{"source", source}},
                    .part = {.uniforms = {{"uv_step", step},
                                          {"offsets", plan.taps.offsets},
                                          {"weights", plan.taps.weights}}}});
    };
    if (plan.pairs == 0) pass("half", blurred_, bright, along_row, guarded);
    for (int i = 1; i <= plan.pairs; ++i) {
        const std::string number = std::to_string(i);
        if (i == 1)
            pass("horizontal1", across_, bright, along_row, guarded);
        else
            pass("horizontal" + number, across_, blurred_.color(), along_row, unguarded);
        pass("vertical" + number, blurred_, across_.color(), along_column, guarded);
    }
    return blurred_.color();
}
// end excerpt

} // namespace gll::gaussian_bloom
