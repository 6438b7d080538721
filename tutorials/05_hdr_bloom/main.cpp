// 05_hdr_bloom: a thousand cubes drawn into a floating-point target, every ninth of them far brighter than
// white; what is too bright is blurred down and up a pyramid, added back as bloom, and the sum is tone
// mapped.
#include "01_hdr/tone_map.hpp"
#include "04_pyramid_bloom/pyramid_bloom.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "rung/scene_image.hpp"
#include "swarm.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

namespace {
using namespace gll;
using namespace gll::hdr_bloom;
using pyramid_bloom::PyramidBloom;
using pyramid_bloom::PyramidBloomParameters;
using pyramid_bloom::PyramidFilters;

struct HdrBloomOptions {
    Settings all;
    // excerpt: settings
    Toggle bloom = all.toggle("bloom", true, "whether bright light spills over its edges");
    Integer levels = all.integer("levels", 5, 1, pyramid_bloom::max_bloom_levels,
                                 "bloom levels, each half the size of the one before");
    Number threshold = all.number("threshold", 1.0, 0, 1000, "luminance from which a pixel blooms");
    Number knee =
        all.number("knee", 0.6, 0, 100, "half the width of the soft step at the threshold, luminance");
    Number intensity = all.number("intensity", 0.7, 0, 100, "how much bloom is added to the scene");
    PyramidFilters filters{all, "average", "5tap"};
    hdr::ToneMapOptions display{all, "aces_narkowicz", "gamma22"};
    Integer instances = all.integer("instances", 1000, 1, 1'000'000, "number of cubes");
    Number boost = all.number("boost", 8, 0, 1000, "how many times brighter a glowing cube is");
    Integer glow_every =
        all.integer("glow_every", 9, 0, 1'000'000, "every how many cubes one glows; 0: none does");
    Integer glow_first = all.integer("glow_first", 0, 0, 1'000'000, "the first cube that glows");
    Choice depth = all.choice("depth", "depth24", {"depth24", "depth16"},
                              "bits of the depth buffer; with 16, faces that nearly touch fight");
    OrbitSettings orbit{all};
    // end excerpt

    HdrBloomOptions() {
        all.group(Setting::Group::look, {"instances", "boost", "glow_every", "glow_first"});
        all.needs({"levels", "threshold", "knee", "intensity", "karis", "down_filter", "up_filter", "finest",
                   "normalise", "guard"},
                  {{"bloom", {"on"}}});
        all.dial({"bloom", {"on", "off"}});
        all.dial({"levels"});
        PyramidFilters::dials(all);
        all.preset({"recommended",
                    "splines by area: all the light, steady and round, at every size",
                    {{"down_filter", "spline"},
                     {"up_filter", "spline"},
                     {"finest", "off"},
                     {"normalise", "on"},
                     {"karis", "none"},
                     {"intensity", "0.5"}}});
    }
};

class HdrBloom final : public Rung {
  public:
    using Options = HdrBloomOptions;

    HdrBloom(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), image_(resources), bloom_(resources.shaders) {}

    // excerpt: frame
    void render(Frame& frame) override {
        const Format depth = formatNamed(options_.depth.name());
        hdr_.remake({{.name = "hdr", .format = Format::rgba16f},
                     {.name = "depth", .format = depth, .filter = Filter::nearest}},
                    frame.size());
        drawScene(frame);
        composite(frame, options_.bloom ? &bloom_.draw(frame, hdr_.color(), bloomParameters()) : nullptr);
    }
    // end excerpt

  private:
    // excerpt: scene
    void drawScene(Frame& frame) {
        if (image_) return image_.draw(frame, "scene", hdr_);
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
    PyramidBloomParameters bloomParameters() const {
        return {.filters = options_.filters,
                .levels = options_.levels,
                .threshold = options_.threshold,
                .knee = options_.knee,
                .blur_radius = 0};
    }
    // end excerpt

    // excerpt: composite
    void composite(Frame& frame, const Texture* bloom) {
        const Defines with_bloom = {{"BLOOM", bloom != nullptr ? "1" : "0"}};
        const Program& program = shaders_.fullScreen(
            "lib/present.frag", options_.display.defines() + options_.filters.guard.defines() + with_bloom);
        std::vector<UniformSetting> uniforms;
        std::vector<Input> inputs = {{"hdr", hdr_.color()}};
        if (bloom != nullptr) {
            inputs.push_back({"bloom", *bloom});
            uniforms.push_back({"intensity", options_.intensity * PyramidBloom::share(bloomParameters())});
        }
        frame.pass(
            "composite", frame.presented(),
            {.program = program, .inputs = inputs, .uniforms = uniforms, .part = options_.display.part()});
    }
    // end excerpt

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
    SceneImage image_; // --image
    Framebuffer hdr_;
    PyramidBloom bloom_;
    std::optional<Mesh> swarm_;
    std::array<int, 3> swarm_made_from_ = {};
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<HdrBloom>(argc, argv,
                              {.name = "05_hdr_bloom",
                               .summary = "A swarm of glowing cubes: HDR target, bloom, ACES.",
                               .takes = {"image"}});
}
