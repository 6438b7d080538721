// 05_hdr_bloom: a thousand cubes drawn into a floating-point target, every ninth of them far brighter than
// white; what is too bright is blurred down and up a pyramid, added back as bloom, and the sum is tone
// mapped.
#include "01_hdr/tone_map.hpp"
#include "app/camera.hpp"
#include "run/run.hpp"
#include "swarm.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

namespace {
using namespace gll;

constexpr int max_levels = 8;

struct HdrBloomOptions {
    Settings all;
    // excerpt: settings
    Toggle bloom = all.toggle("bloom", true, "whether bright light spills over its edges");
    Integer levels =
        all.integer("levels", 5, 1, max_levels, "bloom levels, each half the size of the one before");
    Number threshold = all.number("threshold", 1.0, 0, 1000, "luminance from which a pixel blooms");
    Number knee =
        all.number("knee", 0.6, 0, 100, "half the width of the soft step at the threshold, luminance");
    Number intensity = all.number("intensity", 0.7, 0, 100, "how much bloom is added to the scene");
    Choice karis =
        all.choice("karis", "seed", {"seed", "texel", "none"},
                   "Karis weight against fireflies: on the average of four texels, on each, or none");
    Choice down_filter =
        all.choice("down_filter", "5tap", {"5tap", "13tap", "4tap", "box"}, "how levels are halved");
    Choice up_filter =
        all.choice("up_filter", "tent", {"tent", "4tap", "bilinear"}, "how levels are doubled");
    ToneMapOptions display{all, "aces_narkowicz", "gamma22"};
    Integer instances = all.integer("instances", 1000, 1, 1'000'000, "number of cubes");
    Number boost = all.number("boost", 8, 0, 1000, "how many times brighter a glowing cube is");
    Integer glow_every =
        all.integer("glow_every", 9, 0, 1'000'000, "every how many cubes one glows; 0: none does");
    Integer glow_first = all.integer("glow_first", 0, 0, 1'000'000, "the first cube that glows");
    OrbitSettings orbit{all};
    // end excerpt
};

class HdrBloom final : public Rung {
  public:
    using Options = HdrBloomOptions;

    HdrBloom(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options) {}

    void render(Frame& frame) override {
        resize(frame.size());
        drawScene(frame);
        if (options_.bloom) drawBloom(frame);
        composite(frame);
    }

  private:
    // excerpt: resize
    void resize(glm::ivec2 size) {
        hdr_.resize(size);
        while (static_cast<int>(bloom_.size()) < options_.levels)
            bloom_.emplace_back(Framebuffer({{"bloom" + std::to_string(bloom_.size())}}, {1, 1}));
        for (int i = 0; i < options_.levels; ++i)
            level(i).resize(glm::max(glm::ivec2(size.x >> (i + 1), size.y >> (i + 1)), 1));
    }
    // end excerpt

    // excerpt: scene
    void drawScene(Frame& frame) {
        const float orbit_rad = frame.time_s() * 0.3F;
        const Camera camera = options_.orbit.apply(
            {.position = {14 * std::cos(orbit_rad), 2 * std::sin(2 * orbit_rad), 14 * std::sin(orbit_rad)},
             .vertical_field_of_view_deg = 60,
             .near = 0.1F,
             .far = 60});
        frame.pass(
            "scene", hdr_,
            {.program = shaders_.program("05_hdr_bloom/scene.vert", "05_hdr_bloom/scene.frag"),
             .uniforms = {{"clip_from_world", camera.clipFromView(frame.aspect()) * camera.viewFromWorld()},
                          {"camera_position", camera.position},
                          {"time_s", frame.time_s()},
                          {"emissive_boost", options_.boost}},
             .mesh = &swarm(),
             .instances = options_.instances,
             .depth_test = DepthTest::less_equal,
             .cull = Cull::back,
             .clear_color = glm::vec4(0.01F, 0, 0.03F, 1),
             .clear_depth = 1.0F});
    }
    // end excerpt

    // excerpt: bloom
    void drawBloom(Frame& frame) {
        frame.pass("bright", level(0),
                   {.program = shaders_.fullScreen("05_hdr_bloom/bright.frag", options_.karis.defines()),
                    .inputs = {{"hdr", hdr_.color()}},
                    .uniforms = {{"threshold", options_.threshold}, {"knee", options_.knee}}});
        for (int i = 1; i < options_.levels; ++i)
            frame.pass(
                "down" + std::to_string(i), level(i),
                {.program = shaders_.fullScreen("05_hdr_bloom/down.frag", options_.down_filter.defines()),
                 .inputs = {{"source", level(i - 1).color()}}});
        for (int i = options_.levels - 2; i >= 0; --i)
            frame.pass("up" + std::to_string(i), level(i),
                       {.program = shaders_.fullScreen("05_hdr_bloom/up.frag", options_.up_filter.defines()),
                        .inputs = {{"source", level(i + 1).color()}},
                        .blend = Blend::add});
    }
    // end excerpt

    // excerpt: composite
    void composite(Frame& frame) {
        const Program& program = shaders_.fullScreen(
            "lib/present.frag", options_.display.defines() + Defines{{"BLOOM", options_.bloom ? "1" : "0"}});
        std::vector<UniformSetting> uniforms = usedBy(program, options_.display.uniforms());
        std::vector<Input> inputs = {{"hdr", hdr_.color()}};
        if (options_.bloom) {
            inputs.push_back({"bloom", level(0).color()});
            uniforms.push_back({"intensity", options_.intensity});
        }
        frame.pass("composite", frame.presented(),
                   {.program = program, .inputs = inputs, .uniforms = uniforms});
    }
    // end excerpt

    Framebuffer& level(int i) { return bloom_[static_cast<std::size_t>(i)]; }

    // The cubes, made anew where a setting that they are made from has changed.
    const Mesh& swarm() {
        const std::array<int, 3> made_from = {options_.instances, options_.glow_every, options_.glow_first};
        if (!swarm_ || made_from != swarm_made_from_) {
            swarm_.emplace(makeSwarm(options_.instances, options_.glow_every, options_.glow_first));
            swarm_made_from_ = made_from;
        }
        return *swarm_;
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Framebuffer hdr_{{{.name = "hdr", .format = Format::rgba16f},
                      {.name = "depth", .format = Format::depth24, .filter = Filter::nearest}},
                     {1, 1}};
    std::vector<Framebuffer> bloom_; // level i is 1 / 2^(i + 1) of the frame's size, RGBA16F, bilinear
    std::optional<Mesh> swarm_;
    std::array<int, 3> swarm_made_from_ = {};
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<HdrBloom>(
        argc, argv,
        {.name = "05_hdr_bloom", .summary = "A swarm of glowing cubes: HDR target, bloom, ACES."});
}
