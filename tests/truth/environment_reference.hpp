// What 09 must arrive at: integrals over every pixel of an environment, in double, and the pixels of its
// balls at which frames are compared with them.
#pragma once

#include "09_environment_light/balls.hpp"
#include "io/image.hpp"
#include "measure/raster.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace gll::truth {

inline double luminanceOf(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

class SkyReference {
  public:
    // Floats, three or more channels, equirectangular: u round the y axis from -x over -z, v from +y down.
    explicit SkyReference(const Image& image);

    // As GL_LINEAR reads it, going round.
    glm::dvec3 radiance(const glm::dvec3& direction) const;

    glm::dvec3 irradiance(const glm::dvec3& normal) const; // over pi

    // GGX's lobe (alpha = roughness^2) as if seen along the normal, times the cosine, normalised by itself.
    glm::dvec3 lobe(const glm::dvec3& normal, double roughness) const;

    // Everything that GGX with height-correlated Smith and Schlick's Fresnel reflects once.
    glm::dvec3 reflected(const glm::dvec3& normal, const glm::dvec3& to_camera, double roughness,
                         double f0) const;

    // Without what is brighter than this: the sky alone, as a picture for --environment.
    Image cutAt(double brightest) const;

  private:
    double azimuth(double column) const;
    glm::dvec3 at(double x, double y) const;
    template <typename Weight>
    glm::dvec3 overSphere(const glm::dvec3& axis, double alpha, const Weight& weight, double* weights) const;

    int width_, height_;
    std::vector<glm::dvec3> pixels_;
    std::vector<glm::dvec2> around_; // cosine and sine of each column's azimuth
};

// A pixel that shows a ball of the first row, metal that absorbs nothing.
struct BallPixel {
    int x, y;
    glm::dvec3 normal, to_camera, mirrored;
};

// Every step-th pixel of one ball of 09 in frame 60 at this size, none of them at its very rim.
std::vector<BallPixel> ballPixels(std::size_t ball, glm::ivec2 size, int step, int yaw_deg = 0);

// How far a frame is off at pixels whose truth is known, relative to the mean truth.
struct EnvironmentError {
    double squares = 0, sum = 0, truth = 0;
    int count = 0;

    void add(const measure::ColorImage& frame, const BallPixel& pixel, const glm::dvec3& expected) {
        const auto& color = frame.at(pixel.x, pixel.y);
        const double off = luminanceOf({color.r, color.g, color.b}) - luminanceOf(expected);
        squares += off * off;
        sum += off;
        truth += luminanceOf(expected);
        ++count;
    }
    double rmsPercent() const { return 100 * std::sqrt(squares / count) / (truth / count); }
    double biasPercent() const { return 100 * sum / truth; }
};

} // namespace gll::truth
