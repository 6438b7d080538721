// Picks the mesh reader by extension, and holds what the readers share.
// No third-party reader here: obj.cpp and gltf.cpp wrap theirs.
#include "io/mesh.hpp"

#include "io/files.hpp"
#include "io/mesh_build.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gll {

namespace {

// A mesh of which nothing can be seen is drawn, and would leave one looking for it.
MeshData withWordIfFlat(MeshData mesh, const std::string& name) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]];
        const glm::dvec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::dvec3 c = mesh.positions[mesh.indices[i + 2]];
        if (glm::cross(b - a, c - a) != glm::dvec3(0.0)) return mesh;
    }
    mesh.warnings.push_back(name + ": none of its " + std::to_string(mesh.indices.size() / 3) +
                            " triangles has an area, nothing of it is seen");
    return mesh;
}

} // namespace

MeshData loadMesh(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    try {
        if (extension == ".obj") return withWordIfFlat(loadObj(path), path.string());
        if (extension == ".gltf" || extension == ".glb") return withWordIfFlat(loadGltf(path), path.string());
    } catch (const std::bad_alloc&) {
        throw fileError(path.string(), "needs more memory than there is, simplify the mesh");
    }
    throw fileError(path.string(), "ends in '" + extension + "', name a .obj, .gltf or .glb file");
}

void setParts(MeshData& mesh, const std::vector<std::vector<std::uint32_t>>& indices_by_material) {
    for (std::size_t material = 0; material < indices_by_material.size(); ++material) {
        const auto& indices = indices_by_material[material];
        if (indices.empty()) continue;
        mesh.parts.push_back({.first_index = static_cast<std::uint32_t>(mesh.indices.size()),
                              .index_count = static_cast<std::uint32_t>(indices.size()),
                              .material = static_cast<std::uint32_t>(material)});
        mesh.indices.insert(mesh.indices.end(), indices.begin(), indices.end());
    }
}

glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback) {
    // Scaled first, so that neither tiny nor huge vectors lose their direction.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(v.x + v.y + v.z) || !std::isfinite(largest)) return fallback;
    return glm::vec3(glm::normalize(v / largest));
}

std::vector<glm::vec3> angleWeightedNormals(const std::vector<glm::vec3>& positions,
                                            const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F));
    for (const auto& triangle : triangles) {
        const std::array<glm::dvec3, 3> corners = {positions[triangle[0]], positions[triangle[1]],
                                                   positions[triangle[2]]};
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 to_next = corners[(i + 1) % 3] - corners[i];
            const glm::dvec3 to_last = corners[(i + 2) % 3] - corners[i];
            const double angle_rad = std::atan2(length, glm::dot(to_next, to_last));
            normals[triangle[i]] += glm::vec3(normal / length * angle_rad);
        }
    }
    return normals;
}

} // namespace gll
