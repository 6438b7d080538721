// The blooms that are compared, and how far each is from exact convolution.
#pragma once

#include "charts/bloom_methods.hpp"

namespace gll::charts {

// Blurs are compared at one width only, and its second moment is its measure: that of the recommended splines
// of three, four and five levels. Five are the rungs' default, so at their width methods compete.
inline constexpr double widths_px[] = {5.87, 10.0, 17.6};
inline constexpr double compared_width_px = widths_px[2];
inline constexpr const char* recommended = "recommended";

struct ComparedBloom : BloomMethod {
    std::string dial = {};
    std::string mark = {};
    double width_px = 0; // one of widths_px, or an original's own
    int period_px = 32;  // the response repeats when the light moves by so much
    int levels = 0;      // of a pyramid

    bool competes() const { return width_px == compared_width_px; }
    bool finestAdds() const { return has("finest", "on"); }
    // What of a light of 1 is in its bloom. Pyramids only add, so that each level has all of it.
    double gain() const { return addingLevels(levels); }
};

// All on equal terms: everything blooms, no weight against fireflies, half floats; and the pyramids both
// ways, with and without the light of their largest level.
std::vector<ComparedBloom> comparedBlooms();

inline std::string key(const ComparedBloom& method) { return method.name + ", " + method.dial; }

struct BloomErrors {
    double sigma_px = 0;
    double shift_variance = 0;
    double inner_energy_error = 0; // of lights far from the edges
    double energy_error = 0;       // of all
    double rounding = 0;           // of the recommended, what of its light exact arithmetic does not explain
    double squareness = 0;
    double flip[3] = {};     // mean HDR-FLIP to the exact convolution: swarm, lights, hall
    double mixture_flip = 0; // lights, to the convolution with Gaussians as wide as the levels should be
};

// Renders all of them, which takes minutes; one result a bloom.
std::vector<BloomErrors> bloomErrors(const std::filesystem::path& programs,
                                     const std::vector<ComparedBloom>& blooms);

} // namespace gll::charts
