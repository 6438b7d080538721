// What tests of the glTF reader share: loading what a GltfMaker has made, and what its triangle is to come
// out as.
#pragma once

#include "io/mesh.hpp"

#include "gltf_maker.hpp"
#include "test_files.hpp"

namespace gll::test {

inline const std::vector<glm::vec3> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

inline MeshData load(const TemporaryFolder& folder, const GltfMaker& maker) {
    return loadMesh(folder.write("a.gltf", maker.gltf()));
}

// A material on the triangle that reads an image: an image's texture is texture 0, with sampler 0.
inline nlohmann::json& textured(GltfMaker& maker) {
    maker.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    maker.json["samplers"] = {nlohmann::json::object()};
    maker.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    maker.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.primitive()["material"] = 0;
    return maker.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

// The one warning of a file, without its path.
inline std::string onlyWarning(const MeshData& mesh) {
    EXPECT_EQ(mesh.warnings.size(), 1u);
    if (mesh.warnings.empty()) return "";
    const std::size_t at = mesh.warnings.front().find("a.gltf: ");
    EXPECT_NE(at, std::string::npos) << mesh.warnings.front();
    return mesh.warnings.front().substr(at + 8);
}

} // namespace gll::test
