// 04_pyramid_bloom: a harbour at night, from strings of bulbs to a lighthouse; what is bright goes down a
// pyramid of ever smaller images, is blurred on every level, and comes up again as one glow, tight and wide.
#include "01_hdr/tone_map.hpp"
#include "04_pyramid_bloom/harbour.hpp"
#include "04_pyramid_bloom/pyramid_bloom.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "rung/scene_image.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace {
using namespace gll;
using namespace gll::pyramid_bloom;

struct PyramidOptions {
    Settings all;
    // excerpt: settings
    Toggle bloom = all.toggle("bloom", true, "whether bright light spills over its edges");
    Number threshold = all.number("threshold", 0.8, 0, 1000, "luminance from which a pixel blooms");
    Number soft_knee =
        all.number("soft_knee", 0.5, 0, 1, "half the width of the soft step, of the threshold");
    Number strength = all.number("strength", 1, 0, 100, "how much bloom is added to the scene");
    Number radius = all.number("radius", 0.5, 0, 4, "distance of the blur's taps, texels of its level");
    Integer levels =
        all.integer("levels", 5, 1, max_bloom_levels, "bloom levels, each half the size of the one before");
    Choice blur = all.choice("blur", "gaussian", {"gaussian", "none"}, "what each level is blurred by");
    PyramidFilters filters{all, "none", "13tap"};
    Choice accumulate = all.choice("accumulate", "on", {"on", "as_printed"},
                                   "whether a level passes on what it received from the smaller ones");
    Choice format = all.choice("format", "rgba16f", {"rgba16f", "r11f_g11f_b10f", "rgba8"}, "of the levels");
    Choice view = all.choice("view", "picture", {"picture", "pyramid", "sums"},
                             "the picture, or every level on the way down or after the way up");
    hdr::ToneMapOptions display{all, "aces_hill", "srgb"};
    OrbitSettings orbit{all};
    // end excerpt

    PyramidOptions() {
        all.group(Setting::Group::look, {"view"});
        all.needs({"threshold", "soft_knee", "strength", "radius", "levels", "blur", "accumulate", "format",
                   "view", "karis", "down_filter", "up_filter", "finest", "normalise", "guard"},
                  {{"bloom", {"on"}}});
        all.needs({"radius"}, {{"blur", {"gaussian"}}});
        all.needs({"strength", "accumulate", "up_filter", "finest", "normalise"},
                  {{"view", {"picture", "sums"}}});
        all.dial({"bloom", {"on", "off"}});
        all.dial({"levels"});
        PyramidFilters::dials(all);
        all.dial({"format", {"rgba16f", "r11f_g11f_b10f", "rgba8"}});
        all.preset({"recommended",
                    "splines by area: all the light, steady and round, at every size",
                    {{"down_filter", "spline"},
                     {"up_filter", "spline"},
                     {"finest", "off"},
                     {"normalise", "on"},
                     {"blur", "none"}}});
    }
};

class PyramidBloomRung final : public Rung {
  public:
    using Options = PyramidOptions;

    PyramidBloomRung(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), image_(resources), bloom_(shaders_) {}

    // excerpt: frame
    void render(Frame& frame) override {
        hdr_.resize(frame.size());
        lit_.resize(frame.size());
        drawScene(frame);
        if (!options_.bloom) return present(frame, hdr_.color());
        const PyramidBloomParameters parameters = bloomParameters();
        bloom_.drawDown(frame, hdr_.color(), parameters);
        if (options_.view == "pyramid") return drawSheet(frame, hdr_.color());
        bloom_.drawUp(frame, parameters);
        bloom_.composite(frame, hdr_.color(), options_.strength * PyramidBloom::share(parameters), lit_,
                         parameters.filters.guard.defines());
        if (options_.view == "sums") return drawSheet(frame, lit_.color());
        present(frame, lit_.color());
    }
    // end excerpt

