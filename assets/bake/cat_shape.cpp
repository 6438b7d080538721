// The sculpture: ellipsoids, capsules and round cones joined by smooth unions, carved by smooth subtractions.
// Primitives and smooth minimum after Inigo Quilez, "distance functions" and "smooth minimum",
// iquilezles.org.
#include "cat_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

double ellipsoid(const Vec3& p, const Vec3& radii) {
    const double k0 = glm::length(p / radii);
    const double k1 = glm::length(p / (radii * radii));
    return k1 < 1e-9 ? -std::min({radii.x, radii.y, radii.z}) : k0 * (k0 - 1.0) / k1;
}

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
    const Vec3 pa = p - a;
    const Vec3 ba = b - a;
    const double h = std::clamp(glm::dot(pa, ba) / glm::dot(ba, ba), 0.0, 1.0);
    return glm::length(pa - ba * h) - radius;
}

double roundCone(const Vec3& p, const Vec3& a, const Vec3& b, double radius_a, double radius_b) {
    const Vec3 ba = b - a;
    const double l2 = glm::dot(ba, ba);
    const double rr = radius_a - radius_b;
    const double a2 = l2 - rr * rr;
    const double il2 = 1.0 / l2;
    const Vec3 pa = p - a;
    const double y = glm::dot(pa, ba);
    const double z = y - l2;
    const Vec3 across = pa * l2 - ba * y;
    const double x2 = glm::dot(across, across);
    const double y2 = y * y * l2;
    const double z2 = z * z * l2;
    const double k = (rr > 0.0 ? 1.0 : -1.0) * rr * rr * x2;
    if ((z > 0.0 ? 1.0 : -1.0) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - radius_b;
    if ((y > 0.0 ? 1.0 : -1.0) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - radius_a;
    return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - radius_a;
}

double smoothUnion(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k * 0.25;
}

double smoothIntersection(double a, double b, double k) { return -smoothUnion(-a, -b, k); }

double smoothCut(double a, double cutter, double k) { return smoothIntersection(a, -cutter, k); }

Vec3 mirrored(const Vec3& p) { return {std::abs(p.x), p.y, p.z}; }

Vec3 turnedY(const Vec3& p, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
}

Vec3 turnedX(const Vec3& p, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

Vec3 turnedZ(const Vec3& p, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

/// One ear in the head's frame (mirrored half): a flattened cone, hollowed by a smaller one from the front.
double ear(const Vec3& head_point) {
    Vec3 p = head_point - Vec3{0.066, 0.058, -0.014};
    p = turnedZ(p, 0.24); // lean outward
    p = turnedX(p, 0.08); // lean a little forward
    p = turnedY(p, 0.50); // the opening looks forward and outward
    const double flatness = 0.58;
    const Vec3 flat{p.x, p.y, p.z / flatness};
    const double shell = roundCone(flat, {0.0, 0.0, 0.0}, {0.006, 0.126, -0.014}, 0.064, 0.011);
    const Vec3 hollow_point{p.x, p.y, (p.z - 0.031) / flatness};
    const double hollow = roundCone(hollow_point, {0.0, 0.012, 0.0}, {0.006, 0.098, -0.012}, 0.046, 0.006);
    return smoothCut(shell * 0.75, hollow * 0.75, 0.010);
}

/// The head's masses, before eyes and mouth are cut.
double skull(const Vec3& p) {
    const Vec3 m = mirrored(p);
    double d = ellipsoid(p - Vec3{0.0, 0.012, -0.015}, {0.110, 0.096, 0.112});
    d = smoothUnion(d, ellipsoid(m - Vec3{0.058, -0.030, 0.022}, {0.054, 0.048, 0.058}), 0.05);      // cheeks
    d = smoothUnion(d, ellipsoid(p - Vec3{0.0, -0.036, 0.082}, {0.052, 0.040, 0.050}), 0.04);        // muzzle
    d = smoothUnion(d, roundCone(p, {0.0, 0.046, 0.066}, {0.0, -0.012, 0.122}, 0.030, 0.017), 0.03); // bridge
    d = smoothUnion(d, capsule(m, {0.022, 0.038, 0.080}, {0.072, 0.054, 0.054}, 0.014), 0.028);      // brow
    d = smoothUnion(d, ellipsoid(m - Vec3{0.021, -0.044, 0.112}, {0.025, 0.020, 0.023}),
                    0.010);                                                                    // whisker pads
    d = smoothUnion(d, ellipsoid(p - Vec3{0.0, -0.071, 0.096}, {0.024, 0.017, 0.024}), 0.012); // chin
    d = smoothUnion(d, ellipsoid(p - Vec3{0.0, -0.019, 0.131}, {0.018, 0.011, 0.011}), 0.006); // nose
    return d;
}

/// The skull's front surface at (x, y) of the head's frame.
Vec3 onFace(double x, double y) {
    Vec3 p{x, y, 0.2};
    for (int i = 0; i < 200; ++i)
        p.z -= 0.8 * skull(p);
    return p;
}

/// Distance to a line of capsules drawn on the face.
template <std::size_t count>
double drawn(const Vec3& p, const std::array<Vec3, count>& line, double radius) {
    double d = 1e9;
    for (std::size_t i = 0; i + 1 < count; ++i)
        d = std::min(d, capsule(p, line[i], line[i + 1], radius));
    return d;
}

/// The head around its own centre, looking along +z.
double head(const Vec3& p) {
    static const std::array upper_lid{onFace(0.018, -0.004), onFace(0.026, 0.015), onFace(0.036, 0.025),
                                      onFace(0.048, 0.030),  onFace(0.061, 0.029), onFace(0.073, 0.024),
                                      onFace(0.084, 0.020),  onFace(0.094, 0.022)};
    static const std::array lower_lid{onFace(0.018, -0.004), onFace(0.030, -0.009), onFace(0.043, -0.008),
                                      onFace(0.056, -0.003), onFace(0.068, 0.006),  onFace(0.078, 0.018)};
    static const std::array mouth{onFace(0.0, -0.028), onFace(0.001, -0.053), onFace(0.012, -0.062),
                                  onFace(0.028, -0.062), onFace(0.044, -0.052)};
    static const Vec3 eye = onFace(0.049, 0.011);
    const Vec3 m = mirrored(p);
    double d = smoothUnion(skull(p), ear(m), 0.022);
    // The eye: a hollow between the lids, an eyeball that fills it but for a groove, and two lids round it.
    const Vec3 e = turnedY(turnedZ(m - eye, -0.34), 0.58);
    d = smoothCut(d, ellipsoid(e - Vec3{0.002, 0.0, 0.004}, {0.030, 0.0200, 0.012}), 0.008);
    d = smoothUnion(d, ellipsoid(e - Vec3{-0.001, 0.0, -0.0200}, {0.038, 0.028, 0.0235}), 0.006);
    d = smoothCut(d, ellipsoid(e - Vec3{0.002, 0.0, 0.005}, {0.0062, 0.0135, 0.0060}), 0.004); // pupil
    d = smoothUnion(d, drawn(m, upper_lid, 0.0040), 0.012);
    d = smoothUnion(d, drawn(m, lower_lid, 0.0028), 0.010);
    d = smoothCut(d, drawn(m, mouth, 0.0036), 0.006);
    return d;
}

/// Tail: round cones along a curve that leaves the rump, follows the right flank and ends on the front paws.
double tail(const Vec3& p) {
    struct Knot {
        Vec3 position;
        double radius;
    };
    static constexpr std::array<Knot, 9> knots{{
        {{-0.040, 0.085, -0.270}, 0.050},
        {{0.040, 0.056, -0.345}, 0.050},
        {{0.160, 0.041, -0.325}, 0.047},
        {{0.250, 0.038, -0.215}, 0.044},
        {{0.294, 0.036, -0.070}, 0.042},
        {{0.290, 0.035, 0.090}, 0.041},
        {{0.226, 0.034, 0.236}, 0.039},
        {{0.120, 0.032, 0.316}, 0.036},
        {{0.012, 0.034, 0.330}, 0.027},
    }};
    constexpr int pieces_per_span = 6;
    static const auto pieces = [] {
        std::array<Knot, (knots.size() - 1) * pieces_per_span + 1> line{};
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::size_t span = std::min(i / pieces_per_span, knots.size() - 2);
            const double t = static_cast<double>(i - span * pieces_per_span) / pieces_per_span;
            const auto knot = [](std::size_t k) { return knots[std::min(k, knots.size() - 1)]; };
            const Knot a = knot(span > 0 ? span - 1 : 0);
            const Knot b = knot(span);
            const Knot c = knot(span + 1);
            const Knot d = knot(span + 2);
            // Catmull-Rom.
            const double w0 = ((-t + 2.0) * t - 1.0) * t * 0.5;
            const double w1 = ((3.0 * t - 5.0) * t * t + 2.0) * 0.5;
            const double w2 = ((-3.0 * t + 4.0) * t + 1.0) * t * 0.5;
            const double w3 = (t - 1.0) * t * t * 0.5;
            line[i].position = w0 * a.position + w1 * b.position + w2 * c.position + w3 * d.position;
            line[i].radius = w0 * a.radius + w1 * b.radius + w2 * c.radius + w3 * d.radius;
        }
        return line;
    }();
    double d = 1e9;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        d = std::min(d, roundCone(p, pieces[i].position, pieces[i + 1].position, pieces[i].radius,
                                  pieces[i + 1].radius));
    }
    return d;
}

/// A paw at the origin of its own frame, toes along +z.
double paw(const Vec3& p, double width) {
    double d = ellipsoid(p - Vec3{0.0, 0.030, 0.0}, {width, 0.036, 0.062});
    for (int toe = 0; toe < 4; ++toe) {
        const double across = (static_cast<double>(toe) - 1.5) / 1.5;
        const Vec3 centre{across * width * 0.66, 0.024, 0.046 - 0.016 * across * across};
        d = smoothUnion(d, ellipsoid(p - centre, {width * 0.29, 0.025, 0.028}), 0.006);
    }
    return d;
}

double body(const Vec3& p) {
    const Vec3 m = mirrored(p);
    // Trunk: hips, loin, ribs, shoulders, neck; a chain whose back draws the S curve.
    double d = ellipsoid(p - Vec3{0.0, 0.165, -0.155}, {0.160, 0.180, 0.165});
    d = smoothUnion(d, roundCone(p, {0.0, 0.240, -0.135}, {0.0, 0.420, -0.040}, 0.148, 0.128), 0.08);
    d = smoothUnion(d, roundCone(p, {0.0, 0.420, -0.030}, {0.0, 0.545, 0.030}, 0.128, 0.100), 0.06);
    d = smoothUnion(d, roundCone(p, {0.0, 0.550, 0.035}, {0.0, 0.740, 0.055}, 0.090, 0.068), 0.07);
    // Breast: the proud front of the chest.
    d = smoothUnion(d, ellipsoid(p - Vec3{0.0, 0.465, 0.082}, {0.088, 0.130, 0.088}), 0.06);
    // Haunches: thigh with a knee that stands out from the flank.
    double thigh = ellipsoid(turnedX(m - Vec3{0.132, 0.165, -0.085}, 0.30), {0.088, 0.155, 0.176});
    thigh = smoothUnion(thigh, ellipsoid(m - Vec3{0.168, 0.150, 0.020}, {0.060, 0.105, 0.085}), 0.05);
    d = smoothUnion(d, thigh, 0.030);
    // Hind feet.
    const Vec3 hind = turnedY(m - Vec3{0.172, 0.0, 0.085}, -0.14);
    d = smoothUnion(
        d, smoothUnion(paw(hind, 0.050), capsule(hind, {0.0, 0.032, -0.10}, {0.0, 0.030, 0.0}, 0.036), 0.02),
        0.022);
    // Shoulders and front legs.
    double leg = ellipsoid(turnedX(m - Vec3{0.085, 0.440, 0.060}, -0.20), {0.058, 0.125, 0.085});
    leg = smoothUnion(leg, roundCone(m, {0.078, 0.400, 0.095}, {0.066, 0.215, 0.150}, 0.058, 0.043), 0.03);
    leg = smoothUnion(leg, roundCone(m, {0.066, 0.215, 0.150}, {0.064, 0.055, 0.160}, 0.043, 0.036), 0.0005);
    leg = smoothUnion(leg, paw(m - Vec3{0.065, 0.0, 0.190}, 0.047), 0.022);
    d = smoothUnion(d, leg, 0.028);
    return d;
}

} // namespace

double catDistance(const Vec3& position) {
    constexpr double head_scale = 1.10;
    constexpr double head_reach = 0.30; // of the ear tips, from the head's centre
    constexpr double head_blend = 0.030;
    constexpr double tail_top = 0.15;
    constexpr double tail_blend = 0.022;
    double d = body(position);
    // Parts too far away to reach into the blend are not asked: three quarters of the time.
    const Vec3 from_head = position - Vec3{0.0, 0.800, 0.085};
    if (glm::length(from_head) - head_reach < d + head_blend) {
        Vec3 head_point = from_head / head_scale;
        head_point = turnedY(head_point, 0.16); // looks a little to its left, over the tail
        head_point = turnedX(head_point, -0.03);
        d = smoothUnion(d, head(head_point) * head_scale, head_blend);
    }
    if (position.y - tail_top < d + tail_blend) d = smoothUnion(d, tail(position), tail_blend);
    // The base: cut by the ground, with a worn edge.
    return smoothIntersection(d, -position.y, 0.012);
}

namespace {

/// The gradient times 4 `step`.
Vec3 scaledGradient(const Vec3& position, double step) {
    static constexpr std::array<Vec3, 4> corners{
        {{1.0, -1.0, -1.0}, {-1.0, -1.0, 1.0}, {-1.0, 1.0, -1.0}, {1.0, 1.0, 1.0}}};
    Vec3 sum{0.0};
    for (const Vec3& corner : corners)
        sum += corner * catDistance(position + corner * step);
    return sum;
}

} // namespace

Vec3 catNormal(const Vec3& position, double step) { return glm::normalize(scaledGradient(position, step)); }

Vec3 projectToCat(Vec3 position) {
    constexpr double step = 5e-4;
    for (int i = 0; i < 10; ++i) {
        const double distance = catDistance(position);
        if (std::abs(distance) < 1e-6) break;
        const Vec3 gradient = scaledGradient(position, step) / (4.0 * step);
        // On a crease the gradient is short: never step further than twice the distance.
        position -= gradient * distance / std::max(glm::dot(gradient, gradient), 0.25);
    }
    return position;
}

} // namespace bake
