// Reads OBJ and MTL through tinyobjloader, which reads "nan" as 0 and takes indices out of range with a
// warning at most. So every statement is checked here first, with its line, and tinyobjloader sees only what
// has passed. Polygons are cut up here too: its ear test measures from the origin and drops faces that lie
// badly to it.
#include "io/files.hpp"
#include "io/mesh_build.hpp"

#include <glm/geometric.hpp>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace gll {
namespace {

// One statement of the file: keyword, the rest of the line without blanks at its ends, and "path:line".
struct Statement {
    std::string_view keyword;
    std::string_view rest;
    std::string where;
};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// The next word of text, which is shortened by it; empty at the end.
std::string_view nextWord(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    return word;
}

// Calls use(statement) for every line that is neither empty nor a comment. Lines end in LF, CRLF or CR.
template <typename Use>
void forEachStatement(std::string_view text, const std::string& path, const Use& use) {
    if (text.find('\0') != std::string_view::npos) throw fileError(path, "is binary, an OBJ or MTL is text");
    std::size_t line_number = 0;
    while (!text.empty()) {
        ++line_number;
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end);
        if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
        if (line.empty() || line.front() == '#') continue;
        Statement statement;
        statement.keyword = nextWord(line);
        statement.rest = trimmed(line);
        statement.where = path + ":" + std::to_string(line_number);
        use(statement);
    }
}

// A finite number that a float can hold with room to spare, because tinyobjloader's own parser rounds
// otherwise than this one. It also raises ten to whatever exponent it finds, so words are limited in length.
float parseNumber(std::string_view word, const std::string& where) {
    double value = 0.0;
    std::string_view digits = word;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (word.empty() || parsed.ec == std::errc::invalid_argument ||
        parsed.ptr != digits.data() + digits.size())
        throw fileError(where, word.empty() ? "a number is missing" : inQuotes(word) + " is not a number");
    if (parsed.ec != std::errc() || !(std::abs(value) <= 1e38) || word.size() > 64)
        throw fileError(where, inQuotes(word) + " is not a finite number of sensible size");
    return static_cast<float>(value);
}

// --- MTL ---

// Numbers as "Kd r g b"; a single one stands for all three, as the MTL specification has it.
glm::vec3 parseColor(std::string_view rest, const std::string& where) {
    glm::vec3 colour(parseNumber(nextWord(rest), where));
    if (!rest.empty()) {
        colour.y = parseNumber(nextWord(rest), where);
        colour.z = parseNumber(nextWord(rest), where);
    }
    if (colour.x < 0.0F || colour.y < 0.0F || colour.z < 0.0F)
        throw fileError(where, "a colour is not negative in any channel");
    return colour;
}

float parseUnit(std::string_view rest, const std::string& where) {
    const float value = parseNumber(nextWord(rest), where);
    if (value < 0.0F || value > 1.0F) throw fileError(where, "a value of 0 to 1 is needed");
    return value;
}

// "map_... [options] file" read by tinyobjloader, then the file looked up beside the MTL.
TextureData parseTexture(const Statement& statement, const std::filesystem::path& folder) {
    std::string name;
    tinyobj::texture_option_t options{};
    options.imfchan = 'm';
    options.scale[0] = options.scale[1] = options.scale[2] = tinyobj::real_t(1);
    const std::string rest(statement.rest);
    if (!tinyobj::ParseTextureNameAndOption(&name, &options, rest.c_str()) || trimmed(name).empty())
        throw fileError(statement.where, "the texture's file name is missing");
    name = trimmed(name);
    if (name.front() == '-')
        throw fileError(statement.where, "the texture option " + inQuotes(name) + " is unknown, remove it");
    const auto is = [](const tinyobj::real_t* v, tinyobj::real_t value) {
        return v[0] == value && v[1] == value;
    };
    if (!is(options.origin_offset, 0) || !is(options.scale, 1))
        throw fileError(statement.where,
                        "texture options -o and -s are not applied, change the mesh's vt instead");

    TextureData result;
    switch (options.imfchan) {
    case 'm':
    case 'l':
    case 'r':
        result.channel = 0;
        break;
    case 'g':
        result.channel = 1;
        break;
    case 'b':
        result.channel = 2;
        break;
    default:
        throw fileError(statement.where, "-imfchan takes r, g, b or m");
    }
    result.image.file = confinedFile(folder, name, statement.where + ": texture");
    result.image.name = result.image.file.string();
    return result;
}

