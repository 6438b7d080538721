// A UV atlas: the mesh cut into nearly flat charts, each projected on its own plane and packed into a square.
// Charts keep one scale and are never mirrored, so texel density varies only with the projection's slant.
#pragma once

#include "mesh.hpp"

namespace bake {

struct Atlas {
    std::vector<Vec2> uvs;                   ///< one a chart vertex, in [0, 1], v = 0 the image's bottom
    std::vector<std::array<int, 3>> corners; ///< indices into `uvs`, in the order of the mesh's triangles
    std::vector<int> chart_of;               ///< the chart of each triangle
    int charts = 0;
    double texels_per_unit = 0.0; ///< at no slant
    double coverage = 0.0;        ///< share of the texels whose centre lies in a triangle
    double worst_slant = 1.0;     ///< smallest cosine between a triangle and its chart's plane
    double mean_slant = 1.0;
};

/// Charts grow by the normal metric of Cohen-Steiner, Alliez and Desbrun, "Variational Shape Approximation",
/// SIGGRAPH 2004; the packing puts each chart's texels, with `gutter` texels round them, where they first
/// fit. Throws std::runtime_error if no scale fits.
Atlas makeAtlas(const Mesh& mesh, int resolution, int gutter);

/// Which triangle covers each texel centre, row 0 at the top; -1 where none does. Throws std::runtime_error
/// if two triangles claim one texel (a centre exactly on a shared edge belongs to the first).
std::vector<int> texelOwners(const Atlas& atlas, int resolution);

} // namespace bake
