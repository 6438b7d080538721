// An equirectangular sky: the analytic daylight of Preetham, a small sun, thin clouds, and a ground they
// light. Direction d maps to u = atan(d.z, d.x) / (2 pi) + 0.5 and v = acos(d.y) / pi, v = 0 the top row.
#include "assets.hpp"
#include "files.hpp"
#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace bake {
namespace {

using glm::dvec3;

constexpr int width = 1024;
constexpr int height = 512;
constexpr double pi = std::numbers::pi;
constexpr double turbidity = 2.6; // a clear day
constexpr double sun_elevation_deg = 50.0;
constexpr double sun_azimuth_deg = 55.0; // from +x towards +z: ahead of the cat, to its left
constexpr double mean_sky_luminance = 0.75;
// What the sun's beam gives a surface facing it over what the sky gives the level ground. A hazy noon:
// clearer skies reach 5, but would take the peak near the largest half float.
constexpr double beam_to_sky = 2.6;
constexpr double sun_radius_deg = 0.60; // the disc's real 0.27, blurred until it covers texels
const dvec3 luminance_weights{0.2126, 0.7152, 0.0722};
const dvec3 sun_color{1.06, 0.995, 0.87}; // luminance 1
const dvec3 ground_albedo{0.215, 0.175, 0.128};

dvec3 sunDirection() {
    const double elevation_rad = glm::radians(sun_elevation_deg);
    const double azimuth_rad = glm::radians(sun_azimuth_deg);
    return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::sin(elevation_rad),
            std::cos(elevation_rad) * std::sin(azimuth_rad)};
}

/// Perez et al. 1993: relative value at an angle from zenith and an angle from the sun.
struct Perez {
    double a, b, c, d, e;
    double operator()(double cos_zenith, double gamma_rad) const {
        const double cos_gamma = std::cos(gamma_rad);
        return (1.0 + a * std::exp(b / cos_zenith)) *
               (1.0 + c * std::exp(d * gamma_rad) + e * cos_gamma * cos_gamma);
    }
};

