// Bump maps: heights become normals, and what is a normal map already is told by its colors.
#include "06_gbuffer/height_map.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace gll;

namespace {

// Each pixel from color(x, y), of as many channels.
template <class Color>
Image picture(int width, int height, const Color& color) {
    Image image;
    image.width = width;
    image.height = height;
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto channels = color(x, y);
            image.channels = static_cast<int>(channels.size());
            for (const int channel : channels)
                pixels.push_back(static_cast<std::uint8_t>(channel));
        }
    image.pixels = pixels;
    return image;
}

using Grey = std::array<int, 1>;
using Rgb = std::array<int, 3>;

glm::vec3 normalAt(const std::vector<std::uint8_t>& normals, int width, int x, int y) {
    const std::uint8_t* c = &normals[static_cast<std::size_t>((y * width + x) * 3)];
    return (glm::vec3(c[0], c[1], c[2]) - 128.0F) / 127.0F;
}

} // namespace

TEST(HeightMap, HeightsAreNoNormals) {
    EXPECT_FALSE(gbuffer::looksLikeNormalMap(picture(16, 16, [](int x, int) { return Grey{x * 16}; })));
    for (int grey = 0; grey < 256; ++grey)
        EXPECT_FALSE(gbuffer::looksLikeNormalMap(picture(2, 2, [&](int, int) {
            return Rgb{grey, grey, grey};
        }))) << grey;
    EXPECT_FALSE(gbuffer::looksLikeNormalMap(picture(16, 16, [](int x, int y) {
        return Rgb{x * 16, y * 16, 40};
    })));
    EXPECT_FALSE(gbuffer::looksLikeNormalMap(picture(16, 16, [](int x, int) {
        return Rgb{180, 90, x * 4};
    }))) << "brick";
    EXPECT_FALSE(gbuffer::looksLikeNormalMap(picture(16, 16, [](int x, int) {
        return Rgb{100 + x, 140, 200};
    }))) << "sky";
}

TEST(HeightMap, NormalMapsAreToldByTheirColors) {
    EXPECT_TRUE(gbuffer::looksLikeNormalMap(picture(4, 4, [](int, int) { return Rgb{128, 128, 255}; })));
    EXPECT_TRUE(gbuffer::looksLikeNormalMap(picture(32, 32, [](int x, int y) {
        const glm::vec3 n = glm::normalize(glm::vec3(std::sin(float(x)), std::cos(float(y)), 1.2F));
        return Rgb{int((n.x + 1) * 127), int((n.y + 1) * 127), int((n.z + 1) * 127)};
    })));
    const auto mostly = [](int share) { // of ten columns that are flat normals; the others are black
        return picture(10, 4, [=](int x, int) { return x < share ? Rgb{128, 128, 255} : Rgb{0, 0, 0}; });
    };
    EXPECT_TRUE(gbuffer::looksLikeNormalMap(mostly(9)));
    EXPECT_FALSE(gbuffer::looksLikeNormalMap(mostly(8)));
}

TEST(HeightMap, ASlopeLeansAwayFromWhereItRises) {
    // Rises by 5 codes a texel to the right, and by 10 down the image.
    const Image image = picture(16, 16, [](int x, int y) { return Grey{x * 5 + y * 10}; });
    for (const float scale : {1.0F, 20.0F, -20.0F}) {
        const glm::vec3 expected =
            glm::normalize(glm::vec3(-5 * scale / 255, 10 * scale / 255, 1)); // green up the image
        const glm::vec3 normal = normalAt(gbuffer::normalsFromHeights(image, 0, scale), 16, 8, 8);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(normal[c], expected[c], 0.005F) << scale;
    }
}

TEST(HeightMap, RepeatsAndReadsTheChannelThatIsAsked) {
    // One white column at the left: what is right of it, and left of it round the edge, leans away.
    const Image image = picture(8, 2, [](int x, int) { return Rgb{0, x == 0 ? 255 : 0, 0}; });
    const auto normals = gbuffer::normalsFromHeights(image, 1, 2.0F);
    EXPECT_GT(normalAt(normals, 8, 1, 0).x, 0.5F);
    EXPECT_LT(normalAt(normals, 8, 7, 0).x, -0.5F);
    EXPECT_NEAR(normalAt(normals, 8, 0, 0).x, 0.0F, 0.01F);
    EXPECT_NEAR(normalAt(gbuffer::normalsFromHeights(image, 0, 2.0F), 8, 1, 0).x, 0.0F, 0.01F);
}
