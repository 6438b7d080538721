// Rays against triangles (Embree): what tests of the deferred rungs hold for true.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

namespace gll::truth {

// Triangles to shoot rays at, in world space.
class RayScene {
  public:
    RayScene(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    // How far along a unit vector the nearest triangle is, world units; infinity where there is none. What is
    // nearer than 0.0005 is taken for the surface itself.
    float distance(glm::vec3 origin, glm::vec3 direction) const;

    // Whether a triangle is nearer than `far` along a unit vector, and farther than 0.0005.
    bool isBlocked(glm::vec3 origin, glm::vec3 direction, float far) const;

  private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

// The unit vector that octahedral.glsl stores as two numbers in [0, 1].
glm::vec3 directionFromOctahedral(glm::dvec2 stored);

} // namespace gll::truth
