// 10_deferred: a cat statue on a brick floor, its materials written once into a G-buffer and lit afterwards:
// a shadow-casting sun, three coloured lights going round, an environment, and ambient occlusion.
#include "01_hdr/tone_map.hpp"
#include "environment.hpp"
#include "run/run.hpp"
#include "rung/camera.hpp"
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace {
using namespace gll;

struct DeferredOptions {
    Settings all;
    // excerpt: settings
    Choice gbuffer = all.choice("gbuffer", "seed", {"seed", "octahedral", "depth", "compact"},
                                "what is stored: 24 bytes; octahedral normals, 20; position from depth, 16; "
                                "both, 12");
    Choice albedo = all.choice("albedo", "linear", {"linear", "srgb"},
                               "how albedo is stored in 8 bits; linear has bands in the dark");
    Choice texture_filter =
        all.choice("texture_filter", "bilinear", {"bilinear", "mipmapped", "anisotropic"},
                   "how materials are sampled; anisotropic where the driver offers it, else as mipmapped");
    Integer shadow_size = all.integer("shadow_size", 1024, 16, 8192, "side of the shadow map, texels");
    Choice shadow_pcf = all.choice("shadow_pcf", "5", {"1", "3", "5", "7", "9"},
                                   "shadow comparisons averaged in either direction, a texel apart");
    Choice shadow_bias =
        all.choice("shadow_bias", "slope", {"constant", "slope", "texel"},
                   "against self-shadowing: 0.0025; by slope and polygon offset; by slope and texel size");
    Choice ssao = all.choice("ssao", "seed", {"off", "seed", "blur", "gtao"},
                             "ambient occlusion: none, noisy, with depth-aware blur, horizons with blur");
    Choice ssao_resolution = all.choice("ssao_resolution", "full", {"full", "half"},
                                        "occlusion for each pixel, or for a quarter of them");
    Integer ssao_samples = all.integer("ssao_samples", 16, 1, 64, "occlusion samples a pixel");
    Number ssao_radius = all.number("ssao_radius", 0.6, 0.01, 10, "how far occluders are sought, units");
    Number ssao_bias = all.number("ssao_bias", 0.03, 0, 1, "how much nearer an occluder must be, units");
    Number ssao_strength = all.number("ssao_strength", 1.7, 0, 10, "factor on the occlusion; not for gtao");
    Toggle sun = all.toggle("sun", true, "the directional light, with its shadow");
    Toggle points = all.toggle("points", true, "the three coloured lights");
    Toggle environment = all.toggle("environment", true, "ambient and reflected light");
    Choice environment_diffuse =
        all.choice("environment_diffuse", "raw", {"raw", "sh9"},
                   "light on matt surfaces: one fetch along the normal, or nine coefficients");
    Choice environment_specular =
        all.choice("environment_specular", "raw", {"raw", "prefiltered"},
                   "reflections: one fetch, or mip levels filtered for the surface's roughness");
    ToneMapOptions display{all, "clamp", "gamma22"};
    Choice view =
        all.choice("view", "lit", {"lit", "albedo", "normal", "position", "depth", "ssao", "shadow"},
                   "the picture, or one buffer full screen");
    Toggle filmstrip = all.toggle("filmstrip", true, "four buffers along the bottom");
    Toggle flip_v = all.toggle("flip_v", false,
                               "turn the model's texture coordinates over: for OBJ files whose v runs down");
    OrbitSettings orbit{all};
    // end excerpt
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

std::filesystem::path chosen(const std::filesystem::path& given, const Resources& files, const char* own) {
    return given.empty() ? files.find(own) : given;
}

class Deferred final : public Rung {
  public:
    using Options = DeferredOptions;

    Deferred(RungResources resources, const Options& options)
        : shaders_(resources.shaders), options_(options),
          scene_(chosen(resources.given.mesh, resources.files, "assets/cat/cat.obj"),
                 chosen(resources.given.floor, resources.files, "assets/brick/brick.mtl"),
                 resources.warnings),
          environment_(chosen(resources.given.environment, resources.files, "assets/sky/sky.hdr"),
                       resources.warnings) {
        // the rung's own cat is what the original drew of it
        const std::filesystem::path& mesh = resources.given.mesh;
        if (!mesh.empty()) resources.warnings.add(scene_.notDrawn(mesh.string()));
    }

    void render(Frame& frame) override {
        setUp(frame);
        drawShadow(frame);
        drawGeometry(frame);
        drawOcclusion(frame);
        light(frame);
        present(frame);
        if (options_.filmstrip) drawFilmstrip(frame);
    }

  private:
    static constexpr float light_near = 0.1F; // of the sun's view, units
    static constexpr float light_far = 20;
    static constexpr float light_half_width = 4;

    // excerpt: animation
    void setUp(const Frame& frame) {
        const float time_s = frame.time_s();
        const float orbit_rad = time_s * 0.3F;
        camera_ =
            options_.orbit.apply({.position = {4.6F * std::cos(orbit_rad), 2.3F, 4.6F * std::sin(orbit_rad)},
                                  .target = {0, 1, 0},
                                  .vertical_field_of_view_deg = 50,
                                  .near = 0.1F,
                                  .far = 60});
        view_from_world_ = camera_.viewFromWorld();
        clip_from_view_ = camera_.clipFromView(frame.aspect());

        const float sun_rad = time_s * 0.25F;
        to_sun_ = glm::normalize(glm::vec3(0.6F * std::cos(sun_rad), 1.05F, 0.6F * std::sin(sun_rad)));
        light_clip_from_world_ = glm::ortho(-light_half_width, light_half_width, -light_half_width,
                                            light_half_width, light_near, light_far) *
                                 glm::lookAt(to_sun_ * 8.0F, {0, 0.8F, 0}, {0, 1, 0});

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
        makeTargets(frame.size());
    }
    // end excerpt

    // excerpt: gbuffer
    // In order of location; depth comes last and, with the first three, makes the 24, 20, 16 or 12 bytes.
    std::vector<Attachment> gbufferAttachments() const {
        const bool octahedral = options_.gbuffer == "octahedral" || options_.gbuffer == "compact";
        std::vector<Attachment> attachments = {
            {.name = "albedo", .format = options_.albedo == "srgb" ? Format::srgb8_alpha8 : Format::rgba8},
            {.name = "normal", .format = octahedral ? Format::rg16 : Format::rgba16f}};
        if (storesPosition()) attachments.push_back({.name = "position", .format = Format::rgba16f});
        attachments.push_back({.name = "depth", .format = Format::depth24});
        for (Attachment& attachment : attachments)
            attachment.filter = Filter::nearest; // between two surfaces there is none
        return attachments;
    }
    bool storesPosition() const { return options_.gbuffer == "seed" || options_.gbuffer == "octahedral"; }
    // end excerpt

    void makeTargets(glm::ivec2 size) {
        const std::string layout = options_.gbuffer.name() + options_.albedo.name();
        if (layout != gbuffer_made_for_) {
            gbuffer_ = Framebuffer(gbufferAttachments(), size);
            gbuffer_made_for_ = layout;
        }
        gbuffer_.resize(size);
        lit_.resize(size);
        shadow_.resize({options_.shadow_size, options_.shadow_size});
        if (!(options_.ssao == "off")) occlusion().resize(occlusionSize(size));
        if (blurred())
            for (Framebuffer& target : noisy_)
                target.resize(occlusionSize(size));
    }

    MaterialFilter materialFilter() const {
        return options_.texture_filter == "bilinear"    ? MaterialFilter::bilinear
               : options_.texture_filter == "mipmapped" ? MaterialFilter::mipmapped
                                                        : MaterialFilter::anisotropic;
    }

    // Each draw with its variant of the program.
    std::vector<Draw> withPrograms(std::vector<Draw> draws, const std::string& stages,
                                   const Defines& defines) {
        for (Draw& draw : draws)
            draw.program = &shaders_.program(stages + ".vert", stages + ".frag", defines + draw.part.defines);
        return draws;
    }

    // excerpt: shadow
    void drawShadow(Frame& frame) {
        const bool offset = options_.shadow_bias == "slope";
        const std::vector<Draw> draws =
            withPrograms(scene_.depthDraws(materialFilter(), options_.flip_v), "10_deferred/shadow", {});
        frame.pass("shadow", shadow_,
                   {.program = *draws.front().program,
                    .uniforms = {{"light_clip_from_world", light_clip_from_world_}},
                    .draws = draws,
                    .depth_test = DepthTest::less,
                    .polygon_offset = offset ? std::optional(glm::vec2(2, 4)) : std::nullopt,
                    .clear_depth = 1.0F});
    }
    // end excerpt

    // excerpt: geometry
    void drawGeometry(Frame& frame) {
        const std::vector<Draw> draws =
            withPrograms(scene_.materialDraws(materialFilter(), options_.flip_v), "10_deferred/geometry",
                         options_.gbuffer.defines() + options_.texture_filter.defines());
        frame.pass("geometry", gbuffer_,
                   {.program = *draws.front().program,
                    .uniforms = {{"clip_from_world", clip_from_view_ * view_from_world_}},
                    .draws = draws,
                    .depth_test = DepthTest::less,
                    .srgb_encode = options_.albedo == "srgb",
                    .clear_color = glm::vec4(0),
                    .clear_depth = 1.0F});
    }
    // end excerpt

    bool halved() const { return options_.ssao_resolution == "half"; }
    glm::ivec2 occlusionSize(glm::ivec2 size) const { return halved() ? (size + 1) / 2 : size; }
    Framebuffer& occlusion() { return halved() ? half_ssao_ : ssao_; }
    bool blurred() const { return options_.ssao == "blur" || options_.ssao == "gtao"; }

    // excerpt: occlusion
    void drawOcclusion(Frame& frame) {
        if (options_.ssao == "off") return;
        const int samples = options_.ssao_samples;
        Defines defines = options_.gbuffer.defines() + options_.ssao.defines() +
                          Defines{{"WITH_VIEW_Z", blurred() || halved() ? "1" : "0"}};
        if (!(options_.ssao == "gtao")) defines.push_back({"SSAO_SAMPLES", std::to_string(samples)});
        const Program& program = shaders_.fullScreen("10_deferred/ssao.frag", defines);
        const int slices = std::max(samples / 8, 1);
        const glm::vec2 scale(clip_from_view_[0][0], clip_from_view_[1][1]);
        frame.pass(
            "ssao", blurred() ? noisy_[0] : occlusion(),
            {.program = program,
             .part = gbufferPart() + ShaderPart{.uniforms = {{"view_from_world", view_from_world_},
                                                             {"view_z_from_depth", viewZFromDepth()},
                                                             {"view_from_ndc", 1.0F / scale},
                                                             {"half_uv_from_view", 0.5F * scale},
                                                             {"pixel_step", halved() ? 2 : 1},
                                                             {"radius", options_.ssao_radius},
                                                             {"slices", slices},
                                                             {"steps", std::max(samples / (2 * slices), 1)},
                                                             {"bias", options_.ssao_bias},
                                                             {"strength", options_.ssao_strength}}}});
        if (!blurred()) return;
        for (const int axis : {0, 1}) {
            glm::vec2 uv_step(0);
            uv_step[axis] = 1.0F / static_cast<float>(noisy_[0].size()[axis]);
            frame.pass(axis == 0 ? "ssao_blur_x" : "ssao_blur_y", axis == 0 ? noisy_[1] : occlusion(),
                       {.program = shaders_.fullScreen("10_deferred/ssao_blur.frag",
                                                       {{"WITH_VIEW_Z", axis == 0 || halved() ? "1" : "0"}}),
                        .inputs = {{"occlusion", noisy_[axis == 0 ? 0 : 1].color()}},
                        .uniforms = {{"uv_step", uv_step}}});
        }
    }
    // end excerpt

    // excerpt: lighting
    void light(Frame& frame) {
        const Program& program = shaders_.fullScreen(
            "10_deferred/lighting.frag",
            options_.gbuffer.defines() + options_.ssao.defines() + options_.ssao_resolution.defines() +
                options_.shadow_bias.defines() + options_.environment_diffuse.defines() +
                options_.environment_specular.defines() +
                Defines{{"PCF_TAPS", options_.shadow_pcf.name()},
                        {"SUN", options_.sun ? "1" : "0"},
                        {"POINTS", options_.points ? "1" : "0"},
                        {"ENVIRONMENT", options_.environment ? "1" : "0"}});
        ShaderPart part =
            gbufferPart() +
            ShaderPart{.inputs = {{"ssao_map", occlusion().color()},
                                  {"shadow_map", shadow_.depth()},
                                  {"environment_map", environment_.map()}},
                       .uniforms = {
                           {"to_sun", to_sun_},
                           {"view_z_from_world", glm::row(view_from_world_, 2)},
                           {"shadow_from_world",
                            glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.5F)), glm::vec3(0.5F)) *
                                light_clip_from_world_},
                           {"shadow_texel", 2 * light_half_width / static_cast<float>(options_.shadow_size)},
                           {"shadow_depth_range", light_far - light_near},
                           {"point_position", point_positions_},
                           {"point_color", point_colors_}}};
        // made when first used: neither is quick
        if (program.uniforms().contains("irradiance_sh"))
            part.uniforms.push_back({"irradiance_sh", environment_.irradiance()});
        if (program.uniforms().contains("prefiltered_map")) {
            part.inputs.push_back({"prefiltered_map", environment_.prefiltered()});
            part.uniforms.push_back({"prefiltered_levels", float(Environment::last_level)});
        }
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
        const Program& program = shaders_.fullScreen(
            "10_deferred/view.frag", options_.view.defines() + options_.gbuffer.defines() +
                                         options_.ssao.defines() + options_.display.encode.defines());
        frame.pass("present", frame.presented(),
                   {.program = program,
                    .part = gbufferPart() + ShaderPart{.inputs = {{"ssao_map", occlusion().color()},
                                                                  {"shadow_map", shadow_.depth()}},
                                                       .uniforms = {{"aspect", frame.aspect()}}}});
    }
    // end excerpt

    void drawFilmstrip(Frame& frame) {
        const Program& program = shaders_.program("10_deferred/filmstrip.vert", "10_deferred/filmstrip.frag",
                                                  options_.gbuffer.defines() + options_.ssao.defines());
        frame.pass("filmstrip", frame.presented(),
                   {.program = program,
                    .part = gbufferPart() + ShaderPart{.inputs = {{"ssao_map", occlusion().color()}}},
                    .mesh = &filmstrip_});
    }

    // For shaders that read the G-buffer.
    ShaderPart gbufferPart() const {
        const glm::mat3 world_from_view = glm::transpose(glm::mat3(view_from_world_));
        ShaderPart part = {
            .inputs = {{"albedo_map", gbuffer_["albedo"]},
                       {"normal_map", gbuffer_["normal"]},
                       {"depth_map", gbuffer_["depth"]}},
            .uniforms = {{"camera_position", camera_.position},
                         {"view_z_from_depth", viewZFromDepth()},
                         {"world_from_ray",
                          glm::mat3(world_from_view[0] / clip_from_view_[0][0],
                                    world_from_view[1] / clip_from_view_[1][1], -world_from_view[2])},
                         {"material_shininess", seed_shininess}}};
        if (storesPosition()) part.inputs.push_back({"position_map", gbuffer_["position"]});
        return part;
    }

    // From depth in [0, 1] back through the perspective matrix: view z = x / (depth + y).
    glm::vec2 viewZFromDepth() const {
        return {-0.5F * clip_from_view_[3][2], 0.5F * (clip_from_view_[2][2] - 1)};
    }

    ShaderLibrary& shaders_;
    const Options& options_;
    Scene scene_;
    Environment environment_;
    Mesh filmstrip_ = makeFilmstrip();
    Framebuffer shadow_{{{.name = "shadow",
                          .format = Format::depth24,
                          .filter = Filter::linear,
                          .wrap = Wrap::border_one, // outside of what the sun's view holds, all is lit
                          .compare_depth = true}},
                        {1, 1}};
    Framebuffer gbuffer_{{{.name = "albedo"}}, {1, 1}}; // see gbufferAttachments()
    std::string gbuffer_made_for_;
    Framebuffer ssao_{{{.name = "ssao", .format = Format::r8}}, {1, 1}};
    Framebuffer half_ssao_{{{.name = "ssao", .format = Format::rg16f, .filter = Filter::nearest}}, {1, 1}};
    std::array<Framebuffer, 2> noisy_{
        Framebuffer({{.name = "ssao_noisy", .format = Format::rg16f, .filter = Filter::nearest}}, {1, 1}),
        Framebuffer({{.name = "ssao_half_blurred", .format = Format::rg16f, .filter = Filter::nearest}},
                    {1, 1})};
    Framebuffer lit_{{{.name = "lit", .format = Format::rgba16f, .filter = Filter::nearest}}, {1, 1}};

    // of the frame being drawn
    Camera camera_;
    glm::mat4 view_from_world_{1};
    glm::mat4 clip_from_view_{1};
    glm::mat4 light_clip_from_world_{1};
    glm::vec3 to_sun_{0, 1, 0};
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
