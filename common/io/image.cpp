// Reads images and writes them. OpenImageIO decodes JPEG and EXR and never sees a file that has not passed
// through here: it accepts headers of any size, acts on metadata, and would open any of its thirty formats.
#include "io/image.hpp"

#include "io/image_read.hpp"
#include "io/openimageio.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <unistd.h>
#include <utility>

namespace gll {
namespace {

using namespace std::string_view_literals;

enum class Format { png, jpeg, hdr, exr, bmp, tga };

Format formatOf(std::string_view bytes, const std::string& name) {
    if (bytes.empty()) throw fileError(name, "is empty, export it again");
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return Format::png;
    if (bytes.starts_with("\xff\xd8\xff"sv)) return Format::jpeg;
    if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return Format::exr;
    if (bytes.starts_with("#?"sv)) return Format::hdr;
    if (bytes.starts_with("BM"sv)) return Format::bmp;
    std::string extension = std::filesystem::path(name).extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (extension == ".tga") return Format::tga; // the one without a mark of its own
    throw fileError(name,
                    "is no PNG, JPEG, Radiance HDR, EXR, BMP or (named .tga) TGA image, convert it to one");
}

Image decodeJpeg(CleanFile file, const std::string& name) {
    const std::unique_ptr<EncodedImage> input = openImageIo().open("jpeg", file.bytes, name);
    const EncodedImage::Part part = input->part(0);
    const auto channels = static_cast<int>(part.channels.size());
    if (!part.has_bytes || (channels != 1 && channels != 3))
        throw fileError(name, "its header is read in two ways, save it as a PNG");
    checkSize(part.width, part.height, part.channels.size(), name);
    Image image;
    image.width = part.width;
    image.height = part.height;
    image.channels = channels;
    image.color_space = ColorSpace::srgb;
    image.warnings = std::move(file.warnings);
    image.pixels = input->bytes(0, 0, channels);
    return image;
}

// The picture is the display window. Where the file has no pixels for it, they are 0, alpha too.
Image decodeExr(CleanExr exr, const std::string& name) {
    const std::unique_ptr<EncodedImage> input = openImageIo().open("openexr", exr.bytes, name);
    const EncodedImage::Part part = input->part(exr.part);
    std::vector<int> channels; // which of the file's, in the picture's order
    for (const std::string& channel : exr.channels) {
        const auto place = std::find(part.channels.begin(), part.channels.end(), channel);
        channels.push_back(place == part.channels.end() ? -1
                                                        : static_cast<int>(place - part.channels.begin()));
    }
    const auto [first, last] = std::minmax_element(channels.begin(), channels.end());
    if (part.is_deep || part.width != exr.data.width() || part.height != exr.data.height() || *first < 0)
        throw fileError(name, "its header is read in two ways, export it again");
    const auto stored_channels = static_cast<std::size_t>(*last - *first + 1);
    checkSize(part.width, part.height, stored_channels * sizeof(float), name);
    checkSize(exr.display.width(), exr.display.height(), channels.size() * sizeof(float), name);
    const std::vector<float> stored = input->floats(exr.part, *first, *last + 1);

    Image image;
    image.width = exr.display.width();
    image.height = exr.display.height();
    image.channels = static_cast<int>(channels.size());
    image.color_space = ColorSpace::linear;
    image.cube_map = exr.cube_map;
    image.warnings = std::move(exr.warnings);
    std::vector<float> pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                              channels.size());
    const int left = std::max(exr.data.left, exr.display.left);
    const int right = std::min(exr.data.right, exr.display.right);
    for (int y = std::max(exr.data.top, exr.display.top); y <= std::min(exr.data.bottom, exr.display.bottom);
         ++y)
        for (int x = left; x <= right; ++x) {
            const auto pixelOf = [&](const PixelWindow& window) {
                return static_cast<std::size_t>(y - window.top) * static_cast<std::size_t>(window.width()) +
                       static_cast<std::size_t>(x - window.left);
            };
            const float* from = stored.data() + pixelOf(exr.data) * stored_channels;
            float* to = pixels.data() + pixelOf(exr.display) * channels.size();
            for (const int channel : channels)
                *to++ = from[channel - *first];
        }

