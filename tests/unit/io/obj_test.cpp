// OBJ and MTL: geometry known by hand, in the many ways that the format may say it.
// Broken files are in tests/hostile.
#include "io/mesh.hpp"

#include "test_files.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace gll;
using namespace gll::test;

namespace {

constexpr const char* square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Twice the signed area of all triangles seen from +z: tells lost, doubled and turned faces.
float doubleArea(const MeshData& mesh) {
    float area = 0.0F;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[i + 2]];
        area += glm::cross(b - a, c - a).z;
    }
    return area;
}

std::string image() { return "\x89PNG only named, read later"; }

} // namespace

TEST(Obj, ATriangleComesOutAsItIsWritten) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                                         "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 2\n"
                                                         "f 1/1/1 2/2/1 3/3/1\n"));
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}})) << "v = 0 is the image's top row";
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_EQ(mesh.parts[0].index_count, 3u);
    ASSERT_EQ(mesh.materials.size(), 1u) << "faces without a material have a default one";
    EXPECT_TRUE(mesh.tangents.empty());
}

TEST(Obj, RelativeIndicesCountBackFromTheLatestVertex) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(
        folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -2\n"));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0));
}

TEST(Obj, LinesMayEndInCrlfOrCrAndHaveCommentsBlanksAndUnknownKeywords) {
    const TemporaryFolder folder;
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char* line : {"# a comment", "", "  v 0 0 0 1.0", "v\t1 +0 0 0.5 0.5 0.5", "v 0 1e0 0  ",
                                 "o thing", "s off", "vp 0.1", "g a b", "f 1 2  3 "})
            text += line + end;
        const MeshData mesh = loadMesh(folder.write("a.obj", text));
        EXPECT_FLOAT_EQ(doubleArea(mesh), 1.0F);
    }
}

TEST(Obj, AQuadIsCutAlongItsShorterDiagonal) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write("a.obj", "v 0 0 0\nv 3 1 0\nv 0 2 0\nv -3 1 0\nf 1 2 3 4\n"));
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_FLOAT_EQ(doubleArea(mesh), 12.0F);
    std::set<std::uint32_t> ends; // both triangles touch the ends of the cut
    for (std::uint32_t vertex = 0; vertex < 4; ++vertex)
        if (std::count(mesh.indices.begin(), mesh.indices.end(), vertex) == 2) ends.insert(vertex);
    for (const std::uint32_t end : ends)
        EXPECT_EQ(mesh.positions[end].x, 0.0F);
}

TEST(Obj, ConcavePolygonsKeepTheirAreaWhereverTheyLieAndHoweverSmall) {
    const TemporaryFolder folder;
    // An L of area 3 with seven corners, one of them on a straight edge; an arrow head of area 1; and two
    // long arms of area 44.5, whose shortest cut would run past the notch at (0.5, 0.5).
    const std::vector<std::pair<std::vector<glm::vec2>, float>> shapes = {
        {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}}, 3.0F},
        {{{0, 0}, {1, 2}, {0, 1}, {-1, 2}}, 1.0F},
        {{{0, 0}, {2, 0}, {30, 0}, {30, 1}, {0.5F, 0.5F}, {1, 30}, {0, 30}, {0, 2}}, 44.5F}};
    for (const auto& [corners, area] : shapes) {
        for (const glm::vec2 offset : {glm::vec2(0, 0), glm::vec2(10, -7), glm::vec2(-3, 5)}) {
            for (const float scale : {1.0F, 1e-4f}) {
                std::string text;
                std::string face = "f";
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    const glm::vec2 p = (corners[i] + offset) * scale;
                    text.append("v ").append(std::to_string(p.x)).append(" ").append(std::to_string(p.y)) +=
                        " 0\n";
                    face.append(" ").append(std::to_string(i + 1));
                }
                const MeshData mesh = loadMesh(folder.write("a.obj", text + face + "\n"));
                EXPECT_EQ(mesh.indices.size(), (corners.size() - 2) * 3);
                EXPECT_NEAR(doubleArea(mesh) / (scale * scale), 2.0F * area, 0.02F);
                for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                    const glm::vec3 a = mesh.positions[mesh.indices[i]];
                    const glm::vec3 normal = glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                                        mesh.positions[mesh.indices[i + 2]] - a);
                    EXPECT_GE(normal.z, 0.0F) << "no triangle is turned over";
                }
            }
        }
    }
}

TEST(Obj, APolygonOf255CornersIsRead) {
    const TemporaryFolder folder;
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 255; ++i) {
        const double angle_rad = 2.0 * 3.14159265358979 * i / 255.0;
        text.append("v ").append(std::to_string(std::cos(angle_rad))).append(" ");
        text.append(std::to_string(std::sin(angle_rad))).append(" 0\n");
        face.append(" ").append(std::to_string(i + 1));
    }
    EXPECT_NEAR(doubleArea(loadMesh(folder.write("a.obj", text + face))), 2.0F * 3.1413F, 1e-3f);
}

