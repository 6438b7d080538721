// The shaders' formulas, each drawn by itself and read back.
#include "06_gbuffer/gbuffer.hpp"
#include "07_shadow_map/shadow_map.hpp"
#include "gl_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>
#include <vector>

namespace gll::test {
namespace {

// Of the G-buffer, as the settings' defaults make it.
Defines layout() {
    Settings settings;
    return gbuffer::GBufferOptions(settings).defines();
}
const Defines original_layout = layout();
const Defines ssao_kinds = {{"SSAO_OFF", "0"}, {"SSAO_SEED", "1"}, {"SSAO_BLUR", "2"}, {"SSAO_GTAO", "3"}};

std::vector<float> valuesOf(const Texture& texture) {
    return std::get<std::vector<float>>(readTexture(texture).pixels);
}

class DeferredShader : public GlTest {
  protected:
    // A full-screen program of the test's own text, which may include the ladder's shaders.
    const Program& program(const std::string& fragment, const Defines& defines = {}) {
        const std::string name = "probe" + std::to_string(++probes_) + ".frag";
        folder_.write(name, "#version 330 core\n" + fragment);
        return shaders.fullScreen(name, defines);
    }

    TemporaryFolder folder_;
    ShaderLibrary shaders{{folder_.path(), GLLADDER_SHADERS}};
    int probes_ = 0;
};

TEST_F(DeferredShader, octahedralNormalsIn32BitsAreWithin0004Degrees) {
    const std::string direction = R"(
#include "06_gbuffer/octahedral.glsl"
in vec2 uv;
vec3 direction() {
    float z = 1.0 - 2.0 * uv.y;
    float around = 6.2831853 * uv.x;
    return normalize(vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(around), sin(around)), z));
}
)";
    const Framebuffer stored({{.name = "stored", .format = Format::rg16, .filter = Filter::nearest}},
                             {512, 512});
    draw(stored, {.program = program(
                      direction +
                      "out vec2 color;\nvoid main() { color = octahedralFromDirection(direction()); }\n")});
    const Framebuffer error({{.name = "error", .format = Format::r32f}}, {512, 512});
    draw(error, {.program = program(direction + R"(uniform sampler2D stored;
out float sine;
void main() { sine = length(cross(direction(), directionFromOctahedral(textureLod(stored, uv, 0.0).rg))); }
)"),
                 .inputs = {{"stored", stored.color()}}});
    float worst = 0;
    for (const float sine : valuesOf(error.color()))
        worst = std::max(worst, sine);
    EXPECT_LT(glm::degrees(std::asin(worst)), 0.004F);
}

std::uint32_t hashed(std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

constexpr const char* turn_probe = R"(
#include "10_deferred/noise.glsl"
out float turn;
void main() { turn = turnOf(ivec2(gl_FragCoord.xy)); }
)";

TEST_F(DeferredShader, noiseIsTheSameAsTheProcessorsOwn) {
    const Framebuffer target({{.name = "turn", .format = Format::r32f}}, {64, 64});
    draw(target, {.program = program(turn_probe, ssao_kinds + Defines{{"SSAO", "1"}})});
    const std::vector<float> turns = valuesOf(target.color()); // top row first
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            ASSERT_EQ(turns[(63 - y) * 64 + x], static_cast<float>(hashed(x + (y << 16U)) >> 8U) * 0x1p-24F);
}

TEST_F(DeferredShader, noiseForTheBlurHasSixteenTurnsInEachFourByFourBlock) {
    const Framebuffer target({{.name = "turn", .format = Format::r32f}}, {8, 8});
    draw(target, {.program = program(turn_probe, ssao_kinds + Defines{{"SSAO", "2"}})});
    const std::vector<float> turns = valuesOf(target.color());
    for (std::size_t block = 0; block < 4; ++block) {
        unsigned seen = 0;
        for (std::size_t i = 0; i < 16; ++i)
            seen |=
                1U << static_cast<unsigned>(turns[(block / 2 * 4 + i / 4) * 8 + block % 2 * 4 + i % 4] * 16);
        EXPECT_EQ(seen, 0xFFFFU);
    }
}

