// What of a surface's reflectance does not depend on the light: the second sum of the split-sum
// approximation.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace gll::environment_light {

// A surface of GGX (alpha = roughness^2, height-correlated Smith, Schlick's Fresnel), lit by 1 from all round
// and seen at this cosine to its normal, reflects f0 * x + y (Karis 2013, "Real Shading in Unreal Engine 4").
// cosine and roughness in [0, 1].
glm::dvec2 brdfScaleAndBias(double cosine, double roughness, int samples);

// That for cosines 0 to 1 (columns) and roughnesses 0 to 1 (rows), both ends included: x and y of each in
// turn.
std::vector<float> brdfTable(int size);

} // namespace gll::environment_light
