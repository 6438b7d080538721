// Loading the scene and listing its draws.
#include "scene.hpp"

#include "gbuffer.hpp"
#include "statue.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace gll::gbuffer {
namespace {

constexpr float floor_uv_per_unit = 0.35F;

// Vertices grow by colors and second_uvs where there are any.
Mesh makeMesh(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
              std::span<const glm::vec4> colors = {}, std::span<const glm::vec2> second_uvs = {}) {
    std::vector<VertexAttribute> attributes = {
        {0, 3, offsetof(Vertex, position)}, {1, 3, offsetof(Vertex, normal)}, {2, 2, offsetof(Vertex, uv)}};
    std::size_t stride = sizeof(Vertex);
    const auto grow = [&](GLuint location, int components, std::size_t bytes) {
        attributes.push_back({location, components, stride});
        stride += bytes;
    };
    if (!colors.empty()) grow(3, 4, sizeof(glm::vec4));
    if (!second_uvs.empty()) grow(4, 2, sizeof(glm::vec2));
    std::vector<std::byte> bytes(vertices.size() * stride);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        std::byte* to = bytes.data() + i * stride;
        const auto put = [&](const auto& value) {
            std::memcpy(to, &value, sizeof value);
            to += sizeof value;
        };
        put(vertices[i]);
        if (!colors.empty()) put(colors[i]);
        if (!second_uvs.empty()) put(second_uvs[i]);
    }
    return Mesh({.vertices = bytes,
                 .vertex_stride_bytes = static_cast<int>(stride),
                 .attributes = attributes,
                 .indices = indices});
}

Mesh makeStatue(const MeshData& data, const StatuePlace& place) {
    std::vector<Vertex> vertices;
    vertices.reserve(data.positions.size());
    for (std::size_t i = 0; i < data.positions.size(); ++i)
        vertices.push_back(
            {place.position(data.positions[i]), place.direction(data.normals[i]), data.uvs[i]});
    return makeMesh(vertices, data.indices, data.colors, data.second_uvs);
}

// Whether the model has no inside: it has no thickness, or an edge, told by the places of its ends, that its
// triangles do not run along as often in one direction as in the other.
bool isSheet(const MeshData& data) {
    const std::vector<glm::vec3>& p = data.positions;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(p[a].x, p[a].y, p[a].z) < std::tie(p[b].x, p[b].y, p[b].z);
    };
    std::vector<std::uint32_t> order(p.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), before);
    std::vector<std::uint64_t> place(p.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i)
        place[order[i]] = place[order[i - 1]] + (before(order[i - 1], order[i]) ? 1 : 0);

    std::array<std::vector<std::uint64_t>, 2> edges; // towards the later place, and back
    for (std::size_t i = 0; i < data.indices.size(); ++i) {
        const std::uint64_t from = place[data.indices[i]];
        const std::uint64_t to = place[data.indices[i % 3 == 2 ? i - 2 : i + 1]];
        if (from != to) edges[from < to ? 0 : 1].push_back(std::min(from, to) << 32 | std::max(from, to));
    }
    for (std::vector<std::uint64_t>& direction : edges)
        std::sort(direction.begin(), direction.end());
    glm::vec3 lowest = p.front();
    glm::vec3 highest = lowest;
    for (const glm::vec3& position : p) {
        lowest = glm::min(lowest, position);
        highest = glm::max(highest, position);
    }
    return edges[0] != edges[1] || glm::any(glm::equal(lowest, highest));
}

// Heights stand in for the normals that a material has none of: see loadMaterial().
MaterialData withNormals(MaterialData material) {
    if (material.normal_texture.empty()) material.normal_texture = material.height_texture;
    return material;
}

Mesh makeFloor(float half_width) {
    std::vector<Vertex> vertices;
    for (const glm::vec2 corner : {glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
        const glm::vec2 place = corner * half_width;
        vertices.push_back({{place.x, 0, place.y}, {0, 1, 0}, place * floor_uv_per_unit});
    }
    constexpr std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    return makeMesh(vertices, indices);
}

} // namespace

