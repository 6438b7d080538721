// MTL: materials known by hand, in the many ways that the format may say them.
// Broken files are in tests/hostile.
#include "io/mesh.hpp"

#include "test_files.hpp"

#include <utility>

using namespace gll;
using namespace gll::test;

namespace {

std::string image() { return "\x89PNG only named, read later"; }

// The only material of an MTL, whose statements begin at line 2. Where no warnings are asked for, there are
// none.
MaterialData only(const TemporaryFolder& folder, const std::string& statements,
                  std::vector<std::string>* warnings = nullptr) {
    std::vector<std::string> unexpected;
    const auto path = folder.write("a.mtl", "newmtl a\n" + statements);
    const MaterialData material = loadMtl(path, warnings == nullptr ? unexpected : *warnings).at(0);
    EXPECT_EQ(unexpected, std::vector<std::string>());
    return material;
}

} // namespace

TEST(Mtl, NamesImagesChannelsAndFactors) {
    const TemporaryFolder folder;
    for (const char* name : {"colour.jpg", "maps/packed one.jpg", "normal.png", "other.png"})
        folder.write(name, image());
    const auto path =
        folder.write("a.mtl", "# made by hand\r\nnewmtl stone\r\nKd 0.5 0.25 1\r\nmap_Kd colour.jpg\r\n"
                              "map_ao -imfchan r maps/packed one.jpg\r\n"
                              "map_Pr -imfchan g maps\\packed one.jpg\r\nPr 0.75\r\n"
                              "map_Pm -imfchan b maps/packed one.jpg\r\n"
                              "norm normal.png\r\nmap_Bump -bm 1.0 other.png\r\nillum 2\r\nNs 10\r\n");
    std::vector<std::string> warnings;
    const std::vector<MaterialData> materials = loadMtl(path, warnings);
    EXPECT_TRUE(warnings.empty());
    ASSERT_EQ(materials.size(), 1u);
    const MaterialData& stone = materials[0];
    EXPECT_EQ(stone.name, "stone");
    EXPECT_EQ(stone.base_color, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
    EXPECT_EQ(stone.base_color_texture.image.file.filename(), "colour.jpg");
    EXPECT_EQ(stone.occlusion_texture.channel, 0);
    EXPECT_EQ(stone.roughness_texture.channel, 1);
    EXPECT_EQ(stone.roughness, 0.75F);
    EXPECT_EQ(stone.metallic_texture.channel, 2);
    EXPECT_EQ(stone.metallic, 1.0F) << "a map without a factor counts in full";
    EXPECT_EQ(stone.occlusion_texture.image, stone.roughness_texture.image) << "one file, one upload";
    EXPECT_EQ(stone.occlusion_texture.image.file.filename(), "packed one.jpg");
    EXPECT_EQ(stone.normal_texture.image.file.filename(), "normal.png");
    EXPECT_EQ(stone.height_texture.image.file.filename(), "other.png") << "map_Bump holds heights";
}

TEST(Mtl, WithoutMapsASurfaceIsRoughAndNoMetal) {
    const TemporaryFolder folder;
    const MaterialData plain = only(folder, "Kd 0.5\n");
    EXPECT_EQ(plain.base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1.0F));
    EXPECT_EQ(plain.roughness, 1.0F);
    EXPECT_EQ(plain.metallic, 0.0F);
    EXPECT_TRUE(plain.base_color_texture.image.empty());
    EXPECT_EQ(plain.base_color_texture, TextureData()) << "repeated, as it is";
    EXPECT_EQ(only(folder, "illum 2\n").base_color, glm::vec4(0.8F, 0.8F, 0.8F, 1.0F)) << "plain grey";
}

TEST(Mtl, BumpIsAHeightWithAScale) {
    const TemporaryFolder folder;
    folder.write("h.png", image());
    for (const char* keyword : {"map_Bump", "map_bump", "bump"}) {
        const MaterialData material = only(folder, keyword + std::string(" -bm 0.25 h.png\n"));
        EXPECT_TRUE(material.normal_texture.empty());
        EXPECT_EQ(material.height_texture.image.file.filename(), "h.png");
        EXPECT_EQ(material.height_scale, 0.25F);
    }
    EXPECT_EQ(only(folder, "bump h.png\n").height_scale, 1.0F);
    for (const char* keyword : {"norm", "map_Kn", "map_kn"}) {
        const MaterialData material = only(folder, keyword + std::string(" h.png\n"));
        EXPECT_EQ(material.normal_texture.image.file.filename(), "h.png");
        EXPECT_TRUE(material.height_texture.empty());
    }
}

