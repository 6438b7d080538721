// What 09 must arrive at: integrals over every pixel of an environment, in double, and the pixels of its
// balls at which frames are compared with them.
#pragma once

#include "09_environment_light/balls.hpp"
#include "io/image.hpp"
#include "measure/raster.hpp"
#include "rung/camera.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace gll::truth {

inline double luminanceOf(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

class SkyReference {
  public:
    // Floats, three or more channels, equirectangular: u round the y axis from -x over -z, v from +y down.
    explicit SkyReference(const Image& image) : width_(image.width), height_(image.height) {
        const auto& values = std::get<std::vector<float>>(image.pixels);
        for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels))
            pixels_.emplace_back(values[i], values[i + 1], values[i + 2]);
        for (int column = 0; column < width_; ++column)
            around_.emplace_back(std::cos(azimuth(column + 0.5)), std::sin(azimuth(column + 0.5)));
    }

    // As GL_LINEAR reads it, going round.
    glm::dvec3 radiance(const glm::dvec3& direction) const {
        const double u = std::atan2(direction.z, direction.x) / (2 * pi) + 0.5;
        return at(u * width_ - 0.5, std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * height_ - 0.5);
    }

    glm::dvec3 mean() const {
        return integral({0, 1, 0}, 1, [](double) { return 1.0; }) / (4 * pi);
    }

    // Over pi.
    glm::dvec3 irradiance(const glm::dvec3& normal) const {
        return integral(normal, 1, [](double cosine) { return std::max(cosine, 0.0); }) / pi;
    }

    // GGX's lobe (alpha = roughness^2) as if seen along the normal, times the cosine, normalised by itself.
    glm::dvec3 lobe(const glm::dvec3& normal, double roughness) const {
        const double alpha = roughness * roughness;
        double weights = 0;
        const glm::dvec3 sum = integral(
            normal, alpha,
            [&](double cosine) {
                return cosine <= 0 ? 0 : distribution(std::sqrt(0.5 * (1 + cosine)), alpha) / 4 * cosine;
            },
            &weights);
        return sum / weights;
    }

    // Everything that GGX with height-correlated Smith and Schlick's Fresnel reflects once.
    glm::dvec3 reflected(const glm::dvec3& normal, const glm::dvec3& to_camera, double roughness,
                         double f0) const {
        const double alpha = roughness * roughness;
        const double seen = glm::dot(normal, to_camera);
        const glm::dvec3 mirrored = 2 * seen * normal - to_camera;
        return overSphere(
            mirrored, alpha,
            [&](const glm::dvec3& light) {
                const double lit = glm::dot(normal, light);
                if (lit <= 0) return 0.0;
                const glm::dvec3 half = glm::normalize(light + to_camera);
                const double fresnel = f0 + (1 - f0) * std::pow(1 - glm::dot(half, to_camera), 5);
                const double smith =
                    0.5 / (lit * std::sqrt(alpha * alpha + seen * seen * (1 - alpha * alpha)) +
                           seen * std::sqrt(alpha * alpha + lit * lit * (1 - alpha * alpha)));
                return distribution(glm::dot(normal, half), alpha) * smith * fresnel * lit;
            },
            nullptr);
    }

    // Without what is brighter than this: the sky alone, as a picture for --environment.
    Image cutAt(double brightest) const {
        Image image{.width = width_, .height = height_, .channels = 3, .pixels = {}};
        std::vector<float> values;
        for (const glm::dvec3& pixel : pixels_)
            for (int c = 0; c < 3; ++c)
                values.push_back(
                    static_cast<float>(pixel[c] * std::min(1.0, brightest / luminanceOf(pixel))));
        image.pixels = std::move(values);
        return image;
    }

  private:
    static constexpr double pi = std::numbers::pi;

    static double distribution(double cosine, double alpha) {
        const double spread = cosine * cosine * (alpha * alpha - 1) + 1;
        return alpha * alpha / (pi * spread * spread);
    }
    double azimuth(double column) const { return (column / width_ - 0.5) * 2 * pi; }

    glm::dvec3 at(double x, double y) const {
        const double left = std::floor(x);
        const double above = std::floor(y);
        const auto pixel = [&](double column, double row) {
            const int c = static_cast<int>(column - std::floor(column / width_) * width_);
            const int r = std::clamp(static_cast<int>(row), 0, height_ - 1);
            return pixels_[static_cast<std::size_t>(r) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(c)];
        };
        return glm::mix(glm::mix(pixel(left, above), pixel(left + 1, above), x - left),
                        glm::mix(pixel(left, above + 1), pixel(left + 1, above + 1), x - left), y - above);
    }

    glm::dvec3 integral(const glm::dvec3& axis, double alpha, const std::function<double(double)>& weight,
                        double* weights = nullptr) const {
        return overSphere(
            axis, alpha, [&](const glm::dvec3& light) { return weight(glm::dot(axis, light)); }, weights);
    }

    // Sum of radiance, weight and solid angle. Pixels near the axis are divided where the lobe, of a width of
    // alpha, is narrow beside them.
    template <typename Weight>
    glm::dvec3 overSphere(const glm::dvec3& axis, double alpha, const Weight& weight, double* weights) const {
        glm::dvec3 sum(0);
        double all = 0;
        const double pixel_rad = pi / height_;
        const int parts = std::clamp(static_cast<int>(std::ceil(4 * pixel_rad / alpha)), 1, 16);
        const double near = std::cos(std::min(12 * alpha + 2 * pixel_rad, pi));
        for (int row = 0; row < height_; ++row) {
            const double down = (row + 0.5) / height_ * pi;
            const double sine = std::sin(down);
            const double cosine = std::cos(down);
            const double solid_angle =
                (std::cos(row * pi / height_) - std::cos((row + 1) * pi / height_)) * 2 * pi / width_;
            for (int column = 0; column < width_; ++column) {
                const glm::dvec2& turned = around_[static_cast<std::size_t>(column)];
                const glm::dvec3 light(sine * turned.x, cosine, sine * turned.y);
                if (parts == 1 || glm::dot(light, axis) < near) {
                    const double share = weight(light) * solid_angle;
                    all += share;
                    sum += share * pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                           static_cast<std::size_t>(column)];
                    continue;
                }
                for (int part = 0; part < parts * parts; ++part) {
                    const double x = column + (part % parts + 0.5) / parts;
                    const double y = row + (part / parts + 0.5) / parts;
                    const double part_down = y / height_ * pi;
                    const glm::dvec3 there(std::sin(part_down) * std::cos(azimuth(x)), std::cos(part_down),
                                           std::sin(part_down) * std::sin(azimuth(x)));
                    const double share = weight(there) * std::sin(part_down) * pi / height_ * 2 * pi /
                                         width_ / (parts * parts);
                    all += share;
                    sum += share * at(x - 0.5, y - 0.5);
                }
            }
        }
        if (weights != nullptr) *weights = all;
        return sum;
    }

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
inline std::vector<BallPixel> ballPixels(std::size_t ball, glm::ivec2 size, int step, int yaw_deg = 0) {
    Settings settings;
    const OrbitSettings orbit(settings);
    settings.set("camera_yaw_deg=" + std::to_string(yaw_deg));
    const Camera camera = orbit.apply(environment_light::ballsCamera(1));
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const glm::dmat4 world_from_clip =
        glm::inverse(glm::dmat4(camera.clipFromView(aspect)) * glm::dmat4(camera.viewFromWorld()));
    const glm::dvec3 eye(camera.position);
    const glm::dvec3 from_middle = eye - glm::dvec3(environment_light::balls()[ball].middle);
    std::vector<BallPixel> pixels;
    for (int y = step / 2; y < size.y; y += step)
        for (int x = step / 2; x < size.x; x += step) {
            const glm::dvec4 far =
                world_from_clip * glm::dvec4((x + 0.5) / size.x * 2 - 1, 1 - (y + 0.5) / size.y * 2, 1, 1);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(far) / far.w - eye);
            const double along = glm::dot(from_middle, ray);
            const double radius = environment_light::ball_radius;
            const double inside = along * along - glm::dot(from_middle, from_middle) + radius * radius;
            if (inside < 0) continue;
            const glm::dvec3 normal = (from_middle + ray * (-along - std::sqrt(inside))) / radius;
            if (glm::dot(normal, -ray) < 0.1) continue;
            pixels.push_back({x, y, normal, -ray, glm::reflect(ray, normal)});
        }
    return pixels;
}

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
