// The shaders' formulas, each drawn by itself and read back.
#include "06_gbuffer/gbuffer.hpp"
#include "07_shadow_map/shadow_map.hpp"
#include "08_ssao/ssao.hpp"
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
// Of the noise for occlusion, so chosen.
Defines noiseDefines(const std::string& noise) {
    Settings settings;
    const ssao::SsaoOptions options(settings);
    settings.set("ssao_noise", noise);
    return options.noise.defines();
}

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
#include "08_ssao/noise.glsl"
out float turn;
void main() { turn = noiseOf(ivec2(gl_FragCoord.xy)).x; }
)";

TEST_F(DeferredShader, noiseIsTheSameAsTheProcessorsOwn) {
    const Framebuffer target({{.name = "turn", .format = Format::r32f}}, {64, 64});
    draw(target, {.program = program(turn_probe, noiseDefines("hash"))});
    const std::vector<float> turns = valuesOf(target.color()); // top row first
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            ASSERT_EQ(turns[(63 - y) * 64 + x], static_cast<float>(hashed(x + (y << 16U)) >> 8U) * 0x1p-24F);
}

TEST_F(DeferredShader, noiseForTheBlurHasSixteenTurnsInEachFourByFourBlock) {
    const Framebuffer target({{.name = "turn", .format = Format::r32f}}, {8, 8});
    draw(target, {.program = program(turn_probe, noiseDefines("interleaved"))});
    const std::vector<float> turns = valuesOf(target.color());
    for (std::size_t block = 0; block < 4; ++block) {
        unsigned seen = 0;
        for (std::size_t i = 0; i < 16; ++i)
            seen |=
                1U << static_cast<unsigned>(turns[(block / 2 * 4 + i / 4) * 8 + block % 2 * 4 + i % 4] * 16);
        EXPECT_EQ(seen, 0xFFFFU);
    }
}

TEST(HilbertIndex, visitsEveryCellAndStepsOnlyToNeighbours) {
    constexpr int order = 6;
    constexpr int side = 1 << order;
    std::vector<glm::ivec2> cells(side * side, glm::ivec2(-1));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int index = ssao::hilbertIndex(x, y, order);
            ASSERT_TRUE(index >= 0 && index < side * side);
            cells[static_cast<std::size_t>(index)] = {x, y};
        }
    for (std::size_t i = 1; i < cells.size(); ++i) {
        const glm::ivec2 step = glm::abs(cells[i] - cells[i - 1]);
        ASSERT_EQ(step.x + step.y, 1) << i;
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
#include "lib/noise.glsl"
void main() { gl_FragDepth = hashedUnit(ivec2(gl_FragCoord.xy)); }
)"),
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

// 09 with a table, the sun as a light and energy given back.
const Defines environment_defines = {{"ENVIRONMENT_DIFFUSE_RAW", "0"},
                                     {"ENVIRONMENT_DIFFUSE_MIP", "1"},
                                     {"ENVIRONMENT_DIFFUSE_SH9_SUN", "2"},
                                     {"ENVIRONMENT_DIFFUSE", "0"},
                                     {"ENVIRONMENT_SPECULAR_RAW", "0"},
                                     {"ENVIRONMENT_SPECULAR_PREFILTERED", "1"},
                                     {"ENVIRONMENT_SPECULAR", "1"},
                                     {"ENVIRONMENT_SUN", "1"},
                                     {"ENVIRONMENT_LAYOUT_EQUIRECTANGULAR", "0"},
                                     {"ENVIRONMENT_LAYOUT_OCTAHEDRAL", "1"},
                                     {"ENVIRONMENT_LAYOUT", "0"},
                                     {"ENVIRONMENT_BRDF_ORIGINAL", "0"},
                                     {"ENVIRONMENT_BRDF_TABLE", "1"},
                                     {"ENVIRONMENT_BRDF_KARIS", "2"},
                                     {"ENVIRONMENT_BRDF_LAZAROV", "3"},
                                     {"ENVIRONMENT_BRDF", "1"},
                                     {"ENVIRONMENT_ENERGY_NONE", "0"},
                                     {"ENVIRONMENT_ENERGY_FDEZ_AGUERA", "1"},
                                     {"ENVIRONMENT_ENERGY_TURQUIN", "2"},
                                     {"ENVIRONMENT_ENERGY", "1"}};

