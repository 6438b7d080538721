// 02_auto_exposure: a walk from a sunlit court through an arch into a dark hall and back. Every frame is
// metered, the eye adapts to it over time, and the exposure that follows brings the frame into a display's
// range.
#include "01_hdr/tone_map.hpp"
#include "auto_exposure.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "rung/capture.hpp"
#include "scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec4.hpp>

namespace {
using namespace gll;
using namespace gll::auto_exposure;

constexpr std::array patterns = {"none", "black", "flat", "checkerboard", "one_hot", "ramp"};

struct AutoExposureRungOptions {
    Settings all;
    AutoExposureOptions exposure{all};
    hdr::ToneMapOptions display{all, "reinhard_extended", "srgb", 0.22};
    Toggle overlay = all.toggle("overlay", true, "figures and histogram in the picture");
    Number light_ev = all.number("light_ev", 0, -16, 16, "all light of the scene, stops");
    Choice test_pattern = all.choice("test_pattern", "none", {patterns.begin(), patterns.end()},
                                     "in place of the scene, for trying the meter");
    OrbitSettings orbit{all};

    AutoExposureRungOptions() {
        all.group(Setting::Group::look, {"overlay", "light_ev", "test_pattern"});
        all.needs({"camera_yaw_deg", "camera_pitch_deg", "camera_zoom"}, {{"test_pattern", {"none"}}});
        all.at("white_point").needs = {{{"tone_map", {"reinhard_extended"}}, {"reduction", {"mipmap_r16"}}}};
        all.dial({"reduction", {"area", "histogram", "mipmap_r16f", "mipmap_r16"}});
        all.preset({"recommended",
                    "the reduction that is right at every size: the default already",
                    {{"reduction", "area"}}});
    }
};

class AutoExposureRung final : public Rung {
  public:
    using Options = AutoExposureRungOptions;

    AutoExposureRung(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), meter_(shaders_, options.exposure),
          past_meter_(shaders_, options.exposure), exposure_(shaders_, options.exposure) {}

    // excerpt: frame
    void render(Frame& frame) override {
        const std::optional<double> previous_stop = adaptedBefore(frame.number());
        hdr_.resize(frame.size());
        drawScene(frame, hdr_, options_.orbit.apply(walk(frame.number())), frame.aspect());
        const Texture& metered = meter_.measure(frame, hdr_.color(), options_.display.white_point);
        exposure_state_ = &exposure_.draw(frame, metered, previous_stop, options_.display.exposure_ev);
        composite(frame);
        if (options_.overlay) drawOverlay(frame);
    }
    // end excerpt

    std::vector<Reading> readings() override {
        const Image image = readTexture(*exposure_state_);
        const auto& state = std::get<std::vector<float>>(image.pixels);
        return {{"metered_luminance", "", std::exp2(double(state[3]))},
                {"metered_ev", "stops", state[3]},
                {"adapted_luminance", "", state[1]},
                {"key", "", state[2]},
                {"exposure_ev", "stops", std::log2(double(state[0])), true}};
    }

    // What is metered: all of the frame, unless a histogram is trimmed already.
    std::vector<std::string> implied() const override {
        if (options_.exposure.reduction == "histogram") return {};
        return {"low_percent=0", "high_percent=100"};
    }

  private:
    // excerpt: past
    // What the eye had adapted to one frame ago, by metering small frames of the scripted walk from the first
    // one on, or as many as matter. They are no part of this frame: they stand in for a past that a program
    // started at frame 500 has not seen.
    std::optional<double> adaptedBefore(int frame_number) {
        if (!options_.exposure.adapt) return std::nullopt;
        return history_.before(frame_number, options_.exposure, meteredWith(), [&](int number) {
            Frame past(number, past_, triangle_, nullptr);
            drawScene(past, past_, walk(number), 4.0F / 3.0F);
            const Image image =
                readTexture(past_meter_.measure(past, past_.color(), options_.display.white_point));
            return std::get<std::vector<float>>(image.pixels)[0];
        });
    }
    // end excerpt

    // All that the meter's reading of a past frame depends on.
    std::string meteredWith() const {
        const AutoExposureOptions& meter = options_.exposure;
        std::string text = meter.reduction.name();
        text += options_.test_pattern.name();
        text += std::to_string(shaders_.generation());
        for (const float value : {float(options_.light_ev), float(meter.epsilon), float(meter.low_percent),
                                  float(meter.high_percent), float(options_.display.white_point)})
            (text += ",") += std::to_string(std::bit_cast<std::uint32_t>(value)); // exact
        return text;
    }

