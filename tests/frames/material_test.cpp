// What of a glTF material is drawn, seen in the G-buffer and in the shadow map: a square that faces the
// camera, by the program, as people run it. A case is a change of the square's glTF and a count of pixels by
// their albedo.
#include "gltf_maker.hpp"
#include "io/image.hpp"
#include "png_maker.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace gll::test {
namespace {

using Json = nlohmann::json;

constexpr glm::vec3 red(1, 0, 0);
constexpr glm::vec3 green(0, 1, 0);
constexpr glm::vec3 white(1);

class DeferredMaterial : public testing::Test {
  protected:
    DeferredMaterial() {
        folder_.write("floor.mtl", "newmtl blue\nKd 0 0 0.5\n");
        Image sky;
        sky.width = 2;
        sky.height = 1;
        sky.channels = 3;
        sky.pixels = std::vector<float>(6, 1.0F);
        saveImage(folder_.path() / "sky.hdr", sky);

        maker_.attributes()["POSITION"] =
            maker_.accessor(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 4);
        maker_.attributes()["NORMAL"] =
            maker_.accessor(packed<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 4);
        setUvs("TEXCOORD_0", {0, 1, 1, 1, 0, 0, 1, 0});
        maker_.primitive()["mode"] = 5;
        maker_.primitive()["material"] = 0;
        maker_.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
        maker_.json["samplers"] = {{{"magFilter", 9728}}};
    }

    void setUvs(const char* key, const std::vector<float>& uvs) {
        maker_.attributes()[key] = maker_.accessor(packed(uvs), 5126, "VEC2", 4);
    }

    Json& material() { return maker_.json["materials"][0]; }
    Json& pbr() { return material()["pbrMetallicRoughness"]; }

    // An image of one row of RGBA texels, and what refers to it.
    Json texture(const std::string& texels) {
        const auto width = static_cast<std::uint32_t>(texels.size() / 4);
        maker_.json["images"].push_back(
            {{"uri", "data:image/png;base64," + base64(png(width, 1, 8, 6, std::string(1, '\0') + texels))}});
        maker_.json["textures"].push_back({{"source", maker_.json["images"].size() - 1}, {"sampler", 0}});
        return {{"index", maker_.json["textures"].size() - 1}};
    }

    // The square's targets, RGBA.
    struct Targets {
        std::vector<float> albedo, normal, shadow;
    };
    Targets draw() {
        folder_.write("square.gltf", maker_.gltf());
        const std::string folder = folder_.path().string() + "/";
        const std::string settings =
            R"("size":"160x120","frame":1,"set":{"shadow_size":128,"ssao":"off","points":false,"environment":false}})";
        std::string batch;
        for (const std::string target : {"albedo", "normal", "shadow"})
            batch +=
                R"({"target":")" + target + R"(","out":")" + folder + target + R"(.exr",)" + settings + "\n";
        folder_.write("batch.jsonl", batch);
        const std::string command = std::string(GLLADDER_RUNG) + " --headless --mesh " + folder +
                                    "square.gltf --floor " + folder + "floor.mtl --environment " + folder +
                                    "sky.hdr --batch " + folder + "batch.jsonl > " + folder + "log";
        EXPECT_EQ(std::system(command.c_str()), 0);
        const auto values = [&](const char* name) {
            return std::get<std::vector<float>>(loadImage(folder_.path() / name).pixels);
        };
        return {values("albedo.exr"), values("normal.exr"), values("shadow.exr")};
    }

    // How many of the square's pixels have this albedo, of 8 bits; the floor is blue and beyond it all is
    // black.
    static int count(const std::vector<float>& albedo, glm::vec3 color) {
        int pixels = 0;
        for (std::size_t i = 0; i < albedo.size(); i += 4)
            pixels +=
                glm::distance(glm::vec3(albedo[i], albedo[i + 1], albedo[i + 2]), color) < 0.01F ? 1 : 0;
        return pixels;
    }
    static int countSquare(const std::vector<float>& albedo) {
        int pixels = 0;
        for (std::size_t i = 0; i < albedo.size(); i += 4)
            pixels += albedo[i] + albedo[i + 1] > 0.01F ? 1 : 0;
        return pixels;
    }

