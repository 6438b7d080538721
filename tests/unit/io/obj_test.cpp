// OBJ: geometry known by hand, in the many ways that the format may say it. Materials are in mtl_test.cpp.
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
        folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -2\n"));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0));
}

TEST(Obj, LinesMayEndInCrlfOrCrAndHaveCommentsBlanksAndUnknownKeywords) {
    const TemporaryFolder folder;
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char* line : {"# a comment", "", "  v 0 0 0 1.0", "v\t1 +0 0 0.5 0.5 0.5", "v 0 1e0 0  ",
                                 "o thing", "s off", "vp 0.1", "g a b", "g", "f 1 2  3 "})
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

TEST(Obj, NormalsMissingInASmoothingGroupAreSmoothAndDoNotDependOnTheDiagonals) {
    const TemporaryFolder folder;
    // The corner of a box with sides 3, 2, 1: three right angles, so the mean normal is (1,1,1)/sqrt(3),
    // however large the faces and whichever way they are cut.
    for (const char* faces : {"f 1 2 3 4\nf 1 4 5 6\nf 1 6 7 2\n", "f 2 3 4 1\nf 4 5 6 1\nf 6 7 2 1\n",
                              "f 1 2 3\nf 1 3 4\nf 1 4 6\nf 4 5 6\nf 1 6 7 2\n"}) {
        const MeshData mesh = loadMesh(folder.write(
            "a.obj",
            std::string("v 3 2 1\nv 0 2 1\nv 0 0 1\nv 3 0 1\nv 3 0 0\nv 3 2 0\nv 0 2 0\ns 1\n") + faces));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0F, 1e-6f);
            if (mesh.positions[i] == glm::vec3(3, 2, 1)) {
                EXPECT_NEAR(glm::distance(mesh.normals[i], glm::vec3(std::sqrt(1.0F / 3.0F))), 0.0F, 1e-6f);
            }
        }
        EXPECT_EQ(mesh.uvs, std::vector<glm::vec2>(7, glm::vec2(0.0F)));
    }
}

TEST(Obj, WithoutASmoothingGroupFacesAreFlat) {
    const TemporaryFolder folder;
    // Two faces that meet at a right angle along vertices 1 and 2.
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n";
    for (const char* off : {"", "s off\n", "s 0\n", "s 1\ns off\n"}) {
        const MeshData mesh = loadMesh(folder.write("a.obj", vertices + off + "f 1 2 3 4\nf 2 1 5 6\n"));
        ASSERT_EQ(mesh.positions.size(), 8u) << off;
        for (std::size_t i = 0; i < 8; ++i)
            EXPECT_EQ(mesh.normals[i], i < 4 ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0)) << off;
    }
}

TEST(Obj, NormalsAreSmoothWithinASmoothingGroupOnly) {
    const TemporaryFolder folder;
    // As above, and a third face that meets both at vertex 1, in a group of its own.
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n";
    const MeshData mesh =
        loadMesh(folder.write("a.obj", vertices + "s 3\nf 1 2 3 4\nf 2 1 5 6\ns 7\nf 1 4 7 5\n"));
    std::size_t at_corner = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i] != glm::vec3(0, 0, 0)) continue;
        ++at_corner;
        const glm::vec3 smooth = glm::normalize(glm::vec3(0, 1, 1));
        EXPECT_NEAR(std::min(glm::distance(mesh.normals[i], smooth),
                             glm::distance(mesh.normals[i], glm::vec3(1, 0, 0))),
                    0.0F, 1e-6F);
    }
    EXPECT_EQ(at_corner, 2u);
    const MeshData on = loadMesh(folder.write("b.obj", vertices + "s on\nf 1 2 3 4\nf 2 1 5 6\n"));
    EXPECT_EQ(on.positions.size(), 6u) << "'on' is a group too";
    const MeshData given = loadMesh(
        folder.write("c.obj", vertices + "vn 1 0 0\ns off\nf 1//1 2//1 3//1\ns 1\nf 1//1 3//1 4//1\n"));
    EXPECT_EQ(given.normals, std::vector<glm::vec3>(4, glm::vec3(1, 0, 0))) << "a normal in the file counts";
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
    const MeshData mesh = loadMesh(folder.write("a.obj", std::string(square) + "s 1\nf 1 2 3\nf 1 3 4\n"));
    EXPECT_EQ(mesh.positions.size(), 4u);
    const MeshData seam = loadMesh(
        folder.write("b.obj", std::string(square) + "s 1\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n"));
    EXPECT_EQ(seam.positions.size(), 5u);
    EXPECT_EQ(seam.normals, std::vector<glm::vec3>(5, glm::vec3(0, 0, 1)));
}

