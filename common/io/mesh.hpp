// Triangle meshes and their materials as plain data, read from OBJ + MTL and from glTF 2.0 (.gltf, .glb).
// What is returned has been checked: indices are in range, every number is finite, image files exist. No
// OpenGL.
#pragma once

#include "io/image.hpp"

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gll {

enum class TextureWrap { repeat, mirrored_repeat, clamp_to_edge };

// An image as a surface reads it: which one, where, and how between and beyond its texels.
struct TextureData {
    ImageSource image; // empty: 1 in every channel
    int channel = 0;   // of an image that packs several quantities, for those that are one: 0 red to 3 alpha
    int uv_set = 0;    // 0: MeshData::uvs, 1: MeshData::second_uvs
    // Applied to (u, v, 1) before the look-up (KHR_texture_transform; MTL's -s and -o).
    glm::mat3x2 uv_transform = glm::mat3x2(1.0F);
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool nearest = false; // magnified texels are squares

    bool empty() const { return image.empty(); }
    bool operator==(const TextureData&) const = default;
};

enum class AlphaMode {
    opaque, // alpha means nothing
    mask,   // what has less than alpha_cutoff is not there
    blend,  // alpha mixes with what is behind
};

// A metallic-roughness surface. A texture's value multiplies its factor. Colors are linear factors; color
// images are sRGB, the others data.
struct MaterialData {
    std::string name;
    bool implied = false;                   // the file has none such: what names no material has this one
    glm::vec4 base_color = glm::vec4(1.0F); // linear; alpha: opacity, see alpha_mode
    TextureData base_color_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    glm::vec3 emitted_color = glm::vec3(0.0F); // linear
    TextureData emitted_color_texture;
    // Tangent space: red along +u, green up the image, which is towards *smaller* v (see MeshData::uvs).
    TextureData normal_texture;
    float normal_scale = 1.0F; // of the normal's x and y
    // Heights of the surface, read only where there is no normal texture.
    TextureData height_texture;
    float height_scale = 1.0F;     // what white is higher than black by, in texels of the image
    TextureData occlusion_texture; // 1: nothing in the way
    float occlusion_strength = 1.0F;
    float roughness = 1.0F; // 0 to 1
    TextureData roughness_texture;
    float metallic = 0.0F; // 0 to 1
    TextureData metallic_texture;
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
    std::vector<glm::vec2> second_uvs; // of TextureData::uv_set 1; empty if no texture of the file uses them
    // Linear, 0 to 1, multiplied onto the base color; alpha onto its alpha. Empty if the file has none, else
    // white where it has none.
    std::vector<glm::vec4> colors;
    // Empty if no part of the file has any; else xyz of unit length and w = +-1, or all zero where it has
    // none. bitangent = cross(normal, tangent.xyz) * tangent.w points up the image. Only glTF has tangents.
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> indices; // three a triangle, each < positions.size()
    std::vector<MeshPart> parts;        // one a material that is used; together all indices
    std::vector<MaterialData> materials;
    bool front_is_positive_z = false; // by the format's convention (glTF); OBJ has none
    // What the file asks for and is not drawn, or was mended: "where: what", one line each.
    std::vector<std::string> warnings;
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
// OBJ: v (with r g b: sRGB), vt, vn, f, s, usemtl, mtllib. Relative indices, indices ahead, polygons
// (triangulated), lines that go on after a backslash; LF, CRLF or CR; a byte order mark. Missing normals are
// the angle-weighted mean of the faces of the same smoothing group round the vertex, without a group the
// face's own. A material library, material or texture that is missing, a texture coordinate or normal that
// does not exist, lines, points and free-form surfaces become warnings. Refused: numbers that are none,
// vertices that do not exist, no faces at all.
//
// glTF: the default scene (without one: the first; without scenes: all root nodes), transforms applied,
// strips and fans as triangles. Missing normals are the faces' own, as the specification has it. Only what
// the scene uses is looked at. Read beyond the core: KHR_texture_transform, KHR_mesh_quantization,
// KHR_materials_emissive_strength; cameras never. Said in warnings where the scene has them: skins (the mesh
// is in its own space), morph targets with weights, animations, points and lines, texture coordinates beyond
// the second set, any other extension that changes the picture, images that are missing. Refused: what a file
// requires beyond these, and geometry or images that only Draco, meshopt or another format than PNG and JPEG
// holds. Minification is the renderer's choice, whatever a sampler says.
//
// Throws std::runtime_error "where: what, what to do"; where is path:line for OBJ and MTL, "path:
// /json/pointer" for glTF, or the path where neither applies.
MeshData loadMesh(const std::filesystem::path& path);

// Reads the materials of an MTL, at least one, in the file's order. Kd, map_Kd: base color (linear; without
// both plain grey). map_ao: occlusion. Pr, map_Pr: roughness, 1 without Pr. Pm, map_Pm: metallic; without Pm
// 1 if there is a map, else 0. Ke, map_Ke: emitted color. norm, map_Kn: a normal map. bump, map_Bump:
// heights, -bm their scale. map_d: an alpha mask, if it is map_Kd's image. "-imfchan r|g|b|m" before a file
// name picks the channel (m: the first); -s and -o: uv * s + o; -clamp. What cannot be read or is not drawn
// is appended to the warnings, "path:line: what". Throws as loadMesh does where there is no file or no
// material in it.
std::vector<MaterialData> loadMtl(const std::filesystem::path& path, std::vector<std::string>& warnings);

} // namespace gll
