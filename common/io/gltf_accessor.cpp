// Accessors of glTF 2.0, section 3.6.2, and what an attribute's may be.
#include "io/gltf_accessor.hpp"

#include "io/files.hpp"
#include "io/mesh.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace gll {
namespace {

// An accessor without a buffer view is all zeros but for its sparse values; it costs a file nothing to claim
// many.
constexpr std::size_t max_zero_elements = std::size_t(1) << 20;

constexpr std::size_t unsigned_byte = 5121;
constexpr std::size_t unsigned_short = 5123;
constexpr std::size_t unsigned_int = 5125;
constexpr std::size_t single_float = 5126;

template <typename Stored>
double stored(const char* bytes) {
    Stored value;
    std::memcpy(&value, bytes, sizeof value); // buffers promise no alignment
    return static_cast<double>(value);
}

constexpr GltfComponentType component_types[] = {{5120, 1, stored<std::int8_t>, 127},
                                                 {unsigned_byte, 1, stored<std::uint8_t>, 255},
                                                 {5122, 2, stored<std::int16_t>, 32767},
                                                 {unsigned_short, 2, stored<std::uint16_t>, 65535},
                                                 {unsigned_int, 4, stored<std::uint32_t>, 4294967295.0},
                                                 {single_float, 4, stored<float>, 1}};

GltfComponentType componentType(const GltfValue& code) {
    const std::size_t number = code.whole(5120, 5126);
    for (const GltfComponentType& type : component_types)
        if (type.code == number) return type;
    code.fail("is none of glTF's types");
}

std::size_t componentCount(const GltfValue& type) {
    constexpr std::pair<std::string_view, std::size_t> counts[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, count] : counts)
        if (name == type.text()) return count;
    type.fail("is " + inQuotes(type.text()) + ", none of glTF's types");
}

// Where `count` elements of `bytes` each lie, from an offset into a view.
GltfElements elements(GltfFile& file, const GltfValue& view, const GltfValue& offset, std::size_t count,
                      std::size_t bytes, const GltfValue& place) {
    const std::string_view data = file.bytes(view);
    const std::size_t first = offset.whole(0, max_mesh_file_bytes, 0);
    const std::size_t stride = view["byteStride"].whole(4, 252, bytes);
    if (stride < bytes)
        place.fail("has elements of " + std::to_string(bytes) + " bytes in a view of stride " +
                   std::to_string(stride));
    const std::size_t end = first + stride * (count - 1) + bytes; // all below 2^28: no overflow
    if (end > data.size())
        place.fail("ends at byte " + std::to_string(end) + " of a buffer view of " +
                   std::to_string(data.size()));
    return {.first = data.data() + first, .stride = stride};
}

} // namespace

void requireUnsigned(const GltfComponentType& type, const GltfValue& place) {
    if (!type.isUnsigned()) place.fail("is not SCALAR of unsigned whole numbers");
}

GltfAccessor readAccessor(GltfFile& file, const GltfValue& number) {
    const GltfValue place = number.in(file["accessors"]);
    const GltfValue views = file["bufferViews"];
    GltfAccessor accessor{.place = place,
                          .type = place.needed("type").text(),
                          .component = componentType(place.needed("componentType")),
                          .components = componentCount(place["type"]),
                          .count = place.needed("count").whole(1, max_mesh_indices),
                          .normalized = place["normalized"].flag()};
    const std::size_t bytes = accessor.component.bytes * accessor.components;
    if (const GltfValue view = place["bufferView"])
        accessor.elements = elements(file, view.in(views), place["byteOffset"], accessor.count, bytes, place);
    else if (accessor.count > max_zero_elements)
        place.fail("has " + std::to_string(accessor.count) + " elements without a buffer view, at most " +
                   std::to_string(max_zero_elements) + " are read");
    if (const GltfValue sparse = place["sparse"]) {
        accessor.sparse_count = sparse.needed("count").whole(1, accessor.count);
        const auto part = [&](const GltfValue& data, std::size_t element_bytes) {
            const GltfValue view = data.needed("bufferView").in(views);
            if (view["byteStride"]) data["bufferView"].fail("has a stride, sparse data has none");
            return elements(file, view, data["byteOffset"], accessor.sparse_count, element_bytes, data);
        };
        const GltfValue indices = sparse.needed("indices");
        accessor.position_type = componentType(indices.needed("componentType"));
        requireUnsigned(accessor.position_type, indices["componentType"]);
        accessor.positions = part(indices, accessor.position_type.bytes);
        accessor.replacements = part(sparse.needed("values"), bytes);
    }
    return accessor;
}

std::optional<GltfAccessor> readAttribute(GltfFile& file, const GltfValue& attributes, const char* key,
                                          std::string_view types, bool small_unsigned, std::size_t vertices) {
    const GltfValue number = attributes[key];
    if (!number) return std::nullopt;
    const GltfAccessor found = readAccessor(file, number);
    const std::size_t code = found.component.code;
    const bool small = code <= unsigned_short;
    const bool fits = found.component.isFloat() ||
                      (small_unsigned && (code == unsigned_byte || code == unsigned_short)) ||
                      (small && file.requiresExtension("KHR_mesh_quantization"));
    if (types.find(found.type) == std::string_view::npos || (!fits && !small))
        number.fail("refers to an accessor of another type than " + std::string(types) + " of float" +
                    (small_unsigned ? ", unsigned byte or unsigned short" : ""));
    if (!fits)
        number.fail("is stored in small whole numbers, name KHR_mesh_quantization in extensionsRequired");
    if (found.count != vertices)
        number.fail("has " + std::to_string(found.count) + " elements for " + std::to_string(vertices) +
                    " vertices");
    return found;
}

} // namespace gll
