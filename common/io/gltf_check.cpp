// Checks a glTF file before tinygltf sees it: tinygltf takes ranges beyond their buffers, writes past images,
// recurses as deep as the JSON nests and opens files outside the folder.
#include "io/gltf_check.hpp"

#include "io/files.hpp"
#include "io/mesh.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace gll {
namespace {

using Json = nlohmann::json;

// JSON takes many times its size once parsed; buffers of binary files do not count.
constexpr std::size_t max_json_bytes = std::size_t(128) << 20;
// An accessor without a buffer view is all zeros but for its sparse values; it costs a file nothing to claim
// many.
constexpr std::size_t max_zero_elements = std::size_t(1) << 20;
// Offsets and lengths: whatever is larger lies outside every buffer that can be read.
constexpr std::size_t max_offset = max_mesh_file_bytes;

std::size_t componentBytes(std::size_t component_type) {
    switch (component_type) {
    case 5120: // BYTE
    case 5121:
        return 1;
    case 5122: // SHORT
    case 5123:
        return 2;
    case 5125: // UNSIGNED_INT
    case 5126:
        return 4;
    default:
        return 0;
    }
}

std::size_t componentCount(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 7> counts = {
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
    for (const auto& [name, count] : counts)
        if (name == type) return count;
    return 0;
}

// Nothing for text that is not base64, whole groups of four or with the padding left off.
std::optional<std::string> decodeBase64(std::string_view text) {
    while (text.ends_with('='))
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        std::uint32_t value = 0;
        if (c >= 'A' && c <= 'Z')
            value = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            value = static_cast<std::uint32_t>(c - 'a') + 26;
        else if (c >= '0' && c <= '9')
            value = static_cast<std::uint32_t>(c - '0') + 52;
        else if (c == '+' || c == '/')
            value = c == '+' ? 62 : 63;
        else
            return std::nullopt;
        bits = (bits << 6 | value) & 0xffffff;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes += static_cast<char>(bits >> bit_count & 0xff);
        }
    }
    return bytes;
}

// Nothing where a '%' is not followed by two hexadecimal digits.
std::optional<std::string> decodePercent(std::string_view text) {
    std::string decoded;
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? digit(text[i + 2]) : -1;
        if (high < 0 || low < 0) return std::nullopt;
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

// Before parsing, because it is the depth of what is parsed that the parsers behind us do not survive.
bool nestsTooDeep(std::string_view json) {
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > max_json_nesting) return true;
        } else if (c == '}' || c == ']') {
            if (depth > 0) --depth;
        }
    }
    return false;
}

class GltfCheck {
  public:
    explicit GltfCheck(const std::filesystem::path& gltf_path) : path(gltf_path), name(gltf_path.string()) {}

    CheckedGltf run() {
        const std::string file = readFile(path, max_mesh_file_bytes);
        parse(split(file));
        checkHead();
        checkBuffers();
        checkViews();
        checkAccessors();
        checkImages();
        checkTextures();
        checkMaterials();
        checkMeshes();
        checkNodes();
        checkScenes();
        checked.json = clean.dump();
        return std::move(checked);
    }

