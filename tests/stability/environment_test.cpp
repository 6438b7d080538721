// Where environment light breaks, in 09: seams of stored maps, a small bright sun, coefficients that ring,
// and rough metal that loses its energy.
#include "charts/frames.hpp"
#include "page_table.hpp"
#include "support/choices.hpp"
#include "truth/environment_reference.hpp"

#include "09_environment_light/radiance_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>

namespace gll::stability {
namespace {

using charts::decimals;
using charts::Set;

constexpr const char* environment_rung = "09_environment_light";
constexpr glm::ivec2 environment_size(320, 240);
constexpr std::size_t rough_half = 4; // the ball of roughness 0.5

class EnvironmentStability : public testing::Test {
  protected:
    static void TearDownTestSuite() { table.check(); }

    static void tell(const std::string& method, const std::string& failure, double number, int digits) {
        std::printf("%s: %s %.4f\n", method.c_str(), failure.c_str(), number);
        table.set(method, failure, decimals(number, digits));
    }

    static std::vector<measure::ColorImage> drawn(const std::vector<Set>& sets) {
        charts::Frames frames(folders.programs / environment_rung);
        for (const Set& set : sets)
            frames.ask(set, environment_size, "hdr");
        frames.run();
        std::vector<measure::ColorImage> images;
        for (std::size_t i = 0; i < sets.size(); ++i)
            images.push_back(frames.read(i));
        return images;
    }

    // The sky that is a formula, as a picture.
    static truth::SkyReference smallSun() {
        const environment_light::RadianceMap map = environment_light::smallSun();
        Image image{.width = map.width, .height = map.height, .channels = 3, .pixels = {}};
        std::vector<float> values;
        for (const glm::vec3& pixel : map.pixels)
            values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
        image.pixels = std::move(values);
        return truth::SkyReference(image);
    }

