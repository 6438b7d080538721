// Meshes: indices, instances, parts and their limits.
#include "gl_test.hpp"

#include <array>
#include <stdexcept>

namespace gll::test {
namespace {

// Points of a strip of pixels: each unit square of it is two triangles.
struct Vertex {
    float unused_before; // so that an offset that is not heeded shows
    glm::vec2 corner;    // [0, 1]
};

constexpr std::array<Vertex, 4> square = {Vertex{9, {0, 0}}, Vertex{9, {1, 0}}, Vertex{9, {1, 1}},
                                          Vertex{9, {0, 1}}};
constexpr std::array<std::uint32_t, 6> square_indices = {0, 1, 2, 2, 3, 0};

struct Instance {
    float column;
    glm::vec3 color;
};

constexpr const char* strip_vertex = R"(#version 330 core
layout(location = 0) in vec2 corner;
layout(location = 2) in float column;
layout(location = 3) in vec3 instance_color;
flat out vec3 flat_color;
void main() {
    flat_color = instance_color;
    gl_Position = vec4((corner.x + column) / 2.0 - 1.0, corner.y * 2.0 - 1.0, 0.0, 1.0);
}
)";
constexpr const char* strip_fragment = R"(#version 330 core
flat in vec3 flat_color;
out vec4 color;
void main() { color = vec4(flat_color, 1.0); }
)";

class MeshTest : public GlTest {
  protected:
    MeshDescription description() {
        return {
            .vertices = std::as_bytes(std::span(square)),
            .vertex_stride_bytes = sizeof(Vertex),
            .attributes = {{0, 2, offsetof(Vertex, corner)}},
            .indices = square_indices,
            .instances = std::as_bytes(std::span(instances)),
            .instance_stride_bytes = sizeof(Instance),
            .instance_attributes = {{2, 1, offsetof(Instance, column)}, {3, 3, offsetof(Instance, color)}}};
    }
    // The red of each of the four columns; -1 where nothing was drawn.
    std::array<float, 4> columns(const Mesh& mesh, int count) {
        const Framebuffer target({{"out", Format::rgba32f}}, {4, 1});
        const Program program = makeProgram(strip_vertex, strip_fragment);
        draw(target, {.program = program, .mesh = &mesh, .instances = count, .clear_color = glm::vec4(-1)});
        std::array<float, 4> reds{};
        for (int x = 0; x < 4; ++x)
            reds[static_cast<std::size_t>(x)] = pixelOf(target.color(), x, 0).r;
        return reds;
    }

    std::vector<Instance> instances = {{0, {10, 0, 0}}, {2, {20, 0, 0}}, {3, {30, 0, 0}}};
};

TEST_F(MeshTest, everyInstanceHasItsOwnValues) {
    EXPECT_EQ(columns(Mesh(description()), 3), (std::array<float, 4>{10, -1, 20, 30}));
    EXPECT_EQ(columns(Mesh(description()), 2), (std::array<float, 4>{10, -1, 20, -1}));
}

TEST_F(MeshTest, aMeshWithoutIndicesDrawsItsVerticesInOrder) {
    constexpr std::array<Vertex, 3> corner = {Vertex{0, {0, 0}}, Vertex{0, {2, 0}}, Vertex{0, {0, 2}}};
    MeshDescription one = description();
    one.vertices = std::as_bytes(std::span(corner));
    one.indices = {};
    instances.resize(1);
    one.instances = std::as_bytes(std::span(instances));
    EXPECT_EQ(columns(Mesh(one), 1)[0], 10);
}

TEST_F(MeshTest, anIndexedMeshWithoutInstancesIsDrawnOnce) {
    MeshDescription plain = description();
    plain.instances = {};
    plain.instance_attributes = {};
    // Attributes without an array read their default, (0, 0, 0): column 0, black.
    EXPECT_EQ(columns(Mesh(plain), 1), (std::array<float, 4>{0, -1, -1, -1}));
}

TEST_F(MeshTest, aPartIsDrawnByItsFirstIndexAndCount) {
    const Mesh mesh(description());
    const Framebuffer target({{"out", Format::rgba32f}}, {16, 4});
    const Program program = makeProgram(strip_vertex, strip_fragment);
    const auto drawnPixels = [&](std::uint32_t first, std::uint32_t count) {
        draw(target, {.program = program,
                      .draws = {{.mesh = mesh, .first_index = first, .index_count = count}},
                      .clear_color = glm::vec4(-1)});
        int drawn = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 16; ++x)
                drawn += pixelOf(target.color(), x, y).r >= 0 ? 1 : 0;
        return drawn;
    };
    const int first_half = drawnPixels(0, 3);
    const int second_half = drawnPixels(3, 3);
    EXPECT_GT(first_half, 0);
    EXPECT_GT(second_half, 0);
    EXPECT_EQ(first_half + second_half, 16);
    EXPECT_EQ(drawnPixels(0, 0), 16);
    EXPECT_EQ(drawnPixels(3, 0), second_half);
}

TEST_F(MeshTest, aPartOutsideTheMeshIsAnError) {
    const Mesh mesh(description());
    EXPECT_THROW(mesh.draw(1, 7), std::out_of_range);
    EXPECT_THROW(mesh.draw(1, 3, 4), std::out_of_range);
    EXPECT_THROW(mesh.draw(1, 1, 0xFFFFFFFF), std::out_of_range);
    EXPECT_THROW(mesh.draw(1, 0xFFFFFFFF, 2), std::out_of_range);
}

TEST_F(MeshTest, aMeshWithoutVerticesIsAnError) {
    EXPECT_THROW(Mesh(MeshDescription{}), std::invalid_argument);
    MeshDescription no_stride = description();
    no_stride.vertex_stride_bytes = 0;
    EXPECT_THROW(Mesh{no_stride}, std::invalid_argument);
}

TEST_F(MeshTest, anIndexBeyondTheVerticesIsAnError) {
    constexpr std::array<std::uint32_t, 3> beyond = {0, 1, 4};
    MeshDescription broken = description();
    broken.indices = beyond;
    EXPECT_THROW(Mesh{broken}, std::invalid_argument);
}

} // namespace
} // namespace gll::test
