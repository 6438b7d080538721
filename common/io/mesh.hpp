// Triangle meshes and their materials as plain data, read from OBJ + MTL and from glTF 2.0 (.gltf, .glb).
// What is returned has been checked: indices are in range, every number is finite, image files exist. No
// OpenGL.
#pragma once

#include "io/image.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gll {

// One channel of an image, for images that pack several quantities.
struct ImageChannel {
    ImageSource image;
    int channel = 0; // 0 red to 3 alpha
};

// A metallic-roughness surface. An image's value multiplies its factor; an empty image counts as 1
// everywhere. Colours are linear factors; colour images are sRGB, the others data.
struct MaterialData {
    std::string name;
    glm::vec4 base_colour = glm::vec4(1.0f); // linear, alpha: opacity (its use is the caller's)
    ImageSource base_colour_image;
    glm::vec3 emitted_colour = glm::vec3(0.0f); // linear; glTF's emissive strength is multiplied in
    ImageSource emitted_colour_image;
    // Tangent space: red along +u, green up the image, which is towards *smaller* v (see MeshData::uvs).
    ImageSource normal_image;
    float normal_scale = 1.0f; // of the normal's x and y
    ImageChannel occlusion;    // 1: nothing in the way
    float occlusion_strength = 1.0f;
    float roughness = 1.0f; // 0 to 1
    ImageChannel roughness_image;
    float metallic = 0.0f; // 0 to 1
    ImageChannel metallic_image;
    bool double_sided = false;
};

// Triangles that share a material: indices [first_index, first_index + index_count).
struct MeshPart {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0; // a multiple of 3, never 0
    std::uint32_t material = 0;    // index into MeshData::materials
};

// One mesh in world space, right-handed, y up; front faces counter-clockwise.
// positions, normals and uvs have one element a vertex.
struct MeshData {
    std::vector<glm::vec3> positions; // the file's unit (glTF: metres)
    std::vector<glm::vec3> normals;   // unit length
    // v = 0 is an image's top row, as in Image and in glTF; OBJ's are turned over on reading. Upload Image
    // rows in their order and a texture lookup needs no flip. Where a file has none: zero.
    std::vector<glm::vec2> uvs;
    // Empty if no part of the file has any; else xyz of unit length and w = +-1, or all zero where it has
    // none. bitangent = cross(normal, tangent.xyz) * tangent.w points up the image. Only glTF has tangents.
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> indices; // three a triangle, each < positions.size()
    std::vector<MeshPart> parts;        // one a material that is used; together all indices
    std::vector<MaterialData> materials;
};

// Of each file; glTF: also of all buffers together, and of all embedded images together.
inline constexpr std::size_t max_mesh_file_bytes = std::size_t(256) << 20;
inline constexpr std::size_t max_mesh_vertices = std::size_t(1) << 24;
inline constexpr std::size_t max_mesh_indices = 3 * max_mesh_vertices;
// Of one OBJ polygon; cutting one up takes its corners cubed at worst.
inline constexpr std::size_t max_face_corners = 255;
inline constexpr std::size_t max_json_nesting = 64;
// Of glTF's node hierarchy.
inline constexpr std::size_t max_node_depth = 256;

// Reads a .obj, .gltf or .glb (told by the extension) with its materials. Files named inside must lie in the
// mesh's folder or below it.
//
// OBJ: v, vt, vn, f, usemtl, mtllib; the rest is skipped. Relative indices, polygons (triangulated), CRLF.
// Missing normals are the angle-weighted mean of the faces round the vertex.
//
// glTF: the default scene (without one: the first; without scenes: all root nodes), transforms applied,
// strips and fans as triangles, points and lines skipped. Missing normals are the faces' own, as the
// specification has it. Refused: required extensions (Draco among them), texture coordinates beyond the first
// set, textures that only an extension holds. Not read: skins, morph targets, animations, cameras, lights,
// alpha modes, texture transforms.
//
// Throws std::runtime_error "where: what, what to do"; where is path:line for OBJ and MTL, "path:
// /json/pointer" for glTF, or the path where neither applies.
MeshData loadMesh(const std::filesystem::path& path);

// Reads the materials of an MTL, at least one, in the file's order. Kd, map_Kd: base colour. map_Ka:
// occlusion. Pr, map_Pr: roughness, 1 without Pr. Pm, map_Pm: metallic; without Pm 1 if there is a map, else
// 0. Ke, map_Ke: emitted colour. norm or, without it, map_Bump: a normal map, not heights. "-imfchan r|g|b|m"
// before a file name picks the channel (m: the first). Throws as loadMesh does.
std::vector<MaterialData> loadMtl(const std::filesystem::path& path);

} // namespace gll