std::vector<MaterialData> readMtl(const std::filesystem::path& path) {
    const std::string text = readFile(path, max_mesh_file_bytes);
    const std::filesystem::path folder = path.parent_path();
    std::vector<MaterialData> materials;
    bool metallic_given = false;
    bool normal_given = false;
    forEachStatement(text, path.string(), [&](const Statement& s) {
        if (s.keyword == "newmtl") {
            if (s.rest.empty()) throw fileError(s.where, "the material's name is missing");
            materials.emplace_back().name = s.rest;
            metallic_given = false;
            normal_given = false;
            return;
        }
        const auto material = [&]() -> MaterialData& {
            if (materials.empty())
                throw fileError(s.where, inQuotes(s.keyword) + " comes before the first newmtl");
            return materials.back();
        };
        if (s.keyword == "Kd") {
            material().base_color = glm::vec4(parseColor(s.rest, s.where), material().base_color.a);
        } else if (s.keyword == "Ke") {
            material().emitted_color = parseColor(s.rest, s.where);
        } else if (s.keyword == "Pr") {
            material().roughness = parseUnit(s.rest, s.where);
        } else if (s.keyword == "Pm") {
            material().metallic = parseUnit(s.rest, s.where);
            metallic_given = true;
        } else if (s.keyword == "map_Kd") {
            material().base_color_texture.image = parseTexture(s, folder).image;
        } else if (s.keyword == "map_Ke") {
            material().emitted_color_texture.image = parseTexture(s, folder).image;
            if (material().emitted_color == glm::vec3(0.0F)) material().emitted_color = glm::vec3(1.0F);
        } else if (s.keyword == "map_Ka") {
            material().occlusion_texture = parseTexture(s, folder);
        } else if (s.keyword == "map_Pr") {
            material().roughness_texture = parseTexture(s, folder);
        } else if (s.keyword == "map_Pm") {
            material().metallic_texture = parseTexture(s, folder);
            if (!metallic_given) material().metallic = 1.0F;
        } else if (s.keyword == "norm") {
            material().normal_texture.image = parseTexture(s, folder).image;
            normal_given = true;
        } else if (s.keyword == "map_Bump" || s.keyword == "map_bump" || s.keyword == "bump") {
            if (!normal_given) material().normal_texture.image = parseTexture(s, folder).image;
        }
    });
    if (materials.empty()) throw fileError(path.string(), "has no material, add a newmtl statement");
    return materials;
}

// --- OBJ ---

// A checked OBJ: text that tinyobjloader reads without surprises, and the materials it refers to by number.
struct CheckedObj {
    std::string text;
    std::vector<MaterialData> materials;
    std::size_t positions = 0;
    std::size_t faces = 0;
};

// "-1" is the last one so far, "1" the first. Both must exist already, as the OBJ specification has it.
void checkIndex(std::string_view word, std::size_t count, const char* what, const std::string& where) {
    long long index = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), index);
    const bool number = parsed.ec == std::errc() && parsed.ptr == word.data() + word.size();
    const long long limit = static_cast<long long>(count);
    if (!number || index == 0 || index > limit || index < -limit)
        throw fileError(where, std::string(what) + " index " + inQuotes(word) + " is not among the " +
                                   std::to_string(count) + " so far");
}

