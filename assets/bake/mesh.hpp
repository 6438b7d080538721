// Triangle meshes from a signed distance: extraction, isotropic remeshing, and the checks a mesh must pass.
// Everything is sequential and ordered by index, so that the same field always gives the same mesh.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "cat_shape.hpp"

namespace bake {

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;                 ///< unit, one a position
    std::vector<std::array<int, 3>> triangles; ///< counter-clockwise seen from outside
};

/// What a mesh is worth, for the self-check and the progress lines.
struct MeshReport {
    int components = 0;
    int euler_characteristic = 0; ///< V - E + F
    double volume = 0.0;          ///< positive if the triangles face outward
    double area = 0.0;
    double min_angle_deg = 0.0;
    Vec3 sharpest_at{0.0};             ///< a corner of the triangle that has it
    double mean_min_angle_deg = 0.0;   ///< mean over the triangles of their smallest angle; 60 is perfect
    double share_below_30_deg = 0.0;   ///< share of the triangles whose smallest angle is below 30 degrees
    double max_surface_distance = 0.0; ///< of the vertices, in statue heights
    double worst_normal_agreement =
        1.0; ///< smallest cosine between a triangle's plane and its vertex normals
};

/// Marching tetrahedra (Doi and Koide, 1991) over cubes of the given edge, six tetrahedra a cube: always
/// closed and manifold if the surface stays inside the box. Only the largest connected part is kept.
Mesh extractSurface(double cell);

/// Isotropic remeshing after Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", SGP
/// 2004: split long edges, collapse short ones, flip, relax along the surface, project back onto it.
/// `target_length` gives the wanted edge length at a point, in statue heights.
Mesh remesh(const Mesh& mesh, const std::function<double(const Vec3&)>& target_length, int rounds);

/// Measures the mesh. Throws std::runtime_error that names the flaw if an edge is not shared by exactly two
/// opposed triangles, a vertex joins several fans, an index is out of range or a number is not finite.
MeshReport inspect(const Mesh& mesh);

} // namespace bake
