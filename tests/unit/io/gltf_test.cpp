// glTF: geometry known by hand, in the many ways that the format may store it.
// Broken files are in tests/hostile.
#include "io/mesh.hpp"

#include "gltf_maker.hpp"
#include "test_files.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace gll;
using namespace gll::test;
using Json = nlohmann::json;

namespace {

const std::vector<glm::vec3> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

MeshData load(const TemporaryFolder& folder, const GltfMaker& maker) {
    return loadMesh(folder.write("a.gltf", maker.gltf()));
}

} // namespace

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

TEST(Gltf, MaterialsNameImagesChannelsAndFactors) {
    const TemporaryFolder folder;
    folder.write("maps/colour 1.png", "read later");
    GltfMaker maker;
    const std::size_t view = maker.view("encoded bytes");
    maker.json["images"] = {{{"uri", "maps/colour%201.png"}},
                            {{"bufferView", view}, {"mimeType", "image/png"}},
                            {{"uri", "data:image/jpeg;base64," + base64("others")}}};
    maker.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    maker.json["materials"] = {
        {{"name", "cat"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 0.5, 0.25, 1}},
           {"baseColorTexture", {{"index", 0}}},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.25},
           {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"occlusionTexture", {{"index", 1}, {"strength", 0.75}}},
         {"normalTexture", {{"index", 2}, {"scale", 2.0}}},
         {"emissiveFactor", {0, 1, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5.0}}}}},
         {"doubleSided", true}}};
    maker.primitive()["material"] = 0;
    const MeshData mesh = load(folder, maker);
    ASSERT_EQ(mesh.materials.size(), 1u);
    const MaterialData& cat = mesh.materials[0];
    EXPECT_EQ(cat.name, "cat");
    EXPECT_EQ(cat.base_color, glm::vec4(1, 0.5F, 0.25F, 1));
    EXPECT_EQ(cat.base_color_texture.image.file.filename(), "colour 1.png");
    EXPECT_EQ(*cat.metallic_texture.image.encoded, "encoded bytes");
    EXPECT_EQ(cat.metallic_texture.channel, 2);
    EXPECT_EQ(cat.metallic, 0.5F);
    EXPECT_EQ(cat.roughness_texture.channel, 1);
    EXPECT_EQ(cat.roughness, 0.25F);
    EXPECT_EQ(cat.occlusion_texture.channel, 0);
    EXPECT_EQ(cat.occlusion_strength, 0.75F);
    EXPECT_EQ(cat.occlusion_texture.image, cat.metallic_texture.image) << "one image, one upload";
    EXPECT_EQ(*cat.normal_texture.image.encoded, "others");
    EXPECT_EQ(cat.normal_scale, 2.0F);
    EXPECT_EQ(cat.emitted_color, glm::vec3(0, 5, 0));
    EXPECT_TRUE(cat.double_sided);
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
