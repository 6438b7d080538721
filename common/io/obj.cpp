// Reads OBJ. tinyobjloader reads numbers, indices, colors and smoothing groups; before it each statement is
// checked, with its line, for what it would take without a word: "nan" as 0, "3x" as 3, an index of 20 digits
// as -1, a polygon of 256 corners as one of none. What it should not see is blanked in its text. It takes one
// word of a material's name, so materials are told here. Polygons are cut up here too: its ear test measures
// from the origin and drops faces that lie badly to it.
#include "io/mesh_build.hpp"
#include "io/polygon.hpp"
#include "io/statements.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gll {
namespace {

// The text of an OBJ, left with what tinyobjloader reads without surprises, and what else it says.
class ObjText {
  public:
    explicit ObjText(const std::filesystem::path& path)
        : text(readFile(path, max_mesh_file_bytes)), path_(path), name_(path.string()) {
        forEachStatement(text, name_, [&](const Statement& s) { check(s); });
        if (counts[0] == 0) throw fileError(name_, "has no vertices, export the mesh again");
        if (face_materials.empty() && dropped_.count > 0)
            throw fileError(at(dropped_.line),
                            "a face of " + std::to_string(dropped_.corners) + " corners, 3 to " +
                                std::to_string(max_face_corners) + " are drawn; none of the faces (" +
                                std::to_string(dropped_.count) + ") can be, export them as triangles");
        if (face_materials.empty())
            throw fileError(name_, undrawn_.empty() ? "has no faces, export the mesh again"
                                                    : "has no faces, only " + undrawn_ +
                                                          ", which is not drawn; export it as polygons");
        if (greatest_[0].index > counts[0])
            refuseVertex(std::to_string(greatest_[0].index), greatest_[0].line);
        resolveMaterials();
    }

    // Of a texture coordinate (1) or normal (2) that faces name and the file does not have.
    void noteMissing(std::size_t kind, std::size_t line, std::size_t times = 1) {
        notes.add(at(line), std::string(kinds[kind]) + " that does not exist is left out", times);
    }
    std::size_t lineOfGreatest(std::size_t kind) const { return greatest_[kind].line; }

    std::string text;
    std::array<std::size_t, 3> counts{};       // v, vt, vn
    std::vector<std::uint32_t> face_materials; // one a face, in the text's order
    std::vector<MaterialData> materials;
    Notes notes;

  private:
    static constexpr std::array kinds = {"a vertex", "a texture coordinate", "a normal"};
    struct Dropped {
        std::size_t count = 0, corners = 0, line = 0; // the last two of the first one
    };
    struct Greatest {
        std::size_t index = 0, line = 0;
    };

    std::string at(std::size_t line) const { return name_ + ":" + std::to_string(line); }
    char* inText(std::string_view part) { return text.data() + (part.data() - text.data()); }
    void blank(std::string_view part) {
        if (!part.empty()) std::fill_n(inText(part), part.size(), ' ');
    }

    void check(const Statement& s) {
        if (s.keyword == "v") return checkNumbers(s, 0, 3, 3);
        if (s.keyword == "vt") return checkNumbers(s, 1, 1, 2);
        if (s.keyword == "vn") return checkNumbers(s, 2, 3, 3);
        if (s.keyword == "f") return checkFace(s);
        if (s.keyword == "s") {
            if (s.rest == "on") std::copy_n(" 1", 2, inText(s.rest));
            return;
        }
        if (s.keyword == "mtllib") readLibraries(s);
        if (s.keyword == "usemtl") {
            const auto [known, is_new] = slots_.emplace(s.rest, static_cast<std::uint32_t>(used_.size()));
            if (is_new) used_.push_back({std::string(s.rest), s.line_number});
            material_ = known->second;
        }
        static const std::set<std::string_view> undrawn = {"l",   "p",   "curv", "curv2", "surf",
                                                           "bzp", "bsp", "cdc",  "cdp",   "call"};
        if (undrawn.contains(s.keyword)) {
            notes.add(s.where(), inQuotes(s.keyword) + " is not drawn");
            undrawn_ = inQuotes(s.keyword);
        }
        blank(s.keyword);
        blank(s.rest);
    }

    // Weights and third texture coordinates do not matter; of colors see vertexColors().
    void checkNumbers(const Statement& s, std::size_t kind, std::size_t least, std::size_t most) {
        std::string_view rest = s.rest;
        for (std::size_t i = 0; i < most; ++i) {
            const std::string_view word = nextWord(rest);
            if (word.empty() && i >= least) break;
            parseNumber(word, s);
        }
        if (++counts[kind] > max_mesh_vertices)
            throw fileError(s.where(), "more than " + std::to_string(max_mesh_vertices) + " vertices");
    }

