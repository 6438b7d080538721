// Environment light against integrals done the slow way.
#include "09_environment_light/radiance_map.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::test {
namespace {

using namespace gll::environment_light;

constexpr double pi = std::numbers::pi;

RadianceMap sky(int width, int height, const std::function<glm::dvec3(glm::dvec3)>& radiance) {
    RadianceMap map{.width = width, .height = height, .pixels = {}};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            map.pixels.emplace_back(radiance(directionOf((column + 0.5) / width, (row + 0.5) / height)));
    return map;
}

// Irradiance over pi by summing every pixel.
glm::dvec3 summed(const RadianceMap& image, glm::dvec3 n) {
    glm::dvec3 sum(0);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const double cosine =
                glm::dot(n, directionOf((column + 0.5) / image.width, (row + 0.5) / image.height));
            const double solid_angle =
                std::sin((row + 0.5) / image.height * pi) * pi / image.height * 2 * pi / image.width;
            if (cosine > 0) sum += cosine * solid_angle / pi * glm::dvec3(image.at(column, row));
        }
    return sum;
}

glm::dvec3 daylight(glm::dvec3 d) {
    const double up = d.y > 0 ? d.y : 0;
    const double toward_light = std::max(glm::dot(d, glm::normalize(glm::dvec3(1, 2, 0.5))), 0.0);
    return glm::dvec3(0.3, 0.25, 0.2) + up * glm::dvec3(0.4, 0.6, 1.0) +
           std::pow(toward_light, 8.0) * glm::dvec3(3, 2.5, 2);
}

TEST(Environment, ofOneColorLightsEveryNormalWithThatColor) {
    const auto coefficients =
        irradianceCoefficients(sky(64, 32, [](glm::dvec3) { return glm::dvec3(1, 2, 0.5); }));
    for (const glm::dvec3 n :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(1, 2, -3))}) {
        const glm::dvec3 light = irradianceAt(coefficients, n);
        EXPECT_NEAR(light.r, 1, 1e-2);
        EXPECT_NEAR(light.g, 2, 2e-2);
        EXPECT_NEAR(light.b, 0.5, 5e-3);
    }
}

TEST(Environment, inNineCoefficientsIsWithinAFewPercentOfTheIntegral) {
    const RadianceMap image = sky(128, 64, daylight);
    const auto coefficients = irradianceCoefficients(image);
    double worst = 0;
    double mean = 0;
    int count = 0;
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 16; ++column, ++count) {
            const glm::dvec3 n = directionOf((column + 0.5) / 16, (row + 0.5) / 8);
            const double error = std::abs(irradianceAt(coefficients, n).g / summed(image, n).g - 1);
            worst = std::max(worst, error);
            mean += error;
        }
    EXPECT_LT(mean / count, 0.02); // 1 % on usual skies (Ramamoorthi and Hanrahan 2001)
    EXPECT_LT(worst, 0.09);        // their bound
}

TEST(Environment, prefilteredKeepsOneColorAndHasNoSeam) {
    for (const glm::vec3& value :
         prefiltered(mipChain(sky(32, 16, [](glm::dvec3) { return glm::dvec3(0.7); })), {8, 4}, 0.6, {}))
        EXPECT_NEAR(value.g, 0.7F, 1e-4F);
    constexpr int width = 64;
    constexpr int height = 32;
    const std::vector<glm::vec3> level =
        prefiltered(mipChain(sky(256, 128, daylight)), {width, height}, 0.4, {});
    const auto green = [&](int column, int row) {
        return level[static_cast<std::size_t>(row * width + column)].g;
    };
    float largest_step = 0; // between neighbours elsewhere
    float seam_step = 0;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column + 1 < width; ++column)
            largest_step = std::max(largest_step, std::abs(green(column, row) - green(column + 1, row)));
        seam_step = std::max(seam_step, std::abs(green(width - 1, row) - green(0, row)));
    }
    EXPECT_LE(seam_step, largest_step);
}

