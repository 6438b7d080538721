// Simple solids as triangles, for what rungs add to the scene.
#pragma once

#include "scene.hpp"

namespace gll::gbuffer {

// An object without triangles: matt, of this linear color.
PlainObject plain(glm::vec3 color);

// A flat quadrilateral, its corners counter-clockwise as seen from outside.
void addQuad(PlainObject& object, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);

// A box between two corners, its sides along the axes.
void addBox(PlainObject& object, glm::vec3 low, glm::vec3 high);

// A ball of this radius about its middle; v runs from the top down.
void addBall(PlainObject& object, glm::vec3 middle, float radius);

} // namespace gll::gbuffer
