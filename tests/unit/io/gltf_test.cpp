// glTF: geometry known by hand, in the many ways that the format may store it. Materials, colours and
// textures are in gltf_material_test.cpp, broken files in tests/hostile.
#include "io/mesh.hpp"

#include "gltf_loading.hpp"
#include "test_files.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace gll;
using namespace gll::test;
using Json = nlohmann::json;

TEST(Gltf, ATriangleComesOutAsItIsWritten) {
    const TemporaryFolder folder;
    const MeshData mesh = load(folder, GltfMaker());
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1))) << "flat, from the face";
    EXPECT_EQ(mesh.uvs, std::vector<glm::vec2>(3, glm::vec2(0.0F)));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(mesh.tangents.empty());
    ASSERT_EQ(mesh.parts.size(), 1u);
    ASSERT_EQ(mesh.materials.size(), 1u);
    EXPECT_EQ(mesh.materials[0].metallic, 1.0F) << "glTF's default material is a metal";
}

TEST(Gltf, ABinaryFileAndAnExternalBufferHoldTheSameMesh) {
    const TemporaryFolder folder;
    GltfMaker maker;
    EXPECT_EQ(loadMesh(folder.write("a.glb", maker.glb())).positions, triangle);
    EXPECT_EQ(loadMesh(folder.write("named_wrongly.gltf", maker.glb())).positions, triangle);
    folder.write("the data.bin", maker.buffer + "and more than byteLength says");
    maker.json["buffers"] = {{{"byteLength", maker.buffer.size()}, {"uri", "the%20data.bin"}}};
    EXPECT_EQ(load(folder, maker).positions, triangle);
}

TEST(Gltf, IndicesMayHaveOneTwoOrFourBytes) {
    const TemporaryFolder folder;
    const auto indices = [&](const std::string& bytes, int component_type) {
        GltfMaker maker;
        maker.attributes()["NORMAL"] =
            maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
        maker.primitive()["indices"] = maker.accessor(bytes, component_type, "SCALAR", 6);
        return load(folder, maker).indices;
    };
    const std::vector<std::uint32_t> expected = {0, 1, 2, 2, 0, 1};
    EXPECT_EQ(indices(packed<std::uint8_t>({0, 1, 2, 2, 0, 1}), 5121), expected);
    EXPECT_EQ(indices(packed<std::uint16_t>({0, 1, 2, 2, 0, 1}), 5123), expected);
    EXPECT_EQ(indices(packed<std::uint32_t>({0, 1, 2, 2, 0, 1}), 5125), expected);
}

TEST(Gltf, StripsAndFansBecomeTrianglesOfOneWinding) {
    const TemporaryFolder folder;
    const auto made = [&](int mode, const std::vector<float>& corners) {
        GltfMaker maker;
        maker.attributes()["POSITION"] = maker.accessor(packed(corners), 5126, "VEC3", 4);
        maker.attributes()["NORMAL"] =
            maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 4);
        maker.primitive()["mode"] = mode;
        return load(folder, maker).indices;
    };
    EXPECT_EQ(made(5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(made(6, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
}

TEST(Gltf, PointsAndLinesAreSkippedBesideTriangles) {
    const TemporaryFolder folder;
    GltfMaker maker;
    for (int mode = 0; mode < 4; ++mode) {
        Json other = maker.primitive();
        other["mode"] = mode;
        maker.json["meshes"][0]["primitives"].push_back(other);
    }
    EXPECT_EQ(load(folder, maker).indices.size(), 3u);
}

TEST(Gltf, InterleavedViewsAreReadByTheirStride) {
    const TemporaryFolder folder;
    GltfMaker maker;
    // position, normal, uv of one vertex after the other: 32 bytes each
    const std::size_t view = maker.view(
        packed<float>({0, 0, 0, 0, 0, 1, 0, 1, /**/ 1, 0, 0, 0, 0, 1, 1, 1, /**/ 0, 1, 0, 0, 0, 1, 0, 0}));
    maker.json["bufferViews"][view]["byteStride"] = 32;
    const auto add = [&](const char* key, int offset, const char* type) {
        maker.json["accessors"].push_back({{"bufferView", view},
                                           {"byteOffset", offset},
                                           {"componentType", 5126},
                                           {"type", type},
                                           {"count", 3}});
        maker.attributes()[key] = maker.json["accessors"].size() - 1;
    };
    add("POSITION", 0, "VEC3");
    add("NORMAL", 12, "VEC3");
    add("TEXCOORD_0", 24, "VEC2");
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}))
        << "as glTF has them: v = 0 is the top";
}