SceneOptions::SceneOptions(Settings& settings, Highlights highlights)
    : texture_filter(settings.choice(
          "texture_filter", "bilinear", {"bilinear", "mipmapped", "anisotropic"},
          "how materials are sampled; anisotropic where the driver offers it, else as mipmapped")),
      specular_aa(
          highlights == Highlights::some
              ? std::optional(settings.toggle(
                    "specular_aa", false, "widen highlights by how much normals vary from pixel to pixel"))
              : std::nullopt),
      flip_v(settings.toggle("flip_v", false,
                             "turn the model's texture coordinates over: for OBJ files whose v runs down")) {
    settings.shared("06_gbuffer", {"texture_filter", "flip_v"});
    if (specular_aa) settings.shared("06_gbuffer", {"specular_aa"});
}

MaterialFilter SceneOptions::filter() const {
    return texture_filter == "bilinear"    ? MaterialFilter::bilinear
           : texture_filter == "mipmapped" ? MaterialFilter::mipmapped
                                           : MaterialFilter::anisotropic;
}

Scene::Scene(const RungResources& resources, float floor_half_width)
    : warnings_(resources.warnings), statue_(Mesh::fullScreenTriangle()),
      floor_(makeFloor(floor_half_width)) {
    const std::filesystem::path mesh = resources.file(&RungFiles::mesh, "assets/cat/cat.obj");
    const MeshData data = loadMesh(mesh);
    warnings_.add(data.warnings);
    statue_has_colors_ = !data.colors.empty();
    statue_is_sheet_ = isSheet(data);
    statue_ = makeStatue(data, StatuePlace(data, mesh));
    for (const MaterialData& material : data.materials)
        surfaces_.push_back({.data = withNormals(material),
                             .occluded_albedo = 0.55F,
                             .specular_scale = 0.6F,
                             .shininess = palette_shininess.x,
                             .normal_strength = material.normal_scale,
                             .tag = 0,
                             .textures = {}});
    for (const MeshPart& part : data.parts)
        parts_.push_back({&*statue_, part.material, part.first_index, part.index_count});
    // the floor's normals are exaggerated, or the mortar would not be seen
    std::vector<std::string> floor_warnings;
    const std::filesystem::path floor = resources.file(&RungFiles::floor, "assets/brick/brick.mtl");
    const MaterialData material = withNormals(loadMtl(floor, floor_warnings).front());
    warnings_.add(floor_warnings);
    surfaces_.push_back({.data = material,
                         .occluded_albedo = 0.5F,
                         .specular_scale = 0.4F,
                         .shininess = palette_shininess.y,
                         .normal_strength = 3 * material.normal_scale,
                         .tag = 1,
                         .textures = {}});
    floor_surface_ = surfaces_.size() - 1;
    parts_.push_back({&*floor_, floor_surface_, 0, 0});
    // the project's own cat is what the original drew of it
    if (!resources.given.mesh.empty()) warnings_.add(notDrawn(mesh.string()));
}

void Scene::add(const PlainObject& object) {
    MaterialData material;
    material.base_color = glm::vec4(object.color, 1);
    material.roughness = 0; // or the original's rule would take highlights from it
    surfaces_.push_back({.data = material,
                         .occluded_albedo = 1,
                         .specular_scale = object.specular,
                         .shininess = object.shininess,
                         .normal_strength = 1,
                         .tag = 0,
                         .textures = {}});
    added_.push_back(makeMesh(object.vertices, object.indices));
    parts_.push_back({&added_.back(), surfaces_.size() - 1, 0, 0});
}

std::vector<std::string> Scene::notDrawn(const std::string& where) const {
    std::vector<std::string> lines;
    const auto say = [&](const std::string& what, const auto& has) {
        for (const Surface& surface : surfaces_)
            if (surface.tag == 0 && !surface.data.implied && has(surface.data)) {
                lines.push_back(where + ": material '" + surface.data.name + "' " + what);
                return;
            }
    };
    say("blends with what is behind it, and is drawn opaque",
        [](const MaterialData& data) { return data.alpha_mode == AlphaMode::blend; });
    say("is metallic, and is drawn as if it were not",
        [](const MaterialData& data) { return data.metallic > 0.0F; });
    say("emits light, which is not drawn",
        [](const MaterialData& data) { return data.emitted_color != glm::vec3(0.0F); });
    return lines;
}