// One corner "v", "v/vt", "v//vn" or "v/vt/vn".
void checkCorner(std::string_view corner, const std::array<std::size_t, 3>& counts,
                 const std::string& where) {
    constexpr std::array names = {"vertex", "texture", "normal"};
    for (std::size_t field = 0; field < 3; ++field) {
        const std::size_t slash = corner.find('/');
        const std::string_view word = corner.substr(0, slash);
        const bool last = slash == std::string_view::npos;
        if (!word.empty() || field == 0 || last) checkIndex(word, counts[field], names[field], where);
        if (last) return;
        corner.remove_prefix(slash + 1);
    }
    throw fileError(where, "a corner has more than three indices");
}

class ObjCheck {
  public:
    explicit ObjCheck(const std::filesystem::path& obj_path) : path(obj_path) {}

    CheckedObj run() {
        const std::string text = readFile(path, max_mesh_file_bytes);
        checked.text.reserve(text.size());
        checked.text = "mtllib all\n"; // tinyobjloader asks NumberedMaterials for it
        forEachStatement(text, path.string(), [&](const Statement& statement) { check(statement); });
        if (counts[0] == 0) throw fileError(path.string(), "has no vertices, export the mesh again");
        if (checked.faces == 0) throw fileError(path.string(), "has no faces, export the mesh again");
        checked.positions = counts[0];
        return std::move(checked);
    }

  private:
    void check(const Statement& s) {
        if (s.keyword == "v") {
            keepNumbers(s, 3, 3);
            ++counts[0];
        } else if (s.keyword == "vt") {
            keepNumbers(s, 1, 2);
            ++counts[1];
        } else if (s.keyword == "vn") {
            keepNumbers(s, 3, 3);
            ++counts[2];
        } else if (s.keyword == "f") {
            checkFace(s);
        } else if (s.keyword == "mtllib") {
            readLibraries(s);
        } else if (s.keyword == "usemtl") {
            const auto found = material_numbers.find(s.rest);
            if (found == material_numbers.end())
                throw fileError(s.where, "material " + inQuotes(s.rest) + " is in no mtllib named above");
            keep(s.keyword, std::to_string(found->second));
        }
        if (counts[0] > max_mesh_vertices || counts[1] > max_mesh_vertices || counts[2] > max_mesh_vertices)
            throw fileError(s.where, "more than " + std::to_string(max_mesh_vertices) + " vertices");
    }

    void keep(std::string_view keyword, std::string_view rest) {
        checked.text.append(keyword).append(" ").append(rest).append("\n");
    }

    // Passes on the first `most` numbers; weights, colours and third texture coordinates after them do not
    // matter.
    void keepNumbers(const Statement& s, std::size_t least, std::size_t most) {
        std::string_view rest = s.rest;
        checked.text += s.keyword;
        for (std::size_t i = 0; i < most; ++i) {
            const std::string_view word = nextWord(rest);
            if (word.empty() && i >= least) break;
            parseNumber(word, s.where);
            checked.text.append(" ").append(word);
        }
        checked.text += '\n';
    }

    void checkFace(const Statement& s) {
        std::string_view rest = s.rest;
        std::size_t corners = 0;
        for (std::string_view corner = nextWord(rest); !corner.empty(); corner = nextWord(rest)) {
            checkCorner(corner, counts, s.where);
            ++corners;
        }
        if (corners < 3 || corners > max_face_corners)
            throw fileError(s.where, "a face of " + std::to_string(corners) + " corners, 3 to " +
                                         std::to_string(max_face_corners) + " are read");
        triangles += corners - 2;
        if (triangles > max_mesh_indices / 3)
            throw fileError(s.where, "more than " + std::to_string(max_mesh_indices / 3) + " triangles");
        ++checked.faces;
        keep(s.keyword, s.rest);
    }

    // "mtllib one.mtl two.mtl", or a single name with blanks in it.
    void readLibraries(const Statement& s) {
        const std::filesystem::path folder = path.parent_path();
        std::error_code failure;
        if (std::filesystem::is_regular_file(folder / std::string(s.rest), failure))
            return readLibrary(s.rest, s);
        std::string_view rest = s.rest;
        std::string_view name = nextWord(rest);
        do
            readLibrary(name, s);
        while (!(name = nextWord(rest)).empty());
    }

