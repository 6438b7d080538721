// 10_deferred: a cat statue on a brick floor, its materials written once into a G-buffer and lit afterwards:
// a shadow-casting sun, three coloured lights going round, an environment, and ambient occlusion.
#include "01_hdr/tone_map.hpp"
#include "06_gbuffer/gbuffer.hpp"
#include "06_gbuffer/scene.hpp"
#include "07_shadow_map/shadow_map.hpp"
#include "08_ssao/ssao.hpp"
#include "09_environment_light/environment.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace {
using namespace gll;

struct DeferredOptions {
    Settings all;
    // excerpt: settings
    gbuffer::GBufferOptions gbuffer{all};
    gbuffer::SceneOptions scene{all};
    shadow_map::ShadowOptions shadow{all};
    ssao::SsaoOptions ssao{all};
    Toggle sun = all.toggle("sun", true, "the directional light, with its shadow");
    Toggle points = all.toggle("points", true, "the three coloured lights");
    Toggle occluded_direct =
        all.toggle("occluded_direct", true, "occlusion darkens the sun and the coloured lights, too");
    Toggle environment = all.toggle("environment", true, "ambient and reflected light");
    environment_light::EnvironmentOptions environment_light{all};
    ToneMapOptions display{all, "clamp", "gamma22"};
    Choice view = all.choice(
        "view", "lit",
        {"lit", "albedo", "normal", "position", "depth", "ssao", "shadow", "sun", "ambient", "reflected"},
        "the picture, or one buffer or term of the light full screen");
    Toggle filmstrip = all.toggle("filmstrip", true, "four buffers along the bottom");
    OrbitSettings orbit{all};
    // end excerpt

    DeferredOptions() {
        all.group(Setting::Group::look, {"sun", "points", "environment", "view", "filmstrip"});
        all.needs({"sun"}, {{"view", {"lit", "sun"}}});
        all.needs({"points", "occluded_direct", "exposure_ev", "tone_map"}, {{"view", {"lit"}}});
        all.needs({"environment"}, {{"view", {"lit", "ambient", "reflected"}}});
        all.needs({"encode"}, {{"view", {"lit", "albedo", "ambient", "reflected"}}});
        all.needs({"shadow_size", "shadow_filter", "shadow_pcf", "shadow_bias", "shadow_fit"},
                  {{"sun", {"on"}}, {"view", {"shadow"}}});
        all.needs({"cascades", "sun_radius_deg"}, {{"sun", {"on"}}});
        all.needs({"ssao"}, {{"view", {"lit", "ssao", "ambient", "reflected"}}, {"filmstrip", {"on"}}});
        all.needs({"ssao_multi_bounce"}, {{"view", {"lit", "ambient"}}});
        all.needs({"occluded_direct"}, {{"sun", {"on"}}, {"points", {"on"}}});
        all.needs({"occluded_direct"}, {{"ssao", {"cone", "hemisphere", "sao", "hbao", "gtao", "bitmask"}}});
        all.needs({"environment_diffuse", "environment_specular", "environment_brdf", "ssao_multi_bounce"},
                  {{"environment", {"on"}}});
        all.needs({"environment_diffuse"}, {{"view", {"lit", "ambient"}}});
        all.needs({"environment_specular", "environment_brdf"}, {{"view", {"lit", "reflected"}}});
        all.needs({"gloss", "specular_aa"}, {{"view", {"lit", "reflected"}}});
        all.needs({"specular_aa"}, {{"gloss", {"float", "8", "6", "4"}}, {"packing", {"rgba16"}}});
        all.needs({"geometric"}, {{"shadow_bias", {"texel", "normal_offset", "front_faces", "plane"}},
                                  {"ssao_normals", {"geometric"}}});
        all.preset({"recommended",
                    "what each rung before found best, at half the cost where nobody sees it",
                    {{"packing", "rgba16"},
                     {"positions", "depth24"},
                     {"texture_filter", "mipmapped"},
                     {"shadow_bias", "plane"},
                     {"shadow_pcf", "3"},
                     {"shadow_fit", "stable"},
                     {"shadow_size", "2048"},
                     {"ssao", "bitmask"},
                     {"ssao_normals", "geometric"},
                     {"ssao_noise", "interleaved"},
                     {"ssao_blur", "separable"},
                     {"ssao_samples", "12"},
                     {"ssao_slices", "1"},
                     {"ssao_bias", "0.003"},
                     {"ssao_resolution", "half"},
                     {"ssao_multi_bounce", "on"},
                     {"occluded_direct", "off"},
                     {"environment_diffuse", "sh9_sun"},
                     {"environment_specular", "prefiltered"},
                     {"prefilter_samples", "32"},
                     {"environment_sun", "on"},
                     {"environment_brdf", "table"},
                     {"environment_energy", "fdez_aguera"},
                     {"tone_map", "pbr_neutral"},
                     {"encode", "srgb"},
                     {"filmstrip", "off"}}});
        all.dial({"ssao_resolution", {"full", "half"}});
        all.dial({"ssao_samples", {"48", "24", "16", "12", "6"}});
        all.dial({"shadow_size", {"4096", "2048", "1024", "512"}});
        all.dial({"texture_filter", {"mipmapped", "bilinear"}});
    }
};

