// What a G-buffer gives back of normals, highlights and distances, against double: every layout of the
// settings, drawn and read by the rung's own shaders.
#include "06_gbuffer/gbuffer.hpp"
#include "gbuffer_reference.hpp"
#include "gl/pass.hpp"
#include "rung/capture.hpp"
#include "rung/context.hpp"
#include "rung/resources.hpp"
#include "rung/settings.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <memory>

namespace gll::truth {
namespace {

struct Layout {
    explicit Layout(const std::vector<std::string>& set) : options(settings) {
        for (const std::string& one : set)
            settings.set(one);
    }
    Settings settings;
    gbuffer::GBufferOptions options;
};

class GBufferTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(context->debugLog().check("G-buffer")); }

    static std::vector<float> valuesOf(const Texture& texture) {
        return std::get<std::vector<float>>(readTexture(texture).pixels);
    }

    const Program& program(const std::string& fragment, const Defines& defines) {
        const std::string name = "probe" + std::to_string(++probes_) + ".frag";
        folder_.write(name, "#version 330 core\n" + fragment);
        return shaders.fullScreen(name, defines);
    }

    static constexpr glm::ivec2 size{256, 256};

    // The directions, `size` of them, written by the layout and read back.
    std::vector<glm::dvec3> stored(const std::vector<glm::dvec3>& directions, const Layout& layout) {
        std::vector<float> values;
        for (const glm::dvec3& direction : directions)
            values.insert(values.end(), {float(direction.x), float(direction.y), float(direction.z)});
        const Texture given({.size = size, .format = Format::rgba32f, .filter = Filter::nearest}, values);
        const bool is_packed = layout.options.packing == "rgba16";
        const std::vector<Attachment> all = layout.options.attachments();
        const std::string name = is_packed ? "packed" : "normal";
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const Attachment& a) { return a.name == name; });
        const Framebuffer target({*found}, size);
        drawPass("store", target,
                 {.program = program(std::string(R"(#include "06_gbuffer/gbuffer.glsl"
uniform sampler2D given;
out vec4 stored;
void main() {
    vec3 normal = texelFetch(given, ivec2(gl_FragCoord.xy), 0).xyz;
    stored = )") + (is_packed ? "packSurface(vec3(0.3), 0.2, normal, 48.0);\n}\n"
                              : "packNormal(normal);\n}\n"),
                                     layout.options.defines()),
                  .inputs = {{"given", given}}},
                 triangle);
        const Framebuffer back({{.name = "back", .format = Format::rgba32f}}, size);
        drawPass("read", back,
                 {.program = program(std::string(R"(#include "06_gbuffer/gbuffer.glsl"
uniform sampler2D stored;
out vec4 back;
void main() {
    vec4 texel = texelFetch(stored, ivec2(gl_FragCoord.xy), 0);
    back = vec4()") + (is_packed ? "packedNormal(wordsOf(texel)), 0.0);\n}\n"
                                 : "unpackNormal(texel), 0.0);\n}\n"),
                                     layout.options.defines()),
                  .inputs = {{"stored", target.color()}}},
                 triangle);
        // what is read back has its top row first
        const std::vector<float> read = valuesOf(back.color());
        std::vector<glm::dvec3> result(directions.size());
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto from = 4 * static_cast<std::size_t>((size.y - 1 - y) * size.x + x);
                result[static_cast<std::size_t>(y * size.x + x)] = {read[from], read[from + 1],
                                                                    read[from + 2]};
            }
        return result;
    }

    // color(index) of `size.x` pixels in a row, as 32-bit floats.
    std::vector<glm::vec4> row(int count, const std::string& main, const Defines& defines) {
        const Framebuffer target({{.name = "row", .format = Format::rgba32f}}, {count, 1});
        drawPass("row", target, {.program = program(main, defines)}, triangle);
        const std::vector<float> values = valuesOf(target.color());
        std::vector<glm::vec4> result;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            result.emplace_back(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]);
        return result;
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    Mesh triangle = Mesh::fullScreenTriangle();
    test::TemporaryFolder folder_;
    ShaderLibrary shaders{[&] {
        auto roots = Resources().shaderRoots();
        roots.push_back(folder_.path());
        return roots;
    }()};
    int probes_ = 0;
};

std::vector<std::string> normalChoices() {
    Settings settings;
    const gbuffer::GBufferOptions options(settings); // declares them
    return settings.at("normals").choices;
}

// The mean and the largest error of two million directions, worked out for another program (see the page's
// sources).
struct Known {
    double mean_deg, largest_deg;
};
const std::map<std::string, Known> known = {
    {"rgb10", {0.042, 0.096}},         {"rgb8", {0.170, 0.384}},          {"oct16", {0.0013, 0.0037}},
    {"oct12", {0.021, 0.059}},         {"oct12 precise", {0.020, 0.039}}, {"oct10", {0.084, 0.236}},
    {"oct10 precise", {0.078, 0.158}}, {"oct8", {0.336, 0.947}},          {"oct8 precise", {0.313, 0.634}}};

