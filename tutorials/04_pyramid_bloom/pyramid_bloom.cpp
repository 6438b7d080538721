// The passes of the pyramid, and the taps of its blur.
#include "04_pyramid_bloom/pyramid_bloom.hpp"

#include "04_pyramid_bloom/spline_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace gll::pyramid_bloom {
namespace {

// A Gaussian over nine taps; with both sides the weights add up to 1.
constexpr std::array gaussian = {0.2270270270F, 0.1945945946F, 0.1216216216F, 0.0540540541F, 0.0162162162F};

// Level i is the source halved i + 1 times, at least one pixel a side: rounded down, or up where the edges
// are mirrored, so that no texel of the larger is left over.
void remakeChain(std::vector<Framebuffer>& chain, const std::string& name, int count, Format format,
                 Wrap wrap, glm::ivec2 source_size) {
    const int rounding = wrap == Wrap::mirrored_repeat ? 1 : 0;
    chain.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < chain.size(); ++i) {
        source_size = glm::max((source_size + rounding) / 2, 1);
        chain[i].remake({{.name = name + std::to_string(i), .format = format, .wrap = wrap}}, source_size);
    }
}

} // namespace

// excerpt: blur_taps
BlurTaps blurTaps(float radius) {
    constexpr int most = 4;
    if (radius > 1) // more texels than taps: nothing to merge
        return {gaussian[0],
                {radius, 2 * radius, 3 * radius, 4 * radius},
                {gaussian.begin() + 1, gaussian.end()}};
    // A tap between two texels is worth a share of either. So at half a texel's distance the nine taps weigh
    // no more than five texels.
    std::array<float, most + 2> texels = {};
    for (int k = -most; k <= most; ++k) {
        const float place = static_cast<float>(k) * radius;
        for (int j = 0; j <= most; ++j)
            texels[static_cast<std::size_t>(j)] +=
                gaussian[static_cast<std::size_t>(std::abs(k))] *
                std::max(1 - std::abs(place - static_cast<float>(j)), 0.0F);
    }
    // And a bilinear fetch placed between two texels, nearer to the heavier one, weighs both at once.
    BlurTaps taps{.centre_weight = texels[0]};
    for (std::size_t j = 1; j <= most; j += 2)
        if (const float weight = texels[j] + texels[j + 1]; weight > 0) {
            taps.offsets.push_back(static_cast<float>(j) + texels[j + 1] / weight);
            taps.weights.push_back(weight);
        }
    return taps;
}
// end excerpt

void PyramidBloom::allocate(glm::ivec2 source_size, const PyramidBloomParameters& parameters) {
    if (parameters.levels < 1 || parameters.levels > max_bloom_levels)
        throw std::invalid_argument("bloom: " + std::to_string(parameters.levels) + " levels; 1 to " +
                                    std::to_string(max_bloom_levels) + " are possible");
    const Wrap wrap = usesSplines(parameters) ? Wrap::mirrored_repeat : Wrap::clamp_to_edge;
    remakeChain(levels_, "bloom", parameters.levels, parameters.format, wrap, source_size);
    remakeChain(blurred_, "blur", parameters.blur_radius > 0 ? parameters.levels : 0, parameters.format, wrap,
                source_size);
    if (!usesSplines(parameters) || std::min(source_size.x, source_size.y) >= smallest_large_px)
        return full_.reset();
    if (!full_) full_.emplace();
    full_->remake({{.name = "bloom", .format = parameters.format}}, source_size);
}

const Texture& PyramidBloom::draw(Frame& frame, const Texture& source,
                                  const PyramidBloomParameters& parameters) {
    drawDown(frame, source, parameters);
    drawUp(frame, parameters);
    return result();
}

bool PyramidBloom::usesSplines(const PyramidBloomParameters& parameters) const {
    return parameters.filters.down_filter == "spline";
}

float PyramidBloom::share(const PyramidBloomParameters& parameters) {
    if (!parameters.filters.normalise) return 1;
    const int adding = parameters.levels - (parameters.filters.finest ? 0 : 1);
    return 1 / static_cast<float>(std::max(adding, 1));
}

// excerpt: down
void PyramidBloom::drawDown(Frame& frame, const Texture& source, const PyramidBloomParameters& parameters) {
    allocate(source.size(), parameters);
    const Defines guard = parameters.filters.guard.defines();
    if (usesSplines(parameters)) {
        drawDownBySplines(frame, source, parameters);
    } else {
        frame.pass("bright", levels_[0],
                   {.program = shaders_.fullScreen("04_pyramid_bloom/bright.frag",
                                                   parameters.filters.karis.defines() + guard),
                    .inputs = {{"source", source}},
                    .uniforms = {{"threshold", parameters.threshold}, {"knee", parameters.knee}}});
        for (std::size_t i = 1; i < levels_.size(); ++i)
            frame.pass("down" + std::to_string(i), levels_[i],
                       {.program = shaders_.fullScreen("04_pyramid_bloom/down.frag",
                                                       parameters.filters.down_filter.defines() + guard),
                        .inputs = {{"source", levels_[i - 1].color()}}});
    }
    for (std::size_t i = 0; i < blurred_.size(); ++i)
        blur(frame, i, parameters.blur_radius, guard);
}
// end excerpt