TEST(Obj, AByteOrderMarkIsNotPartOfTheFirstWord) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write("a.obj", "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_EQ(mesh.positions.size(), 3u);
    folder.write("a.mtl", "\xEF\xBB\xBFnewmtl a\nKd 1 0 0\n");
    std::vector<std::string> warnings;
    EXPECT_EQ(loadMtl(folder.path() / "a.mtl", warnings).at(0).base_color, glm::vec4(1, 0, 0, 1));
}

TEST(Obj, ALineThatEndsInABackslashGoesOnInTheNext) {
    const TemporaryFolder folder;
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const auto path = folder.write("a.obj", "# no continuation \\" + end + "v 0 0 0" + end + "v 1 \\" +
                                                    end + "0 0" + end + "v 0 1 0" + end + "f 1 \\" + end +
                                                    " 2\\" + end + " 3" + end + "v nan 0 0");
        expectError(path, {":9: ", "'nan'"}, [&] { loadMesh(path); });
        folder.write("a.obj", "v 0 0 0" + end + "v 1 \\" + end + "0 0" + end + "v 0 1 0" + end + "f 1 \\" +
                                  end + " 2\\" + end + " 3" + end);
        EXPECT_FLOAT_EQ(doubleArea(loadMesh(path)), 1.0F);
    }
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
    const TemporaryFolder folder;
    const MeshData mesh = loadMesh(folder.write(
        "a.obj", "f 1/1/1 2/2/1 3/3/1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"));
    EXPECT_FLOAT_EQ(doubleArea(mesh), 1.0F);
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}));
    EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Obj, TextureCoordinatesAndNormalsThatDoNotExistAreLeftOut) {
    const TemporaryFolder folder;
    for (const char* face : {"f 1/1 2/2 3/3\n", "f 1/1/ 2/2/ 3/3/\n", "f 1/-1 2/-2 3/-9\n", "f 1/0 2/0 3/0\n",
                             "f 1/99999999999999999999 2/4 3/5\n"}) {
        const MeshData mesh = loadMesh(folder.write("a.obj", square + ("s off\n" + std::string(face))));
        EXPECT_EQ(mesh.uvs, std::vector<glm::vec2>(3, glm::vec2(0.0F))) << face;
        EXPECT_FLOAT_EQ(doubleArea(mesh), 1.0F) << face;
        ASSERT_EQ(mesh.warnings.size(), 1u) << face;
        EXPECT_EQ(mesh.warnings[0],
                  (folder.path() / "a.obj").string() +
                      ":6: a texture coordinate that does not exist is left out (and 2 more like it)")
            << face;
    }
    const MeshData mesh = loadMesh(folder.write(
        "a.obj", square + std::string("vt 0.5 0.5\nvn 0 0 2\nf 1/1/1 2/1/9 3/2/1\nf 1/1/0 3//1 4/1/-5\n")));
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(mesh.normals.size(), glm::vec3(0, 0, 1)));
    EXPECT_EQ(std::count(mesh.uvs.begin(), mesh.uvs.end(), glm::vec2(0.5F)), 4);
    EXPECT_EQ(mesh.warnings.size(), 2u);
    EXPECT_TRUE(loadMesh(folder.write("b.obj", square + std::string("f 1/ 2// 3//\n"))).warnings.empty())
        << "an index that is not written is none";
}

