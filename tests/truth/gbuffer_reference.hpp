// What the layouts of a G-buffer leave of a normal, in double, from the papers and not from the shaders; and
// the directions that they are tried on.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace gll::truth {

// Spread evenly over the sphere: points of a golden spiral (Gonzalez 2010, "Measurement of Areas on a Sphere
// Using Fibonacci and Latitude-Longitude Lattices").
inline std::vector<glm::dvec3> spreadDirections(std::size_t count) {
    constexpr double golden_angle = 2.399963229728653;
    std::vector<glm::dvec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * double(i) + 1) / double(count);
        const double around = golden_angle * double(i);
        directions.emplace_back(std::sqrt(1 - z * z) * glm::dvec2(std::cos(around), std::sin(around)), z);
    }
    return directions;
}

inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return 2 * std::asin(std::min(glm::length(a - b) / 2, 1.0)) * 180 / 3.14159265358979324;
}

// Meyer et al. 2010: onto the octahedron |x| + |y| + |z| = 1, whose lower half folds outwards; to [-1, 1]
// squared.
inline glm::dvec2 octahedral(const glm::dvec3& n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const glm::dvec2 p(n.x / sum, n.y / sum);
    if (n.z >= 0) return p;
    return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

inline glm::dvec3 fromOctahedral(const glm::dvec2& p) {
    const double z = 1 - std::abs(p.x) - std::abs(p.y);
    if (z >= 0) return glm::normalize(glm::dvec3(p, z));
    return glm::normalize(
        glm::dvec3(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y), z));
}

// Bits of one of the two numbers; 0: not octahedral.
inline int octahedralBits(const std::string& normals) {
    return normals.starts_with("oct") ? std::stoi(normals.substr(3)) : 0;
}

// Bits a normal takes, those that a format leaves unused not counted.
inline int normalBits(const std::string& normals) {
    if (octahedralBits(normals) != 0) return 2 * octahedralBits(normals);
    if (normals == "rgb8") return 24;
    if (normals == "rgb10") return 30;
    if (normals == "rgba16f") return 48;
    if (normals == "rgba32f") return 96;
    throw std::invalid_argument("no reference for normals=" + normals);
}

// A unit normal in two octahedral numbers of so many codes each. precise: the nearest of the four codes
// around it (Cigolle et al. 2014).
inline glm::dvec3 storedOctahedral(double codes, bool precise, const glm::dvec3& n) {
    const double steps = codes - 1;
    const glm::dvec2 place = (octahedral(n) * 0.5 + 0.5) * steps;
    if (!precise) return fromOctahedral(glm::round(place) / steps * 2.0 - 1.0);
    glm::dvec3 best(0);
    for (const double x : {std::floor(place.x), std::ceil(place.x)})
        for (const double y : {std::floor(place.y), std::ceil(place.y)})
            if (const glm::dvec3 found = fromOctahedral(glm::dvec2(x, y) / steps * 2.0 - 1.0);
                glm::distance(found, n) < glm::distance(best, n))
                best = found;
    return best;
}

// A unit normal as the layout gives it back. Throws std::invalid_argument for a name that it has no formula
// for.
inline glm::dvec3 storedNormal(const std::string& normals, bool precise, const glm::dvec3& n) {
    if (const int bits = octahedralBits(normals)) return storedOctahedral(std::exp2(bits), precise, n);
    if (normals == "rgba32f") return glm::normalize(glm::dvec3(glm::vec3(n)));
    if (normals == "rgba16f") {
        const auto half = [](double v) { return double(glm::unpackHalf1x16(glm::packHalf1x16(float(v)))); };
        return glm::normalize(glm::dvec3(half(n.x), half(n.y), half(n.z)));
    }
    const double steps = normals == "rgb10" ? 1023 : 255;
    if (normalBits(normals) > 30) throw std::invalid_argument("no reference for normals=" + normals);
    return glm::normalize(glm::round((n * 0.5 + 0.5) * steps) / steps * 2.0 - 1.0);
}

struct NormalError {
    double mean_deg = 0;
    double largest_deg = 0;
};

// Of what store(direction) gives back.
template <class Store>
NormalError normalError(const std::vector<glm::dvec3>& directions, const Store& store) {
    NormalError error;
    for (const glm::dvec3& direction : directions) {
        const double degrees = degreesBetween(store(direction), direction);
        error.mean_deg += degrees / double(directions.size());
        error.largest_deg = std::max(error.largest_deg, degrees);
    }
    return error;
}

} // namespace gll::truth
