// glTF files that lie or break off: each must end in an error that names the file, the JSON pointer and the
// trouble. The list grows: what once crashed a reader stays here.
#include "io/mesh.hpp"

#include "gltf_maker.hpp"
#include "test_files.hpp"

#include <sys/stat.h>

#include <functional>
#include <limits>
#include <string_view>

using namespace gll;
using namespace gll::test;
using Json = nlohmann::json;

namespace {

void refusesText(const TemporaryFolder& folder, const std::string& bytes,
                 std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad.gltf", bytes);
    expectError(path, parts, [&] { loadMesh(path); });
}

// A good file after one change.
void refuses(std::initializer_list<std::string_view> parts, const std::function<void(GltfMaker&)>& change) {
    const TemporaryFolder folder;
    GltfMaker maker;
    change(maker);
    refusesText(folder, maker.gltf(), parts);
}

// Images that nothing uses are not looked at.
void useImage(GltfMaker& maker, const Json& image) {
    maker.json["images"] = {image};
    maker.json["textures"] = {{{"source", 0}}};
    maker.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    maker.primitive()["material"] = 0;
}

// The same, by a JSON patch on a triangle with indices, material, texture and embedded image.
void refusesPatch(std::initializer_list<std::string_view> parts, const std::string& pointer,
                  const Json& value) {
    refuses(parts, [&](GltfMaker& maker) {
        maker.primitive()["indices"] = maker.accessor(packed<std::uint16_t>({0, 1, 2}), 5123, "SCALAR", 3);
        useImage(maker, {{"bufferView", maker.view("image")}, {"mimeType", "image/png"}});
        maker.json[Json::json_pointer(pointer)] = value;
    });
}

} // namespace

TEST(HostileGltf, WhatIsNoFileIsNotOpened) {
    const TemporaryFolder folder;
    for (const char* name : {"a.gltf", "a.glb"}) {
        expectError(folder.path() / name, {"no such file"}, [&] { loadMesh(folder.path() / name); });
        std::filesystem::create_directory(folder.path() / name);
        expectError(folder.path() / name, {"is a folder"}, [&] { loadMesh(folder.path() / name); });
    }
    const auto fifo = folder.path() / "fifo.glb";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    expectError(fifo, {"not a regular file"}, [&] { loadMesh(fifo); });
}

TEST(HostileGltf, WhatIsNotJsonIsRefused) {
    const TemporaryFolder folder;
    refusesText(folder, "", {"is empty"});
    refusesText(folder, "{", {"is not JSON"});
    refusesText(folder, "[]", {"not a JSON object"});
    refusesText(folder, "null", {"not a JSON object"});
    refusesText(folder, "{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e999}", {"is not JSON"});
    refusesText(folder, "{\"\xff\xfe\": 1}", {"is not JSON"});
    refusesText(folder, "{}", {"/asset/version"});
    refusesText(folder, R"({"asset": {"version": "1.0"}})", {"/asset/version", "'1.0'"});
    refusesText(folder, R"({"asset": {"version": 2}})", {"/asset/version"});
    refusesText(folder, R"({"asset": {"version": "2.0"}})", {"nothing to draw"});
}

TEST(HostileGltf, AFileCutOffAnywhereIsRefused) {
    const TemporaryFolder folder;
    const GltfMaker maker;
    for (const std::string& whole : {maker.gltf(), maker.glb()})
        for (std::size_t length = 0; length < whole.size(); ++length)
            refusesText(folder, whole.substr(0, length), {});
}

TEST(HostileGltf, JsonNestedDeeperThan64LevelsIsRefusedUnparsed) {
    const TemporaryFolder folder;
    std::string deep = "0";
    for (int i = 0; i < 5000; ++i)
        deep = "{\"extras\":" + deep + "}";
    refusesText(folder, R"({"asset": {"version": "2.0"}, "extras": )" + deep + "}", {"deeper than 64"});
    refusesText(folder, std::string(1000000, '['), {"deeper than 64"});
    // Brackets in strings do not count.
    GltfMaker maker;
    maker.json["asset"]["generator"] = std::string(100, '[') + "\"\\" + std::string(100, '{');
    EXPECT_EQ(loadMesh(folder.write("good.gltf", maker.gltf())).indices.size(), 3u);
}

