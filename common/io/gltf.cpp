// Reads glTF 2.0 meshes and materials. What the JSON says is checked in gltf_file.cpp as it is read; how it
// fits together, and what lies inside the buffers (indices, numbers that are not finite), is checked here.
#include "io/files.hpp"
#include "io/gltf_accessor.hpp"
#include "io/mesh_build.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

namespace gll {
namespace {

// Read as they are meant, or said to be left out where they are met. Unlit materials are lit.
const std::vector<std::string_view> extensions_read = {"KHR_texture_transform", "KHR_mesh_quantization",
                                                       "KHR_materials_emissive_strength",
                                                       "KHR_materials_unlit"};

// Not read, and the picture is the same without: files hold uncompressed data and PNG or JPEG images beside
// these (where one does not, that is said), or they are about other things than one picture.
constexpr std::string_view extensions_not_missed[] = {"KHR_draco_mesh_compression",
                                                      "EXT_meshopt_compression",
                                                      "KHR_meshopt_compression",
                                                      "KHR_texture_basisu",
                                                      "EXT_texture_webp",
                                                      "EXT_texture_avif",
                                                      "MSFT_texture_dds",
                                                      "KHR_materials_variants",
                                                      "KHR_animation_pointer",
                                                      "KHR_xmp_json_ld",
                                                      "KHR_xmp",
                                                      "MSFT_lod",
                                                      "EXT_structural_metadata",
                                                      "EXT_mesh_features",
                                                      "EXT_instance_features",
                                                      "FB_ngon_encoding"};

class GltfReader {
  public:
    explicit GltfReader(const std::filesystem::path& path) : file_(path, extensions_read) {}

    MeshData run() {
        mesh_.front_is_positive_z = true; // glTF 2.0, section 3.4
        const GltfValue used = file_["extensionsUsed"];
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i].text() != "KHR_materials_unlit") warnOfExtension(used[i], used[i].text());
        if (file_["animations"])
            warn(file_["animations"], "animations are not read, nodes stand as they are");

        struct Visit {
            std::size_t node;
            glm::dmat4 parent_to_world;
        };
        std::vector<Visit> pending;
        for (const std::size_t root : roots())
            pending.push_back({root, glm::dmat4(1.0)});
        while (!pending.empty()) {
            const Visit visit = pending.back();
            pending.pop_back();
            const GltfValue node = file_["nodes"][visit.node];
            warnOfExtensions(node);
            const glm::dmat4 to_world = visit.parent_to_world * localTransform(node);
            if (const GltfValue mesh = node["mesh"]) {
                const GltfValue skin = node["skin"];
                if (skin) warn(skin, "skins are not read, the mesh is drawn where it was modelled");
                // section 3.7.3.3: a skin's joints alone place its mesh
                addMesh(mesh.in(file_["meshes"]), node, skin ? glm::dmat4(1.0) : to_world);
            }
            const GltfValue children = node["children"];
            for (std::size_t i = 0; i < children.size(); ++i)
                pending.push_back({children[i].index(file_["nodes"]), to_world});
        }

        const std::size_t vertices = mesh_.positions.size();
        if (vertices == 0)
            throw fileError(file_.name(), "has no triangles in its scene, export it again" + skipped_);
        if (!mesh_.second_uvs.empty()) mesh_.second_uvs.resize(vertices, glm::vec2(0.0F));
        if (!mesh_.colors.empty()) mesh_.colors.resize(vertices, glm::vec4(1.0F));
        if (!mesh_.tangents.empty()) mesh_.tangents.resize(vertices, glm::vec4(0.0F));
        setParts(mesh_, indices_by_material_);
        return std::move(mesh_);
    }

  private:
    // --- what is left out ---

    // Each kind once, at its first place.
    void warn(const GltfValue& place, const std::string& what) {
        if (!warned_.insert(what).second) return;
        mesh_.warnings.push_back(file_.name() + ": " + place.pointer() + ": " + what);
    }

