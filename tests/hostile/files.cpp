// Models, materials and skies that a rung is given and cannot use: said in one line that names the file.
#include "hostile/hostile.hpp"
#include "unit/io/exr_maker.hpp"
#include "unit/io/gltf_maker.hpp"

#include <algorithm>

namespace gll::test {
namespace {

// The rung with one file given, of these contents.
void expectFileRefused(const char* option, const std::string& name, const std::string& contents,
                       const std::vector<std::string>& parts) {
    const TemporaryFolder folder;
    folder.write(name, contents);
    expectRefusal(run(rungCommand(folder, {"--size", "8x8", option, name, "--out", "frame.png"})), 1, parts);
    EXPECT_EQ(folder.listing(), std::vector<std::string>{name});
}

TEST(Files, thatAreNotThereAreRefused) {
    checkRefusal({"", {"--size", "8x8", "--mesh", "{}/no.obj", "--out", "{}/frame.png"}, 1, {"no.obj"}});
    checkRefusal({"", {"--size", "8x8", "--floor", "{}/no.mtl", "--out", "{}/frame.png"}, 1, {"no.mtl"}});
    checkRefusal(
        {"", {"--size", "8x8", "--environment", "{}/no.hdr", "--out", "{}/frame.png"}, 1, {"no.hdr"}});
}

TEST(Files, thatAreFoldersAreRefused) {
    for (const char* option : {"--mesh", "--floor", "--environment"}) {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder / "folder.obj");
        expectRefusal(run(rungCommand(folder, {"--size", "8x8", option, "folder.obj", "--out", "frame.png"})),
                      1, {"folder.obj"});
    }
}

TEST(Files, ofAnotherKindAreRefused) {
    expectFileRefused("--mesh", "mesh.stl", "solid\n", {"mesh.stl"});
    expectFileRefused("--environment", "sky.hdr", "not a picture", {"sky.hdr"});
    expectFileRefused("--environment", "sky.exr", "", {"sky.exr"});
}

TEST(Files, withACubeMapForAnEnvironmentAreRefused) {
    ExrPart part;
    part.sized(2, 12).more = exrAttribute("envmap", "envmap", std::string(1, '\1'));
    expectFileRefused("--environment", "sky.exr", exr({part}), {"sky.exr", "cube map", "envmap=cube"});
}

TEST(Files, withNothingInThemAreRefused) {
    expectFileRefused("--mesh", "mesh.obj", "", {"mesh.obj"});
    expectFileRefused("--mesh", "mesh.gltf", "", {"mesh.gltf"});
    expectFileRefused("--mesh", "mesh.glb", "glTF", {"mesh.glb"});
    expectFileRefused("--floor", "floor.mtl", "", {"floor.mtl"});
}

TEST(Files, withABrokenMeshAreRefusedByLine) {
    expectFileRefused("--mesh", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", {"mesh.obj:4"});
    expectFileRefused("--mesh", "mesh.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", {"mesh.obj:2"});
}

TEST(Files, withMissingMaterialsAndTexturesAreDrawnAndTheTenFirstNamed) {
    const TemporaryFolder folder;
    std::string mesh = "mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.write("mesh.obj", mesh);
    std::string floor = "newmtl a\nmap_Kd no.png\n";
    for (int i = 0; i < 12; ++i)
        floor += "map_Pr no_" + std::to_string(i) + ".png\n";
    folder.write("floor.mtl", floor);
    const Result result = run(rungCommand(folder, {"--size", "8x8", "--mesh", "mesh.obj", "--floor",
                                                   "floor.mtl", "--frames", "1..3", "--out", "%d.png"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 11) << result.err;
    EXPECT_TRUE(
        result.err.starts_with("10_deferred: warning: mesh.obj:1: material library: 'no.mtl' is missing"))
        << result.err;
    EXPECT_NE(result.err.find("\n10_deferred: warning: floor.mtl:2: texture: 'no.png' is missing"),
              std::string::npos)
        << result.err;
    EXPECT_TRUE(result.err.ends_with("\n10_deferred: warning: ... and 4 more\n")) << result.err;
}

TEST(Files, withAnImageThatCannotBeReadAreDrawnWithoutItAndNamedOnceInABatch) {
    const TemporaryFolder folder;
    folder.write("broken.png", "no picture");
    folder.write("floor.mtl", "newmtl a\nmap_Kd broken.png\n");
    folder.write("two.jsonl",
                 "{\"size\": \"8x8\", \"out\": \"a.png\"}\n"
                 "{\"size\": \"8x8\", \"out\": \"b.png\", \"set\": [\"texture_filter=mipmapped\"]}\n");
    const Result result = run(rungCommand(folder, {"--floor", "floor.mtl", "--batch", "two.jsonl"}));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.out.find("b.png: frame 60, 8x8"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("warning"), std::string::npos);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("10_deferred: warning: ")) << result.err;
    EXPECT_NE(result.err.find("broken.png: "), std::string::npos) << result.err;
}

TEST(Files, withoutMaterialsAreDrawnWithoutAWordOnThem) {
    const TemporaryFolder folder;
    folder.write("mesh.gltf", GltfMaker().gltf());
    const Result result =
        run(rungCommand(folder, {"--size", "8x8", "--mesh", "mesh.gltf", "--out", "a.png"}));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    GltfMaker metallic;
    metallic.json["materials"] = {{{"name", "default"}}};
    metallic.primitive()["material"] = 0;
    folder.write("mesh.gltf", metallic.gltf());
    EXPECT_NE(run(rungCommand(folder, {"--size", "8x8", "--mesh", "mesh.gltf", "--out", "a.png"}))
                  .err.find("material 'default' is metallic"),
              std::string::npos);
}

TEST(Files, whoseHeadersLieAreRefused) {
    expectFileRefused("--environment", "sky.hdr",
                      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n", {"sky.hdr"});
    expectFileRefused(
        "--mesh", "mesh.gltf",
        R"({"asset": {"version": "2.0"}, "nodes": [{"children": [0]}], "scenes": [{"nodes": [0]}]})",
        {"mesh.gltf", "/nodes/0"});
}

} // namespace
} // namespace gll::test
