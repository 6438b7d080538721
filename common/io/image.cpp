// Reads and writes images through OpenImageIO, which never sees a file that has not passed the checks here:
// it accepts headers of 100000x100000 and of negative sizes, and would open any of its thirty formats.
#include "io/image.hpp"

#include "io/files.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace gll {
namespace {

using namespace std::string_view_literals;

enum class Format { png, jpeg, hdr, exr };

// OpenImageIO's names of the readers, in the order of Format.
constexpr std::array reader_names = {"png", "jpeg", "hdr", "openexr"};

// No header comes near this; it bounds the search for the end of one.
constexpr std::size_t max_hdr_header_bytes = 65536;

Format formatOf(std::string_view bytes, const std::string& name) {
    if (bytes.empty()) throw fileError(name, "is empty, export it again");
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return Format::png;
    if (bytes.starts_with("\xff\xd8\xff"sv)) return Format::jpeg;
    if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return Format::exr;
    if (bytes.starts_with("#?RADIANCE\n"sv) || bytes.starts_with("#?RGBE\n"sv)) return Format::hdr;
    throw fileError(name, "is no PNG, JPEG, Radiance HDR or EXR image, convert it to one");
}

void checkSize(long long width, long long height, std::size_t bytes_per_pixel, const std::string& name) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > max_image_extent || height > max_image_extent)
        throw fileError(name, "claims " + size + " pixels, sides of 1 to " +
                                  std::to_string(max_image_extent) + " are read; the file may be damaged");
    if (static_cast<std::size_t>(width * height) > max_image_bytes / bytes_per_pixel)
        throw fileError(name, size + " pixels need more than " + std::to_string(max_image_bytes >> 20) +
                                  " MiB, scale the image down");
}

// The text before the pixels of a Radiance file: OpenImageIO keeps neither the orientation nor XYZ apart.
void checkHdrHeader(std::string_view bytes, const std::string& name) {
    const std::string_view head = bytes.substr(0, max_hdr_header_bytes);
    std::size_t begin = 0;
    bool settings_ended = false;
    while (begin < head.size()) {
        const std::size_t end = head.find('\n', begin);
        if (end == std::string_view::npos) break;
        const std::string_view line = head.substr(begin, end - begin);
        begin = end + 1;
        if (!settings_ended) {
            if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
                throw fileError(name, "stores other than RGBE pixels, convert it to 32-bit_rle_rgbe");
            settings_ended = line.empty();
            continue;
        }
        std::array<int, 2> extent{}; // height, width
        std::string_view rest = line;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const std::string_view mark = axis == 0 ? "-Y " : " +X ";
            if (!rest.starts_with(mark))
                throw fileError(name, "has the size line '" + std::string(line.substr(0, 40)) +
                                          "', only '-Y height +X width' is read; store it upright");
            rest.remove_prefix(mark.size());
            const auto number = std::from_chars(rest.data(), rest.data() + rest.size(), extent[axis]);
            if (number.ec != std::errc()) extent[axis] = -1;
            rest.remove_prefix(static_cast<std::size_t>(number.ptr - rest.data()));
        }
        const auto [height, width] = extent;
        checkSize(width, height, 3 * sizeof(float), name);
        // The shortest row is runs of at most 127 equal bytes in each of four channels, two bytes a run.
        const std::size_t shortest_row_bytes = width < 8
                                                   ? static_cast<std::size_t>(width) * 4
                                                   : 4 + 8 * ((static_cast<std::size_t>(width) + 126) / 127);
        if ((bytes.size() - begin) / shortest_row_bytes < static_cast<std::size_t>(height))
            throw fileError(name, "ends before its last row, fetch it again");
        return;
    }
    throw fileError(name, "ends inside its header, fetch it again");
}

// libjpeg fills what a truncated file lacks with grey and calls that a warning, so look for the end marker:
// walk the segments up to the first scan, then the scan's bytes, in which 0xff is followed by 0 or a restart
// marker.
void checkJpegEnds(std::string_view bytes, const std::string& name) {
    std::size_t at = 2;
    while (at + 4 <= bytes.size()) {
        const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
        if (byteAt(at) != 0xff) { // inside a scan, or padding: on to the next marker
            at = std::min(bytes.find('\xff', at), bytes.size());
            continue;
        }
        const unsigned marker = byteAt(at + 1);
        if (marker == 0xd9) return;
        if (marker == 0xff) { // fill byte
            ++at;
        } else if (marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {
            at += 2;
        } else {
            at += 2 + std::max<std::size_t>(2, std::size_t(byteAt(at + 2)) << 8 | byteAt(at + 3));
        }
    }
    if (bytes.ends_with("\xff\xd9"sv)) return;
    throw fileError(name, "ends before its last row, fetch it again");
}

// libpng reports truncated files and impossible sizes on stderr as well; what passes here is neither.
void checkPng(std::string_view bytes, const std::string& name) {
    const auto bigEndian32 = [&](std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
        return value;
    };
    std::size_t at = 8;
    while (at + 12 <= bytes.size()) { // length, type, checksum: four bytes each
        const std::size_t length = bigEndian32(at);
        if (length > bytes.size() - at - 12) break;
        const std::string_view type = bytes.substr(at + 4, 4);
        if (type == "IHDR" && length >= 8)
            checkSize(static_cast<long long>(bigEndian32(at + 8)),
                      static_cast<long long>(bigEndian32(at + 12)), 1, name);
        if (type == "IEND") return;
        at += 12 + length;
    }
    throw fileError(name, "ends before its last row, fetch it again");
}

// The libraries' complaints, some of several lines, as one line in brackets; nothing when there is none.
std::string inBrackets(const std::string& complaint) {
    return complaint.empty() ? "" : " (" + complaint.substr(0, complaint.find('\n')) + ")";
}

template <typename Sample>
std::vector<Sample> readPixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec,
                               const std::string& name) {
    std::vector<Sample> samples(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                                static_cast<std::size_t>(spec.nchannels));
    constexpr OIIO::TypeDesc sample_type(OIIO::BaseTypeFromC<Sample>::value);
    const bool whole = input.read_image(0, 0, 0, spec.nchannels, sample_type, samples.data());
    const std::string complaint = input.geterror();
    if (!whole || !complaint.empty())
        throw fileError(name, "does not decode whole, fetch or export it again" + inBrackets(complaint));
    return samples;
}

