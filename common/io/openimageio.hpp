// What OpenImageIO does here: it decodes JPEG and EXR, and encodes EXR and HDR. It is in a library of its
// own, loaded when a file first needs it, because the 250 libraries behind Debian's take a quarter of a
// second to load: --help, an error and a PNG have no use for them. Private to common/io.
#pragma once

#include "io/image.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gll {

// An open file in memory. `part`: of an EXR that has several, else 0.
class EncodedImage {
  public:
    struct Part {
        int width = 0;
        int height = 0;
        std::vector<std::string> channels;
        bool has_bytes = false; // 8-bit samples
        bool is_deep = false;
    };
    virtual ~EncodedImage() = default;
    virtual Part part(int part) = 0;
    // Channels first to end - 1 of all pixels, row by row from the top. Both throw std::runtime_error where
    // that fails, naming the file.
    virtual std::vector<std::uint8_t> bytes(int part, int first_channel, int end_channel) = 0;
    virtual std::vector<float> floats(int part, int first_channel, int end_channel) = 0;
};

// The library's functions; both throw std::runtime_error that names the file. Formats are named as
// OpenImageIO names them.
struct OpenImageIo {
    // The bytes must outlive what is returned. Alpha stays beside the color, as the file has it.
    std::unique_ptr<EncodedImage> (*open)(const char* format, std::string& bytes, const std::string& name);
    std::vector<unsigned char> (*encode)(const char* format, const Image& image, bool full_float,
                                         const std::string& name);
};

// Loads it the first time. Throws std::runtime_error where it is not to be had.
const OpenImageIo& openImageIo();

} // namespace gll