TEST(HostileGltf, BinaryHeadersAndChunksThatLieAreRefused) {
    const TemporaryFolder folder;
    const std::string good = GltfMaker().glb();
    const auto bent = [&](std::size_t at, std::uint32_t value) {
        return std::string(good).replace(at, 4, packed<std::uint32_t>({value}));
    };
    refusesText(folder, bent(4, 1), {"version 1"});
    refusesText(folder, bent(8, 0xffffffffu), {"shorter than its header says"});
    refusesText(folder, bent(8, 0), {"has no JSON chunk"});
    refusesText(folder, bent(12, 0xffffffffu), {"chunk 0 is longer"});
    refusesText(folder, bent(12, 0), {""});
    refusesText(folder, bent(16, 0), {"does not begin with a JSON chunk"});
    refusesText(folder, "glTF", {"shorter than its header says"});
}

TEST(HostileGltf, IndicesIntoOtherArraysAreChecked) {
    for (const Json& wrong :
         {Json(99), Json(-1), Json(1.5), Json("0"), Json(nullptr), Json(18446744073709551615u)}) {
        refusesPatch({"/scene:"}, "/scene", wrong);
        refusesPatch({"/scenes/0/nodes/0:"}, "/scenes/0/nodes/0", wrong);
        refusesPatch({"/nodes/0/mesh:"}, "/nodes/0/mesh", wrong);
        refusesPatch({"/nodes/0/children/0:"}, "/nodes/0/children", Json::array({wrong}));
        refusesPatch({"/meshes/0/primitives/0/attributes/POSITION:"},
                     "/meshes/0/primitives/0/attributes/POSITION", wrong);
        refusesPatch({"/meshes/0/primitives/0/attributes/NORMAL:"},
                     "/meshes/0/primitives/0/attributes/NORMAL", wrong);
        refusesPatch({"/meshes/0/primitives/0/indices:"}, "/meshes/0/primitives/0/indices", wrong);
        refusesPatch({"/meshes/0/primitives/0/material:"}, "/meshes/0/primitives/0/material", wrong);
        refusesPatch({"/accessors/0/bufferView:"}, "/accessors/0/bufferView", wrong);
        refusesPatch({"/bufferViews/0/buffer:"}, "/bufferViews/0/buffer", wrong);
        refusesPatch({"/images/0/bufferView:"}, "/images/0/bufferView", wrong);
        refusesPatch({"/textures/0/source:"}, "/textures/0/source", wrong);
        refusesPatch({"/baseColorTexture/index:"}, "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
                     wrong);
    }
}

TEST(HostileGltf, PartsOfTheWrongKindAreRefused) {
    for (const char* pointer : {"/nodes",
                                "/meshes",
                                "/accessors",
                                "/bufferViews",
                                "/materials",
                                "/textures",
                                "/images",
                                "/scenes",
                                "/nodes/0",
                                "/meshes/0",
                                "/accessors/0",
                                "/bufferViews/0",
                                "/materials/0",
                                "/images/0",
                                "/scenes/0",
                                "/meshes/0/primitives",
                                "/meshes/0/primitives/0",
                                "/meshes/0/primitives/0/attributes",
                                "/materials/0/pbrMetallicRoughness",
                                "/materials/0/pbrMetallicRoughness/baseColorTexture",
                                "/nodes/0/children",
                                "/scenes/0/nodes",
                                "/nodes/0/matrix",
                                "/accessors/0/type",
                                "/accessors/0/sparse",
                                "/materials/0/name",
                                "/materials/0/doubleSided",
                                "/extensionsRequired",
                                "/buffers"})
        for (const Json& wrong : {Json(7), Json(nullptr), Json::array({Json::array()}), Json{{"x", 1}}})
            if (!(pointer == std::string("/nodes/0") && wrong.is_object()) &&
                !(wrong.is_object() && (std::string(pointer).ends_with("/0") ||
                                        std::string(pointer).ends_with("pbrMetallicRoughness"))))
                refusesPatch({pointer}, pointer, wrong);
}

