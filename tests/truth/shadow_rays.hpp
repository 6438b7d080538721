// What is true of shadows: rays to the sun against the same triangles (Embree), and how far a rung's shadows
// are off.
#pragma once

#include "measure/raster.hpp"
#include "truth/rays.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace gll::truth {

// A shadow map's sun, as 07_shadow_map's fixed view has it.
struct SunTruth {
    glm::vec3 to_sun;     // world, unit length
    float texel = 0;      // of the map, world units
    int filter_width = 1; // of the comparisons averaged, texels
};

// What rays say of a pixel: shares of the sun that is seen, 0 to 1.
struct TrueShadow {
    bool counts = false;  // a surface that the sun may reach
    float slope_deg = 0;  // between its normal and the sun
    float hard = 1;       // one ray
    float filtered = 1;   // over the map's filter, moved along the surface's plane: what no bias would change
    bool all_lit = false; // or dark, wherever that filter looks and half a texel beyond
    bool all_dark = false;
    float blocker = 0; // distance to what blocks the sun, world units; 0 where nothing does
};

// positions: world, (0, 0, 0) where there is nothing; normals: octahedral, as the G-buffer stores them in 16
// bits.
std::vector<TrueShadow> trueShadows(const RayScene& scene, const SunTruth& sun,
                                    const measure::ColorImage& positions, const Image& normals);

// Sums of several frames' errors; each kind of error is counted among the pixels that can have it.
class ShadowErrors {
  public:
    // Pixels whose slope is in [from, to) degrees.
    void add(const std::vector<TrueShadow>& truth, const SunTruth& sun, const measure::ColorImage& visible,
             float from_deg = 0, float to_deg = 85);

    // Lit wherever the filter looks, and darker than 0.99 in the frame: surfaces that shade themselves,
    // percent.
    double acnePercent() const;
    // Dark wherever the filter looks, and lighter than 0.01: light behind what casts the shadow, percent.
    double leakPercent() const;
    // How far from where a shadow touches what casts it light leaks in, as the sun sees it, texels: what 99 %
    // of the leaking pixels stay within.
    double gapTexels() const;
    double rmseToFilter() const;
    double rmseToHard() const;

  private:
    std::size_t lit_ = 0, acne_ = 0, dark_ = 0, count_ = 0;
    std::vector<float> gaps_;
    double squares_filtered_ = 0, squares_hard_ = 0;
};

} // namespace gll::truth