TEST(Gltf, SparseAccessorsReplaceElementsOrStandAlone) {
    const TemporaryFolder folder;
    GltfMaker maker;
    const Json sparse = {
        {"count", 2},
        {"indices", {{"bufferView", maker.view(packed<std::uint16_t>({0, 2}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", maker.view(packed<float>({7, 8, 9, 4, 5, 6}))}}}};
    maker.json["accessors"][0]["sparse"] = sparse;
    EXPECT_EQ(load(folder, maker).positions, (std::vector<glm::vec3>{{7, 8, 9}, {1, 0, 0}, {4, 5, 6}}));
    maker.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(load(folder, maker).positions, (std::vector<glm::vec3>{{7, 8, 9}, {0, 0, 0}, {4, 5, 6}}));
}

TEST(Gltf, NormalisedIntegersSpanZeroToOne) {
    const TemporaryFolder folder;
    GltfMaker maker;
    const std::size_t bytes = maker.accessor(packed<std::uint8_t>({0, 255, 51, 0, 255, 0}), 5121, "VEC2", 3);
    maker.json["accessors"][bytes]["normalized"] = true;
    maker.attributes()["TEXCOORD_0"] = bytes;
    EXPECT_EQ(load(folder, maker).uvs, (std::vector<glm::vec2>{{0, 1}, {0.2F, 0}, {1, 0}}));
    const std::size_t shorts =
        maker.accessor(packed<std::uint16_t>({0, 65535, 13107, 0, 65535, 0}), 5123, "VEC2", 3);
    maker.json["accessors"][shorts]["normalized"] = true;
    maker.attributes()["TEXCOORD_0"] = shorts;
    EXPECT_EQ(load(folder, maker).uvs, (std::vector<glm::vec2>{{0, 1}, {0.2F, 0}, {1, 0}}));
}

TEST(Gltf, NodesMoveTurnAndScaleInThatOrderDownTheTree) {
    const TemporaryFolder folder;
    GltfMaker maker;
    const float half = std::sqrt(0.5F);
    maker.json["nodes"] = {
        {{"children", {1}}, {"translation", {10, 0, 0}}},
        {{"mesh", 0}, {"scale", {2, 3, 1}}, {"rotation", {0, 0, half, half}}}}; // 90 degrees about z
    const MeshData mesh = load(folder, maker);
    const std::vector<glm::vec3> expected = {{10, 0, 0}, {10, 2, 0}, {7, 0, 0}};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(glm::distance(mesh.positions[i], expected[i]), 0.0F, 1e-5f);

    maker.json["nodes"] = {{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}};
    EXPECT_EQ(load(folder, maker).positions[0], glm::vec3(5, 6, 7));
}

TEST(Gltf, NormalsTurnByTheInverseTranspose) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.attributes()["NORMAL"] =
        maker.accessor(packed<float>({1, 1, 0, 1, 1, 0, 1, 1, 0}), 5126, "VEC3", 3);
    maker.json["nodes"][0]["scale"] = {2, 1, 1};
    const glm::vec3 expected = glm::normalize(glm::vec3(0.5F, 1.0F, 0.0F));
    for (const glm::vec3& normal : load(folder, maker).normals)
        EXPECT_NEAR(glm::distance(normal, expected), 0.0F, 1e-6f);
}

TEST(Gltf, AMirroredNodeKeepsItsFrontsInFront) {
    const TemporaryFolder folder;
    for (const bool file_has_normals : {true, false}) {
        GltfMaker maker;
        if (file_has_normals) {
            maker.attributes()["NORMAL"] =
                maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
            maker.attributes()["TANGENT"] =
                maker.accessor(packed<float>({2, 0, 0, 1, 2, 0, 0, 1, 2, 0, 0, 1}), 5126, "VEC4", 3);
        }
        maker.json["nodes"][0]["scale"] = {-1, 1, 1};
        const MeshData mesh = load(folder, maker);
        const glm::vec3 a = mesh.positions[mesh.indices[0]];
        const glm::vec3 face =
            glm::cross(mesh.positions[mesh.indices[1]] - a, mesh.positions[mesh.indices[2]] - a);
        EXPECT_EQ(face, glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
        EXPECT_TRUE(!file_has_normals || mesh.tangents.at(0) == glm::vec4(-1, 0, 0, -1));
    }
}

TEST(Gltf, AFlattenedNodeHasFiniteUnitNormals) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.attributes()["NORMAL"] =
        maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
    for (const Json& scale : {Json{1, 1, 0}, Json{0, 0, 0}, Json{1e-20, 1e-20, 1e-20}}) {
        maker.json["nodes"][0]["scale"] = scale;
        for (const glm::vec3& normal : load(folder, maker).normals)
            EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
}

TEST(Gltf, TangentsAreZeroForPartsThatHaveNone) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["meshes"][0]["primitives"].push_back(maker.primitive());
    maker.attributes()["NORMAL"] =
        maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
    maker.attributes()["TANGENT"] =
        maker.accessor(packed<float>({2, 0, 0, -1, 2, 0, 0, -1, 2, 0, 0, -1}), 5126, "VEC4", 3);
    const MeshData mesh = load(folder, maker);
    ASSERT_EQ(mesh.tangents.size(), 6u);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(mesh.tangents[5], glm::vec4(0.0F));
}

TEST(Gltf, TheDefaultSceneIsReadElseTheFirstElseAllRoots) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}, {{"mesh", 0}}};
    maker.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 2}}}};
    maker.json["scene"] = 1;
    EXPECT_EQ(load(folder, maker).indices.size(), 6u);
    maker.json.erase("scene");
    EXPECT_EQ(load(folder, maker).indices.size(), 3u);
    maker.json.erase("scenes");
    EXPECT_EQ(load(folder, maker).indices.size(), 9u);
}

