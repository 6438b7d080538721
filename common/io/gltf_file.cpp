// The glTF container, its JSON with checks, its buffers and images. JSON comes from nlohmann's parser, which
// recurses as deep as the text nests: that is limited first.
#include "io/gltf_file.hpp"

#include "io/files.hpp"
#include "io/mesh.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace gll {
namespace {

using Json = nlohmann::json;

// JSON takes many times its size once parsed; buffers of binary files do not count.
constexpr std::size_t max_json_bytes = std::size_t(128) << 20;
// By how much exporters round factors and rotations out of their ranges.
constexpr double rounding = 1e-5;

// Nothing for text that is not base64, whole groups of four or with the padding left off.
std::optional<std::string> decodeBase64(std::string_view text) {
    static const std::array<int, 256> values = [] {
        constexpr std::string_view digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::array<int, 256> result{};
        for (std::size_t c = 0; c < 256; ++c) {
            const std::size_t found = digits.find(static_cast<char>(c));
            result[c] = found == std::string_view::npos ? -1 : static_cast<int>(found);
        }
        return result;
    }();
    while (text.ends_with('='))
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = values[static_cast<unsigned char>(c)];
        if (value < 0) return std::nullopt;
        bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xffffff;
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes += static_cast<char>(bits >> bit_count & 0xff);
    }
    return bytes;
}

// Nothing where a '%' is not followed by two hexadecimal digits.
std::optional<std::string> decodePercent(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const std::string digits(text.substr(i + 1, 2));
        if (digits.size() != 2 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
            return std::nullopt;
        decoded += static_cast<char>(std::stoi(digits, nullptr, 16));
        i += 2;
    }
    return decoded;
}

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
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
    return false;
}

std::shared_ptr<const Json> parsed(const std::string& name, std::string_view json) {
    if (json.size() > max_json_bytes)
        throw fileError(name, "has more than " + std::to_string(max_json_bytes >> 20) +
                                  " MiB of JSON, keep its data in a .bin file");
    if (nestsTooDeep(json))
        throw fileError(name, "nests JSON deeper than " + std::to_string(max_json_nesting) + " levels");
    try {
        auto result = std::make_shared<const Json>(Json::parse(json));
        if (!result->is_object()) throw fileError(name, "is not a JSON object, so not glTF");
        return result;
    } catch (const Json::exception& error) { // "[json.exception.parse_error.101] parse error at line ..."
        const std::string_view what = error.what();
        const std::size_t bracket = what.find("] ");
        throw fileError(name, "is not JSON: " + std::string(bracket == std::string_view::npos
                                                                ? what
                                                                : what.substr(bracket + 2, 160)));
    }
}

std::size_t littleEndian32(std::string_view bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

// Of a value that may be of any length, as a message shows it.
std::string shown(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40);
}

} // namespace

// --- values ---

void GltfValue::fail(std::string_view what) const {
    throw fileError(pointer_.empty() ? *path_ : *path_ + ": " + pointer_, what);
}

GltfValue GltfValue::operator[](std::string_view key) const {
    const std::string inner = pointer_ + "/" + std::string(key);
    if (value_ == nullptr) return {*path_, nullptr, inner};
    if (!value_->is_object()) fail("is not an object");
    const auto found = value_->find(key);
    return {*path_, found == value_->end() ? nullptr : &*found, inner};
}

std::vector<std::string> GltfValue::keys() const {
    std::vector<std::string> keys;
    if (value_ == nullptr) return keys;
    if (!value_->is_object()) fail("is not an object");
    for (const auto& [key, value] : value_->items())
        keys.push_back(key);
    return keys;
}

GltfValue GltfValue::needed(std::string_view key) const {
    GltfValue value = (*this)[key];
    if (!value) fail("has no '" + std::string(key) + "'");
    return value;
}

GltfValue GltfValue::operator[](std::size_t i) const {
    return {*path_, i < size() ? &(*value_)[i] : nullptr, pointer_ + "/" + std::to_string(i)};
}

std::size_t GltfValue::size() const {
    if (value_ == nullptr) return 0;
    if (!value_->is_array()) fail("is not an array");
    return value_->size();
}