    void checkFace(const Statement& s) {
        std::string_view rest = s.rest;
        std::size_t corners = 0;
        for (std::string_view corner = nextWord(rest); !corner.empty(); corner = nextWord(rest)) {
            if (corner.front() == '#') {
                blank({corner.data(), s.rest.data() + s.rest.size()});
                break;
            }
            checkCorner(corner, s);
            ++corners;
        }
        if (corners < 3 || corners > max_face_corners) {
            notes.add(s.where(), "a face of " + std::to_string(corners) + " corners is not drawn, 3 to " +
                                     std::to_string(max_face_corners) + " are");
            if (dropped_.count++ == 0) dropped_ = {1, corners, s.line_number};
            blank(s.keyword);
            return blank(s.rest);
        }
        triangles_ += corners - 2;
        if (triangles_ > max_mesh_indices / 3)
            throw fileError(s.where(), "more than " + std::to_string(max_mesh_indices / 3) + " triangles");
        face_materials.push_back(material_);
    }

    // "v", "v/vt", "v//vn" or "v/vt/vn", written anew where not all of it counts.
    void checkCorner(std::string_view corner, const Statement& s) {
        std::array<std::string_view, 3> words;
        std::string_view rest = corner;
        for (std::size_t i = 0;; ++i) {
            if (i == words.size()) throw fileError(s.where(), "a corner has more than three indices");
            const std::size_t slash = rest.find('/');
            words[i] = rest.substr(0, slash);
            if (slash == std::string_view::npos) break;
            rest.remove_prefix(slash + 1);
        }
        bool mended = corner.ends_with('/');
        for (std::size_t i = 0; i < words.size(); ++i)
            if ((i == 0 || !words[i].empty()) && !counted(words[i], i, s)) {
                words[i] = {};
                mended = true;
            }
        if (!mended) return;
        std::string anew(words[0]);
        if (!words[1].empty() || !words[2].empty()) anew.append("/").append(words[1]);
        if (!words[2].empty()) anew.append("/").append(words[2]);
        anew.resize(corner.size(), ' ');
        std::copy(anew.begin(), anew.end(), inText(corner));
    }

    // "-1" is the last one so far and must exist already; "1", the first, may come after its face. False
    // where a texture coordinate or a normal does not exist.
    bool counted(std::string_view word, std::size_t kind, const Statement& s) {
        long long index = 0;
        const auto parsed = std::from_chars(word.data(), word.data() + word.size(), index);
        if (parsed.ec == std::errc::invalid_argument || parsed.ptr != word.data() + word.size())
            throw fileError(s.where(), inQuotes(word) + " is no index of " + kinds[kind]);
        if (index == 0 || index < -static_cast<long long>(counts[kind]) ||
            index > static_cast<long long>(max_mesh_vertices)) {
            if (kind == 0) refuseVertex(word, s.line_number);
            noteMissing(kind, s.line_number);
            return false;
        }
        const auto positive = static_cast<std::size_t>(std::max(index, 0LL));
        if (positive > greatest_[kind].index) greatest_[kind] = {positive, s.line_number};
        return true;
    }

    [[noreturn]] void refuseVertex(std::string_view word, std::size_t line) const {
        throw fileError(at(line), "vertex index " + inQuotes(word) + " is not among the " +
                                      std::to_string(counts[0]) + ", export the mesh again");
    }

    // "mtllib one.mtl two.mtl", or a single name with blanks in it.
    void readLibraries(const Statement& s) {
        std::error_code failure;
        std::string_view rest = s.rest;
        if (std::filesystem::is_regular_file(path_.parent_path() / std::string(rest), failure))
            return readLibrary(rest, s);
        rest = withoutComment(rest);
        while (!rest.empty()) {
            const std::size_t end = lowerCase(rest).find(".mtl ");
            readLibrary(trimmed(rest.substr(0, end == std::string::npos ? end : end + 4)), s);
            rest.remove_prefix(end == std::string::npos ? rest.size() : end + 4);
        }
        if (s.rest.empty()) readLibrary("", s);
    }

    void readLibrary(std::string_view name, const Statement& s) {
        const std::filesystem::path library =
            namedFile(std::string(name), "material library", path_.parent_path(), s, notes);
        if (!library.empty() && !libraries_.insert(library).second)
            return; // named twice: exporters repeat it for every object
        const bool read = !library.empty() && notes.attempt(s.where(), [&] {
            for (MaterialData& material : readMtl(library, notes))
                materials.push_back(std::move(material));
        });
        library_missing_ = library_missing_ || !read;
    }