TEST(Gltf, UnknownExtensionsAndExtrasThatAreNotRequiredAreSkipped) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["extensionsUsed"] = {"KHR_lights_punctual"};
    maker.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array()}}}};
    maker.json["nodes"][0]["extras"] = {{"note", {1, 2, {{"deep", true}}}}};
    maker.json["animations"] = "broken, but nobody reads it";
    EXPECT_EQ(load(folder, maker).positions, triangle);
}

TEST(Gltf, QuantisedAttributesAreReadWhereTheFileRequiresThem) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.attributes()["POSITION"] =
        maker.accessor(packed<std::int16_t>({0, 0, 0, 0, 100, 0, 0, 0, 0, -100, 0, 0}), 5122, "VEC3", 3);
    maker.json["bufferViews"].back()["byteStride"] = 8;
    maker.attributes()["NORMAL"] =
        maker.accessor(packed<std::int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}), 5120, "VEC3", 3);
    maker.json["accessors"].back()["normalized"] = true;
    maker.json["bufferViews"].back()["byteStride"] = 4;
    maker.attributes()["TEXCOORD_0"] =
        maker.accessor(packed<std::uint16_t>({0, 2, 3, 0, 0, 0}), 5123, "VEC2", 3);
    maker.json["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
    maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {50, 0, 0}, {0, -50, 0}}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs[1], glm::vec2(3, 0)) << "whole numbers that are not normalised stand for themselves";
}

// --- what exporters do ---

TEST(Gltf, RoundingOutOfRangeIsNoError) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["nodes"][0]["rotation"] = {0, 0, 0, 1.0000001192092896};
    maker.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {1.000001, -1e-6, 0, 1}}, {"roughnessFactor", 1.000009}}},
         {"emissiveFactor", {1.0000001, 0, 0}}}};
    maker.primitive()["material"] = 0;
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(mesh.materials[0].base_color, glm::vec4(1, 0, 0, 1)) << "moved into the range";
    EXPECT_EQ(mesh.materials[0].roughness, 1.0F);
}

TEST(Gltf, APrimitiveWithoutPositionsIsSkipped) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(onlyWarning(mesh), "/meshes/0/primitives/1/attributes: has no POSITION, not drawn");
}

