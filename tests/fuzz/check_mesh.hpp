// What mesh.hpp promises of every mesh that a reader returns; the fuzz targets abort where it does not hold.
#pragma once

#include "io/mesh.hpp"

#include <cmath>
#include <cstdlib>

namespace gll::fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

inline void checkMesh(const MeshData& mesh) {
    const std::size_t vertices = mesh.positions.size();
    require(vertices > 0 && vertices <= max_mesh_vertices);
    require(mesh.normals.size() == vertices && mesh.uvs.size() == vertices);
    require(mesh.colors.empty() || mesh.colors.size() == vertices);
    for (const glm::vec4& color : mesh.colors)
        for (int k = 0; k < 4; ++k)
            require(color[k] >= 0.0F && color[k] <= 1.0F);
    require(mesh.second_uvs.empty() || mesh.second_uvs.size() == vertices);
    for (const glm::vec2& uv : mesh.second_uvs)
        require(std::isfinite(uv.x) && std::isfinite(uv.y));
    require(mesh.tangents.empty() || mesh.tangents.size() == vertices);
    require(!mesh.indices.empty() && mesh.indices.size() <= max_mesh_indices);
    for (const std::uint32_t index : mesh.indices)
        require(index < vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        for (int k = 0; k < 3; ++k)
            require(std::isfinite(mesh.positions[i][k]));
        for (int k = 0; k < 2; ++k)
            require(std::isfinite(mesh.uvs[i][k]));
        const glm::vec3 n = mesh.normals[i];
        require(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1.0F) < 1e-4f);
    }
    for (const glm::vec4& t : mesh.tangents)
        require(t == glm::vec4(0.0F) ||
                (std::abs(t.x * t.x + t.y * t.y + t.z * t.z - 1.0F) < 1e-4f && std::abs(t.w) == 1.0F));
    std::size_t covered = 0;
    for (const MeshPart& part : mesh.parts) {
        require(part.first_index == covered && part.index_count > 0 && part.index_count % 3 == 0);
        require(part.material < mesh.materials.size());
        covered += part.index_count;
    }
    require(covered == mesh.indices.size());
}

} // namespace gll::fuzz
