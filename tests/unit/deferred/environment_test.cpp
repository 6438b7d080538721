// Environment light against integrals done the slow way.
#include "09_environment_light/environment.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace gll::test {
namespace {

using namespace gll::environment_light;

constexpr double pi = std::numbers::pi;

glm::dvec3 directionAt(int column, int row, int width, int height) {
    const double around = ((column + 0.5) / width - 0.5) * 2 * pi;
    const double down = (row + 0.5) / height * pi;
    return {std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around)};
}

Image sky(int width, int height, const std::function<glm::dvec3(glm::dvec3)>& radiance) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 3;
    std::vector<float> pixels;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::dvec3 light = radiance(directionAt(column, row, width, height));
            for (int c = 0; c < 3; ++c)
                pixels.push_back(static_cast<float>(light[c]));
        }
    image.pixels = std::move(pixels);
    return image;
}

glm::dvec3 evaluate(const std::array<glm::dvec3, 9>& c, glm::dvec3 n) {
    return c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * n.x * n.y + c[5] * n.y * n.z +
           c[6] * (3 * n.z * n.z - 1) + c[7] * n.x * n.z + c[8] * (n.x * n.x - n.y * n.y);
}

// Irradiance over pi by summing every pixel.
glm::dvec3 summed(const Image& image, glm::dvec3 n) {
    const auto& pixels = std::get<std::vector<float>>(image.pixels);
    glm::dvec3 sum(0);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const double cosine = glm::dot(n, directionAt(column, row, image.width, image.height));
            const double solid_angle =
                std::sin((row + 0.5) / image.height * pi) * pi / image.height * 2 * pi / image.width;
            const auto at = static_cast<std::size_t>(row * image.width + column) * 3;
            if (cosine > 0)
                sum += cosine * solid_angle / pi * glm::dvec3(pixels[at], pixels[at + 1], pixels[at + 2]);
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
        const glm::dvec3 light = evaluate(coefficients, n);
        EXPECT_NEAR(light.r, 1, 1e-2);
        EXPECT_NEAR(light.g, 2, 2e-2);
        EXPECT_NEAR(light.b, 0.5, 5e-3);
    }
}

TEST(Environment, inNineCoefficientsIsWithinAFewPercentOfTheIntegral) {
    const Image image = sky(128, 64, daylight);
    const auto coefficients = irradianceCoefficients(image);
    double worst = 0;
    double mean = 0;
    int count = 0;
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 16; ++column, ++count) {
            const glm::dvec3 n = directionAt(column, row, 16, 8);
            const double error = std::abs(evaluate(coefficients, n).g / summed(image, n).g - 1);
            worst = std::max(worst, error);
            mean += error;
        }
    EXPECT_LT(mean / count, 0.02); // 1 % on usual skies (Ramamoorthi and Hanrahan 2001)
    EXPECT_LT(worst, 0.09);        // their bound
}

TEST(Environment, prefilteredKeepsOneColorAndHasNoSeam) {
    for (const float value :
         prefilteredLevel(sky(32, 16, [](glm::dvec3) { return glm::dvec3(0.7); }), 8, 4, 0.6F))
        EXPECT_NEAR(value, 0.7F, 1e-4F);
    constexpr int width = 64;
    constexpr int height = 32;
    const std::vector<float> level = prefilteredLevel(sky(256, 128, daylight), width, height, 0.4F);
    const auto green = [&](int column, int row) {
        return level[static_cast<std::size_t>(row * width + column) * 3 + 1];
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

} // namespace
} // namespace gll::test
