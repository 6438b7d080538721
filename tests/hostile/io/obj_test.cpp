// OBJ and MTL files that lie or break off: each must end in an error that names the file, the line and the
// trouble. The list grows: what once crashed a reader stays here.
#include "io/mesh.hpp"

#include "test_files.hpp"

#include <string_view>
#include <sys/stat.h>

using namespace gll;
using namespace gll::test;

namespace {

// Vertices, texture coordinates and normals on lines 1 to 3, three of each kind.
const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"; // 7 lines

void refusesObj(const TemporaryFolder& folder, const std::string& text,
                std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad.obj", text);
    expectError(path, parts, [&] { loadMesh(path); });
}

void refusesMtl(const TemporaryFolder& folder, const std::string& text,
                std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad.mtl", text);
    std::vector<std::string> warnings;
    expectError(path, parts, [&] { loadMtl(path, warnings); });
}

} // namespace

TEST(HostileObj, WhatIsNoFileIsNotOpened) {
    const TemporaryFolder folder;
    const auto missing = folder.path() / "missing.obj";
    expectError(missing, {"no such file"}, [&] { loadMesh(missing); });
    const auto directory = folder.path() / "folder.obj";
    std::filesystem::create_directory(directory);
    expectError(directory, {"is a folder"}, [&] { loadMesh(directory); });
    const auto fifo = folder.path() / "fifo.obj";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    expectError(fifo, {"not a regular file"}, [&] { loadMesh(fifo); });
    const auto other = folder.write("a.fbx", "Kaydara");
    expectError(other, {".obj, .gltf or .glb"}, [&] { loadMesh(other); });
}

TEST(HostileObj, AMeshWithoutVerticesOrFacesIsRefused) {
    const TemporaryFolder folder;
    refusesObj(folder, "", {"has no vertices"});
    refusesObj(folder, "# nothing\n", {"has no vertices"});
    refusesObj(folder, three, {"has no faces"});
    refusesObj(folder, three + "l 1 2\n", {"has no faces", "'l', which is not drawn"});
    refusesObj(folder, three + "f 1 2\nf\n", {"bad.obj:8: a face of 2 corners", "none of the faces (2)"});
    std::string many = "f";
    for (int i = 0; i < 256; ++i)
        many += " 1";
    refusesObj(folder, three + many, {"a face of 256 corners", "none of the faces (1)", "triangles"});
    refusesObj(folder, std::string("\x89PNG\0\0", 6), {"is binary"});
}

TEST(HostileObj, IndicesOutOfRangeNameTheirLine) {
    const TemporaryFolder folder;
    refusesObj(folder, three + "f 1 2 99\n", {":8: ", "vertex index '99'", "the 3"});
    refusesObj(folder, three + "f 1 2 3\nf -4 -5 -6\n", {":9: ", "'-4'"});
    refusesObj(folder, three + "f 0 1 2\n", {":8: ", "'0'"});
    refusesObj(folder, three + "f 1 2 99999999999999999999\n", {":8: ", "vertex index"});
    refusesObj(folder, three + "f 1 2 -9223372036854775808\n", {":8: ", "vertex index"});
    refusesObj(folder, "f 1 2 4\nf 1 2 3\n" + three, {":1: ", "vertex index '4'", "the 3"});
    refusesObj(folder, "f -1 -2 -3\n" + three, {":1: ", "vertex index '-1'"});
}

TEST(HostileObj, MalformedFacesNameTheirLine) {
    const TemporaryFolder folder;
    refusesObj(folder, three + "f 1 2 x\n", {":8: ", "'x'"});
    refusesObj(folder, three + "f 1 2 3.5\n", {":8: ", "'3.5'"});
    refusesObj(folder, three + "f 1 2 3x\n", {":8: ", "'3x'"});
    refusesObj(folder, three + "f 1/x 2/1 3/1\n", {":8: ", "'x'"});
    refusesObj(folder, three + "f /1 /2 /3\n", {":8: ", "'' is no index of a vertex"});
    refusesObj(folder, three + "f 1/1/1/1 2/2/1/1 3/3/1/1\n", {":8: ", "more than three indices"});
    refusesObj(folder, three + "f 1//// 2 3\n", {":8: ", "more than three indices"});
}

