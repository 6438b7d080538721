// The passes of metering and exposure, and adaptation over time.
#include "auto_exposure.hpp"

#include <algorithm>
#include <cmath>

namespace gll::auto_exposure {
namespace {

constexpr int reduced_by = 8;         // along either axis, in one step of the area-weighted average
constexpr int histogram_samples = 64; // at most, along either axis

AdaptationSpeed speedOf(const AutoExposureOptions& options) {
    return {.up_s = options.adapt_up_s, .down_s = options.adapt_down_s};
}

} // namespace

// excerpt: settings
AutoExposureOptions::AutoExposureOptions(Settings& settings)
    : reduction(settings.choice("reduction", "area", {"mipmap_r16", "mipmap_r16f", "area", "histogram"},
                                "how a frame's luminances become one")),
      epsilon(settings.number("epsilon", 1e-8, 1e-10, 0.01,
                              "added to every luminance, so that black has a logarithm")),
      low_percent(
          settings.number("low_percent", 10, 0, 50, "darkest samples that do not count; for histogram")),
      high_percent(settings.number("high_percent", 95, 50, 100,
                                   "where the brightest begin that do not count; for histogram")),
      key(settings.number("key", 0, 0, 1, "how bright the average comes out; 0: from the average")),
      min_ev(settings.number("min_ev", -9, -20, 0, "darkest average that is adapted to, log2 luminance")),
      max_ev(settings.number("max_ev", 9, 0, 16, "brightest average that is adapted to, log2 luminance")),
      adapt(settings.toggle("adapt", true, "whether exposure follows the light over time, or at once")),
      adapt_up_s(settings.number("adapt_up_s", 0.4, 0, 10, "time constant towards brighter scenes, s")),
      adapt_down_s(settings.number("adapt_down_s", 1.2, 0, 10, "time constant towards darker scenes, s")),
      guard(settings) {
    settings.needs({"low_percent", "high_percent"}, {{"reduction", {"histogram"}}});
    settings.needs({"adapt_up_s", "adapt_down_s"}, {{"adapt", {"on"}}});
}
// end excerpt

const Texture& LuminanceMeter::measure(Frame& frame, const Texture& hdr, float white_point) {
    const Texture& source = options_.reduction == "area"        ? drawAverages(frame, hdr)
                            : options_.reduction == "histogram" ? drawHistogram(frame, hdr)
                                                                : drawMipmaps(frame, hdr, white_point);
    const Program& program = shaders_.fullScreen("02_auto_exposure/metered.frag",
                                                 options_.reduction.defines() + options_.guard.defines());
    frame.pass("metered", metered_,
               {.program = program,
                .inputs = {{"source", source}},
                .part = {.uniforms = {{"epsilon", options_.epsilon},
                                      {"last_level", levelCount(hdr.size()) - 1},
                                      {"white_point", white_point},
                                      {"low_share", options_.low_percent / 100},
                                      {"high_share", options_.high_percent / 100}}}});
    return metered_.color();
}

// excerpt: mipmaps
const Texture& LuminanceMeter::drawMipmaps(Frame& frame, const Texture& hdr, float white_point) {
    const Format format = options_.reduction == "mipmap_r16" ? Format::r16 : Format::r16f;
    log_luminance_.remake({{.name = "log_luminance", .format = format, .mipmapped = true}}, hdr.size());
    const Program& program = shaders_.fullScreen("02_auto_exposure/log_luminance.frag",
                                                 options_.reduction.defines() + options_.guard.defines());
    frame.pass("log_luminance", log_luminance_,
               {.program = program,
                .inputs = {{"hdr", hdr}},
                .part = {.uniforms = {{"epsilon", options_.epsilon}, {"white_point", white_point}}},
                .generate_mipmaps = true});
    return log_luminance_.color();
}
// end excerpt

// excerpt: averages
const Texture& LuminanceMeter::drawAverages(Frame& frame, const Texture& hdr) {
    const Texture* source = &hdr;
    std::size_t step = 0;
    do {
        const glm::ivec2 size = (source->size() + reduced_by - 1) / reduced_by;
        if (step == averages_.size()) averages_.emplace_back();
        averages_[step].remake({{.name = "average", .format = Format::rg32f, .filter = Filter::nearest}},
                               size);
        const Program& program =
            shaders_.fullScreen("02_auto_exposure/average.frag",
                                options_.guard.defines() + Defines{{"FROM_LIGHT", step == 0 ? "1" : "0"}});
        frame.pass("average" + std::to_string(step), averages_[step],
                   {.program = program,
                    .inputs = {{"source", *source}},
                    .part = {.uniforms = {{"target_size", size}, {"epsilon", options_.epsilon}}}});
        source = &averages_[step++].color();
    } while (source->size() != glm::ivec2(1));
    return *source;
}
// end excerpt

glm::ivec2 LuminanceMeter::histogramGrid(glm::ivec2 size) { return glm::min(size, histogram_samples); }

// excerpt: histogram
const Texture& LuminanceMeter::drawHistogram(Frame& frame, const Texture& hdr) {
    const glm::ivec2 grid = histogramGrid(hdr.size());
    frame.pass("histogram", histogram_,
               {.program = shaders_.program("02_auto_exposure/histogram.vert",
                                            "02_auto_exposure/histogram.frag", options_.guard.defines()),
                .inputs = {{"hdr", hdr}},
                .uniforms = {{"grid", grid}, {"epsilon", options_.epsilon}},
                .instances = grid.x * grid.y, // of one triangle
                .blend = Blend::add,
                .clear_color = glm::vec4(0)});
    return histogram_.color();
}
// end excerpt

// excerpt: adapted
double adaptationShare(double time_constant_s, double dt_s) {
    return time_constant_s > 0 ? -std::expm1(-dt_s / time_constant_s) : 1;
}

double adapted(double previous_stop, double metered_stop, AdaptationSpeed speed, double dt_s) {
    const double tau_s = metered_stop > previous_stop ? speed.up_s : speed.down_s;
    return previous_stop + (metered_stop - previous_stop) * adaptationShare(tau_s, dt_s);
}

int framesThatMatter(AdaptationSpeed speed, double dt_s, double range_stops, double error_stops) {
    const double tau_s = std::max(speed.up_s, speed.down_s);
    if (range_stops <= error_stops) return 0;
    return static_cast<int>(std::ceil(tau_s / dt_s * std::log(range_stops / error_stops)));
}
// end excerpt

// excerpt: history
std::optional<double> AdaptationHistory::before(int frame_number, const AutoExposureOptions& options,
                                                const std::string& made_with,
                                                const std::function<double(int)>& metered) {
    if (frame_number <= 1) return std::nullopt;
    if (made_with != made_with_) std::fill(metered_stops_.begin(), metered_stops_.end(), std::nullopt);
    made_with_ = made_with;
    const auto meteredIn = [&](int number) {
        std::optional<double>& kept =
            metered_stops_[static_cast<std::size_t>(number - 1) % metered_stops_.size()];
        if (!kept) kept = metered(number);
        return std::clamp<double>(*kept, options.min_ev, options.max_ev);
    };
    const AdaptationSpeed speed = speedOf(options);
    const int history = framesThatMatter(speed, 1 / frames_per_second, options.max_ev - options.min_ev);
    const int first = std::max(1, frame_number - 1 - history);
    double stop = meteredIn(first);
    for (int number = first + 1; number < frame_number; ++number)
        stop = adapted(stop, meteredIn(number), speed, 1 / frames_per_second);
    return stop;
}
// end excerpt

const Texture& AutoExposure::draw(Frame& frame, const Texture& metered, std::optional<double> previous_stop,
                                  float compensation_ev) {
    const AdaptationSpeed speed = previous_stop ? speedOf(options_) : AdaptationSpeed{};
    const auto share = [](double tau_s) {
        return static_cast<float>(adaptationShare(tau_s, 1 / frames_per_second));
    };
    frame.pass("exposure", exposure_,
               {.program = shaders_.fullScreen("02_auto_exposure/exposure.frag", options_.guard.defines()),
                .inputs = {{"metered", metered}},
                .uniforms = {{"lowest_stop", options_.min_ev},
                             {"highest_stop", options_.max_ev},
                             {"previous_stop", static_cast<float>(previous_stop.value_or(0))},
                             {"share_up", share(speed.up_s)},
                             {"share_down", share(speed.down_s)},
                             {"key_override", options_.key},
                             {"compensation", std::exp2(compensation_ev)}}});
    return exposure_.color();
}

} // namespace gll::auto_exposure