TEST(HostileGltf, RangesBeyondTheirBuffersAreRefused) {
    refusesPatch({"/bufferViews/0:", "ends at byte"}, "/bufferViews/0/byteLength", 1000);
    refusesPatch({"/bufferViews/0:", "ends at byte"}, "/bufferViews/0/byteOffset", 40);
    refusesPatch({"/bufferViews/0/byteOffset:"}, "/bufferViews/0/byteOffset", 4294967296);
    refusesPatch({"/bufferViews/0/byteOffset:"}, "/bufferViews/0/byteOffset", -4);
    refusesPatch({"/bufferViews/0/byteLength:"}, "/bufferViews/0/byteLength", 18446744073709551615u);
    refusesPatch({"/bufferViews/0/byteLength:"}, "/bufferViews/0/byteLength", 0);
    refusesPatch({"/bufferViews/0/byteStride:"}, "/bufferViews/0/byteStride", 1000);
    refusesPatch({"/accessors/0:", "stride 4"}, "/bufferViews/0/byteStride", 4);
    refusesPatch({"/accessors/0:", "ends at byte"}, "/bufferViews/0/byteStride", 16);
    refusesPatch({"/accessors/0:", "ends at byte"}, "/accessors/0/count", 4);
    refusesPatch({"/accessors/0/count:"}, "/accessors/0/count", 1000000000);
    refusesPatch({"/accessors/0/count:"}, "/accessors/0/count", 0);
    refusesPatch({"/accessors/0/count:"}, "/accessors/0/count", -1);
    refusesPatch({"/accessors/0:", "ends at byte"}, "/accessors/0/byteOffset", 4);
    refusesPatch({"/accessors/0/byteOffset:"}, "/accessors/0/byteOffset", 4294967296);
    refusesPatch({"/accessors/0/componentType:"}, "/accessors/0/componentType", 5130);
    refusesPatch({"/accessors/0/componentType:"}, "/accessors/0/componentType", 5124);
    refusesPatch({"/accessors/0/type:"}, "/accessors/0/type", "VEC5");
    refusesPatch({"/accessors/0:", "ends at byte"}, "/accessors/0/type", "MAT4");
    refusesPatch({"/bufferViews/2:", "ends at byte"}, "/bufferViews/2/byteLength", 6); // the image's
    refuses({"/buffers/0:", "36 bytes"}, [](GltfMaker& maker) {
        maker.json["buffers"] = {{{"byteLength", 1000}, {"uri", "data:;base64," + base64(maker.buffer)}}};
    });
    refuses({"/accessors/0:", "without a buffer view"}, [](GltfMaker& maker) {
        maker.json["accessors"][0].erase("bufferView");
        maker.json["accessors"][0]["count"] = 16000000;
    });
}

TEST(HostileGltf, ManyInstancesOfALargeMeshAreRefusedBeforeMemoryRunsOut) {
    refuses({"/meshes/0/primitives/0", "larger than"}, [](GltfMaker& maker) {
        maker.json["accessors"][0].erase("bufferView");
        maker.json["accessors"][0]["count"] = 999999;
        maker.json["nodes"] = std::vector<Json>(100, {{"mesh", 0}});
        maker.json.erase("scenes");
        maker.json.erase("scene");
    });
}

TEST(HostileGltf, IndexValuesBeyondTheVerticesAreRefused) {
    const auto with = [](const std::string& bytes, int component_type, std::size_t count) {
        return [=](GltfMaker& maker) {
            maker.primitive()["indices"] = maker.accessor(bytes, component_type, "SCALAR", count);
        };
    };
    refuses({"/accessors/1:", "element 2 is index 3 of 3 vertices"},
            with(packed<std::uint8_t>({0, 1, 3}), 5121, 3));
    refuses({"/accessors/1:", "element 0"}, with(packed<std::uint32_t>({0xffffffffu, 1, 2}), 5125, 3));
    refuses({"/accessors/1:", "65535"}, with(packed<std::uint16_t>({0, 1, 65535}), 5123, 3));
    refuses({"whole triangles"}, with(packed<std::uint16_t>({0, 1}), 5123, 2));
    refuses({"whole triangles"}, with(packed<std::uint16_t>({0, 1, 2, 0}), 5123, 4));
    refuses({"/indices:", "SCALAR"}, with(packed<float>({0, 1, 2}), 5126, 3));
}