    static inline PageTable table{environment_rung};
};

// All light of the small sun that a ball's visible half gathers, against what it should be.
TEST_F(EnvironmentStability, aSmallSunIsMissedBySamplesAndKeptAsALight) {
    const truth::SkyReference sky = smallSun();
    const std::vector<truth::BallPixel> pixels = truth::ballPixels(rough_half, environment_size, 4);
    double glossy = 0;
    double matt = 0;
    double least_matt = 1e9;
    for (const truth::BallPixel& pixel : pixels) {
        glossy += sky.reflected(pixel.normal, pixel.to_camera, 0.5, 1).g;
        matt += sky.irradiance(pixel.normal).g;
        least_matt = std::min(least_matt, sky.irradiance(pixel.normal).g);
    }
    const Set map{{"sky", "sun"}, {"environment_brdf", "table"}, {"environment_specular", "prefiltered"}};
    struct Method {
        std::string name;
        Set set;
        bool keeps;
    };
    const std::vector<Method> specular = {
        {"specular raw (the original)", map + Set{{"environment_specular", "raw"}}, false},
        {"prefiltered, every sample of the finest level", map + Set{{"prefilter_filtered", "off"}}, false},
        {"prefiltered", map, false},
        {"prefiltered, environment_sun", map + Set{{"environment_sun", "on"}}, true}};
    std::vector<Set> sets;
    for (const Method& method : specular)
        sets.push_back(method.set);
    const std::vector<std::string> diffuse =
        test::choicesOf(folders.programs / environment_rung, "environment_diffuse");
    for (const std::string& name : diffuse)
        sets.push_back({{"sky", "sun"}, {"view", "irradiance"}, {"environment_diffuse", name}});
    const std::vector<measure::ColorImage> images = drawn(sets);
    const char* const kept = "light of a sun of 21 stops, % of the truth";
    for (std::size_t i = 0; i < specular.size(); ++i) {
        double sum = 0;
        for (const truth::BallPixel& pixel : pixels)
            sum += images[i].at(pixel.x, pixel.y).g;
        const double percent = 100 * sum / glossy;
        tell(specular[i].name, kept, percent, 1);
        if (specular[i].keeps) {
            EXPECT_NEAR(percent, 100, 5) << specular[i].name;
        } else {
            EXPECT_GT(std::abs(percent - 100), 5) << specular[i].name << " is " << news;
        }
    }
    for (std::size_t i = 0; i < diffuse.size(); ++i) {
        double sum = 0;
        double least = 1e9;
        double most_off = 0;
        for (const truth::BallPixel& pixel : pixels) {
            const double light = images[specular.size() + i].at(pixel.x, pixel.y).g;
            sum += light;
            least = std::min(least, light);
            most_off = std::max(most_off, std::abs(light - sky.irradiance(pixel.normal).g));
        }
        const std::string name = "diffuse " + diffuse[i] + (diffuse[i] == "raw" ? " (the original)" : "");
        tell(name, kept, 100 * sum / matt, 1);
        tell(name, "worst error on a matt ball, % of the mean truth",
             100 * most_off / (matt / double(pixels.size())), 1);
    }
}

// Band 2 of a light from one direction is below 0 beside it, whatever it adds up to.
TEST_F(EnvironmentStability, coefficientsRingAboutASmallSunAndAWindowTakesThePeakForIt) {
    const environment_light::RadianceMap map = environment_light::smallSun();
    const environment_light::Irradiance whole = environment_light::irradianceCoefficients(map);
    const environment_light::SunAndSky parted = environment_light::withoutSun(map);
    ASSERT_TRUE(parted.sun);
    const environment_light::Irradiance sky = environment_light::irradianceCoefficients(parted.sky);
    const glm::dvec3 to_sun = parted.sun->direction;
    const double truth = parted.sun->irradiance.g;
    struct Method {
        const char* name;
        environment_light::Irradiance coefficients;
        double sun;
    };
    for (const Method& method : {Method{"diffuse sh9", whole, 0},
                                 Method{"diffuse sh9_windowed", environment_light::windowed(whole), 0},
                                 Method{"diffuse sh9_sun", sky, truth}}) {
        double least = 1e9;
        const glm::dvec3 across = glm::normalize(glm::cross(to_sun, glm::dvec3(0, 1, 0)));
        for (int degrees = 0; degrees <= 180; ++degrees) {
            const double angle_rad = degrees * std::numbers::pi / 180;
            const glm::dvec3 normal = std::cos(angle_rad) * to_sun + std::sin(angle_rad) * across;
            least = std::min(least, environment_light::irradianceAt(method.coefficients, normal).g +
                                        method.sun * std::max(glm::dot(normal, to_sun), 0.0));
        }
        const double facing = environment_light::irradianceAt(method.coefficients, to_sun).g + method.sun;
        tell(method.name, "least light before it is clamped, % of the sun's", 100 * least / truth, 2);
        tell(method.name, "facing the sun, % of the truth",
             100 * facing / (truth + environment_light::irradianceAt(sky, to_sun).g), 1);
        if (method.name == std::string("diffuse sh9")) {
            EXPECT_LT(least / truth, -0.03) << news;
        } else {
            EXPECT_GT(least / truth, -0.002) << method.name;
        }
    }
}

TEST_F(EnvironmentStability, roughMetalLosesMostOfItsEnergyUnlessItIsGivenBack) {
    const std::vector<std::string> energies =
        test::choicesOf(folders.programs / environment_rung, "environment_energy");
    const std::vector<std::string> fits = {"table", "karis", "lazarov"};
    std::vector<Set> sets;
    for (const std::string& fit : fits)
        for (const std::string& energy : energies)
            sets.push_back({{"sky", "furnace"},
                            {"environment_brdf", fit},
                            {"environment_energy", energy},
                            {"environment_specular", "prefiltered"},
                            {"environment_diffuse", "sh9"}});
    const std::vector<measure::ColorImage> images = drawn(sets);
    const std::size_t roughest = std::size(environment_light::ball_roughnesses) - 1;
    const std::vector<truth::BallPixel> pixels = truth::ballPixels(roughest, environment_size, 4);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        double sum = 0;
        for (const truth::BallPixel& pixel : pixels)
            sum += images[i].at(pixel.x, pixel.y).g;
        const std::string& energy = energies[i % energies.size()];
        const double percent = 100 * sum / double(pixels.size());
        tell(fits[i / energies.size()] + ", energy " + energy, "white metal of roughness 1 in a furnace, %",
             percent, 1);
        if (energy != "none") {
            EXPECT_NEAR(percent, 100, 0.5) << fits[i / energies.size()];
        } else if (fits[i / energies.size()] == "table") {
            EXPECT_LT(percent, 70) << news;
        }
    }
}

// Which of the axes a direction is longest along, and to which side: the side of a cube that it meets.
int sideOf(const glm::dvec3& direction) {
    const glm::dvec3 length = glm::abs(direction);
    const int axis = length.x >= length.y && length.x >= length.z ? 0 : length.y >= length.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0 ? 1 : 0);
}

