// Building the cube and its instances.
#include "swarm.hpp"

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace gll::hdr_bloom {
namespace {

constexpr float pi = 3.14159265358979F;

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
};

struct Instance {
    glm::vec3 offset;
    glm::vec3 color; // linear
    float phase;
    float glows;
};

// Six faces of four corners; corners go round counter-clockwise as seen from outside.
void appendFace(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices, glm::vec3 normal,
                glm::vec3 right, glm::vec3 up) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const glm::vec3 corner : {-right - up, right - up, right + up, up - right})
        vertices.push_back({0.5F * (normal + corner), normal});
    for (const std::uint32_t index : {0U, 1U, 2U, 2U, 3U, 0U})
        indices.push_back(first + index);
}

// A Lissajous curve: seven turns about the axis, three up and down, five in and out, so that the swarm fills
// a ball evenly. The hue goes round three times along it.
Instance instanceAt(int i, int count, bool glows) {
    const float along = static_cast<float>(i) / static_cast<float>(count);
    const float theta = along * 2 * pi * 7;
    const float phi = along * 2 * pi * 3;
    const float radius = 5 + 1.5F * std::sin(along * 2 * pi * 5);
    const float hue = along * 6 * pi;
    return {.offset = {radius * std::cos(theta) * std::cos(phi * 0.5F), radius * std::sin(phi),
                       radius * std::sin(theta) * std::cos(phi * 0.5F)},
            .color = {0.5F + 0.5F * std::cos(hue), 0.5F + 0.5F * std::cos(hue + 2.0944F),
                      0.5F + 0.5F * std::cos(hue + 4.1888F)},
            .phase = along,
            .glows = glows ? 1.0F : 0.0F};
}

} // namespace

Mesh makeSwarm(int count, int glow_every, int glow_first) {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    const glm::vec3 x(1, 0, 0);
    const glm::vec3 y(0, 1, 0);
    const glm::vec3 z(0, 0, 1);
    appendFace(vertices, indices, z, x, y);
    appendFace(vertices, indices, x, -z, y);
    appendFace(vertices, indices, y, x, -z);
    appendFace(vertices, indices, -x, z, y);
    appendFace(vertices, indices, -y, x, z);
    appendFace(vertices, indices, -z, -x, y);

    std::vector<Instance> instances;
    instances.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        instances.push_back(instanceAt(i, count, glow_every > 0 && i % glow_every == glow_first));

    return Mesh({.vertices = std::as_bytes(std::span(vertices)),
                 .vertex_stride_bytes = sizeof(Vertex),
                 .attributes = {{0, 3, offsetof(Vertex, position)}, {1, 3, offsetof(Vertex, normal)}},
                 .indices = indices,
                 .instances = std::as_bytes(std::span(instances)),
                 .instance_stride_bytes = sizeof(Instance),
                 .instance_attributes = {{2, 3, offsetof(Instance, offset)},
                                         {3, 3, offsetof(Instance, color)},
                                         {4, 1, offsetof(Instance, phase)},
                                         {5, 1, offsetof(Instance, glows)}}});
}

} // namespace gll::hdr_bloom
