// glTF: materials, colours and textures known by hand, and what of them is said to be left out.
// Broken files are in tests/hostile.
#include "gltf_loading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

using namespace gll;
using namespace gll::test;
using Json = nlohmann::json;

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

TEST(Gltf, VertexColorsAreLinearInFloatsBytesOrShorts) {
    const TemporaryFolder folder;
    const auto colors = [&](const std::string& bytes, int component_type, const char* type) {
        GltfMaker maker;
        maker.attributes()["NORMAL"] =
            maker.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
        maker.attributes()["COLOR_0"] = maker.accessor(bytes, component_type, type, 3);
        maker.json["accessors"].back()["normalized"] = component_type != 5126;
        return load(folder, maker).colors;
    };
    const std::vector<glm::vec4> opaque = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.2F, 1}};
    EXPECT_EQ(colors(packed<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.2F}), 5126, "VEC3"), opaque);
    EXPECT_EQ(colors(packed<std::uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 13107}), 5123, "VEC3"), opaque);
    const std::vector<glm::vec4> clear = {{1, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 0.2F, 0.2F}};
    EXPECT_EQ(colors(packed<std::uint8_t>({255, 0, 0, 0, 0, 255, 0, 255, 0, 0, 51, 51}), 5121, "VEC4"),
              clear);
    EXPECT_TRUE(load(folder, GltfMaker()).colors.empty());
}

TEST(Gltf, PartsWithoutColorsAreWhite) {
    const TemporaryFolder folder;
    GltfMaker maker;
    const Json plain = maker.primitive();
    maker.attributes()["COLOR_0"] =
        maker.accessor(packed<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}), 5126, "VEC3", 3);
    maker.json["meshes"][0]["primitives"] = {plain, maker.primitive(), plain};
    const MeshData mesh = load(folder, maker);
    ASSERT_EQ(mesh.colors.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(mesh.colors[i], i / 3 == 1 ? glm::vec4(1, 0, 0, 1) : glm::vec4(1.0F)) << i;
}

TEST(Gltf, AlphaModesAndCutoffsAreRead) {
    const TemporaryFolder folder;
    GltfMaker maker;
    maker.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.1}}}}}};
    maker.primitive()["material"] = 0;
    EXPECT_EQ(load(folder, maker).materials[0].alpha_mode, AlphaMode::opaque);
    maker.json["materials"][0]["alphaMode"] = "MASK";
    EXPECT_EQ(load(folder, maker).materials[0].alpha_mode, AlphaMode::mask);
    EXPECT_EQ(load(folder, maker).materials[0].alpha_cutoff, 0.5F);
    maker.json["materials"][0]["alphaCutoff"] = 0.25;
    EXPECT_EQ(load(folder, maker).materials[0].alpha_cutoff, 0.25F);
    maker.json["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(load(folder, maker).materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_EQ(load(folder, maker).materials[0].base_color.a, 0.1F);
}

TEST(Gltf, SamplersSayHowImagesRepeatAndEnlarge) {
    const TemporaryFolder folder;
    GltfMaker maker;
    textured(maker);
    maker.json["samplers"][0] = {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}};
    const TextureData texture = load(folder, maker).materials[0].base_color_texture;
    EXPECT_EQ(texture.wrap_u, TextureWrap::clamp_to_edge);
    EXPECT_EQ(texture.wrap_v, TextureWrap::mirrored_repeat);
    EXPECT_TRUE(texture.nearest);
    maker.json["samplers"][0] = {{"wrapS", 10497}, {"magFilter", 9729}};
    const TextureData plain = load(folder, maker).materials[0].base_color_texture;
    EXPECT_EQ(plain.wrap_u, TextureWrap::repeat);
    EXPECT_EQ(plain.wrap_v, TextureWrap::repeat);
    EXPECT_FALSE(plain.nearest);
    maker.json["samplers"][0] = {{"wrapS", 10496}};
    EXPECT_EQ(onlyWarning(load(folder, maker)),
              "/samplers/0/wrapS: is none of glTF's wrap modes, drawn as repeat");
}

TEST(Gltf, TextureTransformsScaleThenTurnThenMove) {
    const TemporaryFolder folder;
    GltfMaker maker;
    Json& info = textured(maker);
    EXPECT_EQ(load(folder, maker).materials[0].base_color_texture.uv_transform, glm::mat3x2(1.0F));
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", std::acos(0.0)}, {"scale", {2, 4}}};
    const glm::mat3x2 transform = load(folder, maker).materials[0].base_color_texture.uv_transform;
    // a quarter turn counter-clockwise as seen, v running down: u goes up, v goes right
    const auto moved = [&](float u, float v) { return transform * glm::vec3(u, v, 1); };
    EXPECT_NEAR(glm::distance(moved(0, 0), glm::vec2(0.5F, 0.25F)), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::distance(moved(1, 0), glm::vec2(0.5F, 0.25F - 2)), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::distance(moved(0, 1), glm::vec2(0.5F + 4, 0.25F)), 0.0F, 1e-6F);
}

TEST(Gltf, TheSecondSetOfTextureCoordinatesIsReadWhereATextureUsesIt) {
    const TemporaryFolder folder;
    GltfMaker maker;
    Json& info = textured(maker);
    const std::vector<glm::vec2> second = {{0.5F, 0}, {0, 0.5F}, {1, 1}};
    maker.attributes()["TEXCOORD_1"] =
        maker.accessor(packed<float>({0.5F, 0, 0, 0.5F, 1, 1}), 5126, "VEC2", 3);
    EXPECT_TRUE(load(folder, maker).second_uvs.empty());
    info["texCoord"] = 1;
    EXPECT_EQ(load(folder, maker).second_uvs, second);
    EXPECT_EQ(load(folder, maker).materials[0].base_color_texture.uv_set, 1);
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
    EXPECT_EQ(load(folder, maker).materials[0].base_color_texture.uv_set, 0) << "a transform may override it";
    info["texCoord"] = 0;
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(load(folder, maker).second_uvs, second);
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
    const MeshData third = load(folder, maker);
    EXPECT_TRUE(third.materials[0].base_color_texture.empty());
    EXPECT_EQ(onlyWarning(third),
              "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/texCoord: "
              "texture coordinates beyond TEXCOORD_1 are not read, drawn without this texture");
}