    void warnOfExtension(const GltfValue& place, const std::string& extension) {
        const auto in = [&](const auto& list) {
            return std::find(std::begin(list), std::end(list), extension) != std::end(list);
        };
        if (!in(extensions_read) && !in(extensions_not_missed))
            warn(place, "extension " + inQuotes(extension) + " is not read, drawn without");
    }

    void warnOfExtensions(const GltfValue& object) {
        for (const std::string& extension : object["extensions"].keys())
            warnOfExtension(object["extensions"], extension);
    }

    void skip(const GltfValue& place, const std::string& what) {
        warn(place, what);
        if (skipped_.empty()) skipped_ = " (" + place.pointer() + " " + what + ")";
    }

    // --- nodes ---

    // The nodes that the scene to be read begins with.
    std::vector<std::size_t> roots() {
        const GltfValue nodes = file_["nodes"];
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::vector<std::size_t> parents(nodes.size(), none);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            const GltfValue children = nodes[i]["children"];
            for (std::size_t k = 0; k < children.size(); ++k) {
                std::size_t& parent = parents[children[k].index(nodes)];
                if (parent != none)
                    children[k].fail("is already a child of node " + std::to_string(parent) +
                                     ", a node has one parent");
                parent = i;
            }
        }
        // With one parent each, whatever does not reach a root within the limit is too deep or goes round.
        for (std::size_t i = 0; i < parents.size(); ++i) {
            std::size_t depth = 1;
            for (std::size_t at = i; parents[at] != none; at = parents[at])
                if (++depth > max_node_depth)
                    nodes[i].fail("is its own ancestor or lies deeper than " +
                                  std::to_string(max_node_depth) + " levels");
        }