TEST(Obj, MissingNormalsAreSmoothAndDoNotDependOnTheDiagonals) {
    const TemporaryFolder folder;
    // The corner of a box with sides 3, 2, 1: three right angles, so the mean normal is (1,1,1)/sqrt(3),
    // however large the faces and whichever way they are cut.
    for (const char* faces : {"f 1 2 3 4\nf 1 4 5 6\nf 1 6 7 2\n", "f 2 3 4 1\nf 4 5 6 1\nf 6 7 2 1\n",
                              "f 1 2 3\nf 1 3 4\nf 1 4 6\nf 4 5 6\nf 1 6 7 2\n"}) {
        const MeshData mesh = loadMesh(folder.write(
            "a.obj", std::string("v 3 2 1\nv 0 2 1\nv 0 0 1\nv 3 0 1\nv 3 0 0\nv 3 2 0\nv 0 2 0\n") + faces));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0F, 1e-6f);
            if (mesh.positions[i] == glm::vec3(3, 2, 1)) {
                EXPECT_NEAR(glm::distance(mesh.normals[i], glm::vec3(std::sqrt(1.0F / 3.0F))), 0.0F, 1e-6f);
            }
        }
        EXPECT_EQ(mesh.uvs, std::vector<glm::vec2>(7, glm::vec2(0.0F)));
    }
}

TEST(Obj, AZeroNormalInTheFileIsReplacedByTheFacesOwn) {
    const TemporaryFolder folder;
    const MeshData mesh =
        loadMesh(folder.write("a.obj", std::string(square) + "vn 0 0 0\nf 1//1 2//1 3//1\n"));
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
}

TEST(Obj, FacesWithoutAreaStillHaveUnitNormals) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write("a.obj", "v 1 1 1\nf 1 1 1\n"));
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_EQ(glm::length(normal), 1.0F);
}

TEST(Obj, CornersThatAgreeInAllIndicesShareAVertex) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write("a.obj", std::string(square) + "f 1 2 3\nf 1 3 4\n"));
    EXPECT_EQ(mesh.positions.size(), 4u);
    const MeshData seam = loadMesh(
        folder.write("b.obj", std::string(square) + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n"));
    EXPECT_EQ(seam.positions.size(), 5u);
    EXPECT_EQ(seam.normals, std::vector<glm::vec3>(5, glm::vec3(0, 0, 1)));
}

TEST(Obj, EachMaterialIsOnePart) {
    const TemporaryFolder folder;
    folder.write("one.mtl", "newmtl red\nKd 1 0 0\nnewmtl not used\n");
    folder.write("two.mtl", "newmtl deep blue\nKd 0 0 1\n");
    const MeshData mesh = loadMesh(folder.write(
        "a.obj", std::string("mtllib one.mtl two.mtl\n") + square +
                     "usemtl red\nf 1 2 3\nusemtl deep blue\nf 1 2 3\nf 1 3 4\nusemtl red\nf 1 3 4\n"));
    ASSERT_EQ(mesh.parts.size(), 2u);
    EXPECT_EQ(mesh.materials.at(mesh.parts[0].material).name, "red");
    EXPECT_EQ(mesh.materials.at(mesh.parts[1].material).name, "deep blue");
    EXPECT_EQ(mesh.parts[0].index_count, 6u);
    EXPECT_EQ(mesh.parts[1].first_index, 6u);
    EXPECT_EQ(mesh.parts[1].index_count, 6u);
}

TEST(Obj, ALibraryNameMayHaveBlanks) {
    const TemporaryFolder folder;
    folder.write("my own.mtl", "newmtl a\n");
    EXPECT_EQ(
        loadMesh(folder.write("a.obj", std::string("mtllib my own.mtl\n") + square + "usemtl a\nf 1 2 3\n"))
            .materials.at(0)
            .name,
        "a");
}

TEST(Mtl, NamesImagesChannelsAndFactors) {
    const TemporaryFolder folder;
    for (const char* name : {"colour.jpg", "maps/packed one.jpg", "normal.png", "other.png"})
        folder.write(name, image());
    const auto path =
        folder.write("a.mtl", "# made by hand\r\nnewmtl stone\r\nKd 0.5 0.25 1\r\nmap_Kd colour.jpg\r\n"
                              "map_Ka -imfchan r maps/packed one.jpg\r\n"
                              "map_Pr -imfchan g maps\\packed one.jpg\r\nPr 0.75\r\n"
                              "map_Pm -imfchan b maps/packed one.jpg\r\n"
                              "norm normal.png\r\nmap_Bump -bm 1.0 other.png\r\nillum 2\r\nNs 10\r\n");
    const std::vector<MaterialData> materials = loadMtl(path);
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
    EXPECT_EQ(stone.normal_texture.image.file.filename(), "normal.png") << "norm goes before map_Bump";
}

TEST(Mtl, WithoutMapsASurfaceIsRoughAndNoMetal) {
    const TemporaryFolder folder;
    const MaterialData plain = loadMtl(folder.write("a.mtl", "newmtl a\nKd 0.5\n")).at(0);
    EXPECT_EQ(plain.base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1.0F));
    EXPECT_EQ(plain.roughness, 1.0F);
    EXPECT_EQ(plain.metallic, 0.0F);
    EXPECT_TRUE(plain.base_color_texture.image.empty());
}

TEST(Mtl, MapBumpServesAsTheNormalMapWhereThereIsNoNorm) {
    const TemporaryFolder folder;
    folder.write("n.png", image());
    EXPECT_EQ(loadMtl(folder.write("a.mtl", "newmtl a\nmap_Bump n.png\n"))
                  .at(0)
                  .normal_texture.image.file.filename(),
              "n.png");
}