  private:
    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
        throw fileError(name + ": " + pointer, what);
    }

    // --- the container ---

    static std::size_t littleEndian32(std::string_view bytes, std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = 4; i-- > 0;)
            value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
        return value;
    }

    // The JSON text; of a .glb also notes the binary chunk.
    std::string_view split(std::string_view file) {
        if (file.empty()) throw fileError(name, "is empty, export it again");
        if (!file.starts_with("glTF")) return file;
        constexpr std::size_t header_bytes = 12;
        if (file.size() < header_bytes || littleEndian32(file, 8) > file.size())
            throw fileError(name, "is shorter than its header says, fetch it again");
        if (littleEndian32(file, 4) != 2)
            throw fileError(name, "is binary glTF of version " + std::to_string(littleEndian32(file, 4)) +
                                      ", 2 is read");
        std::string_view json;
        std::size_t at = header_bytes;
        const std::size_t end = littleEndian32(file, 8);
        for (std::size_t chunk = 0; at + 8 <= end; ++chunk) {
            const std::size_t length = littleEndian32(file, at);
            const std::string_view type = file.substr(at + 4, 4);
            if (length > end - at - 8)
                throw fileError(name, "chunk " + std::to_string(chunk) +
                                          " is longer than the file, fetch it again");
            if (chunk == 0 && type != "JSON") throw fileError(name, "does not begin with a JSON chunk");
            if (chunk == 0) json = file.substr(at + 8, length);
            if (chunk == 1 && type == std::string_view("BIN\0", 4))
                binary_chunk = file.substr(at + 8, length);
            at += 8 + length;
        }
        if (json.empty()) throw fileError(name, "has no JSON chunk, export it again");
        return json;
    }

    void parse(std::string_view json) {
        if (json.size() > max_json_bytes)
            throw fileError(name, "has more than " + std::to_string(max_json_bytes >> 20) +
                                      " MiB of JSON, keep its data in a .bin file");
        if (nestsTooDeep(json))
            throw fileError(name, "nests JSON deeper than " + std::to_string(max_json_nesting) + " levels");
        try {
            doc = Json::parse(json);
        } catch (const Json::exception& error) { // "[json.exception.parse_error.101] parse error at line ..."
            const std::string_view what = error.what();
            const std::size_t bracket = what.find("] ");
            throw fileError(name, "is not JSON: " + std::string(bracket == std::string_view::npos
                                                                    ? what
                                                                    : what.substr(bracket + 2, 160)));
        }
        if (!doc.is_object()) throw fileError(name, "is not a JSON object, so not glTF");
    }

    // --- access with checks ---

    // A top-level array of objects; empty if the file has none.
    const Json& list(const std::string& key) const {
        static const Json none = Json::array();
        const auto found = doc.find(key);
        if (found == doc.end()) return none;
        if (!found->is_array()) fail("/" + key, "is not an array");
        return *found;
    }

    template <typename Use>
    void forEach(const std::string& key, const Use& use) {
        Json& kept = clean[key] = Json::array();
        const Json& elements = list(key);
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const std::string pointer = "/" + key + "/" + std::to_string(i);
            if (!elements[i].is_object()) fail(pointer, "is not an object");
            kept.push_back(Json::object());
            use(elements[i], pointer, kept.back(), i);
        }
        if (kept.empty()) clean.erase(key);
    }

    std::optional<std::size_t> whole(const Json& object, const std::string& pointer, const char* key,
                                     std::size_t least, std::size_t most) const {
        const auto found = object.find(key);
        if (found == object.end()) return std::nullopt;
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() < least ||
            found->get<std::uint64_t>() > most)
            fail(pointer + "/" + key, "is " + found->dump().substr(0, 40) + ", a whole number of " +
                                          std::to_string(least) + " to " + std::to_string(most) +
                                          " is needed");
        return static_cast<std::size_t>(found->get<std::uint64_t>());
    }

    std::size_t wholeOr(const Json& object, const std::string& pointer, const char* key, std::size_t least,
                        std::size_t most, std::size_t fallback) const {
        return whole(object, pointer, key, least, most).value_or(fallback);
    }

    std::size_t needed(std::optional<std::size_t> value, const std::string& pointer, const char* key) const {
        if (!value) fail(pointer, "has no '" + std::string(key) + "'");
        return *value;
    }

    // An index into a top-level array.
    void checkIndex(const Json& value, const std::string& pointer, const char* array) const {
        const std::size_t size = list(array).size();
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size)
            fail(pointer,
                 "is " + value.dump().substr(0, 40) + ", there are " + std::to_string(size) + " " + array);
    }

    std::optional<std::size_t> index(const Json& object, const std::string& pointer, const char* key,
                                     const char* array) const {
        const auto found = object.find(key);
        if (found == object.end()) return std::nullopt;
        checkIndex(*found, pointer + "/" + key, array);
        return found->get<std::size_t>();
    }

    std::optional<std::string> text(const Json& object, const std::string& pointer, const char* key) const {
        const auto found = object.find(key);
        if (found == object.end()) return std::nullopt;
        if (!found->is_string()) fail(pointer + "/" + key, "is not a string");
        return found->get<std::string>();
    }

    bool flag(const Json& object, const std::string& pointer, const char* key) const {
        const auto found = object.find(key);
        if (found == object.end()) return false;
        if (!found->is_boolean()) fail(pointer + "/" + key, "is neither true nor false");
        return found->get<bool>();
    }

    const Json* object(const Json& parent, const std::string& pointer, const char* key) const {
        const auto found = parent.find(key);
        if (found == parent.end()) return nullptr;
        if (!found->is_object()) fail(pointer + "/" + key, "is not an object");
        return &*found;
    }

    void checkNumber(const Json& value, const std::string& pointer, double least, double most) const {
        if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most))
            fail(pointer, "is " + value.dump().substr(0, 40) + ", a number in its range is needed");
    }

    static constexpr double largest_float = std::numeric_limits<float>::max();

    // Copies a number, if there is one.
    void number(const Json& from, const std::string& pointer, const char* key, Json& to,
                double least = -largest_float, double most = largest_float) const {
        const auto found = from.find(key);
        if (found == from.end()) return;
        checkNumber(*found, pointer + "/" + key, least, most);
        to[key] = *found;
    }

    // Copies an array of `count` numbers, if there is one.
    void numbers(const Json& from, const std::string& pointer, const char* key, std::size_t count, Json& to,
                 double least = -largest_float, double most = largest_float) const {
        const auto found = from.find(key);
        if (found == from.end()) return;
        const std::string place = pointer + "/" + key;
        if (!found->is_array() || found->size() != count)
            fail(place, "is not an array of " + std::to_string(count) + " numbers");
        for (std::size_t i = 0; i < count; ++i)
            checkNumber((*found)[i], place + "/" + std::to_string(i), least, most);
        to[key] = *found;
    }

    // --- the file's parts ---

    void checkHead() {
        const Json* asset = object(doc, "", "asset");
        const std::string version = asset ? text(*asset, "/asset", "version").value_or("") : "";
        if (!version.starts_with("2."))
            fail("/asset/version", "is " + inQuotes(version) + ", glTF 2.0 is read; convert the file");
        clean["asset"]["version"] = "2.0";
        const Json& required = list("extensionsRequired");
        if (!required.empty())
            fail("/extensionsRequired/0",
                 "extension " + required[0].dump().substr(0, 80) + " is not supported, export without it");
    }

    std::string readUri(const std::string& uri, const std::string& pointer, std::size_t max_bytes,
                        std::filesystem::path* file) const {
        if (uri.starts_with("data:")) {
            const std::size_t comma = uri.find(',');
            if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
                fail(pointer, "is a data URI without ';base64,'");
            std::optional<std::string> bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
            if (!bytes) fail(pointer, "is a data URI that is not base64");
            return *std::move(bytes);
        }
        const std::optional<std::string> relative = decodePercent(uri);
        if (!relative) fail(pointer, inQuotes(uri) + " has a '%' without two hexadecimal digits");
        const std::filesystem::path found =
            confinedFile(path.parent_path(), *relative, name + ": " + pointer);
        if (file) {
            *file = found;
            return {};
        }
        return readFile(found, max_bytes);
    }

    void checkBuffers() {
        const Json& buffers = list("buffers");
        std::size_t total = 0;
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            const std::string pointer = "/buffers/" + std::to_string(i);
            if (!buffers[i].is_object()) fail(pointer, "is not an object");
            const std::size_t length =
                needed(whole(buffers[i], pointer, "byteLength", 1, max_offset), pointer, "byteLength");
            total += length;
            if (total > max_mesh_file_bytes)
                fail(pointer,
                     "makes all buffers larger than " + std::to_string(max_mesh_file_bytes >> 20) + " MiB");
            const std::optional<std::string> uri = text(buffers[i], pointer, "uri");
            if (!uri && (i != 0 || binary_chunk.empty()))
                fail(pointer, "has no 'uri', and there is no binary chunk for it");
            std::string bytes = uri ? readUri(*uri, pointer + "/uri", max_mesh_file_bytes, nullptr)
                                    : std::string(binary_chunk);
            if (bytes.size() < length)
                fail(pointer, "has " + std::to_string(bytes.size()) + " bytes, byteLength says " +
                                  std::to_string(length));
            bytes.resize(length);
            checked.buffers.push_back(std::move(bytes));
        }
    }

    void checkViews() {
        forEach("bufferViews", [&](const Json& view, const std::string& pointer, Json& kept, std::size_t) {
            const std::size_t buffer = needed(index(view, pointer, "buffer", "buffers"), pointer, "buffer");
            const std::size_t offset = wholeOr(view, pointer, "byteOffset", 0, max_offset, 0);
            const std::size_t length =
                needed(whole(view, pointer, "byteLength", 1, max_offset), pointer, "byteLength");
            const std::size_t stride = wholeOr(view, pointer, "byteStride", 4, 252, 0);
            if (offset + length > checked.buffers[buffer].size())
                fail(pointer, "ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                                  std::to_string(checked.buffers[buffer].size()));
            kept = {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
            if (stride != 0) kept["byteStride"] = stride;
            views.push_back({.buffer = buffer, .offset = offset, .length = length, .stride = stride});
        });
    }

    // `count` elements from `offset` of a view; an element has `bytes`.
    void checkRange(std::size_t view, std::size_t offset, std::size_t count, std::size_t bytes,
                    const std::string& pointer) const {
        const std::size_t stride = views[view].stride == 0 ? bytes : views[view].stride;
        if (stride < bytes)
            fail(pointer, "has elements of " + std::to_string(bytes) + " bytes in a view of stride " +
                              std::to_string(stride));
        // All factors are below 2^28: no overflow in 64 bits.
        const std::size_t end = offset + stride * (count - 1) + bytes;
        if (end > views[view].length)
            fail(pointer, "ends at byte " + std::to_string(end) + " of a buffer view of " +
                              std::to_string(views[view].length));
    }

    void checkAccessors() {
        forEach("accessors", [&](const Json& accessor, const std::string& pointer, Json& kept, std::size_t) {
            const std::size_t component =
                needed(whole(accessor, pointer, "componentType", 0, 65535), pointer, "componentType");
            if (componentBytes(component) == 0) fail(pointer + "/componentType", "is none of glTF's types");
            const std::string type = text(accessor, pointer, "type").value_or("");
            if (componentCount(type) == 0)
                fail(pointer + "/type", "is " + inQuotes(type) + ", none of glTF's types");
            const std::size_t bytes = componentBytes(component) * componentCount(type);
            const std::size_t count =
                needed(whole(accessor, pointer, "count", 1, max_mesh_indices), pointer, "count");
            const std::size_t offset = wholeOr(accessor, pointer, "byteOffset", 0, max_offset, 0);
            const std::optional<std::size_t> view = index(accessor, pointer, "bufferView", "bufferViews");
            kept = {{"componentType", component}, {"type", type}, {"count", count}, {"byteOffset", offset}};
            if (flag(accessor, pointer, "normalized")) kept["normalized"] = true;
            if (view) {
                checkRange(*view, offset, count, bytes, pointer);
                kept["bufferView"] = *view;
            } else if (count > max_zero_elements) {
                fail(pointer, "has " + std::to_string(count) + " elements without a buffer view, at most " +
                                  std::to_string(max_zero_elements) + " are read");
            }
            if (const Json* sparse = object(accessor, pointer, "sparse"))
                checkSparse(*sparse, pointer + "/sparse", count, bytes, kept["sparse"]);
            accessors.push_back({.component = component, .type = type, .count = count});
        });
    }

    void checkSparse(const Json& sparse, const std::string& pointer, std::size_t elements, std::size_t bytes,
                     Json& kept) const {
        const std::size_t count = needed(whole(sparse, pointer, "count", 1, elements), pointer, "count");
        kept["count"] = count;
        for (const char* part : {"indices", "values"}) {
            const std::string place = pointer + "/" + part;
            const Json* data = object(sparse, pointer, part);
            if (!data) fail(pointer, "has no '" + std::string(part) + "'");
            const std::size_t view =
                needed(index(*data, place, "bufferView", "bufferViews"), place, "bufferView");
            const std::size_t offset = wholeOr(*data, place, "byteOffset", 0, max_offset, 0);
            if (views[view].stride != 0) fail(place + "/bufferView", "has a stride, sparse data has none");
            kept[part] = {{"bufferView", view}, {"byteOffset", offset}};
            std::size_t element_bytes = bytes;
            if (part == std::string_view("indices")) {
                const std::size_t type =
                    needed(whole(*data, place, "componentType", 5121, 5125), place, "componentType");
                if (type != 5121 && type != 5123 && type != 5125)
                    fail(place + "/componentType", "is not an unsigned whole number");
                element_bytes = componentBytes(type);
                kept[part]["componentType"] = type;
            }
            checkRange(view, offset, count, element_bytes, place);
        }
    }

    void checkImages() {
        const Json& images = list("images");
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::string pointer = "/images/" + std::to_string(i);
            if (!images[i].is_object()) fail(pointer, "is not an object");
            const std::optional<std::string> uri = text(images[i], pointer, "uri");
            const std::optional<std::size_t> view = index(images[i], pointer, "bufferView", "bufferViews");
            if (uri.has_value() == view.has_value()) fail(pointer, "needs either 'uri' or 'bufferView'");
            ImageSource source{.name = name + ": " + pointer, .file = {}, .encoded = nullptr};
            if (view) {
                const View& v = views[*view];
                source.encoded =
                    std::make_shared<const std::string>(checked.buffers[v.buffer].substr(v.offset, v.length));
            } else {
                std::string bytes = readUri(*uri, pointer + "/uri", max_mesh_file_bytes, &source.file);
                if (source.file.empty())
                    source.encoded = std::make_shared<const std::string>(std::move(bytes));
            }
            image_bytes += source.encoded ? source.encoded->size() : 0;
            if (image_bytes > max_mesh_file_bytes)
                fail(pointer, "makes all embedded images larger than " +
                                  std::to_string(max_mesh_file_bytes >> 20) + " MiB");
            checked.images.push_back(std::move(source));
        }
    }

    void checkTextures() {
        forEach("textures", [&](const Json& texture, const std::string& pointer, Json& kept, std::size_t) {
            const std::optional<std::size_t> source = index(texture, pointer, "source", "images");
            if (source) kept["source"] = *source;
            texture_has_source.push_back(source.has_value());
        });
    }

    // A material's reference to a texture; `scalar` names the number some of them carry.
    void checkTexture(const Json& from, const std::string& pointer, const char* key, Json& to,
                      const char* scalar = nullptr) const {
        const Json* info = object(from, pointer, key);
        if (!info) return;
        const std::string place = pointer + "/" + key;
        const std::size_t texture = needed(index(*info, place, "index", "textures"), place, "index");
        if (!texture_has_source[texture])
            fail("/textures/" + std::to_string(texture), "has no PNG or JPEG 'source', export one");
        if (wholeOr(*info, place, "texCoord", 0, 65535, 0) != 0)
            fail(place + "/texCoord", "is not 0, only the first set of texture coordinates is read");
        to[key]["index"] = texture;
        if (scalar) number(*info, place, scalar, to[key]);
    }

    void checkMaterials() {
        forEach("materials", [&](const Json& material, const std::string& pointer, Json& kept, std::size_t) {
            if (const auto material_name = text(material, pointer, "name")) kept["name"] = *material_name;
            if (const Json* pbr = object(material, pointer, "pbrMetallicRoughness")) {
                const std::string place = pointer + "/pbrMetallicRoughness";
                Json& kept_pbr = kept["pbrMetallicRoughness"] = Json::object();
                numbers(*pbr, place, "baseColorFactor", 4, kept_pbr, 0.0, 1.0);
                number(*pbr, place, "metallicFactor", kept_pbr, 0.0, 1.0);
                number(*pbr, place, "roughnessFactor", kept_pbr, 0.0, 1.0);
                checkTexture(*pbr, place, "baseColorTexture", kept_pbr);
                checkTexture(*pbr, place, "metallicRoughnessTexture", kept_pbr);
            }
            checkTexture(material, pointer, "normalTexture", kept, "scale");
            checkTexture(material, pointer, "occlusionTexture", kept, "strength");
            checkTexture(material, pointer, "emissiveTexture", kept);
            numbers(material, pointer, "emissiveFactor", 3, kept, 0.0, 1.0);
            if (flag(material, pointer, "doubleSided")) kept["doubleSided"] = true;
            if (const Json* extensions = object(material, pointer, "extensions")) {
                const char* key = "KHR_materials_emissive_strength";
                if (const Json* strength = object(*extensions, pointer + "/extensions", key)) {
                    Json& kept_strength = kept["extensions"][key] = Json::object();
                    number(*strength, pointer + "/extensions/" + key, "emissiveStrength", kept_strength, 0.0);
                }
            }
        });
    }

    // An attribute's accessor, if the primitive has it; the types are those of glTF 2.0, section 3.7.2.1.
    void checkAttribute(const Json& attributes, const std::string& pointer, const char* key, const char* type,
                        bool small_integers, std::size_t vertices, Json& kept) const {
        const std::optional<std::size_t> found = index(attributes, pointer, key, "accessors");
        if (!found) return;
        const Accessor& accessor = accessors[*found];
        const bool component_fits =
            accessor.component == 5126 ||
            (small_integers && (accessor.component == 5121 || accessor.component == 5123));
        if (accessor.type != type || !component_fits)
            fail(pointer + "/" + key, "refers to an accessor of another type than " + std::string(type) +
                                          " of float" +
                                          (small_integers ? ", unsigned byte or unsigned short" : ""));
        if (accessor.count != vertices)
            fail(pointer + "/" + key, "has " + std::to_string(accessor.count) + " elements for " +
                                          std::to_string(vertices) + " vertices");
        kept[key] = *found;
    }

    void checkMeshes() {
        forEach("meshes", [&](const Json& mesh, const std::string& pointer, Json& kept, std::size_t) {
            const auto primitives = mesh.find("primitives");
            if (primitives == mesh.end() || !primitives->is_array() || primitives->empty())
                fail(pointer + "/primitives", "is not an array of primitives");
            kept["primitives"] = Json::array();
            for (std::size_t i = 0; i < primitives->size(); ++i) {
                const std::string place = pointer + "/primitives/" + std::to_string(i);
                const Json& primitive = (*primitives)[i];
                if (!primitive.is_object()) fail(place, "is not an object");
                Json& kept_primitive = kept["primitives"].emplace_back(Json::object());
                kept_primitive["mode"] = wholeOr(primitive, place, "mode", 0, 6, 4);
                if (const auto material = index(primitive, place, "material", "materials"))
                    kept_primitive["material"] = *material;
                const Json* attributes = object(primitive, place, "attributes");
                const std::string inside = place + "/attributes";
                if (!attributes) fail(place, "has no 'attributes'");
                Json& kept_attributes = kept_primitive["attributes"] = Json::object();
                const std::size_t position =
                    needed(index(*attributes, inside, "POSITION", "accessors"), inside, "POSITION");
                const std::size_t vertices = accessors[position].count;
                if (vertices > max_mesh_vertices)
                    fail(inside + "/POSITION",
                         "has more than " + std::to_string(max_mesh_vertices) + " vertices");
                checkAttribute(*attributes, inside, "POSITION", "VEC3", false, vertices, kept_attributes);
                checkAttribute(*attributes, inside, "NORMAL", "VEC3", false, vertices, kept_attributes);
                checkAttribute(*attributes, inside, "TANGENT", "VEC4", false, vertices, kept_attributes);
                checkAttribute(*attributes, inside, "TEXCOORD_0", "VEC2", true, vertices, kept_attributes);
                if (const auto indices = index(primitive, place, "indices", "accessors")) {
                    const Accessor& accessor = accessors[*indices];
                    if (accessor.type != "SCALAR" ||
                        (accessor.component != 5121 && accessor.component != 5123 &&
                         accessor.component != 5125))
                        fail(place + "/indices",
                             "refers to an accessor that is not SCALAR of unsigned whole numbers");
                    kept_primitive["indices"] = *indices;
                }
            }
        });
    }

    void checkNodes() {
        const std::size_t count = list("nodes").size();
        constexpr std::size_t no_parent = std::numeric_limits<std::size_t>::max();
        std::vector<std::size_t> parents(count, no_parent);
        forEach("nodes", [&](const Json& node, const std::string& pointer, Json& kept, std::size_t i) {
            if (const auto mesh = index(node, pointer, "mesh", "meshes")) kept["mesh"] = *mesh;
            numbers(node, pointer, "matrix", 16, kept);
            if (!kept.contains("matrix")) {
                numbers(node, pointer, "translation", 3, kept);
                numbers(node, pointer, "rotation", 4, kept, -1.0, 1.0);
                numbers(node, pointer, "scale", 3, kept);
            }
            const auto children = node.find("children");
            if (children == node.end()) return;
            if (!children->is_array()) fail(pointer + "/children", "is not an array");
            for (std::size_t k = 0; k < children->size(); ++k) {
                const std::string place = pointer + "/children/" + std::to_string(k);
                checkIndex((*children)[k], place, "nodes");
                std::size_t& parent = parents[(*children)[k].get<std::size_t>()];
                if (parent != no_parent)
                    fail(place,
                         "is already a child of node " + std::to_string(parent) + ", a node has one parent");
                parent = i;
            }
            if (!children->empty()) kept["children"] = *children;
        });
        // With one parent each, whatever does not reach a root within the limit is too deep or goes round.
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t depth = 1;
            for (std::size_t at = i; parents[at] != no_parent; at = parents[at])
                if (++depth > max_node_depth)
                    fail("/nodes/" + std::to_string(i), "is its own ancestor or lies deeper than " +
                                                            std::to_string(max_node_depth) + " levels");
            is_root.push_back(parents[i] == no_parent);
        }
    }

    // Keeps one scene: the one to be read, with its nodes, each a root named once.
    void checkScenes() {
        const std::optional<std::size_t> chosen = index(doc, "", "scene", "scenes");
        const Json& scenes = list("scenes");
        Json roots = Json::array();
        if (scenes.empty()) {
            for (std::size_t i = 0; i < is_root.size(); ++i)
                if (is_root[i]) roots.push_back(i);
        } else {
            const std::string pointer = "/scenes/" + std::to_string(chosen.value_or(0));
            const Json& scene = scenes[chosen.value_or(0)];
            if (!scene.is_object()) fail(pointer, "is not an object");
            const auto nodes = scene.find("nodes");
            if (nodes != scene.end() && !nodes->is_array()) fail(pointer + "/nodes", "is not an array");
            std::vector<bool> named(is_root.size(), false);
            for (std::size_t i = 0; nodes != scene.end() && i < nodes->size(); ++i) {
                const std::string place = pointer + "/nodes/" + std::to_string(i);
                checkIndex((*nodes)[i], place, "nodes");
                const std::size_t node = (*nodes)[i].get<std::size_t>();
                if (!is_root[node] || named[node])
                    fail(place, named[node] ? "names a node twice" : "is not a root node");
                named[node] = true;
                roots.push_back(node);
            }
        }
        if (roots.empty())
            throw fileError(name, "has no nodes in its scene, nothing to draw; export it again");
        clean["scenes"] = Json::array({{{"nodes", roots}}});
        clean["scene"] = 0;
    }

    struct View {
        std::size_t buffer, offset, length, stride; // stride 0: packed
    };
    struct Accessor {
        std::size_t component;
        std::string type;
        std::size_t count;
    };

    const std::filesystem::path& path;
    const std::string name;
    std::string_view binary_chunk;
    Json doc;
    Json clean;
    CheckedGltf checked;
    std::vector<View> views;
    std::vector<Accessor> accessors;
    std::vector<bool> texture_has_source;
    std::vector<bool> is_root;
    std::size_t image_bytes = 0;
};

} // namespace

CheckedGltf checkGltf(const std::filesystem::path& path) { return GltfCheck(path).run(); }

} // namespace gll