        std::vector<std::size_t> roots;
        const GltfValue scenes = file_["scenes"];
        if (scenes.size() == 0) {
            for (std::size_t i = 0; i < parents.size(); ++i)
                if (parents[i] == none) roots.push_back(i);
        } else {
            const GltfValue chosen = file_["scene"];
            const GltfValue listed = (chosen ? chosen.in(scenes) : scenes[0])["nodes"];
            std::vector<bool> named(parents.size(), false);
            for (std::size_t i = 0; i < listed.size(); ++i) {
                const std::size_t node = listed[i].index(nodes);
                if (named[node]) listed[i].fail("names a node twice");
                named[node] = true;
            }
            for (std::size_t i = 0; i < listed.size(); ++i) {
                const std::size_t node = listed[i].index(nodes);
                bool drawn_by_ancestor = false;
                for (std::size_t at = node; parents[at] != none; at = parents[at])
                    drawn_by_ancestor = drawn_by_ancestor || named[parents[at]];
                if (parents[node] != none)
                    warn(listed[i], "is not a root node, as glTF wants it; drawn once, move it to the root");
                if (!drawn_by_ancestor) roots.push_back(node);
            }
        }
        if (roots.empty())
            throw fileError(file_.name(), "has no nodes in its scene, nothing to draw; export it again");
        return roots;
    }

    static glm::dmat4 localTransform(const GltfValue& node) {
        if (node["matrix"]) return glm::make_mat4(node["matrix"].numbers<16>({}).data());
        const auto translation = node["translation"].numbers<3>({0, 0, 0});
        const auto rotation = node["rotation"].numbers<4>({0, 0, 0, 1}, -1.0, 1.0);
        const auto scale = node["scale"].numbers<3>({1, 1, 1});
        const glm::dquat quaternion(rotation[3], rotation[0], rotation[1], rotation[2]);
        const double length = glm::length(quaternion);
        if (!(length > 0.0)) node["rotation"].fail("is all zero");
        glm::dmat4 transform = glm::mat4_cast(quaternion / length);
        for (int i = 0; i < 3; ++i)
            transform[i] *= scale[static_cast<std::size_t>(i)];
        transform[3] = glm::dvec4(glm::make_vec3(translation.data()), 1.0);
        return transform;
    }

    // --- materials ---

    TextureWrap wrap(const GltfValue& mode) {
        switch (mode.whole(0, 65535, 10497)) {
        case 33071:
            return TextureWrap::clamp_to_edge;
        case 33648:
            return TextureWrap::mirrored_repeat;
        case 10497:
            break;
        default:
            warn(mode, "is none of glTF's wrap modes, drawn as repeat");
        }
        return TextureWrap::repeat;
    }

    TextureData texture(const GltfValue& info, int channel = 0) {
        if (!info) return {};
        const GltfValue texture = info.needed("index").in(file_["textures"]);
        const GltfValue transform = info["extensions"]["KHR_texture_transform"];
        const GltfValue set = transform["texCoord"] ? transform["texCoord"] : info["texCoord"];
        TextureData data;
        data.channel = channel;
        data.uv_set = static_cast<int>(set.whole(0, 65535, 0));
        if (data.uv_set > 1) {
            warn(set, "texture coordinates beyond TEXCOORD_1 are not read, drawn without this texture");
            return {};
        }
        if (!texture["source"]) {
            std::string others;
            for (const std::string& extension : texture["extensions"].keys())
                others += " (but " + extension + ", which is not read)";
            texture.fail("has no PNG or JPEG 'source'" + others + ", export one");
        }
        try {
            data.image = file_.image(texture["source"].in(file_["images"]));
        } catch (const ImageMissing& missing) {
            mesh_.warnings.push_back(std::string(missing.what()) + "; drawn without this texture");
        }
        if (data.image.empty()) return {};
        if (transform) {
            const auto offset = transform["offset"].numbers<2>({0, 0});
            const auto scale = transform["scale"].numbers<2>({1, 1});
            const double rotation_rad = transform["rotation"].number(0.0);
            const double cosine = std::cos(rotation_rad);
            const double sine = std::sin(rotation_rad);
            // Counter-clockwise as one sees it, with v running down.
            data.uv_transform = glm::dmat3x2(cosine * scale[0], -sine * scale[0], sine * scale[1],
                                             cosine * scale[1], offset[0], offset[1]);
        }
        if (const GltfValue number = texture["sampler"]) {
            const GltfValue sampler = number.in(file_["samplers"]);
            data.wrap_u = wrap(sampler["wrapS"]);
            data.wrap_v = wrap(sampler["wrapT"]);
            constexpr std::size_t gl_nearest = 9728;
            data.nearest = sampler["magFilter"].whole(0, 65535, 0) == gl_nearest;
        }
        return data;
    }

    MaterialData material(const GltfValue& from) {
        MaterialData to;
        to.name = from["name"].text(from ? "" : "default");
        to.implied = !from;
        const GltfValue pbr = from["pbrMetallicRoughness"];
        to.base_color = glm::make_vec4(pbr["baseColorFactor"].numbers<4>({1, 1, 1, 1}, 0.0, 1.0).data());
        to.base_color_texture = texture(pbr["baseColorTexture"]);
        to.roughness = static_cast<float>(pbr["roughnessFactor"].number(1.0, 0.0, 1.0));
        to.roughness_texture = texture(pbr["metallicRoughnessTexture"], 1);
        to.metallic = static_cast<float>(pbr["metallicFactor"].number(1.0, 0.0, 1.0));
        to.metallic_texture = texture(pbr["metallicRoughnessTexture"], 2);
        to.normal_texture = texture(from["normalTexture"]);
        to.normal_scale = static_cast<float>(from["normalTexture"]["scale"].number(1.0));
        to.occlusion_texture = texture(from["occlusionTexture"]);
        to.occlusion_strength =
            static_cast<float>(from["occlusionTexture"]["strength"].number(1.0, 0.0, 1.0));
        const double strength =
            from["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].number(1.0, 0.0);
        to.emitted_color = glm::vec3(
            strength * glm::make_vec3(from["emissiveFactor"].numbers<3>({0, 0, 0}, 0.0, 1.0).data()));
        to.emitted_color_texture = texture(from["emissiveTexture"]);
        const std::string alpha_mode = from["alphaMode"].text("OPAQUE");
        to.alpha_mode = alpha_mode == "MASK"    ? AlphaMode::mask
                        : alpha_mode == "BLEND" ? AlphaMode::blend
                                                : AlphaMode::opaque;
        if (to.alpha_mode == AlphaMode::opaque && alpha_mode != "OPAQUE")
            warn(from["alphaMode"], "is none of glTF's alpha modes, drawn opaque");
        to.alpha_cutoff = static_cast<float>(from["alphaCutoff"].number(0.5, 0.0));
        to.double_sided = from["doubleSided"].flag();
        if (from["extensions"]["KHR_materials_unlit"])
            warn(from["extensions"]["KHR_materials_unlit"], "unlit materials are lit like the others");
        warnOfExtensions(from);
        return to;
    }

    // Of MeshData::materials, read when first used; the one that glTF means where a primitive names none is
    // fully metallic, unlike ours.
    std::size_t materialNumber(const GltfValue& named) {
        const GltfValue from =
            named ? named.in(file_["materials"]) : GltfValue(file_.name(), nullptr, "/materials");
        const auto [known, is_new] = material_numbers_.try_emplace(from.pointer(), mesh_.materials.size());
        if (is_new) {
            mesh_.materials.push_back(material(from));
            indices_by_material_.emplace_back();
        }
        return known->second;
    }

    // --- meshes ---

    void addMesh(const GltfValue& mesh, const GltfValue& node, const glm::dmat4& to_world) {
        warnOfExtensions(mesh);
        const GltfValue primitives = mesh.needed("primitives");
        if (primitives.size() == 0) primitives.fail("is not an array of primitives");
        const GltfValue weights = node["weights"] ? node["weights"] : mesh["weights"];
        bool is_morphed = false;
        for (std::size_t i = 0; i < weights.size(); ++i)
            is_morphed = is_morphed || weights[i].number(0.0) != 0.0;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            if (is_morphed && primitives[i]["targets"])
                warn(primitives[i]["targets"], "morph targets are not read, drawn without");
            addPrimitive(primitives[i], to_world);
        }
    }

    // The vertices' numbers three a triangle, whatever the mode.
    std::vector<std::uint32_t> triangleIndices(const GltfValue& primitive, std::size_t mode,
                                               std::size_t vertices) {
        constexpr std::size_t triangles_mode = 4;
        constexpr std::size_t strip_mode = 5;
        std::vector<std::uint32_t> order;
        if (const GltfValue indices = primitive["indices"]) {
            const GltfAccessor found = readAccessor(file_, indices);
            if (found.type != "SCALAR") indices.fail("is not SCALAR of unsigned whole numbers");
            requireUnsigned(found.component, indices);
            order.resize(found.count);
            forEachElement(found, [&](std::size_t i, const GltfValues& values) {
                if (values[0] >= static_cast<double>(vertices))
                    found.place.fail("element " + std::to_string(i) + " is index " +
                                     std::to_string(static_cast<std::uint32_t>(values[0])) + " of " +
                                     std::to_string(vertices) + " vertices");
                order[i] = static_cast<std::uint32_t>(values[0]);
            });
        } else {
            order.resize(vertices);
            for (std::size_t i = 0; i < vertices; ++i)
                order[i] = static_cast<std::uint32_t>(i);
        }
        if (order.size() < 3 || (mode == triangles_mode && order.size() % 3 != 0))
            primitive.fail(std::to_string(order.size()) + " corners do not make whole triangles");
        if (mode == triangles_mode) return order;

        if (order.size() - 2 > max_mesh_indices / 3)
            primitive.fail("has more than " + std::to_string(max_mesh_indices / 3) +
                           " triangles, simplify it");
        std::vector<std::uint32_t> triangles;
        triangles.reserve((order.size() - 2) * 3);
        for (std::size_t i = 0; i + 2 < order.size(); ++i) {
            if (mode == strip_mode) // every other one is turned over
                triangles.insert(triangles.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
            else
                triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
        }
        return triangles;
    }

    void addPrimitive(const GltfValue& primitive, const glm::dmat4& to_world) {
        warnOfExtensions(primitive);
        const std::size_t mode = primitive["mode"].whole(0, 6, 4);
        if (mode < 4) return skip(primitive["mode"], "says points or lines, which are not drawn");
        const GltfValue attributes = primitive.needed("attributes");
        const GltfValue position = attributes["POSITION"];
        if (!position) return skip(attributes, "has no POSITION, not drawn");
        const GltfValue draco = primitive["extensions"]["KHR_draco_mesh_compression"];
        if (draco && !position.in(file_["accessors"])["bufferView"])
            draco.fail("holds the only copy of the geometry, and is not read; export without compression");

        std::size_t vertices = readAccessor(file_, position).count;
        if (vertices > max_mesh_vertices)
            position.fail("has more than " + std::to_string(max_mesh_vertices) + " vertices");
        const GltfAccessor positions = *readAttribute(file_, attributes, "POSITION", "VEC3", false, vertices);
        const auto normals = readAttribute(file_, attributes, "NORMAL", "VEC3", false, vertices);
        const auto uvs = readAttribute(file_, attributes, "TEXCOORD_0", "VEC2", true, vertices);
        auto tangents = readAttribute(file_, attributes, "TANGENT", "VEC4", false, vertices);
        if (!normals) tangents.reset(); // as glTF says
        auto colors = readAttribute(file_, attributes, "COLOR_0", "VEC3, VEC4", true, vertices);
        std::vector<std::uint32_t> triangles = triangleIndices(primitive, mode, vertices);
        const std::size_t material_number = materialNumber(primitive["material"]);
        const MaterialData& material = mesh_.materials[material_number];
        std::optional<GltfAccessor> second_uvs;
        for (const TextureData* texture :
             {&material.base_color_texture, &material.roughness_texture, &material.metallic_texture,
              &material.normal_texture, &material.occlusion_texture, &material.emitted_color_texture})
            if (texture->uv_set == 1)
                second_uvs = readAttribute(file_, attributes, "TEXCOORD_1", "VEC2", true, vertices);

        // Without normals faces are flat, and flat faces share no vertices: vertex i is corner i.
        std::vector<std::uint32_t> corners;
        if (!normals) {
            corners = triangles;
            for (std::size_t i = 0; i < triangles.size(); ++i)
                triangles[i] = static_cast<std::uint32_t>(i);
        }
        const std::size_t first = mesh_.positions.size();
        const std::size_t added = normals ? vertices : corners.size();
        index_total_ += triangles.size();
        vertices_read_ += vertices; // many nodes may use little of a large accessor
        if (std::max(first + added, vertices_read_) > max_mesh_vertices || index_total_ > max_mesh_indices)
            primitive.fail("makes the scene larger than " + std::to_string(max_mesh_vertices) +
                           " vertices or " + std::to_string(max_mesh_indices / 3) +
                           " triangles, simplify it");

        // The cofactor matrix is the inverse transpose times the determinant, and exists for flattened shapes
        // too.
        const glm::dmat3 linear(to_world);
        const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                  glm::cross(linear[0], linear[1]));
        const double handedness = glm::dot(linear[0], cofactor[0]) < 0.0 ? -1.0 : 1.0;

        // Element i of an attribute, converted, goes to every vertex that is made of it.
        const auto fill = [&](auto& to, const GltfAccessor& from, auto missing, const auto& convert) {
            std::vector<decltype(missing)> read(vertices, missing);
            forEachElement(from,
                           [&](std::size_t i, const GltfValues& values) { read[i] = convert(i, values); });
            to.resize(first, missing); // as parts before this one have none
            for (std::size_t i = 0; i < added; ++i)
                to.push_back(read[normals ? i : corners[i]]);
        };
        const auto toUv = [](std::size_t, const GltfValues& v) { return glm::vec2(v[0], v[1]); };
        fill(mesh_.positions, positions, glm::vec3(0.0F), [&](std::size_t i, const GltfValues& v) {
            const glm::dvec4 world = to_world * glm::dvec4(v[0], v[1], v[2], 1.0);
            for (int k = 0; k < 3; ++k)
                if (!(std::abs(world[k]) <= GltfValue::largest))
                    position.fail("the nodes move vertex " + std::to_string(i) + " to infinity");
            return glm::vec3(world);
        });
        mesh_.normals.resize(first + added, glm::vec3(0.0F, 0.0F, 1.0F));
        if (normals) {
            forEachElement(*normals, [&](std::size_t i, const GltfValues& v) {
                mesh_.normals[first + i] =
                    unitOr(cofactor * glm::dvec3(v[0], v[1], v[2]) * handedness, glm::vec3(0.0F, 0.0F, 1.0F));
            });
        }
        if (uvs) fill(mesh_.uvs, *uvs, glm::vec2(0.0F), toUv);
        mesh_.uvs.resize(first + added, glm::vec2(0.0F));
        if (second_uvs) fill(mesh_.second_uvs, *second_uvs, glm::vec2(0.0F), toUv);
        if (tangents) {
            fill(mesh_.tangents, *tangents, glm::vec4(0.0F), [&](std::size_t, const GltfValues& v) {
                const glm::vec3 tangent = unitOr(linear * glm::dvec3(v[0], v[1], v[2]), glm::vec3(0.0F));
                const double sign = (v[3] < 0.0 ? -1.0 : 1.0) * handedness;
                return tangent == glm::vec3(0.0F) ? glm::vec4(0.0F)
                                                  : glm::vec4(tangent, static_cast<float>(sign));
            });
        }
        if (colors) {
            colors->normalized = !colors->component.isFloat(); // the only meaning whole numbers have here
            const bool has_alpha = colors->components == 4;
            fill(mesh_.colors, *colors, glm::vec4(1.0F), [&](std::size_t, const GltfValues& v) {
                const glm::dvec4 color(v[0], v[1], v[2], has_alpha ? v[3] : 1.0);
                return glm::vec4(glm::clamp(color, 0.0, 1.0));
            });
        }

        std::vector<std::uint32_t>& indices = indices_by_material_[material_number];
        indices.reserve(indices.size() + triangles.size());
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            std::array<std::size_t, 3> corner = {first + triangles[i], first + triangles[i + 1],
                                                 first + triangles[i + 2]};
            if (handedness < 0.0) std::swap(corner[1], corner[2]); // a mirrored triangle shows its back
            if (!normals) {
                const glm::dvec3 a(mesh_.positions[corner[0]]);
                const glm::dvec3 b(mesh_.positions[corner[1]]);
                const glm::dvec3 c(mesh_.positions[corner[2]]);
                const glm::vec3 flat = unitOr(glm::cross(b - a, c - a), glm::vec3(0.0F, 0.0F, 1.0F));
                for (const std::size_t vertex : corner)
                    mesh_.normals[vertex] = flat;
            }
            for (const std::size_t vertex : corner)
                indices.push_back(static_cast<std::uint32_t>(vertex));
        }
    }

    GltfFile file_;
    MeshData mesh_;
    std::vector<std::vector<std::uint32_t>> indices_by_material_;
    std::map<std::string, std::size_t> material_numbers_; // by pointer
    std::set<std::string> warned_;
    std::string skipped_; // why the first primitive that is not drawn is not
    std::size_t index_total_ = 0;
    std::size_t vertices_read_ = 0;
};

} // namespace

MeshData loadGltf(const std::filesystem::path& path) { return GltfReader(path).run(); }

} // namespace gll
