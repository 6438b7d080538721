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

void refuses(const TemporaryFolder& folder, const std::string& text,
             std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad.obj", text);
    expectError(path, parts, [&] { loadMesh(path); });
}

void refusesMtl(const TemporaryFolder& folder, const std::string& text,
                std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad.mtl", text);
    expectError(path, parts, [&] { loadMtl(path); });
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
    refuses(folder, "", {"has no vertices"});
    refuses(folder, "# nothing\n", {"has no vertices"});
    refuses(folder, three, {"has no faces"});
    refuses(folder, three + "l 1 2\np 1\n", {"has no faces"});
    refuses(folder, std::string("\x89PNG\0\0", 6), {"is binary"});
}

TEST(HostileObj, IndicesOutOfRangeNameTheirLine) {
    const TemporaryFolder folder;
    refuses(folder, three + "f 1 2 99\n", {":8: ", "vertex index '99'", "3 so far"});
    refuses(folder, three + "f 1 2 3\nf -4 -5 -6\n", {":9: ", "'-4'"});
    refuses(folder, three + "f 0 1 2\n", {":8: ", "'0'"});
    refuses(folder, three + "f 1/1 2/2 3/4\n", {":8: ", "texture index '4'"});
    refuses(folder, three + "f 1//1 2//1 3//2\n", {":8: ", "normal index '2'"});
    refuses(folder, three + "f 1 2 99999999999999999999\n", {":8: ", "vertex index"});
    refuses(folder, three + "f 1 2 -9223372036854775808\n", {":8: ", "vertex index"});
    refuses(folder, "f 1 2 3\n" + three, {":1: ", "0 so far"});
}

TEST(HostileObj, MalformedFacesNameTheirLine) {
    const TemporaryFolder folder;
    refuses(folder, three + "f\n", {":8: ", "0 corners"});
    refuses(folder, three + "f 1 2\n", {":8: ", "2 corners"});
    refuses(folder, three + "f 1 2 x\n", {":8: ", "'x'"});
    refuses(folder, three + "f 1 2 3.5\n", {":8: ", "'3.5'"});
    refuses(folder, three + "f 1/ 2/ 3/\n", {":8: ", "texture index ''"});
    refuses(folder, three + "f 1// 2// 3//\n", {":8: ", "normal index ''"});
    refuses(folder, three + "f /1 /2 /3\n", {":8: ", "vertex index ''"});
    refuses(folder, three + "f 1/1/1/1 2/2/1/1 3/3/1/1\n", {":8: ", "more than three indices"});
    std::string many = "f";
    for (int i = 0; i < 256; ++i)
        many += " 1";
    refuses(folder, three + many, {":8: ", "256 corners"});
}

TEST(HostileObj, NumbersThatAreNoneNameTheirLine) {
    const TemporaryFolder folder;
    refuses(folder, "v 0 0 0\r\nv nan 0 0\r\n", {":2: ", "'nan'"});
    refuses(folder, "v 0 0 0\rv 0 -inf 0\r", {":2: ", "'-inf'"});
    refuses(folder, "v 1e39 0 0\n", {":1: ", "'1e39'"});
    refuses(folder, "v 3.4028236e38 0 0\n", {":1: "});
    refuses(folder, "v 1e999999999999 0 0\n", {":1: "});
    refuses(folder, "v 0e" + std::string(100, '9') + " 0 0\n", {":1: "});
    refuses(folder, "v " + std::string(100000, '1') + " 0 0\n", {":1: ", "'1111"});
    refuses(folder, "v 0 0\n", {":1: ", "missing"});
    refuses(folder, "v 0 0 0x10\n", {":1: ", "'0x10'"});
    refuses(folder, "v 0 0 +-1\n", {":1: ", "'+-1'"});
    refuses(folder, "vt\n", {":1: ", "missing"});
    refuses(folder, "vn 0 0\n", {":1: ", "missing"});
}