TEST(HostileGltf, SparseAccessorsThatLieAreRefused) {
    const auto bent = [](std::initializer_list<std::string_view> parts, const std::string& pointer,
                         const Json& value) {
        refuses(parts, [&](GltfMaker& maker) {
            maker.json["accessors"][0]["sparse"] = {
                {"count", 1},
                {"indices",
                 {{"bufferView", maker.view(packed<std::uint32_t>({3}))}, {"componentType", 5125}}},
                {"values", {{"bufferView", maker.view(packed<float>({1, 2, 3}))}}}};
            if (!pointer.empty()) maker.json[Json::json_pointer("/accessors/0/sparse" + pointer)] = value;
        });
    };
    bent({"/accessors/0/sparse/indices:", "position 3"}, "", nullptr);
    bent({"/accessors/0/sparse/count:"}, "/count", 4);
    bent({"/accessors/0/sparse/count:"}, "/count", -1);
    bent({"/accessors/0/sparse/indices:", "ends at byte"}, "/count", 2);
    bent({"/accessors/0/sparse/indices/bufferView:"}, "/indices/bufferView", 9);
    bent({"/accessors/0/sparse/indices/componentType:"}, "/indices/componentType", 5126);
    bent({"/accessors/0/sparse/values/byteOffset:"}, "/values/byteOffset", 4294967296);
    bent({"/accessors/0/sparse/values:", "ends at byte"}, "/values/byteOffset", 4);
    bent({"/accessors/0/sparse/values"}, "/values", Json::array());
}

TEST(HostileGltf, NumbersThatAreNotFiniteAreRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity})
        refuses({"element 1 is not a finite number"}, [&](GltfMaker& maker) {
            maker.attributes()["POSITION"] =
                maker.accessor(packed<float>({0, 0, 0, 1, bad, 0, 0, 1, 0}), 5126, "VEC3", 3);
        });
    refuses({"/attributes/POSITION:", "to infinity"}, [](GltfMaker& maker) {
        maker.json["nodes"] = {{{"children", {1}}, {"scale", {1e38, 1, 1}}},
                               {{"mesh", 0}, {"scale", {1e38, 1, 1}}}};
    });
    refusesPatch({"/nodes/0/scale/1:"}, "/nodes/0/scale", {1, 1e300, 1});
    refusesPatch({"/nodes/0/scale:"}, "/nodes/0/scale", {1, 1});
    refusesPatch({"/nodes/0/rotation:", "all zero"}, "/nodes/0/rotation", {0, 0, 0, 0});
    refusesPatch({"/nodes/0/matrix:"}, "/nodes/0/matrix", {1, 2, 3});
    refusesPatch({"/emissiveFactor/0:"}, "/materials/0/emissiveFactor", {2, 0, 0});
    refusesPatch({"/roughnessFactor:"}, "/materials/0/pbrMetallicRoughness/roughnessFactor", "rough");
}

TEST(HostileGltf, NodesThatGoRoundOrTooDeepAreRefused) {
    refuses({"/nodes/0", "ancestor"}, [](GltfMaker& maker) { maker.json["nodes"][0]["children"] = {0}; });
    refuses({"/nodes/", "ancestor"}, [](GltfMaker& maker) {
        maker.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
    });
    refuses({"/nodes/1/children/0", "one parent"}, [](GltfMaker& maker) {
        maker.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
    });
    refuses({"/nodes/0/children/1", "one parent"}, [](GltfMaker& maker) {
        maker.json["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
    });
    refuses({"/scenes/0/nodes/1", "twice"}, [](GltfMaker& maker) {
        maker.json["scenes"][0]["nodes"] = {0, 0};
    });
    refuses({"/nodes/", "256"}, [](GltfMaker& maker) {
        maker.json["nodes"] = Json::array();
        for (int i = 0; i < 100000; ++i)
            maker.json["nodes"].push_back({{"children", {i + 1}}});
        maker.json["nodes"].push_back({{"mesh", 0}});
    });
}

TEST(HostileGltf, UrisOutsideTheFolderAreNotRead) {
    const TemporaryFolder folder;
    folder.write("secret.bin", std::string(36, '\0'));
    std::filesystem::create_directory(folder.path() / "in");
    std::filesystem::create_symlink("../secret.bin", folder.path() / "in/link.bin");
    std::filesystem::create_directory(folder.path() / "in/folder.bin");
    ASSERT_EQ(::mkfifo((folder.path() / "in/fifo.bin").c_str(), 0600), 0);
    for (const char* uri :
         {"../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin", "..%5Csecret.bin", "x/../../secret.bin",
          "/etc/passwd", "%2Fetc/passwd", "file:///etc/passwd", "http://example.org/a.bin", "link.bin",
          "folder.bin", "fifo.bin", "missing.bin", "", "%00", "secret.bin%00.png", "%zz", "%2"}) {
        for (const bool image : {false, true}) {
            GltfMaker maker;
            if (image)
                useImage(maker, {{"uri", uri}});
            else
                maker.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
            const auto path = folder.write("in/bad.gltf", maker.gltf());
            if (!image || std::string_view(uri).starts_with("%z") || std::string_view(uri) == "%2") {
                expectError(path, {image ? "/images/0/uri" : "/buffers/0/uri"}, [&] { loadMesh(path); });
                continue;
            }
            const MeshData mesh = loadMesh(path);
            EXPECT_TRUE(mesh.materials.at(0).base_color_texture.image.empty()) << uri;
            ASSERT_EQ(mesh.warnings.size(), 1u) << uri;
            for (const char* part : {"bad.gltf: /images/0/uri: ", "; drawn without this texture"})
                EXPECT_NE(mesh.warnings[0].find(part), std::string::npos) << mesh.warnings[0];
        }
    }
}

TEST(HostileGltf, DataUrisThatAreNotBase64AreRefused) {
    for (const char* uri : {"data:", "data:,abc", "data:;base64", "data:;base64,a", "data:;base64,ab*d",
                            "data:image/png;base64,\x01\x02"})
        refuses({"/images/0/uri"}, [&](GltfMaker& maker) { useImage(maker, {{"uri", uri}}); });
    refuses({"/buffers/0:"}, [](GltfMaker& maker) {
        maker.json["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64,"}}};
    });
}