TEST(Environment, takesWhatIsNegativeOrTooBrightAndRefusesWhatIsNoNumber) {
    Image image{.width = 2, .height = 1, .channels = 3, .pixels = {}};
    image.pixels = std::vector<float>{-1, 2, std::numeric_limits<float>::infinity(), 1, 1, 1};
    Warnings warnings;
    EXPECT_EQ(radianceMap(image, "sky.exr", warnings).at(0, 0), glm::vec3(0, 2, 65504));
    EXPECT_EQ(warnings.take(),
              std::vector<std::string>{
                  "sky.exr: 1 values are cut off at 65504, the largest half float, of up to inf"});
    image.pixels = std::vector<float>{-1, 2, 65504, 1, 1, 1};
    radianceMap(image, "sky.exr", warnings);
    EXPECT_TRUE(warnings.take().empty());
    image.pixels = std::vector<float>{1, std::nanf(""), 1, 1, 1, 1};
    try {
        radianceMap(image, "sky.exr", warnings);
        FAIL() << "not refused";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "sky.exr: holds a value that is not a number");
    }
}

TEST(Environment, keepsItsEnergyInEveryHalf) {
    for (const glm::ivec2 size :
         {glm::ivec2(64, 32), glm::ivec2(37, 19), glm::ivec2(3, 2), glm::ivec2(1, 1)}) {
        const RadianceMap map =
            sky(size.x, size.y, [](glm::dvec3 d) { return daylight(d) + glm::dvec3(d.x > 0.9 ? 50 : 0); });
        const auto mean = [](const RadianceMap& of) {
            double sum = 0;
            for (int row = 0; row < of.height; ++row)
                for (int column = 0; column < of.width; ++column)
                    sum += solidAngle(of, row) / (4 * pi) * of.at(column, row).g;
            return sum;
        };
        for (const RadianceMap& half : mipChain(map))
            EXPECT_NEAR(mean(half) / mean(map), 1, 1e-5) << size.x << " " << half.width;
    }
}

TEST(Environment, ofASunIsPartedWithNothingLostAndGivenBackAsALight) {
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1, 2, -1));
    const RadianceMap map = sky(512, 256, [&](glm::dvec3 d) {
        return glm::dvec3(0.3, 0.4, 0.5) + (glm::dot(d, to_sun) > std::cos(0.02) ? 3000.0 : 0.0);
    });
    const SunAndSky parted = withoutSun(map);
    ASSERT_TRUE(parted.sun);
    EXPECT_GT(glm::dot(parted.sun->direction, to_sun), std::cos(0.004)) << "a third of a pixel";
    for (const glm::vec3& pixel : parted.sky.pixels)
        ASSERT_NEAR(pixel.g, 0.4F, 1e-3F);
    for (const glm::dvec3 n : {to_sun, glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(1, 0.1, 1))})
        EXPECT_NEAR((summed(parted.sky, n) + parted.sun->irradiance * std::max(glm::dot(n, to_sun), 0.0)).g /
                        summed(map, n).g,
                    1, 2e-3);
    EXPECT_FALSE(withoutSun(sky(512, 256, daylight)).sun) << "a glow is no sun";
    EXPECT_FALSE(withoutSun(sky(3, 2, [](glm::dvec3 d) { return glm::dvec3(d.x > 0.9 ? 100 : 0); })).sun);
}

TEST(Environment, ofASunOfOnePixelLeavesItThatPixelsSize) {
    RadianceMap map = sky(512, 256, [](glm::dvec3) { return glm::dvec3(0.3); });
    map.pixels[100 * 512 + 300] = glm::vec3(5000);
    const SunAndSky parted = withoutSun(map);
    ASSERT_TRUE(parted.sun);
    EXPECT_NEAR(parted.sun->mean_squared_angle / (solidAngle(map, 100) / (2 * pi)), 1, 1e-6);
}

