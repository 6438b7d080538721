// 03_gaussian_bloom: a street at night. The scene pass writes two targets, what is seen and what of it is
// bright; the bright one is blurred by a Gaussian, in one of several ways, and added back before tone
// mapping.
#include "01_hdr/guard.hpp"
#include "01_hdr/tone_map.hpp"
#include "gaussian_blur.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "rung/scene_image.hpp"
#include "street.hpp"

#include <cmath>
#include <cstdio>

namespace {
using namespace gll;
using namespace gll::gaussian_bloom;

struct GaussianBloomOptions {
    Settings all;
    // excerpt: settings
    Toggle bloom = all.toggle("bloom", true, "whether bright light spills over its edges");
    Choice bright_pass =
        all.choice("bright_pass", "fixed", {"fixed", "white_point"},
                   "what is bright: luminance above threshold, or threshold_multiple white points");
    Number threshold = all.number("threshold", 1, 0, 1000, "luminance above which a pixel blooms; for fixed");
    Number threshold_multiple = all.number("threshold_multiple", 2.95, 0, 100,
                                           "white points from which a pixel blooms; for white_point");
    Choice bright_format = all.choice("bright_format", "rgba16f", {"rgba16f", "r11f_g11f_b10f"},
                                      "format of the bright target and of all that is blurred");
    Choice blur =
        all.choice("blur", "ping_pong_9tap",
                   {"ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap", "mipmap", "wide_gaussian"},
                   "how the bright target is blurred");
    Integer iterations = all.integer("iterations", 5, 1, most_pairs,
                                     "pairs of blur passes where sigma is 0; wide_gaussian has one");
    Number sigma = all.number("sigma", 0, 0, 32,
                              "width of the blur, pixels, of every method but mipmap; 0: each has its own");
    Choice offsets = all.choice("offsets", "corrected", {"corrected", "as_printed"},
                                "of half_resolution_5tap: as far apart as sigma says, or 12 % less");
    Choice vertical_step = all.choice("vertical_step", "corrected", {"corrected", "as_printed"},
                                      "whether the vertical passes step along the column, or along the row");
    Choice swizzle = all.choice("swizzle", "corrected", {"corrected", "as_printed"},
                                "channels that the bright pass copies: red, green, blue or red, blue, green");
    Number strength = all.number("strength", 0.98, 0, 100, "how much blurred light is added to the scene");
    hdr::Guard guard{all};
    hdr::ToneMapOptions display{all, "exposure", "gamma22"};
    OrbitSettings orbit{all};
    // end excerpt

    GaussianBloomOptions() {
        all.needs({"bright_pass", "threshold", "threshold_multiple", "bright_format", "blur", "iterations",
                   "sigma", "offsets", "vertical_step", "swizzle", "strength", "guard"},
                  {{"bloom", {"on"}}});
        all.needs({"threshold"}, {{"bright_pass", {"fixed"}}});
        all.needs({"threshold_multiple"}, {{"bright_pass", {"white_point"}}});
        all.needs(
            {"sigma", "vertical_step"},
            {{"blur", {"ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap", "wide_gaussian"}}});
        all.needs({"iterations"}, {{"blur", {"ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap"}}});
        all.needs({"offsets"}, {{"blur", {"half_resolution_5tap"}}});
        all.needs({"iterations", "offsets"}, {{"sigma", {"0"}}});
        all.at("white_point").needs = {
            {{"tone_map", {"reinhard_extended"}}, {"bright_pass", {"white_point"}}}};
        all.dial({"bloom", {"on", "off"}});
        all.dial({"blur", {"wide_gaussian", "ping_pong_9tap", "ping_pong_5fetch", "half_resolution_5tap"}});
        all.dial({"bright_format", {"rgba16f", "r11f_g11f_b10f"}});
        all.preset({"recommended",
                    "one Gaussian with computed weights, as wide as the original's ten passes",
                    {{"blur", "wide_gaussian"}, {"sigma", "3.78"}}});
    }
};

class GaussianBloom final : public Rung {
  public:
    using Options = GaussianBloomOptions;

    GaussianBloom(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), image_(resources) {}