TEST(Obj, VertexColorsAreReadAsSrgb) {
    const TemporaryFolder folder;
    const MeshData mesh =
        loadMesh(folder.write("a.obj", "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0.02 1 7e-1\nf 1 2 3\n"));
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_NEAR(glm::distance(mesh.colors[0], glm::vec4(1, 0.21404F, 0, 1)), 0.0F, 1e-4F);
    EXPECT_EQ(mesh.colors[1], glm::vec4(1.0F)) << "without one: white";
    EXPECT_NEAR(glm::distance(mesh.colors[2], glm::vec4(0.001548F, 1, 0.44799F, 1)), 0.0F, 1e-4F);
    const MeshData bytes = loadMesh(
        folder.write("b.obj", "v 0 0 0 255 0 0\nv 1 0 0 0 127.5 1e99999\nv 0 1 0 -3 nan 0\nf 1 2 3\n"));
    ASSERT_EQ(bytes.colors.size(), 3u);
    EXPECT_EQ(bytes.colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(bytes.warnings.size(), 1u) << "that they are not 0 to 1 is said";
    EXPECT_TRUE(loadMesh(folder.write("c.obj", std::string(square) + "f 1 2 3\n")).colors.empty());
    EXPECT_TRUE(
        loadMesh(folder.write("d.obj", "v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1 1 1\nf 1 2 3\n")).colors.empty())
        << "a weight is no color";
}

TEST(Obj, WhatIsNoTriangleIsNamedOnce) {
    const TemporaryFolder folder;
    const auto path =
        folder.write("a.obj", square + std::string("l 1 2\nl 2 3\np 1\nf 1 2\nf 1 2 3 # good\n"));
    const MeshData mesh = loadMesh(path);
    EXPECT_FLOAT_EQ(doubleArea(mesh), 1.0F);
    EXPECT_EQ(mesh.warnings, (std::vector<std::string>{
                                 path.string() + ":5: 'l' is not drawn (and 1 more like it)",
                                 path.string() + ":7: 'p' is not drawn",
                                 path.string() + ":8: a face of 2 corners is not drawn, 3 to 255 are"}));
}

TEST(Obj, AMeshOfTrianglesWithoutAreaIsSaidToShowNothing) {
    const TemporaryFolder folder;
    const std::string line = "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 0 1 0\n";
    const auto path = folder.write("a.obj", line + "f 1 2 3\nf 1 1 2\n");
    EXPECT_EQ(loadMesh(path).warnings,
              std::vector<std::string>{path.string() +
                                       ": none of its 2 triangles has an area, nothing of it is seen"});
    EXPECT_EQ(loadMesh(folder.write("a.obj", line + "f 1 2 3\nf 1 2 4\n")).warnings,
              std::vector<std::string>());
}

TEST(Obj, AMissingLibraryOrMaterialIsDrawnInPlainGrey) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "a.obj", square + std::string("mtllib gone.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"));
    MeshData mesh = loadMesh(path);
    ASSERT_EQ(mesh.warnings.size(), 1u) << "why a and b are missing has been said";
    EXPECT_TRUE(mesh.warnings[0].starts_with(path.string() + ":5: material library: 'gone.mtl' is missing"));
    ASSERT_EQ(mesh.materials.size(), 1u);
    EXPECT_EQ(mesh.materials[0].base_color, glm::vec4(0.8F, 0.8F, 0.8F, 1.0F));
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_EQ(mesh.parts[0].index_count, 6u);

    folder.write("a.obj", square + std::string("usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl a\nf 1 2 3\n"));
    mesh = loadMesh(path);
    EXPECT_EQ(mesh.warnings,
              (std::vector<std::string>{
                  path.string() + ":5: material 'a' is in no material library, drawn in plain grey",
                  path.string() + ":7: material 'b' is in no material library, drawn in plain grey"}));
    folder.write("late.mtl", "newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\nnewmtl c\n");
    mesh = loadMesh(folder.write(
        "b.obj", square + std::string("usemtl a\nf 1 2 3\nmtllib late.mtl\nusemtl c\nf 1 3 4\n")));
    ASSERT_EQ(mesh.parts.size(), 2u);
    EXPECT_EQ(mesh.materials[mesh.parts[0].material].base_color, glm::vec4(1, 0, 0, 1))
        << "the library may come later, and the first of a name counts";
    EXPECT_EQ(mesh.materials[mesh.parts[1].material].name, "c");
    EXPECT_TRUE(mesh.warnings.empty());
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

TEST(Obj, NamesMayHaveAHashAndACommentMayFollowThem) {
    const TemporaryFolder folder;
    folder.write("a #1.mtl", "newmtl a #1\n");
    folder.write("b.mtl", "newmtl b\n");
    const MeshData mesh =
        loadMesh(folder.write("a.obj", std::string("mtllib a #1.mtl\nmtllib b.mtl # a comment\n") + square +
                                           "usemtl a #1\nf 1 2 3\nusemtl b # another\nf 1 3 4\n"));
    EXPECT_EQ(mesh.warnings, std::vector<std::string>());
    ASSERT_EQ(mesh.parts.size(), 2u);
    EXPECT_EQ(mesh.materials[mesh.parts[0].material].name, "a #1");
    EXPECT_EQ(mesh.materials[mesh.parts[1].material].name, "b");
    const MeshData gone = loadMesh(folder.write(
        "b.obj", square + std::string("mtllib gone with blanks.mtl  b.mtl gone too.mtl\nf 1 2 3\n")));
    EXPECT_EQ(gone.warnings.size(), 2u) << "one a library";
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