    void drawScene(Frame& frame, const Framebuffer& target, const Camera& camera, float aspect) {
        const float light = std::exp2(options_.light_ev);
        if (!(options_.test_pattern == "none")) {
            const auto pattern =
                std::find(patterns.begin(), patterns.end(), options_.test_pattern.name()) - patterns.begin();
            frame.pass("scene", target,
                       {.program = shaders_.fullScreen("02_auto_exposure/pattern.frag"),
                        .uniforms = {{"pattern", static_cast<int>(pattern)},
                                     {"light", light},
                                     {"size", target.size()}}});
            return;
        }
        frame.pass("scene", target,
                   {.program = shaders_.program("02_auto_exposure/scene.vert", "02_auto_exposure/scene.frag"),
                    .uniforms = {{"clip_from_world", camera.clipFromView(aspect) * camera.viewFromWorld()},
                                 {"camera_position", camera.position},
                                 {"light", light}},
                    .mesh = &court_and_hall_,
                    .depth_test = DepthTest::less,
                    .cull = Cull::back,
                    .clear_color = glm::vec4(0, 0, 0, 1),
                    .clear_depth = 1.0F});
    }

    void composite(Frame& frame) {
        const Program& program =
            shaders_.fullScreen("02_auto_exposure/composite.frag",
                                options_.display.defines() + options_.exposure.guard.defines());
        frame.pass("composite", frame.presented(),
                   {.program = program,
                    .inputs = {{"hdr", hdr_.color()}, {"exposure", *exposure_state_}},
                    .part = {.uniforms = {{"white_point", options_.display.white_point}}}});
    }

    // Figures and histogram at the lower right, where the window's panel does not reach, as large as the
    // frame allows; none where they have no room.
    void drawOverlay(Frame& frame) {
        constexpr glm::ivec2 read_out(136, 48);
        constexpr int margin = 4;
        const glm::ivec2 size = frame.size();
        if (size.x < read_out.x + 2 * margin || size.y < read_out.y + 2 * margin) return;
        const bool counted = options_.exposure.reduction == "histogram";
        if (!counted) meter_.drawHistogram(frame, hdr_.color());
        const auto scale = static_cast<float>(std::max(1, std::min(size.x / 320, size.y / 240)));
        const glm::vec2 extent = scale * glm::vec2(read_out);
        const glm::vec2 origin(static_cast<float>(size.x) - extent.x - scale * margin, scale * margin);
        const glm::ivec2 grid = LuminanceMeter::histogramGrid(size);
        frame.pass(
            "overlay", frame.presented(),
            {.program = shaders_.program("02_auto_exposure/overlay.vert", "02_auto_exposure/overlay.frag"),
             .inputs = {{"histogram", meter_.histogram()}, {"exposure", *exposure_state_}},
             .uniforms = {{"origin", origin},
                          {"extent", extent},
                          {"frame_size", glm::vec2(size)},
                          {"scale", scale},
                          {"samples", static_cast<float>(grid.x * grid.y)},
                          {"burn_out", burnOut()}},
             .instances = 2});
    }

    // Exposed luminance from which the tone map gives white; 0 where it only comes close.
    float burnOut() const {
        if (options_.display.tone_map == "reinhard_extended") return options_.display.white_point;
        return options_.display.tone_map == "clamp" ? 1.0F : 0.0F;
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Mesh court_and_hall_ = makeCourtAndHall();
    Mesh triangle_ = Mesh::fullScreenTriangle();
    Framebuffer hdr_{{{.name = "hdr", .format = Format::rgba16f, .filter = Filter::nearest},
                      {.name = "depth", .format = Format::depth24, .filter = Filter::nearest}},
                     {1, 1}};
    LuminanceMeter meter_;
    // A power of two, for which every reduction is right; the view is 4:3 whatever the frame's shape.
    Framebuffer past_{{{.name = "past", .format = Format::rgba16f, .filter = Filter::nearest},
                       {.name = "past_depth", .format = Format::depth24, .filter = Filter::nearest}},
                      {64, 64}};
    LuminanceMeter past_meter_;
    AdaptationHistory history_{walk_frames};
    AutoExposure exposure_;
    const Texture* exposure_state_ = nullptr;
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<AutoExposureRung>(
        argc, argv,
        {.name = "02_auto_exposure",
         .summary = "From sun into shade and back: metering, adaptation, exposure."});
}
