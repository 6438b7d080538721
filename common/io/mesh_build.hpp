// What the OBJ and the glTF reader share: collecting triangles by material, and normals where a file has
// none. Private to common/io.
#pragma once

#include "io/mesh.hpp"

#include <array>

namespace gll {

// One loader a format; loadMesh picks.
MeshData loadObj(const std::filesystem::path& path);
MeshData loadGltf(const std::filesystem::path& path);

class Notes; // statements.hpp
std::vector<MaterialData> readMtl(const std::filesystem::path& path, Notes& notes);

// Concatenates triangle indices kept by material into mesh.indices and mesh.parts.
void setParts(MeshData& mesh, const std::vector<std::vector<std::uint32_t>>& indices_by_material);

// The sum over triangles of their unit normal times their angle at the corner (Thurmer and Wuthrich 1998),
// one a position and not normalised: unlike plain averages it does not depend on how polygons were cut into
// triangles.
std::vector<glm::vec3> angleWeightedNormals(const std::vector<glm::vec3>& positions,
                                            const std::vector<std::array<std::uint32_t, 3>>& triangles);

// v / |v|, or the fallback where that is not finite (zero or overflowing length).
glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback);

} // namespace gll
