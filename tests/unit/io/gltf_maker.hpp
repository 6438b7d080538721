// Builds small glTF files: numbers go into one buffer, and the JSON stays open to be bent by a test.
// A fresh maker holds one triangle with counter-clockwise corners (0,0,0), (1,0,0), (0,1,0).
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace gll::test {

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

template <typename Number>
std::string packed(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

struct GltfMaker {
    using Json = nlohmann::json;

    GltfMaker() {
        const auto positions = accessor(packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, "VEC3", 3);
        json["asset"]["version"] = "2.0";
        json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        json["nodes"] = {{{"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }

    // Appends bytes as a buffer view and returns its index.
    std::size_t view(std::string_view bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
        buffer += bytes;
        return json["bufferViews"].size() - 1;
    }

    std::size_t accessor(std::string_view bytes, int component_type, const char* type, std::size_t count) {
        json["accessors"].push_back({{"bufferView", view(bytes)},
                                     {"componentType", component_type},
                                     {"type", type},
                                     {"count", count}});
        return json["accessors"].size() - 1;
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& attributes() { return primitive()["attributes"]; }

    // The text of a .gltf, with the buffer as a data URI unless the test has set buffers itself.
    std::string gltf() const {
        Json whole = json;
        if (!whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", buffer.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return whole.dump();
    }

    // The bytes of a .glb.
    std::string glb() const {
        Json whole = json;
        if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", buffer.size()}}};
        const auto chunk = [](std::string bytes, std::string_view type, char padding) {
            bytes.resize((bytes.size() + 3) / 4 * 4, padding);
            return packed<std::uint32_t>({static_cast<std::uint32_t>(bytes.size())}) + std::string(type) +
                   bytes;
        };
        const std::string chunks =
            chunk(whole.dump(), "JSON", ' ') + chunk(buffer, std::string_view("BIN\0", 4), '\0');
        return "glTF" + packed<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
    }

    Json json;
    std::string buffer;
};

} // namespace gll::test