std::size_t GltfValue::index(const GltfValue& array) const {
    const std::size_t size = array.size();
    if (value_ == nullptr || !value_->is_number_unsigned() || value_->get<std::uint64_t>() >= size)
        fail("is " + (value_ ? shown(*value_) : "missing") + ", there are " + std::to_string(size) + " " +
             array.pointer_.substr(1));
    return value_->get<std::size_t>();
}

GltfValue GltfValue::in(const GltfValue& array) const { return array[index(array)]; }

std::size_t GltfValue::whole(std::size_t least, std::size_t most) const {
    if (value_ == nullptr || !value_->is_number_unsigned() || value_->get<std::uint64_t>() < least ||
        value_->get<std::uint64_t>() > most)
        fail("is " + (value_ ? shown(*value_) : "missing") + ", a whole number of " + std::to_string(least) +
             " to " + std::to_string(most) + " is needed");
    return value_->get<std::size_t>();
}

std::size_t GltfValue::whole(std::size_t least, std::size_t most, std::size_t fallback) const {
    return value_ == nullptr ? fallback : whole(least, most);
}

double GltfValue::number(double fallback, double least, double most) const {
    if (value_ == nullptr) return fallback;
    const double value = value_->is_number() ? value_->get<double>() : most * 2;
    if (!(value >= least - rounding && value <= most + rounding))
        fail("is " + shown(*value_) + ", a number in its range is needed");
    return std::clamp(value, least, most);
}

void GltfValue::requireNumbers(std::size_t count) const {
    if (!value_->is_array() || value_->size() != count)
        fail("is not an array of " + std::to_string(count) + " numbers");
}

std::string GltfValue::text(std::string fallback) const {
    if (value_ == nullptr) return fallback;
    if (!value_->is_string()) fail("is not a string");
    return value_->get<std::string>();
}

bool GltfValue::flag() const {
    if (value_ == nullptr) return false;
    if (!value_->is_boolean()) fail("is neither true nor false");
    return value_->get<bool>();
}

// --- the file ---

GltfFile::GltfFile(const std::filesystem::path& path, const std::vector<std::string_view>& extensions)
    : path_(path), name_(path.string()), file_(readFile(path, max_mesh_file_bytes)) {
    if (file_.empty()) throw fileError(name_, "is empty, export it again");
    const std::string_view json = file_.starts_with("glTF") ? splitBinary() : std::string_view(file_);
    json_ = parsed(name_, json);

    const GltfValue asset = (*this)["asset"];
    const std::string version = asset["version"].text();
    if (!version.starts_with("2."))
        asset["version"].fail("is " + inQuotes(version) + ", glTF 2.0 is read; convert the file");
    const std::string least = asset["minVersion"].text("2.0");
    if (least != "2.0" && !least.starts_with("1."))
        asset["minVersion"].fail("is " + inQuotes(least) + ", glTF 2.0 is read; convert the file");
    const GltfValue required = (*this)["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string extension = required[i].text();
        if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
            required[i].fail("extension " + inQuotes(extension) + " is not supported, export without it");
    }
}

// The JSON of a binary file; also notes the binary chunk.
std::string_view GltfFile::splitBinary() {
    const std::string_view file = file_;
    constexpr std::size_t header_bytes = 12;
    if (file.size() < header_bytes || littleEndian32(file, 8) > file.size())
        throw fileError(name_, "is shorter than its header says, fetch it again");
    if (littleEndian32(file, 4) != 2)
        throw fileError(name_, "is binary glTF of version " + std::to_string(littleEndian32(file, 4)) +
                                   ", 2 is read");
    std::string_view json;
    std::size_t at = header_bytes;
    const std::size_t end = littleEndian32(file, 8);
    for (std::size_t chunk = 0; at + 8 <= end; ++chunk) {
        const std::size_t length = littleEndian32(file, at);
        const std::string_view type = file.substr(at + 4, 4);
        if (length > end - at - 8)
            throw fileError(name_,
                            "chunk " + std::to_string(chunk) + " is longer than the file, fetch it again");
        if (chunk == 0 && type != "JSON") throw fileError(name_, "does not begin with a JSON chunk");
        if (chunk == 0) json = file.substr(at + 8, length);
        if (chunk == 1 && type == std::string_view("BIN\0", 4)) binary_chunk_ = file.substr(at + 8, length);
        at += 8 + length;
    }
    if (json.empty()) throw fileError(name_, "has no JSON chunk, export it again");
    return json;
}

