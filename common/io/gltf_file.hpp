// A glTF file as JSON whose every value is checked where it is read, and what it keeps outside of the JSON.
// Private to common/io. Only what is asked for is checked, opened and decoded: what a scene does not use may
// be broken.
#pragma once

#include "io/image.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gll {

// A value in the JSON, or the lack of one, and its place. Reading what has another type or lies out of range
// throws std::runtime_error "path: /json/pointer: what, what to do".
class GltfValue {
  public:
    static constexpr double largest = std::numeric_limits<float>::max();

    GltfValue(const std::string& path, const nlohmann::json* value, std::string pointer)
        : path_(&path), value_(value), pointer_(std::move(pointer)) {}

    explicit operator bool() const { return value_ != nullptr; }
    const std::string& pointer() const { return pointer_; }
    [[noreturn]] void fail(std::string_view what) const;

    // Of an object, or of nothing, whose members are nothing.
    GltfValue operator[](std::string_view key) const;
    std::vector<std::string> keys() const;
    // The member, which must be there.
    GltfValue needed(std::string_view key) const;
    // Of an array, or of nothing, which has no elements.
    GltfValue operator[](std::size_t i) const;
    std::size_t size() const;
    // The element of an array that this number says.
    GltfValue in(const GltfValue& array) const;
    std::size_t index(const GltfValue& array) const;

    std::size_t whole(std::size_t least, std::size_t most) const;
    std::size_t whole(std::size_t least, std::size_t most, std::size_t fallback) const;
    // Numbers out of range by rounding are moved into it.
    double number(double fallback, double least = -largest, double most = largest) const;
    template <std::size_t Count>
    std::array<double, Count> numbers(std::array<double, Count> fallback, double least = -largest,
                                      double most = largest) const {
        if (value_ == nullptr) return fallback;
        requireNumbers(Count);
        for (std::size_t i = 0; i < Count; ++i)
            fallback[i] = (*this)[i].number(0.0, least, most);
        return fallback;
    }
    std::string text(std::string fallback = "") const;
    bool flag() const;

  private:
    void requireNumbers(std::size_t count) const;

    const std::string* path_;
    const nlohmann::json* value_;
    std::string pointer_;
};

// An image that is not there, in a file that can be drawn without it.
struct ImageMissing : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class GltfFile {
  public:
    // A .gltf or .glb, told by its first bytes. Throws as GltfValue does, also where the file requires an
    // extension that is not among `extensions`.
    GltfFile(const std::filesystem::path& path, const std::vector<std::string_view>& extensions);

    GltfValue operator[](std::string_view key) const { return root()[key]; }
    bool requiresExtension(std::string_view extension) const;

    // The bytes of a buffer view, all there.
    std::string_view bytes(const GltfValue& view);
    // Throws ImageMissing, once an image, where its file is not there or may not be read; its source is empty
    // then and from then on.
    ImageSource image(const GltfValue& image);

    const std::string& name() const { return name_; }

  private:
    GltfValue root() const { return {name_, json_.get(), ""}; }
    std::string_view splitBinary();
    std::string readUri(const GltfValue& uri, std::filesystem::path* file) const;
    const std::string& buffer(const GltfValue& buffer);

    std::filesystem::path path_;
    std::string name_;
    std::string file_; // its bytes
    std::string_view binary_chunk_;
    std::shared_ptr<const nlohmann::json> json_;
    std::map<std::string, std::string> buffers_; // by pointer
    std::map<std::string, ImageSource> images_;
    std::size_t buffer_bytes_ = 0;
    std::size_t image_bytes_ = 0;
};

} // namespace gll
