// What a glTF file must satisfy before tinygltf may see it. Private to common/io.
// The checks work on the JSON itself, so that every message can name the place as a JSON pointer.
#pragma once

#include "io/image.hpp"

#include <string>
#include <vector>

namespace gll {

// A glTF file whose references, ranges and sizes have all been checked.
struct CheckedGltf {
    // Only what the mesh reader uses, so that the rest (extras of any depth, extensions, animations) meets no
    // parser. Without buffers and images, which are below.
    std::string json;
    std::vector<std::string> buffers; // each at least as long as its byteLength
    std::vector<ImageSource> images;  // by glTF's image index
};

// Reads and checks a .gltf or .glb (told by its first bytes) with the files it names. Throws
// std::runtime_error "path: /json/pointer: what, what to do". Afterwards holds:
// - every index refers to something, every accessor lies in its buffer view, every view in its buffer
// - accessors have at most max_mesh_indices elements, at most 2^20 without a buffer view; view strides fit
// elements
// - attributes are of the types glTF allows, primitives of one mesh agree on their counts
// - numbers are finite as floats; nodes form trees of depth at most max_node_depth
// Index values, sparse positions and float data inside buffers are the reader's to check.
CheckedGltf checkGltf(const std::filesystem::path& path);

} // namespace gll
