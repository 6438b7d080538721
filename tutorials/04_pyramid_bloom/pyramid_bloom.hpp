// Bloom as a pyramid: what is bright goes down through images of half the size each, is blurred there if
// asked for, and comes up again summed, so that a few taps a level make a glow as wide as the frame.
#pragma once

#include "01_hdr/guard.hpp"
#include "rung/frame.hpp"
#include "rung/settings.hpp"

namespace gll::pyramid_bloom {

inline constexpr int max_bloom_levels = 8;

// The filters as settings, for every rung that draws this bloom; each rung has its own defaults.
struct PyramidFilters {
    PyramidFilters(Settings& settings, std::string_view default_karis, std::string_view default_down_filter)
        : karis(
              settings.choice("karis", default_karis, {"none", "average", "texel", "partial"},
                              "Karis weight against fireflies: none, on the average of four texels, on each, "
                              "or on each of five boxes")),
          down_filter(settings.choice("down_filter", default_down_filter,
                                      {"5tap", "13tap", "13tap_as_printed", "4tap", "box", "spline"},
                                      "how levels are halved; spline: by area, exact at every size")),
          up_filter(settings.choice("up_filter", "tent", {"tent", "4tap", "dual", "bilinear", "spline"},
                                    "how levels are doubled")),
          finest(settings.toggle(
              "finest", true, "whether the largest level adds its own light, or only carries the others'")),
          normalise(
              settings.toggle("normalise", false,
                              "divide by the number of levels: the bloom has the light of what is bright")),
          guard(settings) {
        settings.shared("04_pyramid_bloom", {"karis", "down_filter", "up_filter", "finest", "normalise"});
    }

    // For --budget: the filters from the most accurate on.
    static void dials(Settings& settings) {
        settings.dial({"down_filter", {"spline", "13tap", "5tap", "4tap", "box"}});
        settings.dial({"up_filter", {"spline", "tent", "dual", "4tap", "bilinear"}});
    }

    Choice karis;
    Choice down_filter;
    Choice up_filter;
    Toggle finest;
    Toggle normalise;
    hdr::Guard guard;
};

// excerpt: parameters
// How one bloom is drawn, read anew every frame.
struct PyramidBloomParameters {
    PyramidFilters filters;
    int levels = 5;           // 1 to max_bloom_levels; level i has 1 / 2^(i + 1) of the source's size
    float threshold = 0.8F;   // luminance from which a pixel blooms
    float knee = 0.4F;        // half the width of the soft step at the threshold, luminance; 0: a hard step
    float blur_radius = 0.5F; // distance of the Gaussian's taps, texels of its level; 0: no blur
    bool accumulate = true;   // false: each level takes the next one as it was before it had a sum itself
    Format format = Format::rgba16f; // of the levels
};
// end excerpt

// One direction of the nine-tap Gaussian as fewer bilinear fetches.
struct BlurTaps {
    float centre_weight = 1;
    std::vector<float> offsets = {}; // texels, > 0; each tap stands for itself and its mirror image
    std::vector<float> weights = {};
};

// Nine taps, radius texels apart (0 and up), merged two by two where that saves fetches: the sum over any
// texels is the same. The weights add up to 1.
BlurTaps blurTaps(float radius);

// Keeps its targets from frame to frame and makes them anew only where the size, the format or the number of
// levels changes. Moves, never copies; the shaders must outlive it.
class PyramidBloom {
  public:
    explicit PyramidBloom(ShaderLibrary& shaders) : shaders_(shaders) {}

    // Bright pass, way down and way up of a source of any size and any filterable format (linear filter,
    // clamped to its edges). What it returns is level 0, to be multiplied by a strength and added to the
    // source: strength * share(parameters). Where splines draw a small frame, whose odd pixels would not all
    // get the same from bilinear fetches, it is of the frame's own size. Passes: "bright", "down1"...,
    // "blur_x0", "blur_y0"..., and "up0"...; targets "bloom0"..., "blur0"....
    const Texture& draw(Frame& frame, const Texture& source, const PyramidBloomParameters& parameters);

    // The two halves of draw(), for looking at the levels in between.
    void drawDown(Frame& frame, const Texture& source, const PyramidBloomParameters& parameters);
    void drawUp(Frame& frame, const PyramidBloomParameters& parameters);

    // What to multiply a strength by: 1, or 1 / the number of levels that add their light where normalise is
    // set.
    static float share(const PyramidBloomParameters& parameters);

    // Pass "composite": source + strength * bloom into a target of the source's size, alpha as in the source.
    // guard: the defines of an hdr::Guard.
    void composite(Frame& frame, const Texture& source, float strength, const Framebuffer& target,
                   const Defines& guard = {}) const;

    // Valid after drawDown(). Level 0 to parameters.levels - 1.
    const Texture& level(int i) const { return levels_.at(static_cast<std::size_t>(i)).color(); }

  private:
    const Texture& result() const { return full_ ? full_->color() : level(0); }
    void allocate(glm::ivec2 source_size, const PyramidBloomParameters& parameters);
    bool usesSplines(const PyramidBloomParameters& parameters) const;
    void drawDownBySplines(Frame& frame, const Texture& source, const PyramidBloomParameters& parameters);
    void blur(Frame& frame, std::size_t i, float radius, const Defines& guard);

    ShaderLibrary& shaders_;
    std::vector<Framebuffer> levels_;
    std::optional<Framebuffer> full_; // level 0 at the source's size, where that is small
    std::vector<Framebuffer>
        blurred_; // one direction blurred, of the levels' sizes; empty while there is no blur
};

} // namespace gll::pyramid_bloom