// Where u jumps from 1 to 0, where two sides of a cube meet, and where an octahedron is folded.
TEST_F(EnvironmentStability, storedMapsHaveNoSeamAndMirrorsStaySharp) {
    const truth::SkyReference sky(
        truth::SkyReference(loadImage(folders.tutorials.parent_path() / "assets/sky/sky.hdr")).cutAt(8));
    const std::vector<std::string> layouts =
        test::choicesOf(folders.programs / environment_rung, "environment_layout");
    std::vector<Set> sets{{{"environment_brdf", "table"}}};
    for (const std::string& layout : layouts)
        sets.push_back({{"environment_brdf", "table"},
                        {"environment_specular", "prefiltered"},
                        {"environment_layout", layout},
                        {"environment_sun", "on"}});
    for (std::size_t i = 0; i < layouts.size(); ++i)
        sets.push_back(sets[1 + i] + Set{{"view", "radiance"}});
    const std::vector<measure::ColorImage> images = drawn(sets);
    for (std::size_t i = 0; i < layouts.size(); ++i) {
        truth::EnvironmentError mirror;
        for (const truth::BallPixel& pixel : truth::ballPixels(0, environment_size, 2))
            mirror.add(images[1 + i], pixel, images[0].at(pixel.x, pixel.y));
        tell(layouts[i], "a mirror, RMS to the picture itself, %", mirror.rmsPercent(), 2);
        EXPECT_LT(mirror.rmsPercent(), 1) << layouts[i];
        // how much more light changes from a pixel to the next than the lobe's integral does
        double worst = 0;
        double mean = 0;
        int seen = 0;
        for (const std::size_t ball : {rough_half, std::size(environment_light::ball_roughnesses) - 1}) {
            const double roughness = environment_light::ball_roughnesses[ball];
            const std::vector<truth::BallPixel> pixels = truth::ballPixels(ball, environment_size, 1);
            for (std::size_t p = 0; p + 1 < pixels.size(); ++p) {
                const glm::dvec3& one = pixels[p].mirrored;
                const glm::dvec3& other = pixels[p + 1].mirrored;
                const bool crosses = layouts[i] == "cube" ? sideOf(one) != sideOf(other)
                                     : layouts[i] == "octahedral"
                                         ? one.z < 0 && other.z < 0 && (one.x < 0) != (other.x < 0)
                                         : one.x < 0 && (one.z < 0) != (other.z < 0);
                if (!crosses || pixels[p + 1].x != pixels[p].x + 1 || ++seen % 4 != 0) continue;
                const auto step = [&](const truth::BallPixel& from, const truth::BallPixel& to) {
                    const measure::ColorImage& image = images[1 + layouts.size() + i];
                    return image.at(from.x, from.y).g - image.at(to.x, to.y).g;
                };
                const double expected = sky.lobe(one, roughness).g;
                const double off = step(pixels[p], pixels[p + 1]) - (expected - sky.lobe(other, roughness).g);
                worst = std::max(worst, std::abs(off));
                mean = std::max(mean, expected);
            }
        }
        ASSERT_GT(seen, 10) << layouts[i] << ": no seam is seen";
        tell(layouts[i], "largest step at a seam that is not the sky's, % of the light there",
             100 * worst / mean, 2);
        // Between two sides of a cube, texels of the last level are 9 degrees apart, and a line of bilinear
        // means has a bend there.
        EXPECT_LT(worst / mean, layouts[i] == "cube" ? 0.006 : 0.005) << layouts[i];
    }
}

} // namespace
} // namespace gll::stability
