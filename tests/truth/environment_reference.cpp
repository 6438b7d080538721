// Sums over every pixel of a sky. Compiled with optimisation, whoever uses it.
#include "truth/environment_reference.hpp"

#include "rung/camera.hpp"

#include <algorithm>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>

namespace gll::truth {
namespace {

constexpr double pi = std::numbers::pi;

double distribution(double cosine, double alpha) {
    const double spread = cosine * cosine * (alpha * alpha - 1) + 1;
    return alpha * alpha / (pi * spread * spread);
}

} // namespace

SkyReference::SkyReference(const Image& image) : width_(image.width), height_(image.height) {
    const auto& values = std::get<std::vector<float>>(image.pixels);
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(image.channels))
        pixels_.emplace_back(values[i], values[i + 1], values[i + 2]);
    for (int column = 0; column < width_; ++column)
        around_.emplace_back(std::cos(azimuth(column + 0.5)), std::sin(azimuth(column + 0.5)));
}

double SkyReference::azimuth(double column) const { return (column / width_ - 0.5) * 2 * pi; }

glm::dvec3 SkyReference::at(double x, double y) const {
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

// Sum of radiance, weight and solid angle. Pixels near the axis are divided where the lobe, of a width of
// alpha, is narrow beside them.
template <typename Weight>
glm::dvec3 SkyReference::overSphere(const glm::dvec3& axis, double alpha, const Weight& weight,
                                    double* weights) const {
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
                const double share =
                    weight(there) * std::sin(part_down) * pi / height_ * 2 * pi / width_ / (parts * parts);
                all += share;
                sum += share * at(x - 0.5, y - 0.5);
            }
        }
    }
    if (weights != nullptr) *weights = all;
    return sum;
}

glm::dvec3 SkyReference::radiance(const glm::dvec3& direction) const {
    const double u = std::atan2(direction.z, direction.x) / (2 * pi) + 0.5;
    return at(u * width_ - 0.5, std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * height_ - 0.5);
}

glm::dvec3 SkyReference::irradiance(const glm::dvec3& normal) const {
    return overSphere(
               normal, 1, [&](const glm::dvec3& light) { return std::max(glm::dot(normal, light), 0.0); },
               nullptr) /
           pi;
}

glm::dvec3 SkyReference::lobe(const glm::dvec3& normal, double roughness) const {
    const double alpha = roughness * roughness;
    double weights = 0;
    const glm::dvec3 sum = overSphere(
        normal, alpha,
        [&](const glm::dvec3& light) {
            const double cosine = glm::dot(normal, light);
            return cosine <= 0 ? 0 : distribution(std::sqrt(0.5 * (1 + cosine)), alpha) / 4 * cosine;
        },
        &weights);
    return sum / weights;
}

glm::dvec3 SkyReference::reflected(const glm::dvec3& normal, const glm::dvec3& to_camera, double roughness,
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
            const double smith = 0.5 / (lit * std::sqrt(alpha * alpha + seen * seen * (1 - alpha * alpha)) +
                                        seen * std::sqrt(alpha * alpha + lit * lit * (1 - alpha * alpha)));
            return distribution(glm::dot(normal, half), alpha) * smith * fresnel * lit;
        },
        nullptr);
}

Image SkyReference::cutAt(double brightest) const {
    Image image{.width = width_, .height = height_, .channels = 3, .pixels = {}};
    std::vector<float> values;
    for (const glm::dvec3& pixel : pixels_)
        for (int c = 0; c < 3; ++c)
            values.push_back(static_cast<float>(pixel[c] * std::min(1.0, brightest / luminanceOf(pixel))));
    image.pixels = std::move(values);
    return image;
}

std::vector<BallPixel> ballPixels(std::size_t ball, glm::ivec2 size, int step, int yaw_deg) {
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

} // namespace gll::truth
