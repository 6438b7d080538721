// What is true of ambient occlusion: rays all round against the triangles, or against what the screen shows
// of them.
#pragma once

#include "measure/raster.hpp"
#include "rung/camera.hpp"
#include "truth/rays.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace gll::truth {

// The triangles of a scene of 08_ssao: "cat" (needs the project's assets), "room" or "corner".
std::unique_ptr<RayScene> occlusionScene(std::string_view name);

// A pixel of the screen.
struct SeenPoint {
    bool is_surface = false;
    glm::vec3 position{0}; // world
    glm::vec3 normal{0};   // of the triangle, world, unit length
};

// depth: as the depth target of a frame holds it, [0, 1], 1 where there is nothing; normals: octahedral.
std::vector<SeenPoint> seenPoints(const Camera& camera, const measure::ColorImage& depth,
                                  const Image& normals);

// The screen as a surface of its own: neighbouring pixels joined, as if what is seen went on behind, but for
// those that are farther apart than `longest` (world units): all that a method can know.
std::unique_ptr<RayScene> heightField(const std::vector<SeenPoint>& points, int width, float longest);

// The share of a matt surface's light from all round that nothing nearer than `radius` (world units) is in
// the way of, [0, 1]: cosine-weighted, by `rays` rays, evenly spread and turned from pixel to pixel. 1 where
// there is no surface.
std::vector<float> trueVisibility(const RayScene& scene, const std::vector<SeenPoint>& points, float radius,
                                  int rays);

// The same at a distance (world units) from where two endless planes meet at a right angle, exactly.
double cornerVisibility(double distance, double radius);

} // namespace gll::truth