// Where a lobe is sharp, n.h^2 (a^2 - 1) + 1 is a small difference of numbers near 1.
TEST_F(DeferredShader, theSunsHighlightIsWhatADoubleSays) {
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.4, 0.8, 0.5));
    const glm::dvec3 to_camera = glm::normalize(glm::dvec3(-0.3, 0.2, 0.9));
    const glm::dvec3 halfway = glm::normalize(to_sun + to_camera);
    const glm::dvec3 across = glm::normalize(glm::cross(halfway, glm::dvec3(0, 1, 0)));
    constexpr double spread = 4e-6; // half of the mean squared angle of a sun a quarter of a degree wide
    constexpr int count = 64;
    for (const double roughness : {0.05, 0.1, 0.3, 1.0}) {
        const double alpha_squared = std::pow(roughness, 4) + spread;
        std::vector<glm::vec3> normals;
        std::vector<double> expected;
        for (int i = 0; i < count; ++i) {
            const double angle_rad = 3.0 * i / count * std::sqrt(std::min(alpha_squared, 0.01));
            const glm::dvec3 normal =
                glm::vec3(std::cos(angle_rad) * halfway + std::sin(angle_rad) * across); // in floats
            normals.emplace_back(normal);
            const double length = glm::length(normal);
            const double lit = glm::dot(normal, to_sun) / length;
            const double seen = glm::dot(normal, to_camera) / length;
            const double along = glm::dot(normal, halfway) / length;
            const double wide = 1 - along * along + alpha_squared * along * along;
            const double masked = lit * std::sqrt(alpha_squared + seen * seen * (1 - alpha_squared)) +
                                  seen * std::sqrt(alpha_squared + lit * lit * (1 - alpha_squared));
            const double share = std::min(5 * roughness * (1.7 - 0.7 * roughness), 1.0);
            expected.push_back(alpha_squared / (wide * wide) * 0.5 / masked * lit * share);
        }
        const Framebuffer target({{.name = "light", .format = Format::r32f}}, {count, 1});
        draw(target, {.program = program(R"(
#include "09_environment_light/environment.glsl"
uniform vec3 normals[64];
uniform vec3 to_camera;
uniform float roughness;
out float light;
void main() { light = sunReflected(normals[int(gl_FragCoord.x)], to_camera, vec3(1.0), roughness).r; }
)",
                                         environment_defines),
                      .uniforms = {{"normals", normals},
                                   {"to_camera", glm::vec3(to_camera)},
                                   {"roughness", static_cast<float>(roughness)},
                                   {"to_brightest", glm::vec3(to_sun)},
                                   {"brightest_irradiance", glm::vec3(1)},
                                   {"brightest_spread", static_cast<float>(spread)},
                                   {"prefiltered_levels", 5.0F}}});
        for (std::size_t i = 0; const float light : valuesOf(target.color())) {
            ASSERT_NEAR(light / expected[i], 1, 0.002) << roughness << ", normal " << i;
            ++i;
        }
    }
}

TEST_F(DeferredShader, theSunReflectsNothingWhereItIsBehindOrOpposite) {
    const Framebuffer target({{.name = "light", .format = Format::rgba32f}}, {1, 1});
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0)}) {
        draw(target, {.program = program(R"(
#include "09_environment_light/environment.glsl"
uniform vec3 normal;
uniform vec3 to_camera;
out vec4 light;
void main() { light = vec4(sunReflected(normal, to_camera, vec3(1.0), 0.5), 1.0); }
)",
                                         environment_defines),
                      .uniforms = {{"normal", normal},
                                   {"to_camera", glm::vec3(0, 0, -1)},
                                   {"to_brightest", glm::vec3(0, 0, 1)},
                                   {"brightest_irradiance", glm::vec3(1)},
                                   {"brightest_spread", 1e-5F},
                                   {"prefiltered_levels", 5.0F}}});
        EXPECT_EQ(pixelOf(target.color(), 0, 0), glm::vec4(0, 0, 0, 1)) << normal.z;
    }
}

// A table in half floats may say 1.0005, and where the mirrored sky is black nothing else hides that.
TEST_F(DeferredShader, noLightIsNegativeWhereATableSaysALittleMoreThanOne) {
    const std::vector<float> more_than_one = {0.75F, 0.2505F};
    const Texture table({.size = {1, 1}, .format = Format::rg16f}, std::span<const float>(more_than_one));
    const std::vector<float> dark(3, 0.0F);
    const Texture black({.size = {1, 1}, .format = Format::rgb16f}, std::span<const float>(dark));
    const Framebuffer target({{.name = "light", .format = Format::r32f}}, {1, 1});
    for (const char* energy : {"0", "1", "2"}) {
        Defines defines = environment_defines;
        for (auto& [name, value] : defines)
            if (name == "ENVIRONMENT_ENERGY") value = energy;
        draw(target, {.program = program(R"(
#include "09_environment_light/environment.glsl"
out float light;
void main() {
    vec3 left;
    vec3 up = vec3(0.0, 1.0, 0.0);
    light = environmentReflected(up, up, vec3(1.0), vec3(1.0), 0.5, left).r;
}
)",
                                         defines),
                      .part = {.inputs = {{"prefiltered_map", black}, {"brdf_table", table}},
                               .uniforms = {{"brdf_table_size", 1.0F},
                                            {"to_brightest", glm::vec3(-1, 0, 0)},
                                            {"brightest_irradiance", glm::vec3(0)},
                                            {"brightest_spread", 1e-5F},
                                            {"prefiltered_levels", 0.0F}}}});
        EXPECT_GE(pixelOf(target.color(), 0, 0).r, 0.0F) << energy;
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
                                      {"ENVIRONMENT_DIFFUSE_MIP", "1"},
                                      {"ENVIRONMENT_DIFFUSE", "0"},
                                      {"ENVIRONMENT_SPECULAR_RAW", "0"},
                                      {"ENVIRONMENT_SPECULAR_PREFILTERED", "1"},
                                      {"ENVIRONMENT_SPECULAR", "0"},
                                      {"ENVIRONMENT_BRDF_ORIGINAL", "0"},
                                      {"ENVIRONMENT_BRDF_TABLE", "1"},
                                      {"ENVIRONMENT_BRDF", "0"}}),
                  .inputs = {{"environment_map", map}}});
    for (const float light : valuesOf(target.color()))
        ASSERT_EQ(light, 0);
}

} // namespace
} // namespace gll::test
