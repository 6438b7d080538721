// What the readers of image files share: limits, warnings, and the formats that are decoded or checked here
// before OpenImageIO sees a byte. Private to common/io.
#pragma once

#include "io/files.hpp"
#include "io/image.hpp"
#include "io/primaries.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gll {

// Every `name` here names the file in messages; every function throws std::runtime_error "name: what, what to
// do" for a file that it refuses.

// Both sides 1 to max_image_extent, and no more than max_image_bytes together.
void checkSize(long long width, long long height, std::size_t bytes_per_pixel, const std::string& name);

// The bytes of a file in order. What a file claims beyond its end throws "ends <where>, fetch it again".
class ByteReader {
  public:
    ByteReader(std::string_view bytes, std::string where, const std::string& name)
        : bytes_(bytes), where_(std::move(where)), name_(name) {}

    std::size_t at() const { return at_; }
    std::size_t left() const { return bytes_.size() - at_; }
    std::string_view take(std::size_t count);
    std::string_view takeUntil(char end, std::size_t longest); // without the end, which is passed over
    std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
    std::uint32_t little(std::size_t size); // an unsigned number of 1 to 4 bytes, the lowest first
    std::uint32_t big(std::size_t size);    // the highest first
    std::int32_t signed32() { return static_cast<std::int32_t>(little(4)); }
    float float32();

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
    std::string where_;
    const std::string& name_;
};

// What is left of a PNG or JPEG when all is taken out that its pixels do not need: of comments and Exif, of
// which a picture may say anything ("tiff:RowsPerStrip", 0), OpenImageIO acts on what it finds.
struct CleanFile {
    std::string bytes;
    std::vector<std::string> warnings;
};
CleanFile cleanPng(std::string_view bytes, const std::string& name);
CleanFile cleanJpeg(std::string_view bytes, const std::string& name);
Image decodePng(CleanFile file, const std::string& name);
std::vector<unsigned char> encodePng(const Image& image, const std::string& name); // 8-bit, 1 to 4 channels

// First and last pixel, both inside.
struct PixelWindow {
    int left = 0, top = 0, right = -1, bottom = -1;
    int width() const { return right - left + 1; }
    int height() const { return bottom - top + 1; }
};

// An EXR of whose header only that is left which its pixels need, and what the header says of them.
struct CleanExr {
    std::string bytes;
    int part = 0; // the first flat one
    PixelWindow data;
    PixelWindow display;
    std::vector<std::string> channels; // names of those that make the picture: 1 to 4
    std::optional<Primaries> primaries;
    bool cube_map = false;
    std::vector<std::string> warnings;
};
CleanExr cleanExr(std::string_view bytes, const std::string& name);

Image decodeHdr(std::string_view bytes, const std::string& name);
Image decodeTga(std::string_view bytes, const std::string& name);
Image decodeBmp(std::string_view bytes, const std::string& name);

} // namespace gll
