// Images as plain data: pixels in memory, read from and written to files through libpng and OpenImageIO.
// No OpenGL and none of their headers here; all stay on the other side of this interface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace gll {

// What the numbers of an image mean.
enum class ColorSpace {
    srgb,   // BT.709 primaries, sRGB transfer function: what a display is sent
    linear, // BT.709 primaries, linear light; any range
    data,   // not a colour: normals, roughness, depth
};

// One image. Row 0 is the top; pixel (x, y) has its channels at index (y * width + x) * channels.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0; // 1 to 4: grey, grey + alpha, RGB, RGBA
    ColorSpace color_space = ColorSpace::linear;
    // 8-bit values stand for value / 255; floats for themselves.
    std::variant<std::vector<std::uint8_t>, std::vector<float>> pixels;
    bool cube_map = false; // six faces of an environment one below the other (an EXR's envmap)
    // What the file says and was read otherwise: "path: what", one line each.
    std::vector<std::string> warnings = {};
};

inline constexpr int max_image_extent = 16384;                         // pixels along either side
inline constexpr std::size_t max_image_bytes = std::size_t(512) << 20; // of decoded pixels

// Reads a PNG, JPEG, BMP, TGA (8-bit: as sRGB), Radiance HDR or EXR (float: as linear), told apart by the
// first bytes; only a TGA, which has no mark, by its name. Other formats, sizes over the limits above and
// files that do not decode whole are refused: throws std::runtime_error "path: what, what to do". Of a file's
// metadata only that is read which says what its pixels mean; what of it is left out stands in
// Image::warnings.
// - 16-bit PNGs are read as float in [0, 1], sRGB. Alpha stays unassociated.
// - An EXR's picture is its display window, 0 where it has no pixels; of its parts the first flat one is
// read,
//   of its levels the finest, of its channels R, G, B (A) or Y (A), else the first layer that has such, else
//   its only one. Chromaticities are carried over to BT.709. Its NaN and infinities are kept: callers that
//   cannot use them must look for them.
// - A Radiance HDR is upright whatever its orientation, its EXPOSURE and COLORCORR are divided out, its
//   PRIMARIES or XYZ carried over to BT.709.
Image loadImage(const std::filesystem::path& path);

// Where the encoded bytes of an image are: in a file of its own, or in memory (glTF may embed its images).
struct ImageSource {
    std::string name;                           // for messages: the path, or "path: /json/pointer"
    std::filesystem::path file;                 // an existing file, or empty
    std::shared_ptr<const std::string> encoded; // what that file would hold, or null

    bool empty() const { return file.empty() && !encoded; }
    // Equal sources decode to equal images, so that one upload can serve several uses.
    bool operator==(const ImageSource&) const = default;
};

// Reads from either place, under the same rules. Throws also when the source is empty.
Image loadImage(const ImageSource& source);

// Writes .png (8-bit pixels only), .exr or .hdr (float pixels only). An .exr is half float unless full_float,
// and then infinite from 65520 on; an .hdr takes three channels, finite and not negative. The file appears
// whole or not at all, and equal pixels make equal files. Throws std::runtime_error "path: what, what to do".
void saveImage(const std::filesystem::path& path, const Image& image, bool full_float = true);

} // namespace gll