// As a picture has it whose sun is cut off at its largest number, and blurred by haze: equally bright all
// over.
TEST(Environment, ofAFlatDiscOf5DegreesIsPartedWhole) {
    for (const glm::dvec3 toward : {glm::dvec3(1, 2, -1), glm::dvec3(-1, 0.1, 0.01), glm::dvec3(0.1, 1, 0)}) {
        const glm::dvec3 to_sun = glm::normalize(toward);
        const RadianceMap map = sky(512, 256, [&](glm::dvec3 d) {
            return glm::dvec3(0.3, 0.4, 0.5) +
                   (glm::dot(d, to_sun) > std::cos(2.5 * pi / 180) ? 65000.0 : 0.0);
        });
        const SunAndSky parted = withoutSun(map);
        ASSERT_TRUE(parted.sun);
        EXPECT_GT(glm::dot(parted.sun->direction, to_sun), std::cos(0.004)) << "a third of a pixel";
        EXPECT_NEAR(std::sqrt(2 * parted.sun->mean_squared_angle), 2.5 * pi / 180, 0.002);
        for (const glm::vec3& pixel : parted.sky.pixels)
            ASSERT_NEAR(pixel.g, 0.4F, 1e-2F);
    }
}

TEST(Environment, windowedSeesNoNegativeLightAndIsLeftAloneWhereThereIsNone) {
    const Irradiance point =
        irradianceCoefficients(sky(256, 128, [](glm::dvec3 d) { return glm::dvec3(d.y > 0.999 ? 100 : 0); }));
    double least = 0;
    double least_windowed = 0;
    for (int i = 0; i <= 180; ++i) {
        const glm::dvec3 n(std::sin(i * pi / 180), std::cos(i * pi / 180), 0);
        least = std::min(least, irradianceAt(point, n).g);
        least_windowed = std::min(least_windowed, irradianceAt(windowed(point), n).g);
    }
    const double peak = irradianceAt(point, {0, 1, 0}).g;
    EXPECT_NEAR(least / peak, -0.0396 / 1.0625, 2e-4); // f(c) = 0.09375 + 0.5 c + 0.46875 c^2
    EXPECT_GT(least_windowed / peak, -1e-3);
    const Irradiance day = irradianceCoefficients(sky(256, 128, daylight));
    EXPECT_EQ(day, windowed(day));
}

TEST(Environment, hasALobeWithAnIntegral) {
    for (const double roughness : {0.1, 0.3, 0.6, 0.9, 1.0})
        for (const double least : {0.0, 0.5, 0.9}) {
            double sum = 0;
            constexpr int steps = 200000;
            for (int i = 0; i < steps; ++i)
                sum +=
                    lobe(least + (1 - least) * (i + 0.5) / steps, roughness) * 2 * pi * (1 - least) / steps;
            EXPECT_NEAR(lobeIntegral(roughness, least) / sum, 1, 1e-4) << roughness << " " << least;
        }
}

// Neighbours of one side are near each other, and every direction's texel belongs to one side.
TEST(Environment, asACubeCoversAllDirectionsOnce) {
    constexpr int size = 8;
    const std::vector<glm::vec3> directions = cubeDirections(size);
    ASSERT_EQ(directions.size(), 6U * size * size);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::vec3 length = glm::abs(directions[i]);
        const float longest = std::max({length.x, length.y, length.z});
        const auto axis = static_cast<int>(i / (2 * size * size));
        EXPECT_EQ(length[axis], longest) << i;
        EXPECT_EQ(directions[i][axis] < 0, i / (size * size) % 2 == 1) << i;
        sum += glm::dvec3(directions[i]);
    }
    EXPECT_LT(glm::length(sum), 1e-4);
}

TEST(Environment, asAnOctahedronFoldsItsRimOntoItself) {
    constexpr int size = 16;
    const std::vector<glm::vec3> directions = octahedralDirections(size);
    for (int i = 0; i < size; ++i) {
        const glm::vec3 apart = directions[static_cast<std::size_t>(i)] -
                                directions[static_cast<std::size_t>(size - 1 - i)]; // mirrored along the rim
        EXPECT_LT(glm::length(apart), 1e-6F) << i;
    }
}

} // namespace
} // namespace gll::test
