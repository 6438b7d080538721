// Bytes in order, and what of a PNG and a JPEG its pixels need: the rest never reaches a library.
#include "io/image_read.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace gll {

using namespace std::string_view_literals;

void checkSize(long long width, long long height, std::size_t bytes_per_pixel, const std::string& name) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > max_image_extent || height > max_image_extent)
        throw fileError(name, "claims " + size + " pixels, sides of 1 to " +
                                  std::to_string(max_image_extent) + " are read; the file may be damaged");
    if (static_cast<std::size_t>(width * height) > max_image_bytes / bytes_per_pixel)
        throw fileError(name, size + " pixels need more than " + std::to_string(max_image_bytes >> 20) +
                                  " MiB, scale the image down");
}

std::string_view ByteReader::take(std::size_t count) {
    if (count > left()) throw fileError(name_, "ends " + where_ + ", fetch it again");
    at_ += count;
    return bytes_.substr(at_ - count, count);
}

std::string_view ByteReader::takeUntil(char end, std::size_t longest) {
    const std::string_view window = bytes_.substr(at_, longest + 1);
    const std::size_t length = window.find(end);
    if (length == std::string_view::npos) throw fileError(name_, "ends " + where_ + ", fetch it again");
    at_ += length + 1;
    return window.substr(0, length);
}

std::uint32_t ByteReader::little(std::size_t size) {
    std::uint32_t value = 0;
    const std::string_view bytes = take(size);
    for (std::size_t i = size; i > 0; --i)
        value = value << 8 | static_cast<std::uint8_t>(bytes[i - 1]);
    return value;
}

std::uint32_t ByteReader::big(std::size_t size) {
    std::uint32_t value = 0;
    for (const char c : take(size))
        value = value << 8 | static_cast<std::uint8_t>(c);
    return value;
}

float ByteReader::float32() { return std::bit_cast<float>(little(4)); }

// ISO/IEC 15948. libpng reports truncated files on stderr as well; what passes here is none.
CleanFile cleanPng(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, "before its last row", name);
    CleanFile clean;
    clean.bytes = reader.take(8);
    bool has_srgb = false;
    double gamma = 0;
    std::string type;
    while (type != "IEND") {
        const std::size_t begin = reader.at();
        const std::size_t length = reader.big(4);
        type = reader.take(4);
        ByteReader data(reader.take(length), "inside its chunk " + inQuotes(type), name);
        reader.take(4); // the checksum, which libpng looks at
        if (type == "IHDR") {
            const long long width = data.big(4);
            checkSize(width, data.big(4), 1, name);
        }
        if (type == "IHDR" || type == "PLTE" || type == "IDAT" || type == "tRNS" || type == "IEND") {
            clean.bytes += bytes.substr(begin, reader.at() - begin);
        } else if (type[0] >= 'A' && type[0] <= 'Z') {
            throw fileError(name, "needs the chunk " + inQuotes(type) +
                                      ", which no PNG standard has, save it as a plain PNG");
        } else if (type == "sRGB") {
            has_srgb = true;
        } else if (type == "gAMA" && length == 4) {
            gamma = data.big(4) / 100000.0;
        } else if (type == "iCCP") {
            const std::string_view profile = data.takeUntil('\0', 79);
            if (profile.find("sRGB") == std::string_view::npos)
                clean.warnings.push_back(name + ": the color profile " + inQuotes(profile) +
                                         " is left out, its colors are taken as sRGB");
        } else if (type == "cICP") {
            clean.warnings.push_back(name + ": cICP is left out, its colors are taken as sRGB");
        } else if (type == "acTL") {
            clean.warnings.push_back(name + ": is an animation, its first picture is read");
        }
    }
    constexpr double srgb_gamma = 0.45455;
    if (!has_srgb && gamma != 0 && std::abs(gamma - srgb_gamma) > 0.01)
        clean.warnings.push_back(name + ": gAMA " + std::to_string(gamma) +
                                 " is left out, its values are taken as sRGB");
    return clean;
}

// ITU-T T.81 annex B. libjpeg fills what a truncated file lacks with grey and calls that a warning, so the
// end marker must be there; in a scan, 0xff is followed by 0 or a restart marker.
CleanFile cleanJpeg(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, "before its last row", name);
    CleanFile clean;
    clean.bytes = reader.take(2);
    std::string profile;
    double pixels = 0;
    double scans = 0;
    for (;;) {
        std::size_t begin = reader.at();
        if (reader.byte() != 0xff) { // inside a scan: on to the next marker
            const std::size_t end = std::min(bytes.find('\xff', begin), bytes.size());
            reader.take(end - begin - 1);
            clean.bytes += bytes.substr(begin, end - begin);
            continue;
        }
        unsigned marker = reader.byte();
        while (marker == 0xff) // fill bytes
            marker = reader.byte();
        begin = reader.at() - 2;
        const bool alone = marker <= 1 || (marker >= 0xd0 && marker <= 0xd9);
        std::string_view segment;
        if (!alone) segment = reader.take(std::max<std::size_t>(2, reader.big(2)) - 2);
        ByteReader data(segment, "inside a segment", name);

        const bool frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) {
            const unsigned bits = data.byte();
            const long long height = data.big(2);
            const long long width = data.big(2);
            const unsigned components = data.byte();
            if (bits != 8 || (marker & 3) == 3)
                throw fileError(name, (bits != 8 ? "has " + std::to_string(bits) + " bits a sample"
                                                 : std::string("is a lossless JPEG")) +
                                          ", save it as a JPEG of 8 bits or as a PNG");
            checkSize(width, height, std::max(components, 1u), name);
            if (components == 4)
                clean.warnings.push_back(name + ": is a CMYK JPEG, turned to RGB without its inks' profile");
            pixels = static_cast<double>(width * height);
        }
        if (marker == 0xda) ++scans;
        // Each scan of a progressive file visits every block again: a small file could ask for hours.
        constexpr double most_pixels_of_all_scans = 4e9;
        if (scans > 10 && pixels * scans > most_pixels_of_all_scans)
            throw fileError(name, "goes over its pixels in too many scans, save it as a baseline JPEG");

        if (marker == 0xe2 && segment.starts_with("ICC_PROFILE\0"sv)) profile += segment;
        const bool application = (marker >= 0xe0 && marker <= 0xef) || marker == 0xfe;
        const bool says_color = (marker == 0xe0 && segment.starts_with("JFIF\0"sv)) ||
                                (marker == 0xee && segment.starts_with("Adobe"sv));
        if (!application || says_color) clean.bytes += bytes.substr(begin, reader.at() - begin);
        if (marker == 0xd9) break;
    }
    if (!profile.empty() && profile.find("sRGB") == std::string::npos)
        clean.warnings.push_back(name + ": its color profile is left out, its colors are taken as sRGB");
    return clean;
}

} // namespace gll
