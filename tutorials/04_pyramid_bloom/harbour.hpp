// The scene of 04_pyramid_bloom: a harbour at night. Boxes for what is dark, strokes for what shines.
#pragma once

#include "gl/mesh.hpp"

namespace gll::pyramid_bloom {

// A mesh and how many instances it has. World units are metres; the water is at y = 0, and what it mirrors is
// drawn below.
struct Instances {
    Mesh mesh;
    int count = 0;
};

// Houses, quay, bridge and rock as boxes (locations 0: corner in [-1, 1]; 1: normal; instance 2: centre, 3:
// half of the size, 4: seed of the windows; 0: none, -1: floodlit instead).
Instances makeWalls();

// Everything that shines, each a stroke from a to b with round ends, or a disc where they are the same; the
// farthest first (location 0: corner in [-1, 1]; instance 1: a, 2: b, 3: colour, linear, 4: x radius in
// metres, y period in seconds of its pulse, or, where negative, of its travel (0: it stands still), z phase
// in [0, 1), w 1 for a streak on the water; 5: how far it travels in one period).
Instances makeLamps();

// A square of [0, 1] (location 0).
Mesh makeSquare();

} // namespace gll::pyramid_bloom