// excerpt: down_by_splines
void PyramidBloom::drawDownBySplines(Frame& frame, const Texture& source,
                                     const PyramidBloomParameters& parameters) {
    const auto draw = [&](const std::string& name, const Framebuffer& target, const Texture& from,
                          bool bright) {
        const glm::ivec2 size = from.size();
        const bool even = size.x % 2 == 0 && size.y % 2 == 0;
        const bool large = std::min(size.x, size.y) >= smallest_with_heights_px;
        const char* weights = !bright && even             ? "WEIGHTS_EVEN"
                              : bright && (even || large) ? "WEIGHTS_HEIGHT"
                                                          : "WEIGHTS_AREA";
        const Defines defines =
            parameters.filters.karis.defines() + parameters.filters.guard.defines() +
            Defines{{"BRIGHT", bright ? "1" : "0"}, {"DEGREE", bright ? "1" : "3"}, {"WEIGHTS_EVEN", "0"},
                    {"WEIGHTS_HEIGHT", "1"},        {"WEIGHTS_AREA", "2"},          {"WEIGHTS", weights}};
        const Program& program = shaders_.fullScreen("04_pyramid_bloom/spline.frag", defines);
        frame.pass(name, target,
                   {.program = program,
                    .inputs = {{"source", from}},
                    .part = {.uniforms = {{"threshold", parameters.threshold}, {"knee", parameters.knee}}}});
    };
    draw("bright", levels_[0], source, true);
    for (std::size_t i = 1; i < levels_.size(); ++i)
        draw("down" + std::to_string(i), levels_[i], levels_[i - 1].color(), false);
}
// end excerpt

// excerpt: blur
void PyramidBloom::blur(Frame& frame, std::size_t i, float radius, const Defines& guard) {
    const BlurTaps taps = blurTaps(radius);
    const Program& program = shaders_.fullScreen(
        "04_pyramid_bloom/blur.frag", guard + Defines{{"TAPS", std::to_string(taps.offsets.size())}});
    const auto direction = [&](const std::string& name, const Framebuffer& target, const Texture& source,
                               glm::vec2 step) {
        frame.pass(name + std::to_string(i), target,
                   {.program = program,
                    .inputs = {{"source", source}},
                    .uniforms = {{"direction", step / glm::vec2(source.size())},
                                 {"centre_weight", taps.centre_weight},
                                 {"offsets", taps.offsets},
                                 {"weights", taps.weights}}});
    };
    direction("blur_x", blurred_[i], levels_[i].color(), {1, 0});
    direction("blur_y", levels_[i], blurred_[i].color(), {0, 1});
}
// end excerpt

// excerpt: up
void PyramidBloom::drawUp(Frame& frame, const PyramidBloomParameters& parameters) {
    const Defines guard = parameters.filters.guard.defines();
    const int count = parameters.levels - 1;
    for (int step = 0; step < count; ++step) {
        // From the smallest level on, so that each one takes along what it has received. As printed, each
        // takes the next as it was: the other way round, nothing has been received yet.
        const int i = parameters.accumulate ? count - 1 - step : step;
        frame.pass("up" + std::to_string(i), levels_.at(static_cast<std::size_t>(i)),
                   {.program = shaders_.fullScreen("04_pyramid_bloom/up.frag",
                                                   parameters.filters.up_filter.defines() + guard),
                    .inputs = {{"source", level(i + 1)}},
                    .blend = i > 0 || parameters.filters.finest ? Blend::add : Blend::replace});
    }
    if (full_)
        frame.pass("up", *full_,
                   {.program = shaders_.fullScreen("04_pyramid_bloom/up.frag",
                                                   parameters.filters.up_filter.defines() + guard),
                    .inputs = {{"source", level(0)}}});
}
// end excerpt

void PyramidBloom::composite(Frame& frame, const Texture& source, float strength, const Framebuffer& target,
                             const Defines& guard) const {
    frame.pass("composite", target,
               {.program = shaders_.fullScreen("04_pyramid_bloom/composite.frag", guard),
                .inputs = {{"source", source}, {"bloom", result()}},
                .uniforms = {{"strength", strength}}});
}

} // namespace gll::pyramid_bloom
