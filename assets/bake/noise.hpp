// Noise from integer hashes: the same bits on every machine with IEEE doubles, tileable where asked for.
// Lengths are in lattice cells; callers scale their coordinates.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace bake {

/// A hash of three lattice coordinates and a seed: rounds of the PCG output permutation after Jarzynski and
/// Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// The hash as a number in [0, 1).
double hashUnit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// Gradient noise after Perlin, "Improving Noise", SIGGRAPH 2002; about [-1, 1], mean 0. A `period` above 0
/// in an axis makes the lattice repeat after that many cells.
double gradientNoise(const glm::dvec3& p, std::uint32_t seed, const glm::ivec3& period = glm::ivec3{0});

/// Octaves of gradient noise, each twice as fine and `gain` as strong as the one before; about [-1, 1].
double fractalNoise(const glm::dvec3& p, int octaves, std::uint32_t seed, double gain = 0.5,
                    const glm::ivec3& period = glm::ivec3{0});

struct CellNoise {
    double nearest; ///< distance to the nearest feature point
    double second;  ///< distance to the second nearest
    double id;      ///< a number in [0, 1) that belongs to the nearest point
};

/// One feature point a cell, after Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996.
CellNoise cellNoise(const glm::dvec3& p, std::uint32_t seed, const glm::ivec3& period = glm::ivec3{0});

/// Hermite step: 0 below `low`, 1 above `high`.
double smoothStep(double low, double high, double x);

} // namespace bake
