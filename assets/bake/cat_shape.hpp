// The seated cat as a signed distance field: one function of a point, and what follows from it.
// Units are statue heights (the ear tips stand near y = 1), y is up, the cat looks along +z, it sits on y =
// 0.
#pragma once

#include <glm/glm.hpp>

namespace bake {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// Signed distance to the statue's surface at `position`, negative inside. A bound rather than the exact
/// distance (ellipsoids and smooth unions are not exact), so a ray marcher steps by 0.7 of it.
double catDistance(const Vec3& position);

/// Outward unit normal: the field's gradient by the tetrahedron technique, over `step` statue heights.
Vec3 catNormal(const Vec3& position, double step = 5e-4);

/// The nearest surface point found by a few Newton steps along the gradient.
Vec3 projectToCat(Vec3 position);

/// A box that holds the whole statue with some air around it.
inline constexpr Vec3 cat_box_min{-0.40, -0.06, -0.48};
inline constexpr Vec3 cat_box_max{0.44, 1.08, 0.48};

} // namespace bake
