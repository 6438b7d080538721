// A picture of the light from all round, and what is integrated over it: nine coefficients of irradiance, the
// sun by itself, and what a glossy surface mirrors. All on the CPU, without OpenGL.
#pragma once

#include "io/image.hpp"
#include "rung/warnings.hpp"

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace gll::environment_light {

// Radiance, linear and finite, by latitude and longitude: u goes round the y axis from -x over -z, v from +y
// down.
struct RadianceMap {
    int width = 1;
    int height = 1;
    std::vector<glm::vec3> pixels = {glm::vec3(0)}; // row 0 at the top

    const glm::vec3& at(int column, int row) const {
        return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
};

// From a file's pixels: grey is taken for all three channels, what is below 0 is 0, and nothing is above the
// largest half float, of which a warning says how much light that takes. Throws std::runtime_error naming the
// path for 8-bit pixels, cube maps, and values that are not a number.
RadianceMap radianceMap(const Image& image, const std::filesystem::path& path, Warnings& warnings);

glm::dvec3 directionOf(double u, double v);
double solidAngle(const RadianceMap& map, int row); // of a pixel there, steradians

// The map and its halves down to a single pixel, each pixel weighed by its solid angle. In halves, rows near
// the poles are also averaged along themselves until what a pixel stands for is as wide as it is high:
// elsewhere a level says how coarse it is, and there it would say so only for one of the two directions.
std::vector<RadianceMap> mipChain(const RadianceMap& map);

// Bilinear, going round in u and stopping at the poles in v.
glm::vec3 lookUp(const RadianceMap& map, glm::vec2 uv);
glm::vec2 uvOf(glm::vec3 direction);

// Irradiance over pi, so that a white matt surface shows it as its radiance, as a polynomial of the normal
// n = (x, y, z), in the order 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2: the spherical harmonics of order 2
// with their constants multiplied in (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for
// Irradiance Environment Maps"). Integrated in double over each pixel's true solid angle.
using Irradiance = std::array<glm::dvec3, 9>;
Irradiance irradianceCoefficients(const RadianceMap& map);
glm::dvec3 irradianceAt(const Irradiance& coefficients, glm::dvec3 normal);

// The same, smoothed by no more than it takes until no normal sees light below 0: band l is divided by
// 1 + k l^2 (l + 1)^2, which costs the least roughness for what it keeps (Sloan 2008, "Stupid Spherical
// Harmonics (SH) Tricks", on windowing).
Irradiance windowed(const Irradiance& coefficients);

// The brightest compact light of a map, and the map without it.
struct Sun {
    glm::dvec3 direction{0, 1, 0}; // of the middle of its light, unit length
    glm::dvec3 irradiance{0};      // over pi, of a surface that faces it
    double mean_squared_angle = 0; // of its light from the middle, radians squared
};
struct SunAndSky {
    std::optional<Sun> sun; // none where nothing within 3 degrees is ten times as bright as the map's mean
    RadianceMap sky;
};
SunAndSky withoutSun(const RadianceMap& map);

// What is integrated for one texel of a prefiltered map: the radiance about a normal, weighed by GGX's lobe
// (alpha = roughness^2) as if seen along the normal, and by the cosine (Karis 2013, "Real Shading in Unreal
// Engine 4"). That is one function of the angle to the normal: relative here, and its integral.
double lobe(double cosine, double roughness);
double lobeIntegral(double roughness, double least_cosine = 0); // over directions of that cosine and more

struct Prefilter {
    int samples = 64;
    bool filtered = true; // each sample reads the level of the chain that is as coarse as samples lie apart
    bool has_sun = true;  // what a few pixels hold most light of wants samples that overlap
};

// One texel for each normal, of a map by its chain.
std::vector<glm::vec3> prefiltered(const std::vector<RadianceMap>& chain,
                                   const std::vector<glm::vec3>& normals, double roughness,
                                   const Prefilter& prefilter);
// The same for the normals of a map of this size.
std::vector<glm::vec3> prefiltered(const std::vector<RadianceMap>& chain, glm::ivec2 size, double roughness,
                                   const Prefilter& prefilter);

// Octahedral maps of size x size texels: those at the rim stand on the rim, so that a lower level's edge is
// the same directions. Texel by texel, rows from the bottom.
std::vector<glm::vec3> octahedralDirections(int size);
// Cube maps of six sides of size x size texels, in the order of their pixels in a Texture.
std::vector<glm::vec3> cubeDirections(int size);

} // namespace gll::environment_light