bool GltfFile::requiresExtension(std::string_view extension) const {
    const GltfValue required = (*this)["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i)
        if (required[i].text() == extension) return true;
    return false;
}

// What the URI holds, or names: then *file is set, if one is asked for, and nothing is read.
std::string GltfFile::readUri(const GltfValue& uri, std::filesystem::path* file) const {
    const std::string text = uri.text();
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
            uri.fail("is a data URI without ';base64,'");
        std::optional<std::string> bytes = decodeBase64(std::string_view(text).substr(comma + 1));
        if (!bytes) uri.fail("is a data URI that is not base64");
        return *std::move(bytes);
    }
    const std::optional<std::string> relative = decodePercent(text);
    if (!relative) uri.fail(inQuotes(text) + " has a '%' without two hexadecimal digits");
    const std::string where = name_ + ": " + uri.pointer();
    if (file == nullptr)
        return readFile(confinedFile(path_.parent_path(), *relative, where), max_mesh_file_bytes);
    try {
        *file = confinedFile(path_.parent_path(), *relative, where);
    } catch (const std::runtime_error& error) {
        throw ImageMissing(error.what());
    }
    return {};
}

const std::string& GltfFile::buffer(const GltfValue& buffer) {
    const auto [known, is_new] = buffers_.try_emplace(buffer.pointer());
    if (!is_new) return known->second;
    const std::size_t length = buffer.needed("byteLength").whole(1, max_mesh_file_bytes);
    buffer_bytes_ += length;
    if (buffer_bytes_ > max_mesh_file_bytes)
        buffer.fail("makes all buffers larger than " + std::to_string(max_mesh_file_bytes >> 20) + " MiB");
    std::string bytes;
    if (const GltfValue uri = buffer["uri"]) {
        bytes = readUri(uri, nullptr);
    } else {
        for (const std::string& extension : buffer["extensions"].keys())
            buffer.fail("has no 'uri', its data is compressed by " + extension +
                        ", which is not read; export without it");
        if (buffer.pointer() != "/buffers/0" || binary_chunk_.empty())
            buffer.fail("has no 'uri', and there is no binary chunk for it");
        bytes = binary_chunk_;
    }
    if (bytes.size() < length)
        buffer.fail("has " + std::to_string(bytes.size()) + " bytes, byteLength says " +
                    std::to_string(length));
    bytes.resize(length);
    return known->second = std::move(bytes);
}

std::string_view GltfFile::bytes(const GltfValue& view) {
    const std::string& whole = buffer(view.needed("buffer").in((*this)["buffers"]));
    const std::size_t offset = view["byteOffset"].whole(0, max_mesh_file_bytes, 0);
    const std::size_t length = view.needed("byteLength").whole(1, max_mesh_file_bytes);
    if (offset + length > whole.size())
        view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                  std::to_string(whole.size()));
    return std::string_view(whole).substr(offset, length);
}

ImageSource GltfFile::image(const GltfValue& image) {
    const auto [known, is_new] = images_.try_emplace(image.pointer());
    if (!is_new) return known->second;
    const GltfValue uri = image["uri"];
    const GltfValue view = image["bufferView"];
    if (!uri && !view) throw ImageMissing(name_ + ": " + image.pointer() + ": names no image");
    if (uri && view) image.fail("needs either 'uri' or 'bufferView'");
    ImageSource source{.name = name_ + ": " + image.pointer(), .file = {}, .encoded = nullptr};
    std::string encoded =
        view ? std::string(bytes(view.in((*this)["bufferViews"]))) : readUri(uri, &source.file);
    if (source.file.empty()) source.encoded = std::make_shared<const std::string>(std::move(encoded));
    image_bytes_ += source.encoded ? source.encoded->size() : 0;
    if (image_bytes_ > max_mesh_file_bytes)
        image.fail("makes all embedded images larger than " + std::to_string(max_mesh_file_bytes >> 20) +
                   " MiB");
    return known->second = std::move(source);
}

} // namespace gll