    void readLibrary(std::string_view name, const Statement& s) {
        const std::filesystem::path library =
            confinedFile(path.parent_path(), std::string(name), s.where + ": material library");
        if (!libraries.emplace(library, true).second)
            return; // named twice: exporters repeat it for every object
        for (MaterialData& material : readMtl(library)) {
            material_numbers.emplace(material.name, checked.materials.size()); // the first of a name counts
            checked.materials.push_back(std::move(material));
        }
    }

    const std::filesystem::path& path;
    CheckedObj checked;
    std::array<std::size_t, 3> counts{}; // v, vt, vn so far
    std::size_t triangles = 0;
    std::map<std::filesystem::path, bool> libraries;
    std::map<std::string, std::size_t, std::less<>> material_numbers;
};

// Tells tinyobjloader that material "7" is number 7.
class NumberedMaterials : public tinyobj::MaterialReader {
  public:
    explicit NumberedMaterials(std::size_t material_count) : count(material_count) {}

    bool operator()(const std::string&, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* numbers, std::string*, std::string*) override {
        materials->resize(count);
        for (std::size_t i = 0; i < count; ++i)
            numbers->emplace(std::to_string(i), static_cast<int>(i));
        return true;
    }

  private:
    std::size_t count;
};

// A vertex of the result is one combination of an OBJ's three index spaces.
struct Corner {
    int position, uv, normal;
    bool operator==(const Corner&) const = default;
};
struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t h = static_cast<std::uint32_t>(c.position);
        h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint32_t>(c.uv);
        h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint32_t>(c.normal);
        return static_cast<std::size_t>(h ^ (h >> 29));
    }
};