TEST_F(GBufferTest, everyLayoutOfNormalsIsAsFarOffAsItsFormula) {
    const std::vector<glm::dvec3> directions = spreadDirections(static_cast<std::size_t>(size.x * size.y));
    for (const std::string& normals : normalChoices())
        for (const bool precise : {false, true}) {
            if (precise && octahedralBits(normals) == 0) continue;
            const Layout layout({"normals=" + normals, std::string("precise=") + (precise ? "on" : "off")});
            const std::vector<glm::dvec3> back = stored(directions, layout);
            std::size_t next = 0;
            const NormalError drawn =
                normalError(directions, [&](const glm::dvec3&) { return back[next++]; });
            const NormalError formula = normalError(
                directions, [&](const glm::dvec3& n) { return storedNormal(normals, precise, n); });
            const std::string name = normals + (precise ? " precise" : "");
            std::printf("%s: mean %.5f, at most %.5f degrees; by its formula %.5f, %.5f\n", name.c_str(),
                        drawn.mean_deg, drawn.largest_deg, formula.mean_deg, formula.largest_deg);
            // OpenGL leaves open whether half floats are rounded or cut off; 32-bit floats are off by 1e-5
            // degrees
            if (normals == "rgba16f") {
                EXPECT_LE(drawn.mean_deg, 2 * formula.mean_deg);
                EXPECT_LE(drawn.largest_deg, 2 * formula.largest_deg);
                continue;
            }
            EXPECT_NEAR(drawn.mean_deg, formula.mean_deg, 0.005 * formula.mean_deg + 1e-5) << name;
            EXPECT_NEAR(drawn.largest_deg, formula.largest_deg, 0.02 * formula.largest_deg + 2e-5) << name;
            if (const auto entry = known.find(name); entry != known.end()) {
                EXPECT_NEAR(drawn.mean_deg, entry->second.mean_deg, 0.04 * entry->second.mean_deg) << name;
                EXPECT_LE(drawn.largest_deg, 1.02 * entry->second.largest_deg) << name;
            }
        }
}

TEST_F(GBufferTest, thePackedLayoutKeepsNormalsAs2896CodesDo) {
    const std::vector<glm::dvec3> directions = spreadDirections(static_cast<std::size_t>(size.x * size.y));
    const std::vector<glm::dvec3> back = stored(directions, Layout({"packing=rgba16"}));
    std::size_t next = 0;
    const NormalError drawn = normalError(directions, [&](const glm::dvec3&) { return back[next++]; });
    const NormalError formula =
        normalError(directions, [](const glm::dvec3& n) { return storedOctahedral(2896, true, n); });
    std::printf("packed: mean %.5f, at most %.5f degrees\n", drawn.mean_deg, drawn.largest_deg);
    EXPECT_NEAR(drawn.mean_deg, formula.mean_deg, 0.005 * formula.mean_deg);
    EXPECT_NEAR(drawn.largest_deg, formula.largest_deg, 0.02 * formula.largest_deg);
}

// x: the exponent, 1 to 8192 in even steps of its logarithm.
const char* const exponents = R"(
float exponentOf(float place) { return exp2(13.0 * (place - 0.5) / 1000.0); }
)";

TEST_F(GBufferTest, exponentsComeBackWithinHalfAStepOfTheirLogarithm) {
    for (const auto& [gloss, steps] : std::map<std::string, double>{{"8", 255}, {"6", 63}, {"4", 15}}) {
        double worst = 0;
        for (const glm::vec4& found :
             row(1000, "#include \"06_gbuffer/gbuffer.glsl\"\n" + std::string(exponents) + R"(out vec4 color;
void main() {
    float exponent = exponentOf(gl_FragCoord.x);
    color = vec4(exponent, unpackGloss(packGloss(exponent)), 0.0, 0.0);
})",
                 Layout({"gloss=" + gloss}).options.defines()))
            worst = std::max(worst, std::abs(std::log2(double(found.y)) - std::log2(double(found.x))));
        EXPECT_LE(worst, 13 / steps / 2 + 1e-5) << gloss;
        EXPECT_GT(worst, 13 / steps / 2.2) << gloss; // and uses all of its steps
    }
}

TEST_F(GBufferTest, specularComesBackWithinHalfAStepAndItsNeighbourExactly) {
    struct Case {
        std::string gloss;
        double steps;
        int uppers; // what else the eight bits hold
    };
    for (const Case& one : {Case{"palette", 127, 2}, Case{"4", 15, 16}})
        for (int upper = 0; upper < one.uppers; ++upper)
            for (const glm::vec4& found :
                 row(601,
                     "#include \"06_gbuffer/gbuffer.glsl\"\n#define UPPER " + std::to_string(upper) + R"(.0
out vec4 color;
void main() {
    float specular = (gl_FragCoord.x - 0.5) / 1000.0;
    float stored = floor(packSpecular(specular, UPPER) * 255.0 + 0.5) / 255.0; // as eight bits do
    color = vec4(specular, unpackSpecular(stored), 0.0);
})",
                     Layout({"gloss=" + one.gloss}).options.defines())) {
                ASSERT_NEAR(found.y, found.x, 0.6 / one.steps / 2 + 1e-6) << one.gloss;
                ASSERT_EQ(found.z, float(upper)) << one.gloss;
            }
}

