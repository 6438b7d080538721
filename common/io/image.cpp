// Reads images and writes them. OpenImageIO decodes PNG, JPEG and EXR and never sees a file that has not
// passed through here: it accepts headers of any size, acts on metadata, and would open any of its thirty
// formats.
#include "io/image.hpp"

#include "io/image_read.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

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

// OpenImageIO's names, in the order of Format, of those that it reads or writes here.
constexpr std::array oiio_names = {"png", "jpeg", "hdr", "openexr"};

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

// The libraries' complaints, some of several lines, as one line in brackets; nothing when there is none.
std::string inBrackets(const std::string& complaint) {
    return complaint.empty() ? "" : " (" + complaint.substr(0, complaint.find('\n')) + ")";
}

// An open file in memory. The bytes must outlive it.
class Input {
  public:
    Input(Format format, std::string& bytes, const std::string& name)
        : memory_(bytes.data(), bytes.size()), name_(name),
          input_(OIIO::ImageInput::create(oiio_names[static_cast<std::size_t>(format)])) {
        if (!input_ || !input_->set_ioproxy(&memory_))
            throw fileError(name, "this OpenImageIO lacks the reader for it, install one that has it");
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1); // alpha stays beside the color, as the file has it
        OIIO::ImageSpec first;
        if (!input_->open(name, first, config))
            throw fileError(name,
                            "does not decode, fetch or export it again" + inBrackets(input_->geterror()));
    }

    OIIO::ImageSpec spec(int part) { return input_->spec(part, 0); }

    // Some of the channels of all pixels of a part, at its full resolution.
    template <typename Sample>
    std::vector<Sample> read(int part, int first_channel, int end_channel) {
        const OIIO::ImageSpec size = spec(part);
        std::vector<Sample> samples(static_cast<std::size_t>(size.width) *
                                    static_cast<std::size_t>(size.height) *
                                    static_cast<std::size_t>(end_channel - first_channel));
        constexpr OIIO::TypeDesc sample_type(OIIO::BaseTypeFromC<Sample>::value);
        const bool whole =
            input_->read_image(part, 0, first_channel, end_channel, sample_type, samples.data());
        const std::string complaint = input_->geterror();
        if (!whole || !complaint.empty())
            throw fileError(name_, "does not decode whole, fetch or export it again" + inBrackets(complaint));
        return samples;
    }

  private:
    OIIO::Filesystem::IOMemReader memory_;
    const std::string& name_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

Image decodePngOrJpeg(Format format, CleanFile file, const std::string& name) {
    Input input(format, file.bytes, name);
    const OIIO::ImageSpec spec = input.spec(0);
    if (spec.nchannels < 1 || spec.nchannels > 4)
        throw fileError(name, "has " + std::to_string(spec.nchannels) + " channels, 1 to 4 are read");
    const bool eight_bits = spec.format == OIIO::TypeDesc::UINT8;
    checkSize(spec.width, spec.height,
              static_cast<std::size_t>(spec.nchannels) * (eight_bits ? sizeof(std::uint8_t) : sizeof(float)),
              name);
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.nchannels;
    image.color_space = ColorSpace::srgb;
    image.warnings = std::move(file.warnings);
    if (eight_bits)
        image.pixels = input.read<std::uint8_t>(0, 0, spec.nchannels);
    else
        image.pixels = input.read<float>(0, 0, spec.nchannels);
    return image;
}

// The picture is the display window. Where the file has no pixels for it, they are 0, alpha too.
Image decodeExr(CleanExr exr, const std::string& name) {
    Input input(Format::exr, exr.bytes, name);
    const OIIO::ImageSpec spec = input.spec(exr.part);
    std::vector<int> channels; // which of the file's, in the picture's order
    for (const std::string& channel : exr.channels)
        channels.push_back(spec.channelindex(channel));
    const auto [first, last] = std::minmax_element(channels.begin(), channels.end());
    if (spec.deep || spec.width != exr.data.width() || spec.height != exr.data.height() || *first < 0)
        throw fileError(name, "its header is read in two ways, export it again");
    const auto stored_channels = static_cast<std::size_t>(*last - *first + 1);
    checkSize(spec.width, spec.height, stored_channels * sizeof(float), name);
    checkSize(exr.display.width(), exr.display.height(), channels.size() * sizeof(float), name);
    const std::vector<float> stored = input.read<float>(exr.part, *first, *last + 1);

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
    const Format format = formatOf(bytes, name);
    switch (format) {
    case Format::png:
        return decodePngOrJpeg(format, cleanPng(bytes, name), name);
    case Format::jpeg:
        return decodePngOrJpeg(format, cleanJpeg(bytes, name), name);
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
        OIIO::ImageOutput::create(oiio_names[static_cast<std::size_t>(format)]);
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