    if (exr.primaries && image.channels >= 3 && !nearlyEqual(*exr.primaries, bt709_primaries)) {
        try {
            transform(pixels, image.channels,
                      nearlyEqual(*exr.primaries, xyz_primaries) ? bt709FromXyz()
                                                                 : bt709From(*exr.primaries));
        } catch (const std::invalid_argument& error) {
            throw fileError(name,
                            "its chromaticities are " + std::string(error.what()) + ", export it again");
        }
    }
    image.pixels = std::move(pixels);
    return image;
}

Image decode(std::string_view bytes, const std::string& name) {
    switch (formatOf(bytes, name)) {
    case Format::png:
        return decodePng(cleanPng(bytes, name), name);
    case Format::jpeg:
        return decodeJpeg(cleanJpeg(bytes, name), name);
    case Format::exr:
        return decodeExr(cleanExr(bytes, name), name);
    case Format::hdr:
        return decodeHdr(bytes, name);
    case Format::bmp:
        return decodeBmp(bytes, name);
    case Format::tga:
        break;
    }
    return decodeTga(bytes, name);
}

// What OpenImageIO and its libraries throw of their own carries no file name.
template <typename Work>
auto namingTheFile(const std::string& name, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw fileError(name, "needs more memory than there is, scale it down");
    } catch (const std::runtime_error& error) {
        if (std::string_view(error.what()).starts_with(name)) throw;
        throw fileError(name, error.what());
    } catch (const std::exception& error) {
        throw fileError(name, error.what());
    }
}

std::vector<unsigned char> encode(Format format, const Image& image, bool full_float,
                                  const std::string& name) {
    const bool eight_bits = std::holds_alternative<std::vector<std::uint8_t>>(image.pixels);
    if (format == Format::png && !eight_bits)
        throw fileError(name, "PNG takes 8-bit pixels, tone map and encode these floats or write .exr");
    if (format != Format::png && eight_bits)
        throw fileError(name, "EXR and HDR take float pixels, write these 8-bit ones as .png");
    if (image.channels < 1 || image.channels > 4 || (format == Format::hdr && image.channels != 3))
        throw fileError(name, "cannot hold " + std::to_string(image.channels) + " channels, " +
                                  (format == Format::hdr ? "HDR takes 3" : "1 to 4 are written"));
    checkSize(image.width, image.height,
              static_cast<std::size_t>(image.channels) * (eight_bits ? sizeof(std::uint8_t) : sizeof(float)),
              name);
    const std::size_t samples = std::visit([](const auto& pixels) { return pixels.size(); }, image.pixels);
    if (samples != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                       static_cast<std::size_t>(image.channels))
        throw fileError(name, "has " + std::to_string(samples) +
                                  " samples, its size and channels need another number");

    if (format == Format::hdr)
        for (const float sample : std::get<std::vector<float>>(image.pixels))
            if (!(sample >= 0.0F && sample <= std::numeric_limits<float>::max()))
                throw fileError(name, "HDR holds no negative and no infinite or NaN values, write .exr");

    if (format == Format::png) return encodePng(image, name);
    return openImageIo().encode(format == Format::exr ? "openexr" : "hdr", image, full_float, name);
}

// The file under its own name is either the old one or the whole new one, whenever one looks.
void writeWhole(const std::filesystem::path& path, const std::vector<unsigned char>& bytes) {
    static std::atomic<unsigned> serial = 0;
    std::filesystem::path temporary = path;
    temporary +=
        std::string(".").append(std::to_string(::getpid())).append("-").append(std::to_string(serial++));
    temporary += ".tmp";

    std::FILE* file = std::fopen(temporary.c_str(), "wbx"); // x: never onto a file that exists
    if (file == nullptr)
        throw fileError(path.string(), "cannot be written, check that its folder exists and is writable");
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const bool closed = std::fclose(file) == 0;
    std::error_code failure;
    if (written && closed) {
        std::filesystem::rename(temporary, path, failure);
        if (!failure) return;
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw fileError(path.string(), failure ? "cannot be replaced (" + failure.message() + ")"
                                           : "cannot be written whole, make room on the disk");
}

} // namespace

Image loadImage(const std::filesystem::path& path) {
    const std::string name = path.string();
    // No file of a permitted image is larger than its pixels by more than its header.
    const std::string bytes = readFile(path, max_image_bytes + (std::size_t(16) << 20));
    return namingTheFile(name, [&] { return decode(bytes, name); });
}

Image loadImage(const ImageSource& source) {
    if (!source.encoded) {
        if (source.file.empty())
            throw fileError(source.name, "names no image, look for one before reading it");
        return loadImage(source.file);
    }
    return namingTheFile(source.name, [&] { return decode(*source.encoded, source.name); });
}

void saveImage(const std::filesystem::path& path, const Image& image, bool full_float) {
    const std::string name = path.string();
    const std::string extension = path.extension().string();
    Format format = Format::png;
    if (extension == ".hdr")
        format = Format::hdr;
    else if (extension == ".exr")
        format = Format::exr;
    else if (extension != ".png")
        throw fileError(name, "ends in '" + extension + "', name a .png, .exr or .hdr file");
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw fileError(name, "is a folder, name a file in it");
    writeWhole(path, namingTheFile(name, [&] { return encode(format, image, full_float, name); }));
}

} // namespace gll
