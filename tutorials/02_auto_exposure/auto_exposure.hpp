// Automatic exposure: the log-average luminance of a frame by one of four reductions, how an eye adapts to it
// over time, and the factor on scene light that follows.
#pragma once

#include "01_hdr/guard.hpp"
#include "rung/frame.hpp"
#include "rung/settings.hpp"

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gll::auto_exposure {

struct AutoExposureOptions {
    explicit AutoExposureOptions(Settings& settings);

    Choice reduction;
    Number epsilon;
    Number low_percent;
    Number high_percent;
    Number key;
    Number min_ev;
    Number max_ev;
    Toggle adapt;
    Number adapt_up_s;
    Number adapt_down_s;
    hdr::Guard guard;
};

// Reduces a frame's luminances to one number. Targets are kept between frames and made anew where the size
// changes.
class LuminanceMeter {
  public:
    LuminanceMeter(ShaderLibrary& shaders, const AutoExposureOptions& options)
        : shaders_(shaders), options_(options) {}

    // Draws the passes of the chosen reduction of hdr (linear light, any size). white_point is the upper end
    // of the range that mipmap_r16 can hold. Returns 1x1, R32F: the log2 of exp(mean(ln(epsilon +
    // luminance))) by Reinhard et al. 2002, eq. 1, over all pixels whose luminance is a finite number
    // (histogram: over those between the percentiles). Valid until the next call.
    const Texture& measure(Frame& frame, const Texture& hdr, float white_point);

    // Counts samples of hdr in 128 bins of log2 luminance from -16 to 16. Returns 128x1, RG32F: number and
    // sum of log2 luminance. measure() draws it where the reduction needs it.
    const Texture& drawHistogram(Frame& frame, const Texture& hdr);
    const Texture& histogram() const { return histogram_.color(); } // as it was drawn last

    // How many samples of a target of this size the histogram counts, along either axis.
    static glm::ivec2 histogramGrid(glm::ivec2 size);

  private:
    const Texture& drawMipmaps(Frame& frame, const Texture& hdr, float white_point);
    const Texture& drawAverages(Frame& frame, const Texture& hdr);

    ShaderLibrary& shaders_;
    const AutoExposureOptions& options_;
    Framebuffer log_luminance_;
    std::deque<Framebuffer>
        averages_; // each an eighth of the one before; a deque, so that they stay in place
    Framebuffer histogram_{{{.name = "histogram", .format = Format::rg32f, .filter = Filter::nearest}},
                           {128, 1}};
    Framebuffer metered_{{{.name = "metered", .format = Format::r32f, .filter = Filter::nearest}}, {1, 1}};
};

// Stops are log2 luminance throughout.

// How fast an eye adapts: the time after which 1/e of the way is left, seconds; 0: at once.
struct AdaptationSpeed {
    double up_s = 0;   // to a brighter scene
    double down_s = 0; // to a darker one
};

// The share of the way to a new luminance that is gone in dt_s: 1 - exp(-dt / tau).
double adaptationShare(double time_constant_s, double dt_s);

// One step in time from what the eye had adapted to, towards what it sees.
double adapted(double previous_stop, double metered_stop, AdaptationSpeed speed, double dt_s);

// How many frames of history matter. Two eyes that see the same but began range_stops apart come closer by
// exp(-dt / tau) or more in every frame, tau being the slower time constant; after so many frames less than
// error_stops is left.
int framesThatMatter(AdaptationSpeed speed, double dt_s, double range_stops, double error_stops = 0.001);

// What the eye has adapted to when a frame begins, computed from the frames before it: the same however one
// comes to that frame. Metered values are kept as long as the settings they depend on stay the same.
class AdaptationHistory {
  public:
    // metered(n): log2 luminance of frame n, from 1; the scene repeats after period_frames.
    explicit AdaptationHistory(int period_frames) : metered_stops_(static_cast<std::size_t>(period_frames)) {}

    // Forgets all where made_with, the settings that metering depends on, differs from the last call's.
    // Returns nothing for the first frame, which has no past.
    std::optional<double> before(int frame_number, const AutoExposureOptions& options,
                                 const std::string& made_with, const std::function<double(int)>& metered);

  private:
    std::vector<std::optional<double>> metered_stops_;
    std::string made_with_;
};

// The exposure of a frame.
class AutoExposure {
  public:
    AutoExposure(ShaderLibrary& shaders, const AutoExposureOptions& options)
        : shaders_(shaders), options_(options) {}

    // From metered, what LuminanceMeter::measure() gave, and the luminance adapted to one frame ago (nothing:
    // adapts at once). Returns 1x1, RGBA32F: factor on scene light, luminance adapted to, key, log2 luminance
    // metered.
    const Texture& draw(Frame& frame, const Texture& metered, std::optional<double> previous_stop,
                        float compensation_ev);

  private:
    ShaderLibrary& shaders_;
    const AutoExposureOptions& options_;
    Framebuffer exposure_{{{.name = "exposure", .format = Format::rgba32f, .filter = Filter::nearest}},
                          {1, 1}};
};

} // namespace gll::auto_exposure
