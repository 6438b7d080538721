// Gaussian blurs by two passes, along the rows and then along the columns: the taps of each method, computed
// on the CPU, and the passes that fetch them.
#pragma once

#include "rung/frame.hpp"

#include <string_view>
#include <vector>

namespace gll::gaussian_bloom {

// What one pass fetches along its direction. Tap 0 is the pixel itself; every other is fetched on both sides.
// Offsets are in texels of the pass's target and need not be whole: the texture unit then mixes two texels.
struct BlurTaps {
    std::vector<float> offsets; // offsets[0] is 0, rising
    std::vector<float> weights; // of one fetch; the first once and the others twice make 1

    int count() const { return static_cast<int>(offsets.size()); }
};

// What the linear fetches together weigh each texel: [i] for a texel i to the left and for one i to the
// right.
std::vector<double> kernelOf(const BlurTaps& taps);

// The second moment of a symmetric kernel (one side, as above), texels squared: what one pass adds to the
// variance of a picture. Of taps it includes what linear fetches between texels add.
double variance(const std::vector<double>& kernel);
double variance(const BlurTaps& taps);

// A Gaussian sampled at whole texels out to 4 sigma, divided by its sum. sigma: texels, >= 0; 0 is the pixel
// alone.
std::vector<double> gaussianKernel(double sigma);

// The same kernel in half the fetches: one fetch between two texels weighs both (Rákos 2010, "Efficient
// Gaussian blur with linear sampling").
BlurTaps mergedTaps(const std::vector<double>& kernel);

// The nine weights of the usual tutorial's blur, distance texels apart.
BlurTaps nineTaps(double distance = 1);

// Five taps of a fifth each, in the middle of five equal parts of a Gaussian's area. That makes their
// variance 0.767 sigma^2; corrected, the offsets are stretched by 1.1417, and it is sigma^2. sigma: texels of
// the target.
BlurTaps importanceTaps(double sigma, bool corrected);

// A whole blur: pairs of passes, all with the same taps.
struct BlurPlan {
    BlurTaps taps;
    int pairs = 1; // 0: the mean of four texels at half the resolution, and no pass after it
    bool half_resolution = false;
    bool vertical_steps_sideways = false; // the misprint: also the vertical passes fetch along the row
    Defines guard = {};                   // the defines of an hdr::Guard
};

struct BlurRequest {
    // "ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap", "mipmap" or "wide_gaussian"
    std::string_view method;
    double sigma = 0;              // pixels of the frame; 0: the method's own width
    int iterations = 5;            // pairs of passes where sigma is 0; wide_gaussian has one
    bool corrected_offsets = true; // of half_resolution_5tap where sigma is 0
};

// The taps and passes of a method. Where sigma is given, so many pairs that the taps need not lie further
// apart than the method has them, and the taps drawn together until the variance is right. Throws
// std::invalid_argument for an unknown method.
BlurPlan planBlur(const BlurRequest& request);

// The width that a plan reaches, pixels of the frame: the root of its variance, of both directions' mean.
double sigmaOf(const BlurPlan& plan);

// The most pairs that planBlur() makes: ping-pong then reaches a sigma of 16 pixels and no further.
inline constexpr int most_pairs = 90;

// Runs a plan's passes: "horizontal1", "vertical1", "horizontal2" ... into the targets "across" and
// "blurred".
class GaussianBlur {
  public:
    // Returns the blurred picture, of the frame's size or half of it (rounded down, at least 1); valid until
    // the next call. bright: of the frame's size, filtered linearly, clamped to its edges; its format holds
    // what lies between the passes, and the result.
    const Texture& draw(Frame& frame, ShaderLibrary& shaders, const Texture& bright, const BlurPlan& plan);

  private:
    Framebuffer across_;
    Framebuffer blurred_;
};

} // namespace gll::gaussian_bloom