TEST_F(GBufferTest, thePackedLayoutKeepsEverythingWithinHalfAStep) {
    for (const glm::vec4& found :
         row(1000, "#include \"06_gbuffer/gbuffer.glsl\"\n" + std::string(exponents) + R"(
out vec4 color;
void main() {
    float share = (gl_FragCoord.x - 0.5) / 1000.0;
    vec3 albedo = vec3(share, 1.0 - share, share * share);
    vec3 normal = normalize(vec3(sin(17.0 * share), cos(23.0 * share), 2.0 * share - 1.0));
    float exponent = exponentOf(gl_FragCoord.x);
    uvec2 words = wordsOf(floor(packSurface(albedo, 0.6 * share, normal, exponent) * 65535.0 + 0.5) / 65535.0);
    vec3 root_off = abs(sqrt(packedAlbedo(words)) - sqrt(albedo)) * vec3(361.0, 361.0, 511.0);
    color = vec4(max(root_off.x, max(root_off.y, root_off.z)),
                 abs(sqrt(packedSpecular(words) / 0.6) - sqrt(share)) * 127.0,
                 abs(log2(packedShininess(words) / exponent)) / 13.0 * 255.0,
                 degrees(distance(packedNormal(words), normal)));
})",
             Layout({"packing=rgba16"}).options.defines())) {
        ASSERT_LE(found.x, 0.501);
        ASSERT_LE(found.y, 0.501);
        ASSERT_LE(found.z, 0.501);
        ASSERT_LE(found.w, 0.056); // 4095 / 2895 of what 12 bits have at most
    }
}

// Planes across the view at 2000 distances from 0.1 to 1000, each a pixel of a strip, read through the rung's
// own shader.
TEST_F(GBufferTest, distancesComeBackFromEveryDepthBufferAsExactlyAsItsBitsAllow) {
    constexpr double near = 0.1;
    constexpr double far = 1000;
    Camera camera;
    camera.position = {0, 0, 0};
    camera.target = {0, 0, -1};
    camera.vertical_field_of_view_deg = 50;
    camera.near = float(near);
    camera.far = float(far);
    const gbuffer::View view(camera, 1);
    const glm::vec2 reading = gbuffer::viewZFromDepth(view.clip_from_view);
    struct Case {
        std::string positions;
        Format format;
        double near_limit, far_limit; // largest relative error of view z in [1, 10) and [100, 900)
    };
    for (const Case& one :
         {Case{"depth16", Format::depth16, 9e-4, 8e-2}, Case{"depth24", Format::depth24, 2.5e-5, 2e-3},
          Case{"depth32f", Format::depth32f, 2.5e-5, 2e-3}}) {
        const Layout layout({"positions=" + one.positions});
        constexpr int count = 2000;
        const Framebuffer target({{.name = "color", .format = Format::r8},
                                  {.name = "depth", .format = one.format, .filter = Filter::nearest}},
                                 {count, 1});
        const auto distanceOf = [&](int i) { return near * std::pow(far / near, (i + 0.5) / count); };
        drawPass("depth", target,
                 {.program = program("#define COUNT " + std::to_string(count) + R"(.0
out vec4 color;
uniform mat4 clip_from_view;
void main() {
    float view_z = -0.1 * pow(1.0e4, gl_FragCoord.x / COUNT);
    vec4 clip = clip_from_view * vec4(0.0, 0.0, view_z, 1.0);
    gl_FragDepth = clip.z / clip.w * 0.5 + 0.5;
    color = vec4(1.0);
})",
                                     {}),
                  .uniforms = {{"clip_from_view", view.clip_from_view}},
                  .depth_test = DepthTest::less,
                  .clear_depth = 1.0F},
                 triangle);
        const Framebuffer back({{.name = "back", .format = Format::r32f}}, {count, 1});
        drawPass("back", back,
                 {.program = program(R"(#include "06_gbuffer/read_gbuffer.glsl"
in vec2 uv;
out float view_z;
void main() { view_z = viewZAt(uv, 0.0); })",
                                     layout.options.defines()),
                  .inputs = {{"depth_map", target.depth()}},
                  .uniforms = {{"view_z_from_depth", reading}}},
                 triangle);
        const std::vector<float> found = valuesOf(back.color());
        double near_worst = 0, far_worst = 0;
        for (int i = 0; i < count; ++i) {
            const double distance = distanceOf(i);
            const double off = std::abs(-double(found[static_cast<std::size_t>(i)]) - distance) / distance;
            if (distance >= 1 && distance < 10) near_worst = std::max(near_worst, off);
            if (distance >= 100 && distance < 900) far_worst = std::max(far_worst, off);
        }
        std::printf("%s: view z off by at most %.2g of it from 1 to 10, %.2g from 100 to 900\n",
                    one.positions.c_str(), near_worst, far_worst);
        EXPECT_LT(near_worst, one.near_limit) << one.positions;
        EXPECT_LT(far_worst, one.far_limit) << one.positions;
        EXPECT_GT(far_worst, one.far_limit / 10) << one.positions;
    }
}

} // namespace
} // namespace gll::truth