TEST(Gltf, WhatTheSceneDoesNotUseMayBeBroken) {
    const TemporaryFolder folder;
    GltfMaker maker;
    textured(maker);
    maker.json["images"].push_back({{"uri", "missing.png"}});
    maker.json["textures"].push_back({{"source", 1}});
    maker.json["materials"].push_back({{"emissiveTexture", {{"index", 1}}}});
    maker.json["accessors"].push_back({{"bufferView", 99}});
    maker.json["meshes"].push_back({{"primitives", 7}});
    maker.json["cameras"] = {{{"type", "broken"}}};
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(mesh.materials.size(), 1u);
    EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Gltf, ANodeOfTheSceneThatIsNoRootIsDrawnOnce) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["nodes"] = {{{"children", {1}}, {"translation", {5, 0, 0}}}, {{"mesh", 0}}};
    maker.json["scenes"][0]["nodes"] = {0, 1};
    const MeshData both = load(folder, maker);
    ASSERT_EQ(both.positions.size(), 3u);
    EXPECT_EQ(both.positions[0], glm::vec3(5, 0, 0)) << "below its parent";
    EXPECT_EQ(onlyWarning(both),
              "/scenes/0/nodes/1: is not a root node, as glTF wants it; drawn once, move it to the root");
    maker.json["scenes"][0]["nodes"] = {1};
    EXPECT_EQ(load(folder, maker).positions, triangle) << "its parent is not in the scene";
}

TEST(Gltf, ASkinnedNodesOwnTransformIsIgnored) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"scale", {1, 0.2, 1}}}, Json::object()};
    maker.json["skins"] = {{{"joints", {1}}}};
    const MeshData mesh = load(folder, maker);
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(onlyWarning(mesh),
              "/nodes/0/skin: skins are not read, the mesh is drawn where it was modelled");
}

TEST(Gltf, ModelsFaceTowardsPositiveZ) {
    const TemporaryFolder folder;
    EXPECT_TRUE(load(folder, GltfMaker()).front_is_positive_z);
}

TEST(Gltf, OlderMinimumVersionsAreRead) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.0"}};
    EXPECT_EQ(load(folder, maker).positions, triangle);
}

// --- what is left out is said ---

TEST(Gltf, WhatIsNotReadIsNamedOnce) {
    const TemporaryFolder folder;
    const auto warning = [&](const std::string& pointer, const Json& value) {
        GltfMaker maker;
        maker.json["materials"] = {Json::object()};
        maker.primitive()["material"] = 0;
        maker.json[Json::json_pointer(pointer)] = value;
        return onlyWarning(load(folder, maker));
    };
    EXPECT_EQ(warning("/materials/0/extensions", {{"KHR_materials_unlit", Json::object()}}),
              "/materials/0/extensions/KHR_materials_unlit: unlit materials are lit like the others");
    EXPECT_EQ(warning("/materials/0/extensions", {{"KHR_materials_clearcoat", Json::object()}}),
              "/materials/0/extensions: extension 'KHR_materials_clearcoat' is not read, drawn without");
    EXPECT_EQ(warning("/extensionsUsed", {"EXT_mesh_gpu_instancing", "KHR_texture_basisu"}),
              "/extensionsUsed/0: extension 'EXT_mesh_gpu_instancing' is not read, drawn without");
    EXPECT_EQ(warning("/nodes/0/extensions", {{"KHR_lights_punctual", {{"light", 0}}}}),
              "/nodes/0/extensions: extension 'KHR_lights_punctual' is not read, drawn without");
    EXPECT_EQ(warning("/animations", {Json::object()}),
              "/animations: animations are not read, nodes stand as they are");
    EXPECT_EQ(warning("/materials/0/alphaMode", "HASHED"),
              "/materials/0/alphaMode: is none of glTF's alpha modes, drawn opaque");
    EXPECT_EQ(warning("/meshes/0/primitives/1", {{"mode", 1}, {"attributes", {{"POSITION", 0}}}}),
              "/meshes/0/primitives/1/mode: says points or lines, which are not drawn");

    GltfMaker morphed;
    morphed.primitive()["targets"] = {{{"POSITION", 0}}};
    EXPECT_TRUE(load(folder, morphed).warnings.empty()) << "weights are 0 where none are given";
    morphed.json["meshes"][0]["weights"] = {1.0};
    morphed.json["meshes"][0]["primitives"].push_back(morphed.primitive());
    EXPECT_EQ(onlyWarning(load(folder, morphed)),
              "/meshes/0/primitives/0/targets: morph targets are not read, drawn without");
    morphed.json["nodes"][0]["weights"] = {0.0};
    EXPECT_TRUE(load(folder, morphed).warnings.empty()) << "a node's weights are nearer";
}