TEST_F(DeferredShader, anUnoccludedPlaneIsExactlyOne) {
    const glm::vec3 camera(1, 2.3F, 4.6F);
    const glm::mat4 view_from_world = glm::lookAt(camera, {0, 1, 0}, {0, 1, 0});
    const glm::mat4 clip_from_view = glm::perspective(glm::radians(50.0F), 4.0F / 3, 0.1F, 60.0F);
    const Framebuffer plane({{.name = "normal", .format = Format::rgba16f, .filter = Filter::nearest},
                             {.name = "position", .format = Format::rgba16f, .filter = Filter::nearest}},
                            {160, 120});
    draw(plane, {.program = program(R"(
in vec2 uv;
uniform mat4 world_from_clip;
uniform vec3 camera;
layout(location = 0) out vec4 normal;
layout(location = 1) out vec4 position;
void main() {
    vec4 far = world_from_clip * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 ray = far.xyz / far.w - camera;
    float reach = -camera.y / ray.y;
    bool hit = ray.y < 0.0 && length(ray * reach) < 8.0; // beyond, pixels are longer than the bias allows for
    normal = hit ? vec4(0.0, 1.0, 0.0, 24.0) : vec4(0.0);
    position = hit ? vec4(camera + ray * reach, 1.0) : vec4(0.0);
}
)"),
                 .uniforms = {{"world_from_clip", glm::inverse(clip_from_view * view_from_world)},
                              {"camera", camera}}});
    for (const char* kind : {"1", "2", "3"}) {
        Defines defines = original_layout + ssao_kinds +
                          Defines{{"SSAO", kind}, {"SSAO_SAMPLES", "16"}, {"WITH_VIEW_Z", "0"}};
        const Program& ssao = shaders.fullScreen("10_deferred/ssao.frag", defines);
        const Framebuffer target({{.name = "ssao", .format = Format::r8}}, {160, 120});
        draw(target, {.program = ssao,
                      .inputs = {{"normal_map", plane["normal"]}, {"position_map", plane["position"]}},
                      .part = {.uniforms = {{"view_from_world", view_from_world},
                                            {"half_uv_from_view",
                                             0.5F * glm::vec2(clip_from_view[0][0], clip_from_view[1][1])},
                                            {"pixel_step", 1},
                                            {"radius", 0.6F},
                                            {"bias", 0.03F},
                                            {"strength", 1.7F},
                                            {"slices", 2},
                                            {"steps", 4}}}});
        const Image image = readTexture(target.color());
        int below = 0;
        for (const std::uint8_t value : std::get<std::vector<std::uint8_t>>(image.pixels))
            below += value < 255 ? 1 : 0;
        EXPECT_EQ(below, 0) << "kind " << kind;
    }
}

// shadow.glsl asks for shadows at places given one a pixel.
constexpr const char* shadow_probe = R"(
#include "07_shadow_map/shadow.glsl"
uniform vec3 place[4];
out float visible;
void main() {
    visible = sunVisible(place[int(gl_FragCoord.x)], vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0));
}
)";
// Of the shadow map, as the settings' defaults make it but for these.
Defines shadowDefines(const std::vector<std::string>& sets = {}) {
    Settings settings;
    const shadow_map::ShadowOptions options(settings);
    for (const std::string& set : sets)
        settings.set(set);
    return options.defines();
}
// Places in world space are places in the map.
const std::vector<glm::vec4> same_place = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

TEST_F(DeferredShader, aPlaceOutsideTheLightsFrustumIsLit) {
    const Framebuffer shadow(
        {{.name = "shadow", .format = Format::depth24, .wrap = Wrap::border_one, .compare_depth = true}},
        {32, 32});
    draw(shadow, {.program = makeProgram(full_screen_vertex, flat_fragment),
                  .uniforms = {{"flat_color", glm::vec4(1)}},
                  .depth_test = DepthTest::less,
                  .clear_depth = 0.0F}); // all is in shadow
    const Framebuffer target({{.name = "visible", .format = Format::r32f}}, {4, 1});
    const Program& probe = program(shadow_probe, shadowDefines());
    draw(target,
         {.program = probe,
          .inputs = {{"shadow_map", shadow.depth()}},
          .uniforms = {
              {"shadow_rows", same_place},
              {"place", std::vector<glm::vec3>{
                            {0.5F, 0.5F, 0.5F}, {2, 0.5F, 0.5F}, {0.5F, -1, 0.5F}, {0.5F, 0.5F, 1.5F}}}}});
    EXPECT_EQ(valuesOf(target.color()), (std::vector<float>{0, 1, 1, 1}));
}

TEST_F(DeferredShader, aQuarterOfTheShadowTapsGivesTheSameFilter) {
    const Framebuffer shadow(
        {{.name = "shadow", .format = Format::depth24, .wrap = Wrap::border_one, .compare_depth = true}},
        {32, 32});
    draw(shadow, {.program = program(R"(
#include "10_deferred/noise.glsl"
void main() { gl_FragDepth = turnOf(ivec2(gl_FragCoord.xy)); }
)",
                                     ssao_kinds + Defines{{"SSAO", "1"}}),
                  .depth_test = DepthTest::less,
                  .clear_depth = 1.0F});
    for (const char* taps : {"1", "3", "5", "7", "9"}) {
        const Defines defines = shadowDefines({std::string("shadow_pcf=") + taps});
        const Framebuffer target({{.name = "difference", .format = Format::r32f}}, {128, 128});
        draw(target, {.program = program(R"(
#include "07_shadow_map/shadow.glsl"
in vec2 uv;
out float difference;
void main() {
    float sum = 0.0;
    const int reach = PCF_TAPS / 2;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            sum += textureLod(shadow_map, vec3(uv * 1.2 - 0.1 + vec2(x, y) / 32.0, 0.4), 0.0);
    difference = abs(sum / float(PCF_TAPS * PCF_TAPS) - filteredShadow(ShadowPlace(0, uv * 1.2 - 0.1, 0.4, vec2(0.0))));
}
)",
                                         defines),
                      .inputs = {{"shadow_map", shadow.depth()}}});
        float worst = 0;
        for (const float difference : valuesOf(target.color()))
            worst = std::max(worst, difference);
        EXPECT_LT(worst, 1e-4F) << taps;
    }
}