const MaterialTextures& Scene::texturesOf(Surface& surface, MaterialFilter filter) {
    std::optional<MaterialTextures>& textures = surface.textures[static_cast<std::size_t>(filter)];
    if (!textures) textures = loadMaterial(surface.data, filter, warnings_);
    return *textures;
}

Draw Scene::drawOf(const Part& part, const SceneOptions& options) {
    Surface& surface = surfaces_[part.surface];
    const MaterialData& data = surface.data;
    const MaterialTextures& textures = texturesOf(surface, options.filter());
    const bool of_statue = statue_ && part.mesh == &*statue_;
    Draw result = {.mesh = *part.mesh,
                   .part = {.inputs = {{"base_map", textures.base}, {"surface_map", textures.surface}},
                            .uniforms = {{"base_color", glm::vec3(data.base_color)},
                                         {"occluded_albedo", surface.occluded_albedo},
                                         {"specular_scale", surface.specular_scale},
                                         {"shininess", surface.shininess},
                                         {"normal_strength", surface.normal_strength},
                                         {"material", surface.tag},
                                         {"v_factor_offset",
                                          options.flip_v && of_statue ? glm::vec2(-1, 1) : glm::vec2(1, 0)}}},
                   .first_index = part.first_index,
                   .index_count = part.index_count};
    if (of_statue && statue_has_colors_) result.part.defines.push_back({"VERTEX_COLOR", "1"});
    if (of_statue && statue_is_sheet_) result.part.defines.push_back({"SHEET", "1"});
    if (!needsSeparateMaps(data)) return result;

    result.part.defines.push_back({"SEPARATE_MAPS", "1"});
    result.part.inputs.push_back({"occlusion_map", textures.occlusion});
    result.part.inputs.push_back({"roughness_map", textures.roughness});
    const auto place = [&](const std::string& name, const TextureData& texture) {
        const glm::mat3x2& t = texture.uv_transform;
        result.part.uniforms.push_back(
            {name + "_transform", glm::mat3(glm::vec3(t[0], 0), glm::vec3(t[1], 0), glm::vec3(t[2], 1))});
        result.part.uniforms.push_back({name + "_uv_set", texture.uv_set});
    };
    place("base", data.base_color_texture);
    place("occlusion", data.occlusion_texture);
    place("normal", data.normal_texture);
    place("roughness", data.roughness_texture);
    if (data.alpha_mode == AlphaMode::mask) {
        result.part.defines.push_back({"ALPHA_MASK", "1"});
        result.part.uniforms.push_back({"opacity", data.base_color.a});
        result.part.uniforms.push_back({"alpha_cutoff", data.alpha_cutoff});
    }
    return result;
}

std::vector<Draw> Scene::materialDraws(const SceneOptions& options) {
    std::vector<Draw> draws;
    for (const Part& part : parts_)
        draws.push_back(drawOf(part, options));
    return draws;
}

std::vector<Draw> Scene::depthDraws(const SceneOptions& options) {
    const auto hasHoles = [&](const Part& part) {
        return surfaces_[part.surface].data.alpha_mode == AlphaMode::mask;
    };
    std::vector<Draw> draws;
    if (floor_) draws.push_back({.mesh = *floor_});
    for (const Mesh& mesh : added_)
        draws.push_back({.mesh = mesh});
    if (!statue_) return draws;
    if (std::none_of(parts_.begin(), parts_.end(), hasHoles)) {
        draws.push_back({.mesh = *statue_});
        return draws;
    }
    for (const Part& part : parts_) {
        if (part.mesh != &*statue_) continue;
        if (hasHoles(part))
            draws.push_back(drawOf(part, options));
        else
            draws.push_back(
                {.mesh = *statue_, .first_index = part.first_index, .index_count = part.index_count});
    }
    return draws;
}

} // namespace gll::gbuffer