// The four tiles: as high as wide in screen coordinates, so that each shows the whole screen.
Mesh makeFilmstrip() {
    constexpr float size = 0.18F;
    constexpr float gap = 0.012F;
    constexpr float bottom = 0.02F;
    struct Vertex {
        glm::vec2 screen_uv, tile_uv;
        float tile;
    };
    std::vector<Vertex> vertices;
    for (int tile = 0; tile < 4; ++tile)
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(1, 1),
                                       glm::vec2(0, 1), glm::vec2(0, 0)}) {
            const auto number = static_cast<float>(tile);
            const glm::vec2 origin(gap + (gap + size) * number, bottom);
            vertices.push_back({origin + size * corner, corner, number});
        }
    return Mesh({.vertices = std::as_bytes(std::span(vertices)),
                 .vertex_stride_bytes = sizeof(Vertex),
                 .attributes = {{0, 2, offsetof(Vertex, screen_uv)},
                                {1, 2, offsetof(Vertex, tile_uv)},
                                {2, 1, offsetof(Vertex, tile)}}});
}

class Deferred final : public Rung {
  public:
    using Options = DeferredOptions;

    Deferred(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options), scene_(resources),
          environment_(resources.file(&RungFiles::environment, "assets/sky/sky.hdr"), resources.warnings),
          gbuffer_(resources.shaders), shadow_(resources.shaders), ssao_(resources.shaders) {}

    // excerpt: frame
    void render(Frame& frame) override {
        setUp(frame);
        shadow_.draw(frame, sun_, view_, scene_.depthDraws(options_.scene), options_.shadow);
        gbuffer_.draw(frame, "geometry", view_, scene_.materialDraws(options_.scene),
                      options_.scene.defines(), options_.gbuffer);
        ssao_.draw(frame, view_, gbuffer_.part(view_, options_.gbuffer), options_.ssao);
        light(frame);
        present(frame);
        if (options_.filmstrip) drawFilmstrip(frame);
    }
    // end excerpt

  private:
    // excerpt: animation
    void setUp(const Frame& frame) {
        const float time_s = frame.time_s();
        const float orbit_rad = time_s * 0.3F;
        view_ = gbuffer::View(
            options_.orbit.apply({.position = {4.6F * std::cos(orbit_rad), 2.3F, 4.6F * std::sin(orbit_rad)},
                                  .target = {0, 1, 0},
                                  .vertical_field_of_view_deg = 50,
                                  .near = 0.1F,
                                  .far = 60}),
            frame.aspect());

        const float sun_rad = time_s * 0.25F;
        sun_.to_sun = glm::normalize(glm::vec3(0.6F * std::cos(sun_rad), 1.05F, 0.6F * std::sin(sun_rad)));

        point_positions_.clear();
        point_colors_.clear();
        for (int i = 0; i < 3; ++i) {
            const auto number = static_cast<float>(i);
            const float angle_rad = time_s * 0.7F + number * 2.0944F;
            point_positions_.emplace_back(3.2F * std::cos(angle_rad), 1.6F + 0.6F * std::sin(time_s + number),
                                          3.2F * std::sin(angle_rad));
            const auto channel = [&](float phase) { return 0.5F + 0.5F * std::cos(number * 2.5F + phase); };
            point_colors_.push_back(1.4F * glm::vec3(channel(0), channel(2), channel(4)));
        }
        lit_.resize(frame.size());
    }
    // end excerpt