/// Luminance (unscaled) and colour of the clear sky: Preetham, Shirley and Smits, "A Practical Analytic Model
/// for Daylight", SIGGRAPH 1999, appendix A.2; chromaticity to linear BT.709.
dvec3 clearSky(const dvec3& direction) {
    constexpr double t = turbidity;
    static const Perez perez_luminance{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                                       0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    static const Perez perez_x{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                               -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
    static const Perez perez_y{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                               -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
    constexpr double s = 0.5 * pi - sun_elevation_deg * pi / 180.0; // the sun's angle from zenith
    constexpr double s2 = s * s;
    constexpr double s3 = s2 * s;
    constexpr double zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                                t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                                (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    constexpr double zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                                t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                                (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
    const double cos_zenith = std::max(direction.y, 0.02);
    const double gamma_rad = std::acos(std::clamp(glm::dot(direction, sunDirection()), -1.0, 1.0));
    const double luminance = perez_luminance(cos_zenith, gamma_rad) / perez_luminance(1.0, s);
    const double x = zenith_x * perez_x(cos_zenith, gamma_rad) / perez_x(1.0, s);
    const double y = zenith_y * perez_y(cos_zenith, gamma_rad) / perez_y(1.0, s);
    const dvec3 xyz{luminance * x / y, luminance, luminance * (1.0 - x - y) / y};
    const dvec3 rgb{3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                    -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                    0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
    return glm::max(rgb, dvec3{0.0});
}

/// Clear sky with thin clouds on a plane overhead; noise of the direction, so there is neither seam nor pole.
dvec3 cloudySky(const dvec3& direction) {
    const dvec3 clear = clearSky(direction);
    const double up = std::max(direction.y, 0.0);
    const dvec3 q = dvec3{direction.x, 0.35, direction.z} / (up + 0.22);
    const dvec3 bent = q + 0.35 * dvec3{fractalNoise(q * 1.3, 3, 3), 0.0, fractalNoise(q * 1.3 + 9.0, 3, 5)};
    const double puffs = fractalNoise(bent * dvec3{1.5, 1.0, 2.1}, 6, 7, 0.55);
    const double where = smoothStep(-0.40, 0.12, fractalNoise(q * 0.55, 2, 11));
    const double cover = smoothStep(-0.02, 0.40, puffs) * where * smoothStep(0.02, 0.22, up);
    const double facing_sun = std::max(glm::dot(direction, sunDirection()), 0.0);
    // Forward scattering: a cloud before the sun shines. Thick parts turn grey.
    const double glow = 1.60 + 0.9 * std::pow(facing_sun, 6.0) - 0.30 * smoothStep(0.5, 1.0, cover);
    const dvec3 white = dvec3{1.02, 1.0, 0.97} * glow;
    return glm::mix(clear, white, 0.82 * cover);
}

double luminanceOf(const dvec3& rgb) { return glm::dot(rgb, luminance_weights); }

dvec3 directionOf(double x, double y) {
    const double azimuth_rad = ((x + 0.5) / width - 0.5) * 2.0 * pi;
    const double polar_rad = (y + 0.5) / height * pi;
    return {std::sin(polar_rad) * std::cos(azimuth_rad), std::cos(polar_rad),
            std::sin(polar_rad) * std::sin(azimuth_rad)};
}

double solidAngle(int y) {
    return (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height)) * 2.0 * pi / width;
}

/// The blurred disc: 1 in the middle, 0 from the radius on.
double sunDisc(const dvec3& direction) {
    const dvec3 across = glm::cross(direction, sunDirection());
    if (glm::dot(direction, sunDirection()) <= 0.0) return 0.0;
    const double away_deg = glm::degrees(std::asin(std::min(1.0, glm::length(across))));
    return 1.0 - smoothStep(0.35 * sun_radius_deg, sun_radius_deg, away_deg);
}

/// The disc averaged over a texel, so that its sum does not depend on where texel centres fall.
double sunInTexel(int x, int y) {
    if (sunDisc(directionOf(x, y)) == 0.0 &&
        glm::dot(directionOf(x, y), sunDirection()) < std::cos(glm::radians(sun_radius_deg + 0.6))) {
        return 0.0;
    }
    constexpr int taps = 6;
    double sum = 0.0;
    for (int j = 0; j < taps; ++j) {
        for (int i = 0; i < taps; ++i) {
            sum += sunDisc(directionOf(x + (i + 0.5) / taps - 0.5, y + (j + 0.5) / taps - 0.5));
        }
    }
    return sum / (taps * taps);
}

} // namespace

void bakeSky(const std::filesystem::path& folder) {
    std::vector<dvec3> sky(static_cast<std::size_t>(width) * height);
    const auto at = [](int x, int y) {
        return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    };
    forEachRow(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            sky[at(x, y)] = cloudySky(directionOf(x, y));
    });
    double mean = 0.0;
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; ++x)
            mean += luminanceOf(sky[at(x, y)]) * solidAngle(y) / (2.0 * pi);
    }
    const double scale = mean_sky_luminance / mean;
    for (dvec3& radiance : sky)
        radiance *= scale;

    // Irradiance on level ground, from the sky and from the sun's beam.
    dvec3 from_sky{0.0};
    double disc_solid_angle = 0.0;
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            from_sky += sky[at(x, y)] * solidAngle(y) * directionOf(x, y).y;
            disc_solid_angle += sunInTexel(x, y) * solidAngle(y);
        }
    }
    const double beam = beam_to_sky * luminanceOf(from_sky);
    const dvec3 sun_radiance = sun_color * (beam / disc_solid_angle);
    const dvec3 ground_light = (from_sky + sun_color * beam * sunDirection().y) / pi;

    std::vector<float> rgb(static_cast<std::size_t>(width) * height * 3);
    forEachRow(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const dvec3 d = directionOf(x, y);
            dvec3 radiance = sky[at(x, y)];
            if (d.y < 0.02) {
                // Earth and dry grass, fading into haze towards the horizon.
                const double down = std::max(-d.y, 0.0);
                const dvec3 q = dvec3{d.x, -0.4, d.z} / (down + 0.12);
                const double tone = 0.30 * fractalNoise(q * 1.7, 5, 17) + 0.10 * fractalNoise(q * 9.0, 3, 19);
                dvec3 ground = ground_albedo * ground_light * (1.0 + tone * smoothStep(0.0, 0.15, down));
                const dvec3 haze = clearSky(glm::normalize(dvec3{d.x, 0.03, d.z})) * scale * 0.75;
                ground = glm::mix(haze, ground, smoothStep(0.0, 0.14, down));
                radiance = glm::mix(ground, radiance, smoothStep(-0.012, 0.012, d.y));
            }
            radiance += sun_radiance * sunInTexel(x, y);
            for (int c = 0; c < 3; ++c) {
                rgb[at(x, y) * 3 + static_cast<std::size_t>(c)] = static_cast<float>(radiance[c]);
            }
        }
    });

    double peak = 0.0;
    double whole_mean = 0.0;
    double seam = 0.0;
    double inside = 0.0;
    for (int y = 0; y < height; ++y) {
        const auto luminance = [&](int x) {
            const std::size_t i = at(x, y) * 3;
            return luminanceOf({rgb[i], rgb[i + 1], rgb[i + 2]});
        };
        for (int x = 0; x < width; ++x) {
            if (!std::isfinite(luminance(x)) || luminance(x) < 0.0)
                throw std::runtime_error("sky: a value is not finite");
            peak = std::max(peak, luminance(x));
            whole_mean += luminance(x) * solidAngle(y) / (4.0 * pi);
        }
        seam += std::abs(luminance(0) - luminance(width - 1)) / height;
        inside += std::abs(luminance(1) - luminance(0)) / height;
    }
    std::printf(
        "sky: mean luminance %.3f over the sky without the sun, sun peak %.0f, whole mean %.3f (peak / mean "
        "%.0f), ground %.2f, step across u = 0/1 %.4f (beside it %.4f)\n",
        mean_sky_luminance, peak, whole_mean, peak / whole_mean, luminanceOf(ground_albedo * ground_light),
        seam, inside);
    if (peak < 1000.0 * whole_mean) throw std::runtime_error("sky: the sun is too dim; nothing was written");
    if (peak > 60000.0) throw std::runtime_error("sky: the sun exceeds a half float; nothing was written");
    writeHdr(folder / "sky.hdr", width, height, rgb);
}

} // namespace bake