    GltfMaker maker_;
    TemporaryFolder folder_;
};

const std::string red_and_green("\xff\0\0\xff\0\xff\0\xff", 8);

TEST_F(DeferredMaterial, aSquareIsWhiteAndLarge) {
    const std::vector<float> albedo = draw().albedo;
    EXPECT_EQ(count(albedo, white), countSquare(albedo));
    EXPECT_GT(countSquare(albedo), 2000);
}

TEST_F(DeferredMaterial, vertexColorsMultiplyTheBaseColor) {
    pbr()["baseColorFactor"] = {0.5, 1, 1, 1};
    maker_.attributes()["COLOR_0"] =
        maker_.accessor(packed<float>({1, 0.25F, 0, 1, 0.25F, 0, 1, 0.25F, 0, 1, 0.25F, 0}), 5126, "VEC3", 4);
    const std::vector<float> albedo = draw().albedo;
    EXPECT_GT(countSquare(albedo), 2000);
    EXPECT_EQ(count(albedo, {0.5F, 0.25F, 0}), countSquare(albedo));
}

TEST_F(DeferredMaterial, holesAreNeitherSeenNorCastShadows) {
    const Targets opaque = draw();
    const int whole = countSquare(opaque.albedo);
    const auto changed = [&](const Targets& drawn) { // texels of the shadow map
        int texels = 0;
        for (std::size_t i = 0; i < opaque.shadow.size(); ++i)
            texels += drawn.shadow[i] != opaque.shadow[i] ? 1 : 0;
        return texels;
    };
    material()["alphaMode"] = "MASK";
    pbr()["baseColorFactor"] = {1, 1, 1, 0.4};
    const Targets none = draw();
    EXPECT_EQ(countSquare(none.albedo), 0);
    EXPECT_GT(changed(none), 200);
    material()["alphaCutoff"] = 0.3;
    const Targets all = draw();
    EXPECT_EQ(countSquare(all.albedo), whole);
    EXPECT_EQ(changed(all), 0);
    material().erase("alphaCutoff");
    pbr()["baseColorFactor"] = {1, 1, 1, 1};

    // half of the square by the image's alpha, and the other half by the vertices'
    pbr()["baseColorTexture"] = texture(std::string("\xff\xff\xff\x10\xff\xff\xff\xff", 8));
    const Targets half = draw();
    EXPECT_NEAR(countSquare(half.albedo), whole / 2, whole / 20);
    EXPECT_NEAR(changed(half), changed(none) / 2, changed(none) / 10);
    maker_.attributes()["COLOR_0"] = maker_.accessor(
        packed<std::uint8_t>({255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0}),
        5121, "VEC4", 4);
    maker_.json["accessors"].back()["normalized"] = true;
    const Targets neither = draw();
    EXPECT_EQ(countSquare(neither.albedo), 0) << "what vertices have left is half at the middle";
    EXPECT_EQ(neither.shadow, none.shadow);

    material()["alphaMode"] = "OPAQUE";
    const Targets ignored = draw();
    EXPECT_EQ(countSquare(ignored.albedo), whole);
    EXPECT_EQ(ignored.shadow, opaque.shadow);
}

TEST_F(DeferredMaterial, samplersRepeatMirrorOrClamp) {
    setUvs("TEXCOORD_0", {0, 1, 2, 1, 0, 0, 2, 0});
    pbr()["baseColorTexture"] = texture(red_and_green);
    const std::vector<float> repeated = draw().albedo;
    EXPECT_EQ(count(repeated, red) + count(repeated, green), countSquare(repeated))
        << "nearest: nothing between";
    EXPECT_NEAR(count(repeated, red), countSquare(repeated) / 2, 60);
    maker_.json["samplers"][0]["wrapS"] = 33071;
    EXPECT_NEAR(count(draw().albedo, red), countSquare(repeated) / 4, 60);
    maker_.json["samplers"][0]["wrapS"] = 33648; // red, green, green, red
    const std::vector<float> mirrored = draw().albedo;
    EXPECT_NEAR(count(mirrored, red), countSquare(repeated) / 2, 60);
    int changes = 0; // of color, along the row through the middle
    for (std::size_t x = 1; x < 160; ++x) {
        const std::size_t i = (60 * 160 + x) * 4;
        changes += (mirrored[i] > 0.5F) != (mirrored[i - 4] > 0.5F) ? 1 : 0;
    }
    EXPECT_EQ(changes, 4) << "into red, to green, to red and out of it";
    maker_.json["samplers"][0] = {{"magFilter", 9729}};
    const std::vector<float> smooth = draw().albedo;
    EXPECT_LT(count(smooth, red) + count(smooth, green), countSquare(smooth) / 2);
}

TEST_F(DeferredMaterial, everyImageIsReadAtItsOwnPlace) {
    pbr()["baseColorTexture"] = texture(red_and_green);
    pbr()["roughnessFactor"] = 1;
    const std::string dark_then_light("\0\0\0\xff\xff\xff\xff\xff", 8);
    const auto at = [](Json texture, double u) {
        texture["extensions"]["KHR_texture_transform"] = {{"scale", {0, 1}}, {"offset", {u, 0}}};
        return texture;
    };
    const Json map = texture(dark_then_light);
    const std::string tilted_then_flat("\xff\x80\x80\xff\x80\x80\xff\xff", 8);
    const Json normals = texture(tilted_then_flat);
    setUvs("TEXCOORD_1", {0.25F, 0.5F, 0.25F, 0.5F, 0.25F, 0.5F, 0.25F, 0.5F});

    pbr()["baseColorTexture"] = at(pbr()["baseColorTexture"], 0.75);
    std::vector<float> albedo = draw().albedo;
    EXPECT_EQ(count(albedo, green), countSquare(albedo));
    pbr()["baseColorTexture"].erase("extensions");
    pbr()["baseColorTexture"]["texCoord"] = 1;
    albedo = draw().albedo;
    EXPECT_EQ(count(albedo, red), countSquare(albedo));

    // the others move, the base color stays where it is
    const auto firstPixel = [](const Targets& drawn) { // of the square
        std::size_t i = 0;
        while (i + 4 < drawn.albedo.size() && drawn.albedo[i] + drawn.albedo[i + 1] < 0.01F)
            i += 4;
        return i;
    };
    const auto tilted = [](Json texture, double u) { // one color, but with a frame
        texture["extensions"]["KHR_texture_transform"] = {{"scale", {0.4, 1}}, {"offset", {u, 0}}};
        return texture;
    };
    material()["occlusionTexture"] = at(map, 0.25);
    pbr()["metallicRoughnessTexture"] = at(map, 0.75);
    material()["normalTexture"] = tilted(normals, 0.55);
    Targets drawn = draw();
    EXPECT_EQ(count(drawn.albedo, 0.55F * red), countSquare(drawn.albedo)) << "what occlusion darkens";
    EXPECT_EQ(drawn.albedo[firstPixel(drawn) + 3], 0.0F) << "the specular intensity of what is rough";
    EXPECT_GT(drawn.normal[firstPixel(drawn)], 0.99F) << "towards the camera";
    material()["occlusionTexture"] = at(map, 0.75);
    pbr()["metallicRoughnessTexture"] = at(map, 0.25);
    material()["normalTexture"] = tilted(normals, 0.05);
    drawn = draw();
    EXPECT_EQ(count(drawn.albedo, red), countSquare(drawn.albedo));
    EXPECT_NEAR(drawn.albedo[firstPixel(drawn) + 3], 0.6F, 0.01F) << "the mesh's, where roughness is 0";
    EXPECT_LT(drawn.normal[firstPixel(drawn)], 0.2F);
}

} // namespace
} // namespace gll::test