TEST(HostileGltf, WhatIsNotSupportedIsNamed) {
    refusesPatch({"/extensionsRequired/0", "KHR_draco_mesh_compression"}, "/extensionsRequired",
                 {"KHR_draco_mesh_compression"});
    refusesPatch({"/extensionsRequired/1", "KHR_materials_clearcoat"}, "/extensionsRequired",
                 {"KHR_materials_unlit", "KHR_materials_clearcoat"});
    refusesPatch({"/textures/0", "EXT_texture_webp"}, "/textures/0",
                 {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    refusesPatch({"/textures/0", "source"}, "/textures/0", Json::object());
    refusesPatch({"/images/0", "either"}, "/images/0/uri", "a.png");
    refusesPatch({"/mode:"}, "/meshes/0/primitives/0/mode", 7);
    refuses({"has no triangles", "/meshes/0/primitives/0/mode says points or lines"},
            [](GltfMaker& maker) { maker.primitive()["mode"] = 1; });
    refuses({"has no triangles"}, [](GltfMaker& maker) { maker.json["nodes"][0].erase("mesh"); });
    refuses({"TEXCOORD_0:", "VEC2"}, [](GltfMaker& maker) { maker.attributes()["TEXCOORD_0"] = 0; });
    refuses({"NORMAL:", "2 elements for 3 vertices"}, [](GltfMaker& maker) {
        maker.attributes()["NORMAL"] = maker.accessor(packed<float>({0, 0, 1, 0, 0, 1}), 5126, "VEC3", 2);
    });
    refuses({"/asset/minVersion", "'2.1'"}, [](GltfMaker& maker) {
        maker.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
    });
    refusesPatch({"/baseColorTexture/texCoord:"},
                 "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", -1);
    refusesPatch({"/baseColorTexture/extensions/KHR_texture_transform/offset:"},
                 "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
                 {{"KHR_texture_transform", {{"offset", {1, 2, 3}}}}});
    refusesPatch({"/textures/0/sampler:", "there are 0 samplers"}, "/textures/0/sampler", 0);
    refuses({"COLOR_0:", "VEC4"}, [](GltfMaker& maker) {
        maker.attributes()["COLOR_0"] = maker.accessor(packed<float>({0, 0, 0, 0, 0, 0}), 5126, "VEC2", 3);
    });
}

TEST(HostileGltf, CompressedGeometryIsNamedWhereThereIsNoOther) {
    refuses({"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression:", "compression"},
            [](GltfMaker& maker) {
                maker.json["accessors"][0].erase("bufferView");
                maker.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
            });
    refuses({"/buffers/0:", "EXT_meshopt_compression"}, [](GltfMaker& maker) {
        maker.json["buffers"] = {
            {{"byteLength", 36}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    });
    refuses({"POSITION:", "KHR_mesh_quantization"}, [](GltfMaker& maker) {
        maker.attributes()["POSITION"] =
            maker.accessor(packed<std::int16_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), 5122, "VEC3", 3);
        maker.json["bufferViews"].back()["byteStride"] = 8;
    });
}
