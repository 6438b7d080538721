// Noise from integer hashes: gradient noise, its octaves, and cells.
// No floating-point hash anywhere: sin()-based ones differ between machines.
#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

std::uint32_t permute(std::uint32_t v) {
    v = v * 747796405u + 2891336453u;
    const std::uint32_t word = ((v >> ((v >> 28u) + 4u)) ^ v) * 277803737u;
    return (word >> 22u) ^ word;
}

std::int32_t wrapped(std::int32_t i, int period) {
    if (period <= 0) return i;
    const std::int32_t r = i % period;
    return r < 0 ? r + period : r;
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

/// Perlin's twelve edge directions, four of them twice, so that the hash's low bits choose without a
/// division.
constexpr std::array<glm::dvec3, 16> directions{{{1, 1, 0},
                                                 {-1, 1, 0},
                                                 {1, -1, 0},
                                                 {-1, -1, 0},
                                                 {1, 0, 1},
                                                 {-1, 0, 1},
                                                 {1, 0, -1},
                                                 {-1, 0, -1},
                                                 {0, 1, 1},
                                                 {0, -1, 1},
                                                 {0, 1, -1},
                                                 {0, -1, -1},
                                                 {1, 1, 0},
                                                 {-1, 1, 0},
                                                 {0, -1, 1},
                                                 {0, -1, -1}}};

double mix(double a, double b, double t) { return a + (b - a) * t; }

} // namespace

std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    std::uint32_t h = permute(static_cast<std::uint32_t>(x) + seed);
    h = permute(h + static_cast<std::uint32_t>(y));
    return permute(h + static_cast<std::uint32_t>(z));
}

double hashUnit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    return hash(x, y, z, seed) * (1.0 / 4294967296.0);
}

double gradientNoise(const glm::dvec3& p, std::uint32_t seed, const glm::ivec3& period) {
    const double fx = std::floor(p.x);
    const double fy = std::floor(p.y);
    const double fz = std::floor(p.z);
    const double x = p.x - fx;
    const double y = p.y - fy;
    const double z = p.z - fz;
    const std::int32_t x0 = wrapped(static_cast<std::int32_t>(fx), period.x);
    const std::int32_t y0 = wrapped(static_cast<std::int32_t>(fy), period.y);
    const std::int32_t z0 = wrapped(static_cast<std::int32_t>(fz), period.z);
    const std::int32_t x1 = wrapped(x0 + 1, period.x);
    const std::int32_t y1 = wrapped(y0 + 1, period.y);
    const std::int32_t z1 = wrapped(z0 + 1, period.z);
    const double u = fade(x);
    const double v = fade(y);
    const double w = fade(z);
    // hash(), its rounds shared between the corners.
    const auto round = [](std::uint32_t h, std::int32_t c) {
        return permute(h + static_cast<std::uint32_t>(c));
    };
    const std::uint32_t h0 = permute(static_cast<std::uint32_t>(x0) + seed);
    const std::uint32_t h1 = permute(static_cast<std::uint32_t>(x1) + seed);
    const std::uint32_t h00 = round(h0, y0);
    const std::uint32_t h10 = round(h1, y0);
    const std::uint32_t h01 = round(h0, y1);
    const std::uint32_t h11 = round(h1, y1);
    const auto corner = [&](std::uint32_t h, std::int32_t cz, double dx, double dy, double dz) {
        const glm::dvec3& d = directions[round(h, cz) & 15u];
        return d.x * dx + d.y * dy + d.z * dz;
    };
    const double bottom =
        mix(mix(corner(h00, z0, x, y, z), corner(h10, z0, x - 1.0, y, z), u),
            mix(corner(h01, z0, x, y - 1.0, z), corner(h11, z0, x - 1.0, y - 1.0, z), u), v);
    const double above = z - 1.0;
    const double top =
        mix(mix(corner(h00, z1, x, y, above), corner(h10, z1, x - 1.0, y, above), u),
            mix(corner(h01, z1, x, y - 1.0, above), corner(h11, z1, x - 1.0, y - 1.0, above), u), v);
    return mix(bottom, top, w);
}

double fractalNoise(const glm::dvec3& p, int octaves, std::uint32_t seed, double gain,
                    const glm::ivec3& period) {
    double sum = 0.0;
    double weight = 1.0;
    double weights = 0.0;
    int scale = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        const auto octave_seed = seed + 1013u * static_cast<std::uint32_t>(octave);
        sum += weight * gradientNoise(p * static_cast<double>(scale), octave_seed, period * scale);
        weights += weight;
        weight *= gain;
        scale *= 2;
    }
    return sum / weights;
}

CellNoise cellNoise(const glm::dvec3& p, std::uint32_t seed, const glm::ivec3& period) {
    const glm::dvec3 base = glm::floor(p);
    const auto bx = static_cast<std::int32_t>(base.x);
    const auto by = static_cast<std::int32_t>(base.y);
    const auto bz = static_cast<std::int32_t>(base.z);
    double nearest2 = 1e9;
    double second2 = 1e9;
    double id = 0.0;
    for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const std::uint32_t h = hash(wrapped(bx + i, period.x), wrapped(by + j, period.y),
                                             wrapped(bz + k, period.z), seed);
                const glm::dvec3 jitter{(h & 1023u) / 1024.0, ((h >> 10u) & 1023u) / 1024.0,
                                        ((h >> 20u) & 1023u) / 1024.0};
                const glm::dvec3 to = base + glm::dvec3{i, j, k} + jitter - p;
                const double distance2 = glm::dot(to, to);
                if (distance2 < nearest2) {
                    second2 = nearest2;
                    nearest2 = distance2;
                    id = permute(h) * (1.0 / 4294967296.0);
                } else {
                    second2 = std::min(second2, distance2);
                }
            }
        }
    }
    return {std::sqrt(nearest2), std::sqrt(second2), id};
}

double smoothStep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace bake