  private:
    // excerpt: scene
    void drawScene(Frame& frame) {
        if (image_) return image_.draw(frame, "scene", hdr_);
        const float sway_m = 2.5F * std::sin(0.25F * frame.time_s());
        const Camera camera = options_.orbit.apply({.position = {sway_m, 7, 42},
                                                    .target = {0, 9, -60},
                                                    .vertical_field_of_view_deg = 40,
                                                    .near = 1,
                                                    .far = 1000});
        const glm::mat4 clip_from_world = camera.clipFromView(frame.aspect()) * camera.viewFromWorld();
        const float pixels_per_m = static_cast<float>(frame.size().y) /
                                   (2 * std::tan(glm::radians(camera.vertical_field_of_view_deg) / 2));
        const UniformSetting time = {"time_s", frame.time_s()};
        const UniformSetting eye = {"camera_position", camera.position};

        frame.pass("sky", hdr_,
                   {.program = shaders_.fullScreen("04_pyramid_bloom/sky.frag"),
                    .uniforms = {{"world_from_clip", glm::inverse(clip_from_world)}, eye},
                    .clear_depth = 1.0F});
        frame.pass("walls", hdr_,
                   {.program = shaders_.program("04_pyramid_bloom/wall.vert", "04_pyramid_bloom/wall.frag"),
                    .uniforms = {{"clip_from_world", clip_from_world}, eye, time},
                    .mesh = &walls_.mesh,
                    .instances = walls_.count,
                    .depth_test = DepthTest::less_equal,
                    .cull = Cull::back});
        frame.pass("lamps", hdr_,
                   {.program = shaders_.program("04_pyramid_bloom/lamp.vert", "04_pyramid_bloom/lamp.frag"),
                    .uniforms = {{"clip_from_world", clip_from_world},
                                 {"size", glm::vec2(frame.size())},
                                 {"pixels_per_m", pixels_per_m},
                                 time},
                    .mesh = &lamps_.mesh,
                    .instances = lamps_.count,
                    .depth_test = DepthTest::less_equal,
                    .blend = Blend::add});
    }
    // end excerpt

    // excerpt: bloom
    PyramidBloomParameters bloomParameters() const {
        return {.filters = options_.filters,
                .levels = options_.levels,
                .threshold = options_.threshold,
                .knee = options_.threshold * options_.soft_knee,
                .blur_radius = options_.blur == "none" ? 0.0F : static_cast<float>(options_.radius),
                .accumulate = options_.accumulate == "on",
                .format = formatNamed(options_.format.name())};
    }
    // end excerpt

    void present(Frame& frame, const Texture& linear_picture) {
        const Program& program =
            shaders_.fullScreen("lib/present.frag", options_.display.defines() + Defines{{"BLOOM", "0"}});
        frame.pass(
            "present", frame.presented(),
            {.program = program, .inputs = {{"hdr", linear_picture}}, .part = options_.display.part()});
    }

    // The first picture, then every level, in rows of equal frames.
    void drawSheet(Frame& frame, const Texture& first) {
        const int count = options_.levels + 1;
        const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
        const int rows = (count + columns - 1) / columns;
        const glm::vec2 cell = 1.0F / glm::vec2(columns, std::max(rows, columns)); // as wide as the frame is
        const glm::vec2 gap = 2.0F / glm::vec2(frame.size());
        const float top = 0.5F + 0.5F * cell.y * static_cast<float>(rows);
        std::vector<Draw> draws;
        for (int i = 0; i < count; ++i) {
            const glm::vec2 corner(cell.x * static_cast<float>(i % columns),
                                   top - cell.y * static_cast<float>(i / columns + 1));
            draws.push_back({.mesh = square_,
                             .inputs = {{"level", i == 0 ? first : bloom_.level(i - 1)}},
                             .uniforms = {{"place", glm::vec4(corner + gap, corner + cell - gap)}}});
        }
        const Program& program = shaders_.program("04_pyramid_bloom/sheet.vert",
                                                  "04_pyramid_bloom/sheet.frag", options_.display.defines());
        frame.pass("sheet", frame.presented(),
                   {.program = program,
                    .part = options_.display.part(),
                    .draws = draws,
                    .clear_color = glm::vec4(0.1F, 0.1F, 0.1F, 1)});
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    SceneImage image_; // --image
    Framebuffer hdr_{{{.name = "hdr", .format = Format::rgba16f},
                      {.name = "depth", .format = Format::depth24, .filter = Filter::nearest}},
                     {1, 1}};
    Framebuffer lit_{{{.name = "lit", .format = Format::rgba16f}}, {1, 1}}; // scene and bloom
    PyramidBloom bloom_;
    Instances walls_ = makeWalls();
    Instances lamps_ = makeLamps();
    Mesh square_ = makeSquare();
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<PyramidBloomRung>(argc, argv,
                                      {.name = "04_pyramid_bloom",
                                       .summary = "A harbour at night: bloom by a pyramid of blurred levels.",
                                       .takes = {"image"}});
}