    // From the names that faces use to materials, the first of a name; one more where there is none.
    void resolveMaterials() {
        std::map<std::string_view, std::uint32_t> numbers;
        for (std::size_t i = 0; i < materials.size(); ++i)
            numbers.emplace(materials[i].name, static_cast<std::uint32_t>(i));
        for (std::size_t i = 0; i < materials.size(); ++i)
            numbers.emplace(withoutComment(materials[i].name), static_cast<std::uint32_t>(i));
        const auto plain = static_cast<std::uint32_t>(materials.size());
        std::vector<std::uint32_t> of_slot;
        for (const Used& used : used_) {
            auto found = numbers.find(used.name);
            if (found == numbers.end()) found = numbers.find(withoutComment(used.name));
            of_slot.push_back(found == numbers.end() ? plain : found->second);
            if (found == numbers.end() && used.line > 0 && !library_missing_)
                notes.add(at(used.line), "material " + inQuotes(used.name) +
                                             " is in no material library, drawn in plain grey");
        }
        for (std::uint32_t& material : face_materials)
            material = of_slot[material];
        if (std::find(face_materials.begin(), face_materials.end(), plain) == face_materials.end()) return;
        materials.emplace_back().name = "default";
        materials.back().implied = true;
        materials.back().base_color = glm::vec4(glm::vec3(plain_grey), 1.0F);
    }

    struct Used {
        std::string name;
        std::size_t line;
    };

    const std::filesystem::path& path_;
    std::string name_;
    std::array<Greatest, 3> greatest_;
    std::size_t triangles_ = 0;
    std::uint32_t material_ = 0;
    std::vector<Used> used_ = {{"", 0}}; // before any usemtl there is none
    std::map<std::string, std::uint32_t, std::less<>> slots_;
    std::set<std::filesystem::path> libraries_;
    bool library_missing_ = false;
    std::string undrawn_;
    Dropped dropped_;
};

// A vertex of the result is one combination of an OBJ's three index spaces and of what shades it: 0 a normal
// of its own, n > 0 smoothing group n, -n the n-th face.
struct Corner {
    int position, uv, normal;
    std::int64_t shading;
    bool operator==(const Corner&) const = default;
};
struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t h = static_cast<std::uint32_t>(c.position);
        h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint32_t>(c.uv);
        h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint32_t>(c.normal);
        h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint64_t>(c.shading);
        return static_cast<std::size_t>(h ^ (h >> 29));
    }
};

// Linear, from "v x y z r g b", which exporters write in sRGB, some in 0 to 255. Empty where all are white.
std::vector<glm::vec4> vertexColors(const std::vector<tinyobj::real_t>& rgb, const std::string& where,
                                    Notes& notes) {
    const float largest = *std::max_element(rgb.begin(), rgb.end());
    const float scale = largest > 2.0F ? 1.0F / 255.0F : 1.0F;
    if (largest > 2.0F) notes.add(where, "vertex colors above 1 are read as 0 to 255");
    std::vector<glm::vec4> colors(rgb.size() / 3, glm::vec4(1.0F));
    bool any = false;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const float srgb = std::min(std::max(0.0F, rgb[i] * scale), 1.0F); // and 0 for what is no number
        any = any || srgb != 1.0F;
        colors[i / 3][static_cast<int>(i % 3)] =
            srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
    }
    return any ? colors : std::vector<glm::vec4>();
}

} // namespace

