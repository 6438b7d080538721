// The scene of 04_pyramid_bloom: a harbour at night. Boxes for what is dark, strokes for what shines.
#pragma once

#include "gl/mesh.hpp"

namespace gll {

// World units are metres; the water is at y = 0, and what it mirrors is drawn below.
//
// Houses, quay, bridge and rock as boxes (locations 0: corner in [-1, 1]; 1: normal; instance 2: centre, 3:
// half of the size, 4: seed of the windows; 0: none, -1: floodlit instead).
struct Boxes {
    Mesh mesh;
    int count = 0;
};
Boxes makeBoxes();

// Everything that shines, each a stroke from a to b with round ends, or a disc where they are the same; the
// farthest first, as light adds up (location 0: corner in [-1, 1]; instance 1: a, 2: b, 3: colour, linear,
// and 4: x radius in metres, y period of its pulse in seconds (0: steady), z phase of it, [0, 1), w share of
// the light that rippled water keeps (0: not mirrored, the lamp itself); 5: the way that it travels in one
// pulse).
struct Strokes {
    Mesh mesh;
    int count = 0;
};
Strokes makeStrokes();

// A square of [0, 1] (location 0).
Mesh makeSquare();

} // namespace gll