TEST(Mtl, AmbientColorIsNoOcclusion) {
    const TemporaryFolder folder;
    folder.write("a.png", image());
    folder.write("b.png", image());
    std::vector<std::string> warnings;
    EXPECT_TRUE(only(folder, "map_Ka a.png\nmap_Kd a.png\n", &warnings).occlusion_texture.empty());
    EXPECT_TRUE(warnings.empty()) << "the color once more, as exporters write it";
    EXPECT_TRUE(only(folder, "map_Ka b.png\nmap_Kd a.png\n", &warnings).occlusion_texture.empty());
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(":2: 'map_Ka' is not drawn"), std::string::npos) << warnings[0];
    EXPECT_EQ(only(folder, "map_ao a.png\n").occlusion_texture.image.file.filename(), "a.png");
    EXPECT_EQ(only(folder, "map_AO a.png\n").occlusion_texture.image.file.filename(), "a.png");
}

TEST(Mtl, TexturesAreScaledMovedAndClamped) {
    const TemporaryFolder folder;
    folder.write("2.png", image());
    const auto texture = [&](const std::string& options) {
        return only(folder, "map_Kd " + options + " 2.png\n").base_color_texture;
    };
    // The place (0.25, 0.75 up) of the mesh, v running down, and where that is in the image.
    const auto at = [&](const std::string& options) {
        return texture(options).uv_transform * glm::vec3(0.25F, 0.25F, 1.0F);
    };
    EXPECT_EQ(at(""), glm::vec2(0.25F, 0.25F));
    EXPECT_EQ(at("-s 2 4"), glm::vec2(0.5F, 1.0F - 3.0F));
    EXPECT_EQ(at("-s 2 4 1 -o 0.5 0.25 0"), glm::vec2(1.0F, 1.0F - 3.25F));
    EXPECT_EQ(at("-o 0.5"), glm::vec2(0.75F, 0.25F)) << "numbers at the end may be left out";
    EXPECT_EQ(texture("").wrap_u, TextureWrap::repeat);
    EXPECT_EQ(texture("-clamp off").wrap_v, TextureWrap::repeat);
    EXPECT_EQ(texture("-clamp on").wrap_u, TextureWrap::clamp_to_edge);
    EXPECT_EQ(texture("-clamp on").wrap_v, TextureWrap::clamp_to_edge);
    EXPECT_EQ(texture("-blendu on -mm 0 1 -t 0 0 0 -texres 512 -type sphere -boost 2").image.file.filename(),
              "2.png");
}

TEST(Mtl, OpacityIsAMaskWhereItIsTheColorsAlpha) {
    const TemporaryFolder folder;
    folder.write("a.png", image());
    folder.write("b.png", image());
    std::vector<std::string> warnings;
    EXPECT_EQ(only(folder, "map_d a.png\nmap_Kd a.png\nd 1\nTr 0\n", &warnings).alpha_mode, AlphaMode::mask);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(only(folder, "map_Kd a.png\nmap_d b.png\nd 0.5\nTr 0.5\n", &warnings).alpha_mode,
              AlphaMode::opaque);
    EXPECT_EQ(warnings.size(), 2u) << "another image, and (twice) half there";
}

TEST(Mtl, WhatCannotBeReadIsSaidAndTheRestDrawn) {
    const TemporaryFolder folder;
    folder.write("there.png", image());
    const std::vector<std::pair<std::string, std::string>> lines = {
        {"Kd 1 1", "a number is missing"},
        {"Kd nan 1 1", "'nan'"},
        {"Kd -1 1 1", "negative"},
        {"Kd spectral file.rfl", "'spectral'"},
        {"Pr 2", "0 to 1"},
        {"map_Kd gone.png", "texture: 'gone.png' is missing"},
        {"map_Kd", "file name is missing"},
        {"map_Kd -imfchan r", "file name is missing"},
        {"map_Pr -imfchan z there.png", "-imfchan"},
        {"map_Pr -magic 3 there.png", "'-magic' is unknown"},
        {"map_Ks there.png", "'map_Ks' is not drawn"},
        {"disp there.png", "'disp' is not drawn"},
        {"map_Kd C:\\textures\\there.png", "is taken from the file's own folder"},
        {"map_Kd ../../textures/there.png", "is taken from the file's own folder"},
    };
    for (const auto& [line, message] : lines) {
        std::vector<std::string> warnings;
        const MaterialData material = only(folder, line + "\nKe 0.5\n", &warnings);
        ASSERT_EQ(warnings.size(), 1u) << line;
        EXPECT_TRUE(warnings[0].starts_with((folder.path() / "a.mtl").string() + ":2: ")) << warnings[0];
        EXPECT_NE(warnings[0].find(message), std::string::npos) << warnings[0];
        EXPECT_EQ(material.emitted_color, glm::vec3(0.5F)) << line;
        EXPECT_EQ(material.base_color,
                  glm::vec4(glm::vec3(material.base_color_texture.empty() ? 0.8F : 1.0F), 1.0F))
            << line;
    }
}