    // excerpt: lighting
    void light(Frame& frame) {
        ShaderPart part =
            gbuffer_.part(view_, options_.gbuffer) + shadow_.part(sun_, options_.shadow) +
            ssao_.part(view_, options_.ssao) +
            ShaderPart{.defines = options_.view.defines() +
                                  Defines{{"SUN", options_.sun ? "1" : "0"},
                                          {"OCCLUDED_DIRECT", options_.occluded_direct ? "1" : "0"},
                                          {"POINTS", options_.points ? "1" : "0"},
                                          {"ENVIRONMENT", options_.environment ? "1" : "0"}},
                       .uniforms = {{"point_position", point_positions_}, {"point_color", point_colors_}}};
        if (options_.environment) part += environment_.part(options_.environment_light);
        const Program& program =
            shaders_.program("10_deferred/lighting.vert", "10_deferred/lighting.frag", part.defines);
        frame.pass("lighting", lit_, {.program = program, .part = part, .clear_color = glm::vec4(0)});
    }
    // end excerpt

    // excerpt: present
    void present(Frame& frame) {
        if (options_.view == "lit") {
            const Program& program =
                shaders_.fullScreen("10_deferred/present.frag", options_.display.defines());
            frame.pass(
                "present", frame.presented(),
                {.program = program, .inputs = {{"lit_map", lit_.color()}}, .part = options_.display.part()});
            return;
        }
        const ShaderPart part = buffers(frame);
        frame.pass("present", frame.presented(),
                   {.program = shaders_.fullScreen("10_deferred/view.frag", part.defines), .part = part});
    }
    // end excerpt

    void drawFilmstrip(Frame& frame) {
        const ShaderPart part = buffers(frame);
        frame.pass("filmstrip", frame.presented(),
                   {.program = shaders_.program("10_deferred/filmstrip.vert", "10_deferred/filmstrip.frag",
                                                part.defines),
                    .part = part,
                    .mesh = &filmstrip_});
    }

    // What is shown of them, one full screen or four along the bottom.
    ShaderPart buffers(const Frame& frame) const {
        return gbuffer_.part(view_, options_.gbuffer) + shadow_.part(sun_, options_.shadow) +
               ssao_.part(view_, options_.ssao) +
               ShaderPart{.defines = options_.view.defines() + options_.display.encode.defines(),
                          .inputs = {{"lit_map", lit_.color()}},
                          .uniforms = {{"aspect", frame.aspect()}}};
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    gbuffer::Scene scene_;
    environment_light::Environment environment_;
    gbuffer::GBuffer gbuffer_;
    shadow_map::ShadowMap shadow_;
    ssao::Ssao ssao_;
    Mesh filmstrip_ = makeFilmstrip();
    Framebuffer lit_{{{.name = "lit", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}};

    // of the frame being drawn
    gbuffer::View view_{Camera(), 1};
    shadow_map::Sun sun_{.casters_beyond = false}; // as in the original
    std::vector<glm::vec3> point_positions_;
    std::vector<glm::vec3> point_colors_;
};

} // namespace

int main(int argc, char** argv) {
    return gll::run<Deferred>(
        argc, argv,
        {.name = "10_deferred",
         .summary = "A cat on brick: shadow map, G-buffer, ambient occlusion, lighting.",
         .takes = {"mesh", "floor", "environment"}});
}