// Cuts a polygon without holes into corners.size() - 2 triangles of corner numbers, in its own winding, by
// clipping ears in the plane of its Newell normal. Where no ear is left (corners that coincide or edges that
// cross) it cuts anyway: a face never vanishes, and nothing loops.
std::vector<std::array<std::size_t, 3>> cutPolygon(const std::vector<glm::dvec3>& corners) {
    std::vector<std::array<std::size_t, 3>> triangles;
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    // Twice the signed area of three corners as the polygon's front sees them.
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        return glm::dot(normal, glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };

    std::vector<std::size_t> rest(corners.size());
    std::iota(rest.begin(), rest.end(), std::size_t(0));
    while (rest.size() > 3) {
        std::size_t ear = 0;
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const std::size_t a = rest[(i + rest.size() - 1) % rest.size()];
            const std::size_t b = rest[i];
            const std::size_t c = rest[(i + 1) % rest.size()];
            // Of all ears the one whose cut is shortest: for quads that is the usual choice of diagonal.
            const double cut = glm::dot(corners[c] - corners[a], corners[c] - corners[a]);
            if (!(turn(a, b, c) > 0.0) || !(cut < shortest)) continue;
            const bool free = std::none_of(rest.begin(), rest.end(), [&](std::size_t p) {
                return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
                       turn(c, a, p) >= 0.0;
            });
            if (!free) continue;
            ear = i;
            shortest = cut;
        }
        triangles.push_back(
            {rest[(ear + rest.size() - 1) % rest.size()], rest[ear], rest[(ear + 1) % rest.size()]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({rest[0], rest[1], rest[2]});
    return triangles;
}

} // namespace

MeshData loadObj(const std::filesystem::path& path) {
    CheckedObj checked = ObjCheck(path).run();

    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> unused_materials;
    std::string warning;
    std::string error;
    std::istringstream stream(std::move(checked.text));
    NumberedMaterials materials(checked.materials.size());
    constexpr bool triangulate = false;
    constexpr bool make_up_colors = false;
    if (!tinyobj::LoadObj(&attributes, &shapes, &unused_materials, &warning, &error, &stream, &materials,
                          triangulate, make_up_colors))
        throw fileError(path.string(), "cannot be read (" + error.substr(0, error.find('\n')) + ")");

    const auto at3 = [](const std::vector<tinyobj::real_t>& v, int i) {
        const std::size_t k = static_cast<std::size_t>(i) * 3;
        return glm::vec3(v.at(k), v.at(k + 1), v.at(k + 2));
    };
    std::vector<glm::vec3> positions(checked.positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = at3(attributes.vertices, static_cast<int>(i));
    // Three corners a triangle, and the triangle's material.
    std::vector<tinyobj::index_t> corners;
    std::vector<int> triangle_materials;
    for (const tinyobj::shape_t& shape : shapes) {
        std::size_t first = 0;
        for (std::size_t face = 0; face < shape.mesh.num_face_vertices.size(); ++face) {
            const std::size_t count = shape.mesh.num_face_vertices[face];
            std::vector<glm::dvec3> polygon(count);
            for (std::size_t i = 0; i < count; ++i)
                polygon[i] =
                    positions.at(static_cast<std::size_t>(shape.mesh.indices[first + i].vertex_index));
            for (const auto& triangle : cutPolygon(polygon)) {
                for (const std::size_t i : triangle)
                    corners.push_back(shape.mesh.indices[first + i]);
                triangle_materials.push_back(shape.mesh.material_ids[face]);
            }
            first += count;
        }
    }

    std::vector<std::array<std::uint32_t, 3>> triangles(triangle_materials.size());
    bool normals_missing = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        triangles[i / 3][i % 3] = static_cast<std::uint32_t>(corners[i].vertex_index);
        const int normal = corners[i].normal_index;
        normals_missing = normals_missing || normal < 0 ||
                          unitOr(at3(attributes.normals, normal), glm::vec3(0.0F)) == glm::vec3(0.0F);
    }
    std::vector<glm::vec3> smooth_normals;
    if (normals_missing) smooth_normals = angleWeightedNormals(positions, triangles);

    MeshData mesh;
    mesh.materials = std::move(checked.materials);
    const std::size_t default_material = mesh.materials.size(); // for faces before any usemtl
    std::vector<std::vector<std::uint32_t>> indices_by_material(default_material + 1);
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner corner = {corners[i].vertex_index, corners[i].texcoord_index, corners[i].normal_index};
        const auto [vertex, is_new] =
            vertices.emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) {
            if (mesh.positions.size() == max_mesh_vertices)
                throw fileError(path.string(), "has more than " + std::to_string(max_mesh_vertices) +
                                                   " vertices, simplify it");
            const std::size_t position = static_cast<std::size_t>(corner.position);
            mesh.positions.push_back(positions[position]);
            glm::vec3 normal(0.0F, 0.0F, 1.0F); // of a vertex that only faces without area touch
            if (normals_missing) normal = unitOr(smooth_normals[position], normal);
            if (corner.normal >= 0) normal = unitOr(at3(attributes.normals, corner.normal), normal);
            mesh.normals.push_back(normal);
            glm::vec2 uv(0.0F);
            if (corner.uv >= 0) {
                const std::size_t k = static_cast<std::size_t>(corner.uv) * 2;
                uv = glm::vec2(attributes.texcoords.at(k), 1.0F - attributes.texcoords.at(k + 1));
            }
            mesh.uvs.push_back(uv);
        }
        const int material = triangle_materials[i / 3];
        indices_by_material[material < 0 ? default_material : static_cast<std::size_t>(material)].push_back(
            vertex->second);
    }
    if (!indices_by_material[default_material].empty()) mesh.materials.emplace_back().name = "default";
    setParts(mesh, indices_by_material);
    return mesh;
}

std::vector<MaterialData> loadMtl(const std::filesystem::path& path) { return readMtl(path); }

} // namespace gll