// A layered or luminance-chroma EXR would pass as RGB by its number of channels alone.
void checkExrSpec(const OIIO::ImageSpec& spec, const std::string& name) {
    if (spec.deep) throw fileError(name, "is a deep EXR, flatten it");
    for (int i = 0; i < spec.nchannels; ++i) {
        const OIIO::TypeDesc type = spec.channelformat(i);
        const std::string channel(spec.channel_name(i));
        if (type != OIIO::TypeDesc::HALF && type != OIIO::TypeDesc::FLOAT)
            throw fileError(name, "channel '" + channel + "' is not half or float, export it as one");
        if (spec.nchannels >= 3 && channel != std::string(1, "RGBA"[i]))
            throw fileError(name, "channel '" + channel + "' where R, G, B, A are read, export only those");
    }
}

Image decode(std::string_view bytes, const std::string& name) {
    const Format format = formatOf(bytes, name);
    if (format == Format::hdr) checkHdrHeader(bytes, name);
    if (format == Format::jpeg) checkJpegEnds(bytes, name);
    if (format == Format::png) checkPng(bytes, name);

    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size()); // it only reads
    const std::unique_ptr<OIIO::ImageInput> input =
        OIIO::ImageInput::create(reader_names[static_cast<std::size_t>(format)]);
    if (!input || !input->set_ioproxy(&memory))
        throw fileError(name, "this OpenImageIO lacks the reader for it, install one that has it");
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // alpha stays beside the colour, as the file has it
    OIIO::ImageSpec spec;
    if (!input->open(name, spec, config))
        throw fileError(name, "does not decode, fetch or export it again" + inBrackets(input->geterror()));

    if (spec.nchannels < 1 || spec.nchannels > 4)
        throw fileError(name, "has " + std::to_string(spec.nchannels) + " channels, 1 to 4 are read");
    if (spec.depth != 1) throw fileError(name, "is a volume, only flat images are read");
    const bool eight_bits = spec.format == OIIO::TypeDesc::UINT8;
    checkSize(spec.width, spec.height,
              static_cast<std::size_t>(spec.nchannels) * (eight_bits ? sizeof(std::uint8_t) : sizeof(float)),
              name);
    if (format == Format::exr) checkExrSpec(spec, name);

    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.nchannels;
    const bool display_format = format == Format::png || format == Format::jpeg;
    image.color_space = display_format ? ColorSpace::srgb : ColorSpace::linear;
    if (eight_bits)
        image.pixels = readPixels<std::uint8_t>(*input, spec, name);
    else
        image.pixels = readPixels<float>(*input, spec, name);
    return image;
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

    const OIIO::TypeDesc memory_type(eight_bits ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    OIIO::TypeDesc file_type = memory_type;
    if (format == Format::exr && !full_float) file_type = OIIO::TypeDesc::HALF;
    OIIO::ImageSpec spec(image.width, image.height, image.channels, file_type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (format == Format::png) {
        // Measured on 640x480 RGBA frames: the 'sub' filter at level 1 writes in 17 to 28 ms what the
        // defaults (adaptive filter, level 6) take 90 to 140 ms for, in a file 1 to 19 % larger.
        constexpr int png_filter_sub = 0x10;
        spec.attribute("png:filter", png_filter_sub);
        spec.attribute("png:compressionLevel", 1);
        if (image.color_space == ColorSpace::srgb) spec.attribute("oiio:ColorSpace", "sRGB");
    } else if (format == Format::exr) {
        spec.attribute("compression", "zip");
        // Without one OpenImageIO writes the time of day, and equal pixels would make unequal files.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    }

    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(reader_names[static_cast<std::size_t>(format)]);
    if (!output || !output->set_ioproxy(&memory))
        throw fileError(name, "this OpenImageIO lacks the writer for it, install one that has it");
    const void* pixels =
        std::visit([](const auto& p) { return static_cast<const void*>(p.data()); }, image.pixels);
    if (!output->open(name, spec) || !output->write_image(memory_type, pixels) || !output->close())
        throw fileError(name, "cannot be encoded" + inBrackets(output->geterror()));
    return bytes;
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
