// Colour spaces from their standards' definitions; matrices are derived here, not typed.
#include "measure/color.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace gll::measure {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr glm::dvec2 d65_xy(0.3127, 0.3290);

glm::dvec3 xyzOf(const glm::dvec2& xy) { return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y}; }

// SMPTE RP 177: the primaries' XYZ, scaled so that R = G = B = 1 is the white.
glm::dmat3 xyzFromPrimaries(const glm::dvec2& red, const glm::dvec2& green, const glm::dvec2& blue) {
    const glm::dmat3 primaries(xyzOf(red), xyzOf(green), xyzOf(blue));
    const glm::dvec3 scales = glm::inverse(primaries) * xyzOf(d65_xy);
    return {primaries[0] * scales[0], primaries[1] * scales[1], primaries[2] * scales[2]};
}

// SMPTE ST 2084: PQ's signal in [0, 1] for light in cd/m^2.
double pqSignal(double light_cd_m2) {
    constexpr double peak_cd_m2 = 10000;
    constexpr double m1 = 2610 / 16384.0;
    constexpr double m2 = 2523 / 4096.0 * 128;
    constexpr double c1 = 3424 / 4096.0;
    constexpr double c2 = 2413 / 4096.0 * 32;
    constexpr double c3 = 2392 / 4096.0 * 32;
    const double y = std::pow(std::max(light_cd_m2, 0.0) / peak_cd_m2, m1);
    return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}

// Below this a colour's direction is rounding: 1e-9 of the axes' range.
std::optional<double> angleBetween(const glm::dvec2& one, const glm::dvec2& other, double range) {
    if (glm::length(one) < 1e-9 * range || glm::length(other) < 1e-9 * range) return std::nullopt;
    const double cross = one.x * other.y - one.y * other.x;
    return std::abs(std::atan2(cross, glm::dot(one, other))) * degrees;
}

} // namespace

double srgbEncoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgbDecoded(double display) {
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

double luminance709(const glm::dvec3& linear_color) {
    return glm::dot(linear_color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

const glm::dmat3& xyzFromBt709() {
    static const glm::dmat3 matrix = xyzFromPrimaries({0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060});
    return matrix;
}

const glm::dmat3& bt709FromXyz() {
    static const glm::dmat3 matrix = glm::inverse(xyzFromBt709());
    return matrix;
}

const glm::dmat3& xyzFromBt2020() {
    static const glm::dmat3 matrix = xyzFromPrimaries({0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046});
    return matrix;
}

glm::dvec3 cieLab(const glm::dvec3& linear_color) {
    const glm::dvec3 relative = xyzFromBt709() * linear_color / xyzOf(d65_xy);
    constexpr double delta = 6 / 29.0;
    const auto f = [](double t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4 / 29.0;
    };
    const double fy = f(relative.y);
    return {116 * fy - 16, 500 * (f(relative.x) - fy), 200 * (fy - f(relative.z))};
}

glm::dvec3 ictcp(const glm::dvec3& linear_color, double white_cd_m2) {
    static const glm::dmat3 bt2020_from_bt709 = glm::inverse(xyzFromBt2020()) * xyzFromBt709();
    const glm::dvec3 c = bt2020_from_bt709 * linear_color * white_cd_m2;
    const double l = pqSignal((1688 * c.r + 2146 * c.g + 262 * c.b) / 4096);
    const double m = pqSignal((683 * c.r + 2951 * c.g + 462 * c.b) / 4096);
    const double s = pqSignal((99 * c.r + 309 * c.g + 3688 * c.b) / 4096);
    return {(l + m) / 2, (6610 * l - 13613 * m + 7003 * s) / 4096, (17933 * l - 17390 * m - 543 * s) / 4096};
}

// Names and steps of Sharma, Wu, Dalal 2005, equations 2 to 22.
double deltaE2000(const glm::dvec3& lab, const glm::dvec3& other_lab) {
    const auto seventh = [](double c) { return std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)); };
    const auto cosDeg = [](double angle_deg) { return std::cos(angle_deg / degrees); };
    const double mean_chroma = (std::hypot(lab.y, lab.z) + std::hypot(other_lab.y, other_lab.z)) / 2;
    const double a_scale = 1 + 0.5 * (1 - std::sqrt(seventh(mean_chroma)));

    const double a1 = lab.y * a_scale;
    const double a2 = other_lab.y * a_scale;
    const double c1 = std::hypot(a1, lab.z);
    const double c2 = std::hypot(a2, other_lab.z);
    const auto hueDeg = [](double a, double b) {
        const double angle_deg = a == 0 && b == 0 ? 0 : std::atan2(b, a) * degrees;
        return angle_deg < 0 ? angle_deg + 360 : angle_deg;
    };
    const double h1 = hueDeg(a1, lab.z);
    const double h2 = hueDeg(a2, other_lab.z);

    const bool grey = c1 * c2 == 0;
    double hue_step = grey ? 0 : h2 - h1;
    if (hue_step > 180) hue_step -= 360;
    if (hue_step < -180) hue_step += 360;
    const double delta_l = other_lab.x - lab.x;
    const double delta_c = c2 - c1;
    const double delta_h = 2 * std::sqrt(c1 * c2) * std::sin(hue_step / 2 / degrees);

    const double mean_l = (lab.x + other_lab.x) / 2;
    const double mean_c = (c1 + c2) / 2;
    double mean_h = grey ? h1 + h2 : (h1 + h2) / 2;
    if (!grey && std::abs(h1 - h2) > 180) mean_h += h1 + h2 < 360 ? 180 : -180;

    const double t = 1 - 0.17 * cosDeg(mean_h - 30) + 0.24 * cosDeg(2 * mean_h) +
                     0.32 * cosDeg(3 * mean_h + 6) - 0.20 * cosDeg(4 * mean_h - 63);
    const double l_term = (mean_l - 50) * (mean_l - 50);
    const double s_l = 1 + 0.015 * l_term / std::sqrt(20 + l_term);
    const double s_c = 1 + 0.045 * mean_c;
    const double s_h = 1 + 0.015 * mean_c * t;
    const double turn = (mean_h - 275) / 25;
    const double rotation_deg = 30 * std::exp(-turn * turn);
    const double r_t = -std::sin(2 * rotation_deg / degrees) * 2 * std::sqrt(seventh(mean_c));
    const double l = delta_l / s_l;
    const double c = delta_c / s_c;
    const double h = delta_h / s_h;
    return std::sqrt(std::max(l * l + c * c + h * h + r_t * c * h, 0.0));
}

double deltaEItp(const glm::dvec3& itp, const glm::dvec3& other_itp) {
    return 720 * glm::length((itp - other_itp) * glm::dvec3(1, 0.5, 1));
}

ColorDifference colorDifference(const glm::dvec3& linear_color, const glm::dvec3& other_linear_color,
                                double white_cd_m2) {
    const glm::dvec3 lab = cieLab(linear_color);
    const glm::dvec3 other_lab = cieLab(other_linear_color);
    const glm::dvec3 itp = ictcp(linear_color, white_cd_m2);
    const glm::dvec3 other_itp = ictcp(other_linear_color, white_cd_m2);
    return {.delta_e_itp = deltaEItp(itp, other_itp),
            .delta_e_2000 = deltaE2000(lab, other_lab),
            .ictcp_hue_deg = angleBetween({itp.y / 2, itp.z}, {other_itp.y / 2, other_itp.z}, 1),
            .lab_hue_deg = angleBetween({lab.y, lab.z}, {other_lab.y, other_lab.z}, 100),
            .ictcp_intensity = itp.x - other_itp.x,
            .lab_lightness = lab.x - other_lab.x};
}

} // namespace gll::measure
