// Numbers in a glTF file's buffers, by the accessors that say where and how they lie. Private to common/io.
#pragma once

#include "io/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gll {

struct GltfComponentType {
    std::size_t code = 0; // 5120 to 5126, as OpenGL's GL_BYTE to GL_FLOAT
    std::size_t bytes = 0;
    double (*read)(const char*) = nullptr;
    double largest = 0; // of whole numbers, what 1 is stored as where they are normalised

    bool isFloat() const { return code == 5126; }
    bool isUnsigned() const { return code == 5121 || code == 5123 || code == 5125; }
};

// A run of elements inside a buffer view, which holds all of them.
struct GltfElements {
    const char* first = nullptr; // null: all are zero
    std::size_t stride = 0;      // bytes from one to the next
};

struct GltfAccessor {
    GltfValue place;
    std::string type;
    GltfComponentType component;
    std::size_t components = 0; // of an element
    std::size_t count = 0;
    bool normalized = false;
    GltfElements elements = {};
    // of those that replace some elements
    std::size_t sparse_count = 0;
    GltfComponentType position_type = {};
    GltfElements positions = {};
    GltfElements replacements = {};
};

using GltfValues = std::array<double, 4>;

// Calls use(i, values) for every element i; a second time, with the values that count, for those that are
// sparse. At most four components.
template <typename Use>
void forEachElement(const GltfAccessor& accessor, const Use& use) {
    GltfValues values{};
    const auto useElement = [&](std::size_t i, const char* bytes) {
        for (std::size_t k = 0; k < accessor.components; ++k, bytes += accessor.component.bytes) {
            values[k] = accessor.component.read(bytes);
            if (accessor.normalized) values[k] = std::max(values[k] / accessor.component.largest, -1.0);
            if (!std::isfinite(values[k]))
                accessor.place.fail("element " + std::to_string(i) + " is not a finite number");
        }
        use(i, values);
    };
    for (std::size_t i = 0; i < accessor.count; ++i) {
        if (accessor.elements.first != nullptr)
            useElement(i, accessor.elements.first + i * accessor.elements.stride);
        else
            use(i, values);
    }
    for (std::size_t k = 0; k < accessor.sparse_count; ++k) {
        const auto i = static_cast<std::size_t>(
            accessor.position_type.read(accessor.positions.first + k * accessor.positions.stride));
        if (i >= accessor.count)
            accessor.place["sparse"]["indices"].fail("position " + std::to_string(i) +
                                                     " is beyond the accessor's " +
                                                     std::to_string(accessor.count) + " elements");
        useElement(i, accessor.replacements.first + k * accessor.replacements.stride);
    }
}

// The accessor of that number, checked against its buffer view. Throws as GltfValue does.
GltfAccessor readAccessor(GltfFile& file, const GltfValue& number);

// Fails at the place where numbers are not unsigned and whole.
void requireUnsigned(const GltfComponentType& type, const GltfValue& place);

// An attribute, if the primitive has it; types as in glTF 2.0, section 3.7.2.1, and
// KHR_mesh_quantization.
std::optional<GltfAccessor> readAttribute(GltfFile& file, const GltfValue& attributes, const char* key,
                                          std::string_view types, bool small_unsigned, std::size_t vertices);

} // namespace gll
