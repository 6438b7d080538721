// Loading the scene and listing its draws.
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace gll {
namespace {

constexpr float statue_height = 2.2F;
constexpr float statue_radius = 1.35F; // of the sphere round a model; the cat's is a little smaller
constexpr float least_height = 0.005F;
constexpr float floor_half_width = 6;
constexpr float floor_uv_per_unit = 0.35F;

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec2 uv;
};

Mesh makeMesh(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices) {
    return Mesh({.vertices = std::as_bytes(vertices),
                 .vertex_stride_bytes = sizeof(Vertex),
                 .attributes = {{0, 3, offsetof(Vertex, position)},
                                {1, 3, offsetof(Vertex, normal)},
                                {2, 2, offsetof(Vertex, uv)}},
                 .indices = indices});
}

// Stands on the floor with its middle on the y axis, as high as a statue and no wider than the circle in
// which the camera sees all of it, and looks along +x, to where the camera is at first.
Mesh makeStatue(const MeshData& data, const std::filesystem::path& path) {
    glm::vec3 lowest = data.positions.front();
    glm::vec3 highest = lowest;
    for (const glm::vec3& position : data.positions) {
        lowest = glm::min(lowest, position);
        highest = glm::max(highest, position);
    }
    const glm::dvec3 middle = 0.5 * (glm::dvec3(lowest) + glm::dvec3(highest));
    double radius = 0;
    for (const glm::vec3& position : data.positions)
        radius = std::max(radius, glm::distance(glm::dvec3(position), middle));
    const float height = highest.y - lowest.y;
    const float scale = std::min(statue_height / height, static_cast<float>(statue_radius / radius));
    if (!std::isfinite(scale))
        throw std::runtime_error(path.string() + ": all of its vertices lie at one place; export it again");
    const glm::vec3 base(0.5F * (lowest.x + highest.x), lowest.y, 0.5F * (lowest.z + highest.z));
    // What lies flat would fight with the floor for each pixel.
    const glm::vec3 lift(0, height * scale < least_height ? least_height : 0.0F, 0);
    const auto turned = [&](const glm::vec3& v) {
        return data.front_is_positive_z ? glm::vec3(v.z, v.y, -v.x) : v;
    };
    std::vector<Vertex> vertices;
    vertices.reserve(data.positions.size());
    for (std::size_t i = 0; i < data.positions.size(); ++i)
        vertices.push_back(
            {turned((data.positions[i] - base) * scale) + lift, turned(data.normals[i]), data.uvs[i]});
    return makeMesh(vertices, data.indices);
}

// Heights stand in for the normals that a material has none of: see loadMaterial().
MaterialData withNormals(MaterialData material) {
    if (material.normal_texture.empty()) material.normal_texture = material.height_texture;
    return material;
}

Mesh makeFloor() {
    std::vector<Vertex> vertices;
    for (const glm::vec2 corner : {glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
        const glm::vec2 place = corner * floor_half_width;
        vertices.push_back({{place.x, 0, place.y}, {0, 1, 0}, place * floor_uv_per_unit});
    }
    constexpr std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    return makeMesh(vertices, indices);
}

} // namespace

Scene::Scene(const std::filesystem::path& mesh, const std::filesystem::path& floor, Warnings& warnings)
    : warnings_(warnings), statue_(Mesh::fullScreenTriangle()), floor_(makeFloor()) {
    const MeshData data = loadMesh(mesh);
    warnings.add(data.warnings);
    statue_ = makeStatue(data, mesh);
    for (const MaterialData& material : data.materials)
        surfaces_.push_back({.data = withNormals(material),
                             .occluded_albedo = 0.55F,
                             .specular_scale = 0.6F,
                             .shininess = seed_shininess.x,
                             .normal_strength = material.normal_scale,
                             .tag = 0,
                             .textures = {}});
    for (const MeshPart& part : data.parts)
        parts_.push_back({&statue_, part.material, part.first_index, part.index_count});
    // the floor's normals are exaggerated, or the mortar would not be seen
    std::vector<std::string> floor_warnings;
    const MaterialData material = withNormals(loadMtl(floor, floor_warnings).front());
    warnings.add(floor_warnings);
    surfaces_.push_back({.data = material,
                         .occluded_albedo = 0.5F,
                         .specular_scale = 0.4F,
                         .shininess = seed_shininess.y,
                         .normal_strength = 3 * material.normal_scale,
                         .tag = 1,
                         .textures = {}});
    parts_.push_back({&floor_, surfaces_.size() - 1, 0, 0});
}

std::vector<Draw> Scene::materialDraws(MaterialFilter filter, bool flip_v) {
    std::vector<Draw> draws;
    for (const Part& part : parts_) {
        Surface& surface = surfaces_[part.surface];
        std::optional<MaterialTextures>& textures = surface.textures[static_cast<std::size_t>(filter)];
        if (!textures) textures = loadMaterial(surface.data, filter, warnings_);
        draws.push_back({.mesh = *part.mesh,
                         .inputs = {{"base_map", textures->base}, {"surface_map", textures->surface}},
                         .uniforms = {{"base_color", glm::vec3(surface.data.base_color)},
                                      {"occluded_albedo", surface.occluded_albedo},
                                      {"specular_scale", surface.specular_scale},
                                      {"shininess", surface.shininess},
                                      {"normal_strength", surface.normal_strength},
                                      {"material", surface.tag},
                                      {"v_factor_offset",
                                       flip_v && part.mesh == &statue_ ? glm::vec2(-1, 1) : glm::vec2(1, 0)}},
                         .first_index = part.first_index,
                         .index_count = part.index_count});
    }
    return draws;
}

std::vector<Draw> Scene::depthDraws() const { return {{.mesh = floor_}, {.mesh = statue_}}; }

} // namespace gll