TEST_F(DeferredShader, normalsStandWhereTextureCoordinatesHaveNoArea) {
    const Program& geometry =
        shaders.program("06_gbuffer/geometry.vert", "06_gbuffer/geometry.frag",
                        original_layout + Defines{{"TEXTURE_FILTER_BILINEAR", "0"}, {"TEXTURE_FILTER", "0"}});
    const std::vector<std::uint8_t> tilted = {220, 160, 200, 128};
    const Texture map(TextureDescription{}, std::span<const std::uint8_t>(tilted));
    for (const float uv_scale : {0.0F, 1e-6F, -1.0F, 1e6F}) {
        struct Vertex {
            glm::vec3 position, normal;
            glm::vec2 uv;
        };
        std::vector<Vertex> vertices;
        for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(3, -1), glm::vec2(-1, 3)})
            vertices.push_back({{corner, 0}, {0, 0, 1}, uv_scale * corner});
        const Mesh mesh({.vertices = std::as_bytes(std::span(vertices)),
                         .vertex_stride_bytes = sizeof(Vertex),
                         .attributes = {{0, 3, 0}, {1, 3, 12}, {2, 2, 24}}});
        const Framebuffer target(
            {{.name = "albedo", .format = Format::rgba8}, {.name = "normal"}, {.name = "position"}},
            {16, 16});
        draw(target, {.program = geometry,
                      .inputs = {{"base_map", map}, {"surface_map", map}},
                      .uniforms = {{"clip_from_world", glm::mat4(1)},
                                   {"v_factor_offset", glm::vec2(1, 0)},
                                   {"base_color", glm::vec3(1)},
                                   {"occluded_albedo", 0.5F},
                                   {"specular_scale", 0.5F},
                                   {"shininess", 24.0F},
                                   {"normal_strength", 3.0F},
                                   {"material", 0.0F}},
                      .mesh = &mesh});
        for (std::size_t i = 0; const float value : valuesOf(target["normal"])) {
            ASSERT_TRUE(std::isfinite(value)) << uv_scale;
            if (uv_scale == 0.0F && i % 4 < 3) {
                ASSERT_EQ(value, i % 4 == 2 ? 1.0F : 0.0F);
            }
            ++i;
        }
        const glm::vec4 normal = pixelOf(target["normal"], 8, 8);
        EXPECT_NEAR(glm::length(glm::vec3(normal)), 1, 2e-3);
        if (uv_scale > 0) { // u grows to the right; green is up the image, where v is smaller
            EXPECT_GT(normal.x, 0.3F);
            EXPECT_LT(normal.y, 0.0F);
        }
        if (uv_scale < 0) { // mirrored
            EXPECT_LT(normal.x, -0.3F);
        }
    }
}

TEST_F(DeferredShader, theEnvironmentHasNoSeam) {
    const glm::ivec2 size(64, 32);
    const std::vector<float> green_level(static_cast<std::size_t>(size.x * size.y), 0.0F);
    const Texture map({.size = size,
                       .format = Format::rgb16f,
                       .filter = Filter::trilinear,
                       .wrap_x = Wrap::repeat,
                       .levels = levelCount(size)},
                      std::span<const float>(green_level));
    for (int level = 1; level < levelCount(size);
         ++level) { // any light comes from a level that should not be read
        const int texels = std::max(size.x >> level, 1) * std::max(size.y >> level, 1);
        map.setLevel(level, std::vector<float>(static_cast<std::size_t>(texels), 1.0F));
    }
    const Framebuffer target({{.name = "light", .format = Format::r32f}}, {128, 64});
    draw(target, {.program = program(R"(
#include "09_environment_light/environment.glsl"
in vec2 uv;
out float light;
void main() {
    float around = 12.566 * uv.x;
    float height = 2.0 * uv.y - 1.0;
    vec3 direction = vec3(sqrt(1.0 - height * height) * vec2(cos(around), sin(around)), height).xzy;
    light = environmentDiffuse(direction).r + environmentSpecular(direction, 0.5).r;
}
)",
                                     {{"ENVIRONMENT_DIFFUSE_RAW", "0"},
                                      {"ENVIRONMENT_DIFFUSE_SH9", "1"},
                                      {"ENVIRONMENT_DIFFUSE", "0"},
                                      {"ENVIRONMENT_SPECULAR_RAW", "0"},
                                      {"ENVIRONMENT_SPECULAR_PREFILTERED", "1"},
                                      {"ENVIRONMENT_SPECULAR", "0"}}),
                  .inputs = {{"environment_map", map}}});
    for (const float light : valuesOf(target.color()))
        ASSERT_EQ(light, 0);
}

} // namespace
} // namespace gll::test