TEST(HostileObj, MissingLibrariesMaterialsAndTexturesAreNamedWithTheirLine) {
    const TemporaryFolder folder;
    refuses(folder, "mtllib gone.mtl\n" + three + "f 1 2 3\n", {":1: ", "'gone.mtl'", "missing"});
    refuses(folder, "\nmtllib\n", {":2: ", "names no file"});
    refuses(folder, three + "usemtl unknown\nf 1 2 3\n", {":8: ", "'unknown'"});
    const auto library = folder.write("a.mtl", "newmtl a\n\nmap_Kd gone.png\n");
    const auto mesh = folder.write("bad.obj", "mtllib a.mtl\n" + three + "f 1 2 3\n");
    expectError(std::filesystem::canonical(library), {":3: ", "'gone.png'", "missing"},
                [&] { loadMesh(mesh); });
}

TEST(HostileObj, FilesOutsideTheFolderAreRefused) {
    const TemporaryFolder folder;
    folder.write("secret.mtl", "newmtl a\n");
    folder.write("secret.png", "secret");
    const auto inside = [&](const std::string& text) {
        const auto path = folder.write("in/bad.mtl", text);
        expectError(path, {":2: "}, [&] { loadMtl(path); });
    };
    inside("newmtl a\nmap_Kd ../secret.png");
    inside("newmtl a\nmap_Kd ..\\secret.png");
    inside("newmtl a\nmap_Kd x/../../secret.png");
    inside("newmtl a\nmap_Kd /etc/passwd");
    inside("newmtl a\nmap_Kd C:/secret.png");
    inside("newmtl a\nmap_Kd file:///etc/passwd");
    std::filesystem::create_symlink("../secret.png", folder.path() / "in/link.png");
    inside("newmtl a\nmap_Kd link.png");
    std::filesystem::create_directory(folder.path() / "in/folder.png");
    inside("newmtl a\nmap_Kd folder.png");
    const auto mesh = folder.write("in/bad.obj", "mtllib ../secret.mtl\n" + three + "f 1 2 3\n");
    expectError(mesh, {":1: ", "leaves the file's folder"}, [&] { loadMesh(mesh); });
}

TEST(HostileMtl, MalformedMaterialsNameTheirLine) {
    const TemporaryFolder folder;
    folder.write("a.png", "x");
    refusesMtl(folder, "", {"has no material"});
    refusesMtl(folder, "Kd 1 1 1\n", {":1: ", "before the first newmtl"});
    refusesMtl(folder, "newmtl\n", {":1: ", "name is missing"});
    refusesMtl(folder, "newmtl a\nKd\n", {":2: ", "missing"});
    refusesMtl(folder, "newmtl a\nKd 1 1\n", {":2: ", "missing"});
    refusesMtl(folder, "newmtl a\nKd nan 1 1\n", {":2: ", "'nan'"});
    refusesMtl(folder, "newmtl a\nKd -1 1 1\n", {":2: ", "negative"});
    refusesMtl(folder, "newmtl a\nKd spectral file.rfl\n", {":2: ", "'spectral'"});
    refusesMtl(folder, "newmtl a\nPr 2\n", {":2: ", "0 to 1"});
    refusesMtl(folder, "newmtl a\nPm x\n", {":2: ", "'x'"});
    refusesMtl(folder, "newmtl a\nmap_Kd\n", {":2: ", "file name is missing"});
    refusesMtl(folder, "newmtl a\nmap_Kd -imfchan r\n", {":2: ", "file name is missing"});
    refusesMtl(folder, "newmtl a\nmap_Pr -imfchan z a.png\n", {":2: ", "-imfchan"});
    refusesMtl(folder, "newmtl a\nmap_Pr -magic 3 a.png\n", {":2: ", "-magic"});
    refusesMtl(folder, "newmtl a\nmap_Kd -s 2 2 2 a.png\n", {":2: ", "-o and -s"});
    refusesMtl(folder, "newmtl a\nmap_Kd " + std::string(100000, 'x') + "\n", {":2: ", "missing"});
}