TEST(HostileObj, NumbersThatAreNoneNameTheirLine) {
    const TemporaryFolder folder;
    refusesObj(folder, "v 0 0 0\r\nv nan 0 0\r\n", {":2: ", "'nan'"});
    refusesObj(folder, "v 0 0 0\rv 0 -inf 0\r", {":2: ", "'-inf'"});
    refusesObj(folder, "v 1e39 0 0\n", {":1: ", "'1e39'"});
    refusesObj(folder, "v 3.4028236e38 0 0\n", {":1: "});
    refusesObj(folder, "v 1e999999999999 0 0\n", {":1: "});
    refusesObj(folder, "v 0e" + std::string(100, '9') + " 0 0\n", {":1: "});
    refusesObj(folder, "v " + std::string(100000, '1') + " 0 0\n", {":1: ", "'1111"});
    refusesObj(folder, "v 0 0\n", {":1: ", "missing"});
    refusesObj(folder, "v 0 0 0x10\n", {":1: ", "'0x10'"});
    refusesObj(folder, "v 0 0 +-1\n", {":1: ", "'+-1'"});
    refusesObj(folder, "vt\n", {":1: ", "missing"});
    refusesObj(folder, "vn 0 0\n", {":1: ", "missing"});
}

TEST(HostileObj, FilesOutsideTheFolderAreNotRead) {
    const TemporaryFolder folder;
    folder.write("secret.mtl", "newmtl a\n");
    folder.write("secret.png", "secret");
    const auto inside = [&](const std::string& text) {
        std::vector<std::string> warnings;
        const MaterialData material = loadMtl(folder.write("in/bad.mtl", text), warnings).at(0);
        EXPECT_TRUE(material.base_color_texture.empty()) << text;
        ASSERT_EQ(warnings.size(), 1u) << text;
        EXPECT_TRUE(warnings[0].starts_with((folder.path() / "in/bad.mtl:2: texture: ").string()))
            << warnings[0];
    };
    inside("newmtl a\nmap_Kd ../secret.png");
    inside("newmtl a\nmap_Kd ..\\secret.png");
    inside("newmtl a\nmap_Kd x/../../secret.png");
    inside("newmtl a\nmap_Kd /etc/passwd");
    inside("newmtl a\nmap_Kd C:/secret.png");
    inside("newmtl a\nmap_Kd file:///etc/passwd");
    inside("newmtl a\nmap_Kd ..");
    std::filesystem::create_symlink("../secret.png", folder.path() / "in/link.png");
    inside("newmtl a\nmap_Kd link.png");
    std::filesystem::create_directory(folder.path() / "in/folder.png");
    inside("newmtl a\nmap_Kd folder.png");
    inside("newmtl a\nmap_Kd " + std::string(100000, 'x') + "\n");
    const auto mesh =
        loadMesh(folder.write("in/bad.obj", "mtllib ../secret.mtl\n" + three + "usemtl a\nf 1 2 3\n"));
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_NE(mesh.warnings[0].find("bad.obj:1: material library: '../secret.mtl' leaves"), std::string::npos)
        << mesh.warnings[0];
    EXPECT_EQ(mesh.materials.at(0).name, "default");
}

TEST(HostileObj, ABrokenLibraryIsNamedWithTheLineThatNamesIt) {
    const TemporaryFolder folder;
    folder.write("empty.mtl", "# nothing\n");
    const MeshData mesh = loadMesh(folder.write("a.obj", "\nmtllib empty.mtl\n" + three + "f 1 2 3\n"));
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_NE(mesh.warnings[0].find("a.obj:2: "), std::string::npos) << mesh.warnings[0];
    EXPECT_NE(mesh.warnings[0].find("empty.mtl: has no material"), std::string::npos) << mesh.warnings[0];
    EXPECT_EQ(loadMesh(folder.write("b.obj", "mtllib\n" + three + "f 1 2 3\n")).warnings.size(), 1u);
}

TEST(HostileMtl, WithoutAMaterialIsRefused) {
    const TemporaryFolder folder;
    refusesMtl(folder, "", {"has no material"});
    refusesMtl(folder, "Kd 1 1 1\n", {"has no material"});
    refusesMtl(folder, std::string("newmtl a\0", 9), {"is binary"});
}