    // excerpt: render
    void render(Frame& frame) override {
        remake(frame.size());
        drawScene(frame);
        const Texture* blurred = nullptr;
        if (options_.bloom) blurred = &blur_.draw(frame, shaders_, scene_.color(1), blurPlan());
        composite(frame, blurred);
    }
    // end excerpt

    // The width, which each method would choose for itself.
    std::vector<std::string> implied() const override {
        const double sigma = sigmaOf(blurPlan());
        char text[32];
        std::snprintf(text, sizeof text, "sigma=%.2f", sigma);
        return sigma > 0 ? std::vector<std::string>{text} : std::vector<std::string>{};
    }

  private:
    // excerpt: targets
    void remake(glm::ivec2 size) {
        scene_.remake({{.name = "hdr", .format = Format::rgba16f},
                       {.name = "bright", .format = formatNamed(options_.bright_format.name())},
                       {.name = "depth", .format = Format::depth24, .filter = Filter::nearest}},
                      size);
    }
    // end excerpt

    // excerpt: scene
    void drawScene(Frame& frame) {
        const float t = frame.time_s();
        const Camera camera = options_.orbit.apply(
            {.position = {1.3F * std::sin(0.3F * t), 1.9F + 0.25F * std::sin(0.4F * t), 8.4F},
             .target = {0, 2.2F, -12},
             .vertical_field_of_view_deg = 58,
             .near = 0.5F,
             .far = 200});
        const StreetLights lights = streetLightsAt(t);
        const float threshold = options_.bright_pass == "fixed"
                                    ? options_.threshold
                                    : options_.threshold_multiple * options_.display.white_point;
        const Defines defines = {{"LIGHTS", std::to_string(street_light_count)},
                                 {"BRIGHT_CHANNELS", options_.swizzle == "as_printed" ? "rbg" : "rgb"}};
        if (image_)
            return image_.draw(frame, "scene", scene_, "03_gaussian_bloom/image.frag",
                               options_.bright_pass.defines() + defines, {{"threshold", threshold}});
        frame.pass(
            "scene", scene_,
            {.program = shaders_.program("03_gaussian_bloom/scene.vert", "03_gaussian_bloom/scene.frag",
                                         options_.bright_pass.defines() + defines),
             .uniforms = {{"clip_from_world", camera.clipFromView(frame.aspect()) * camera.viewFromWorld()},
                          {"camera_position", camera.position},
                          {"pulse", pulseAt(t)},
                          {"light_positions", lights.positions},
                          {"light_colors", lights.colors},
                          {"threshold", threshold}},
             .mesh = &street_,
             .depth_test = DepthTest::less,
             .cull = Cull::back,
             .clear_color = glm::vec4(0, 0, 0, 1),
             .clear_depth = 1.0F});
    }
    // end excerpt

    BlurPlan blurPlan() const {
        BlurPlan plan = planBlur({.method = options_.blur.name(),
                                  .sigma = options_.sigma,
                                  .iterations = options_.iterations,
                                  .corrected_offsets = options_.offsets == "corrected"});
        plan.vertical_steps_sideways = options_.vertical_step == "as_printed";
        plan.guard = options_.guard.defines();
        return plan;
    }

    // excerpt: composite
    void composite(Frame& frame, const Texture* blurred) {
        const Program& program =
            shaders_.fullScreen("lib/present.frag", options_.display.defines() + options_.guard.defines() +
                                                        Defines{{"BLOOM", blurred ? "1" : "0"}});
        std::vector<UniformSetting> uniforms;
        std::vector<Input> inputs = {{"hdr", scene_.color(0)}};
        if (blurred) {
            inputs.push_back({"bloom", *blurred});
            uniforms.push_back({"intensity", options_.strength});
        }
        frame.pass(
            "composite", frame.presented(),
            {.program = program, .inputs = inputs, .uniforms = uniforms, .part = options_.display.part()});
    }
    // end excerpt

    ShaderLibrary& shaders_;
    const Options& options_;
    SceneImage image_; // --image
    Mesh street_ = makeStreet();
    Framebuffer scene_;
    GaussianBlur blur_;
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<GaussianBloom>(
        argc, argv,
        {.name = "03_gaussian_bloom",
         .summary = "A street at night: bright pass as a second target, Gaussian blurs.",
         .takes = {"image"}});
}