MeshData loadObj(const std::filesystem::path& path) {
    ObjText obj(path);

    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> unused_materials;
    std::string unused_warning;
    std::string error;
    std::istringstream stream(std::move(obj.text));
    constexpr bool triangulate = false;
    const bool read = tinyobj::LoadObj(&attributes, &shapes, &unused_materials, &unused_warning, &error,
                                       &stream, nullptr, triangulate);
    const std::size_t faces = shapes.empty() ? 0 : shapes[0].mesh.num_face_vertices.size();
    if (!read || shapes.size() != 1 || faces != obj.face_materials.size() ||
        attributes.vertices.size() != obj.counts[0] * 3 || attributes.colors.size() != obj.counts[0] * 3 ||
        attributes.texcoords.size() != obj.counts[1] * 2 || attributes.normals.size() != obj.counts[2] * 3)
        throw fileError(path.string(), "cannot be read (" + error.substr(0, error.find('\n')) + ")");
    const tinyobj::mesh_t& shape = shapes[0].mesh;

    const auto at3 = [](const std::vector<tinyobj::real_t>& v, int i) {
        const std::size_t k = static_cast<std::size_t>(i) * 3;
        return glm::vec3(v.at(k), v.at(k + 1), v.at(k + 2));
    };
    // Three corners a triangle; the triangle's face; and the faces' own normals.
    std::vector<Corner> corners;
    std::vector<std::uint32_t> triangle_faces;
    std::vector<glm::vec3> face_normals(faces);
    std::array<std::size_t, 3> missing{};
    const auto existing = [&](int index, std::size_t kind) {
        if (index < 0 || static_cast<std::size_t>(index) < obj.counts[kind]) return std::max(index, -1);
        ++missing[kind];
        return -1;
    };
    bool smoothed = false;
    std::size_t first = 0;
    for (std::size_t face = 0; face < faces; ++face) {
        const std::size_t count = shape.num_face_vertices[face];
        std::vector<glm::dvec3> polygon(count);
        std::vector<Corner> polygon_corners(count);
        for (std::size_t i = 0; i < count; ++i) {
            const tinyobj::index_t index = shape.indices.at(first + i);
            polygon[i] = at3(attributes.vertices, index.vertex_index);
            Corner& corner = polygon_corners[i];
            corner = {index.vertex_index, existing(index.texcoord_index, 1), existing(index.normal_index, 2),
                      0};
            const bool has_normal = corner.normal >= 0 && unitOr(at3(attributes.normals, corner.normal),
                                                                 glm::vec3(0.0F)) != glm::vec3(0.0F);
            if (has_normal) continue;
            const unsigned int group = shape.smoothing_group_ids.at(face);
            corner.normal = -1;
            corner.shading = group > 0 ? std::int64_t(group) : -std::int64_t(face) - 1;
            smoothed = smoothed || group > 0;
        }
        first += count;
        face_normals[face] = unitOr(areaNormal(polygon), glm::vec3(0.0F, 0.0F, 1.0F));
        for (const auto& triangle : cutPolygon(polygon)) {
            for (const std::size_t i : triangle)
                corners.push_back(polygon_corners[i]);
            triangle_faces.push_back(static_cast<std::uint32_t>(face));
        }
    }
    for (const std::size_t kind : {1, 2})
        if (missing[kind] > 0) obj.noteMissing(kind, obj.lineOfGreatest(kind), missing[kind]);

    // Normals of smoothing groups: one a position and group, from all of the group's triangles.
    std::unordered_map<Corner, std::uint32_t, CornerHash> smooth_numbers;
    std::vector<glm::vec3> smooth_normals;
    if (smoothed) {
        std::vector<glm::vec3> positions;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const unsigned int group = shape.smoothing_group_ids.at(triangle_faces[i / 3]);
            if (group == 0) continue;
            if (i % 3 == 0) triangles.emplace_back();
            const auto [known, is_new] = smooth_numbers.emplace(Corner{corners[i].position, 0, 0, group},
                                                                static_cast<std::uint32_t>(positions.size()));
            if (is_new) positions.push_back(at3(attributes.vertices, corners[i].position));
            triangles.back()[i % 3] = known->second;
        }
        smooth_normals = angleWeightedNormals(positions, triangles);
    }

    MeshData mesh;
    mesh.materials = std::move(obj.materials);
    const std::vector<glm::vec4> colors = vertexColors(attributes.colors, path.string(), obj.notes);
    std::vector<std::vector<std::uint32_t>> indices_by_material(mesh.materials.size());
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& corner = corners[i];
        const auto [vertex, is_new] =
            vertices.emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) {
            if (mesh.positions.size() == max_mesh_vertices)
                throw fileError(path.string(), "has more than " + std::to_string(max_mesh_vertices) +
                                                   " vertices, simplify it");
            mesh.positions.push_back(at3(attributes.vertices, corner.position));
            glm::vec3 normal = face_normals[triangle_faces[i / 3]];
            if (corner.normal >= 0) normal = unitOr(at3(attributes.normals, corner.normal), normal);
            if (corner.shading > 0)
                normal = unitOr(smooth_normals[smooth_numbers.at({corner.position, 0, 0, corner.shading})],
                                normal);
            mesh.normals.push_back(normal);
            glm::vec2 uv(0.0F);
            if (corner.uv >= 0) {
                const std::size_t k = static_cast<std::size_t>(corner.uv) * 2;
                uv = glm::vec2(attributes.texcoords.at(k), 1.0F - attributes.texcoords.at(k + 1));
            }
            mesh.uvs.push_back(uv);
            if (!colors.empty()) mesh.colors.push_back(colors[static_cast<std::size_t>(corner.position)]);
        }
        indices_by_material[obj.face_materials[triangle_faces[i / 3]]].push_back(vertex->second);
    }
    setParts(mesh, indices_by_material);
    mesh.warnings = obj.notes.lines();
    return mesh;
}

} // namespace gll
