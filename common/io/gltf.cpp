// Reads glTF 2.0 meshes and materials through tinygltf, from JSON that gltf_check.cpp has checked and
// trimmed; what lies inside the buffers (indices, non-finite numbers) is checked here.
#include "io/files.hpp"
#include "io/gltf_check.hpp"
#include "io/mesh_build.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <fstream> // tinygltf without its file functions forgets it

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace gll {
namespace {

template <typename Stored>
double stored(const char* bytes) {
    Stored value;
    std::memcpy(&value, bytes, sizeof value); // buffers promise no alignment
    return static_cast<double>(value);
}

// One component as the number it stands for; normalised integers by glTF 2.0, section 3.11.
double component(const char* bytes, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const double value = stored<std::int8_t>(bytes);
        return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return stored<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const double value = stored<std::int16_t>(bytes);
        return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return stored<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return stored<std::uint32_t>(bytes);
    default:
        return static_cast<double>(stored<float>(bytes));
    }
}

class GltfReader {
  public:
    explicit GltfReader(const std::filesystem::path& path) : name(path.string()), checked(checkGltf(path)) {
        tinygltf::TinyGLTF loader;
        std::string error;
        std::string warning;
        if (!loader.LoadASCIIFromString(&model, &error, &warning, checked.json.c_str(),
                                        static_cast<unsigned>(checked.json.size()), ""))
            throw fileError(name, "cannot be read (" + error.substr(0, error.find('\n')) + ")");
    }

    MeshData run() {
        for (const tinygltf::Material& material : model.materials)
            mesh.materials.push_back(convert(material));
        indices_by_material.resize(model.materials.size() + 1); // the last: primitives without a material

        struct Visit {
            int node;
            glm::dmat4 parent_to_world;
        };
        std::vector<Visit> pending;
        for (const int root : model.scenes.at(0).nodes)
            pending.push_back({root, glm::dmat4(1.0)});
        while (!pending.empty()) {
            const Visit visit = pending.back();
            pending.pop_back();
            const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(visit.node));
            const glm::dmat4 to_world = visit.parent_to_world * localTransform(node, visit.node);
            if (node.mesh >= 0) addMesh(static_cast<std::size_t>(node.mesh), to_world);
            for (const int child : node.children)
                pending.push_back({child, to_world});
        }

        std::size_t index_count = 0;
        for (const auto& indices : indices_by_material)
            index_count += indices.size();
        if (index_count == 0) throw fileError(name, "has no triangles in its scene, export it again");
        if (!indices_by_material.back().empty()) mesh.materials.emplace_back(defaultMaterial());
        if (!has_tangents) mesh.tangents.clear();
        setParts(mesh, indices_by_material);
        return std::move(mesh);
    }

  private:
    // --- materials ---

    // glTF's default material is fully metallic, ours is not.
    static MaterialData defaultMaterial() {
        MaterialData material;
        material.name = "default";
        material.metallic = 1.0F;
        return material;
    }

    ImageSource image(int texture) const {
        if (texture < 0) return {};
        return checked.images.at(
            static_cast<std::size_t>(model.textures.at(static_cast<std::size_t>(texture)).source));
    }

    MaterialData convert(const tinygltf::Material& from) const {
        MaterialData to;
        to.name = from.name;
        const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
        to.base_color = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
        to.base_color_texture.image = image(pbr.baseColorTexture.index);
        to.emitted_color = glm::vec3(glm::make_vec3(from.emissiveFactor.data()));
        const auto strength = from.extensions.find("KHR_materials_emissive_strength");
        if (strength != from.extensions.end() && strength->second.Has("emissiveStrength"))
            to.emitted_color *=
                static_cast<float>(strength->second.Get("emissiveStrength").GetNumberAsDouble());
        to.emitted_color_texture.image = image(from.emissiveTexture.index);
        to.normal_texture.image = image(from.normalTexture.index);
        to.normal_scale = static_cast<float>(from.normalTexture.scale);
        to.occlusion_texture = {.image = image(from.occlusionTexture.index), .channel = 0};
        to.occlusion_strength = static_cast<float>(from.occlusionTexture.strength);
        to.roughness = static_cast<float>(pbr.roughnessFactor);
        to.roughness_texture = {.image = image(pbr.metallicRoughnessTexture.index), .channel = 1};
        to.metallic = static_cast<float>(pbr.metallicFactor);
        to.metallic_texture = {.image = image(pbr.metallicRoughnessTexture.index), .channel = 2};
        to.double_sided = from.doubleSided;
        return to;
    }

    // --- nodes ---

    glm::dmat4 localTransform(const tinygltf::Node& node, int number) const {
        if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
        glm::dmat4 transform(1.0);
        if (node.rotation.size() == 4) {
            const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
            const double length = glm::length(rotation);
            if (!(length > 0.0))
                throw fileError(name + ": /nodes/" + std::to_string(number) + "/rotation", "is all zero");
            transform = glm::mat4_cast(rotation / length);
        }
        if (node.scale.size() == 3)
            for (int i = 0; i < 3; ++i)
                transform[i] *= node.scale[static_cast<std::size_t>(i)];
        if (node.translation.size() == 3)
            transform[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
        return transform;
    }

    // --- accessors ---

    const char* viewBytes(int view, std::size_t offset) const {
        const tinygltf::BufferView& v = model.bufferViews.at(static_cast<std::size_t>(view));
        return checked.buffers.at(static_cast<std::size_t>(v.buffer)).data() + v.byteOffset + offset;
    }

    // Calls use(i, values) for every element i of an accessor of at most four components; a second time, with
    // the values that count, for those that are sparse.
    template <typename Use>
    void forEachElement(int number, const Use& use) const {
        const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(number));
        const std::size_t components = static_cast<std::size_t>(
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
        const std::size_t component_bytes = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
        std::array<double, 4> values{};
        const auto useElement = [&](std::size_t i, const char* bytes) {
            for (std::size_t k = 0; k < components; ++k) {
                values[k] =
                    component(bytes + k * component_bytes, accessor.componentType, accessor.normalized);
                if (!std::isfinite(values[k]))
                    throw fileError(name + ": /accessors/" + std::to_string(number),
                                    "element " + std::to_string(i) + " is not a finite number");
            }
            use(i, values);
        };
        if (accessor.bufferView >= 0) {
            const char* bytes = viewBytes(accessor.bufferView, accessor.byteOffset);
            std::size_t stride = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
            if (stride == 0) stride = components * component_bytes;
            for (std::size_t i = 0; i < accessor.count; ++i)
                useElement(i, bytes + i * stride);
        } else {
            for (std::size_t i = 0; i < accessor.count; ++i)
                use(i, values);
        }
        if (!accessor.sparse.isSparse) return;
        const auto& indices = accessor.sparse.indices;
        const std::size_t index_bytes = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indices.componentType)));
        const char* index = viewBytes(indices.bufferView, static_cast<std::size_t>(indices.byteOffset));
        const char* value = viewBytes(accessor.sparse.values.bufferView,
                                      static_cast<std::size_t>(accessor.sparse.values.byteOffset));
        for (int k = 0; k < accessor.sparse.count; ++k) {
            const std::size_t i = static_cast<std::size_t>(component(index, indices.componentType, false));
            if (i >= accessor.count)
                throw fileError(name + ": /accessors/" + std::to_string(number) + "/sparse/indices",
                                "position " + std::to_string(i) + " is beyond the accessor's " +
                                    std::to_string(accessor.count) + " elements");
            useElement(i, value);
            index += index_bytes;
            value += components * component_bytes;
        }
    }

    // --- meshes ---

    void addMesh(std::size_t number, const glm::dmat4& to_world) {
        const tinygltf::Mesh& from = model.meshes.at(number);
        for (std::size_t i = 0; i < from.primitives.size(); ++i)
            addPrimitive(from.primitives[i], to_world,
                         "/meshes/" + std::to_string(number) + "/primitives/" + std::to_string(i));
    }

    // The vertices' numbers three a triangle, whatever the mode.
    std::vector<std::uint32_t> triangleIndices(const tinygltf::Primitive& primitive, std::size_t vertices,
                                               const std::string& pointer) const {
        std::vector<std::uint32_t> order;
        if (primitive.indices >= 0) {
            order.resize(model.accessors.at(static_cast<std::size_t>(primitive.indices)).count);
            forEachElement(primitive.indices, [&](std::size_t i, const std::array<double, 4>& values) {
                if (values[0] >= static_cast<double>(vertices))
                    throw fileError(name + ": /accessors/" + std::to_string(primitive.indices),
                                    "element " + std::to_string(i) + " is index " +
                                        std::to_string(static_cast<std::uint32_t>(values[0])) + " of " +
                                        std::to_string(vertices) + " vertices");
                order[i] = static_cast<std::uint32_t>(values[0]);
            });
        } else {
            order.resize(vertices);
            for (std::size_t i = 0; i < vertices; ++i)
                order[i] = static_cast<std::uint32_t>(i);
        }
        if (order.size() < 3 || (primitive.mode == TINYGLTF_MODE_TRIANGLES && order.size() % 3 != 0))
            throw fileError(name + ": " + pointer,
                            std::to_string(order.size()) + " corners do not make whole triangles");
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) return order;

        if (order.size() - 2 > max_mesh_indices / 3)
            throw fileError(name + ": " + pointer, "has more than " + std::to_string(max_mesh_indices / 3) +
                                                       " triangles, simplify it");
        std::vector<std::uint32_t> triangles;
        triangles.reserve((order.size() - 2) * 3);
        for (std::size_t i = 0; i + 2 < order.size(); ++i) {
            if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) // every other one is turned over
                triangles.insert(triangles.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
            else
                triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
        }
        return triangles;
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const glm::dmat4& to_world,
                      const std::string& pointer) {
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return; // points and lines
        const auto attribute = [&](const char* key) {
            const auto found = primitive.attributes.find(key);
            return found == primitive.attributes.end() ? -1 : found->second;
        };
        const int positions = attribute("POSITION");
        const int normals = attribute("NORMAL");
        const int uvs = attribute("TEXCOORD_0");
        const int tangents =
            normals >= 0 ? attribute("TANGENT") : -1; // without normals glTF says to ignore them

        std::size_t vertices = model.accessors.at(static_cast<std::size_t>(positions)).count;
        std::vector<std::uint32_t> triangles = triangleIndices(primitive, vertices, pointer);
        // Without normals faces are flat, and flat faces share no vertices: vertex i is corner i.
        std::vector<std::uint32_t> corners;
        if (normals < 0) {
            corners = triangles;
            for (std::size_t i = 0; i < triangles.size(); ++i)
                triangles[i] = static_cast<std::uint32_t>(i);
        }
        const std::size_t first = mesh.positions.size();
        const std::size_t added = normals < 0 ? corners.size() : vertices;
        std::vector<std::uint32_t>& indices = indices_by_material[static_cast<std::size_t>(
            primitive.material < 0 ? static_cast<int>(model.materials.size()) : primitive.material)];
        index_total += triangles.size();
        vertices_read += vertices; // many nodes may use little of a large accessor
        if (std::max(first + added, vertices_read) > max_mesh_vertices || index_total > max_mesh_indices)
            throw fileError(name + ": " + pointer, "makes the scene larger than " +
                                                       std::to_string(max_mesh_vertices) + " vertices or " +
                                                       std::to_string(max_mesh_indices / 3) +
                                                       " triangles, simplify it");

        // The cofactor matrix is the inverse transpose times the determinant, and exists for flattened shapes
        // too.
        const glm::dmat3 linear(to_world);
        const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                  glm::cross(linear[0], linear[1]));
        const double handedness = glm::dot(linear[0], cofactor[0]) < 0.0 ? -1.0 : 1.0;

        mesh.positions.resize(first + added);
        mesh.normals.resize(first + added, glm::vec3(0.0F, 0.0F, 1.0F));
        mesh.uvs.resize(first + added, glm::vec2(0.0F));
        mesh.tangents.resize(first + added, glm::vec4(0.0F));

        std::vector<glm::vec3> world(vertices);
        forEachElement(positions, [&](std::size_t i, const std::array<double, 4>& v) {
            const glm::dvec4 position = to_world * glm::dvec4(v[0], v[1], v[2], 1.0);
            for (int k = 0; k < 3; ++k)
                if (!(std::abs(position[k]) <= static_cast<double>(std::numeric_limits<float>::max())))
                    throw fileError(name + ": " + pointer + "/attributes/POSITION",
                                    "the nodes move vertex " + std::to_string(i) + " to infinity");
            world[i] = glm::vec3(position);
        });
        std::vector<glm::vec2> file_uvs(uvs >= 0 ? vertices : 0);
        if (uvs >= 0)
            forEachElement(uvs, [&](std::size_t i, const std::array<double, 4>& v) {
                file_uvs[i] = glm::vec2(static_cast<float>(v[0]), static_cast<float>(v[1]));
            });
        for (std::size_t i = 0; i < added; ++i) {
            const std::size_t vertex = normals < 0 ? corners[i] : i;
            mesh.positions[first + i] = world[vertex];
            if (uvs >= 0) mesh.uvs[first + i] = file_uvs[vertex];
        }
        if (normals >= 0)
            forEachElement(normals, [&](std::size_t i, const std::array<double, 4>& v) {
                mesh.normals[first + i] =
                    unitOr(cofactor * glm::dvec3(v[0], v[1], v[2]) * handedness, glm::vec3(0.0F, 0.0F, 1.0F));
            });
        if (tangents >= 0) {
            has_tangents = true;
            forEachElement(tangents, [&](std::size_t i, const std::array<double, 4>& v) {
                const glm::vec3 tangent = unitOr(linear * glm::dvec3(v[0], v[1], v[2]), glm::vec3(0.0F));
                const double sign = (v[3] < 0.0 ? -1.0 : 1.0) * handedness;
                mesh.tangents[first + i] = tangent == glm::vec3(0.0F)
                                               ? glm::vec4(0.0F)
                                               : glm::vec4(tangent, static_cast<float>(sign));
            });
        }

        indices.reserve(indices.size() + triangles.size());
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            std::array<std::size_t, 3> corner = {first + triangles[i], first + triangles[i + 1],
                                                 first + triangles[i + 2]};
            if (handedness < 0.0) std::swap(corner[1], corner[2]); // a mirrored triangle shows its back
            if (normals < 0) {
                const glm::dvec3 a(mesh.positions[corner[0]]);
                const glm::dvec3 b(mesh.positions[corner[1]]);
                const glm::dvec3 c(mesh.positions[corner[2]]);
                const glm::vec3 flat = unitOr(glm::cross(b - a, c - a), glm::vec3(0.0F, 0.0F, 1.0F));
                for (const std::size_t vertex : corner)
                    mesh.normals[vertex] = flat;
            }
            for (const std::size_t vertex : corner)
                indices.push_back(static_cast<std::uint32_t>(vertex));
        }
    }

    const std::string name;
    CheckedGltf checked;
    tinygltf::Model model;
    MeshData mesh;
    std::vector<std::vector<std::uint32_t>> indices_by_material;
    std::size_t index_total = 0;
    std::size_t vertices_read = 0;
    bool has_tangents = false;
};

} // namespace

MeshData loadGltf(const std::filesystem::path& path) { return GltfReader(path).run(); }

} // namespace gll
