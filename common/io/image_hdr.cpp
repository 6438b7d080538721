// Radiance pictures, after Ward, "The RADIANCE Picture File Format" and Radiance's color.c: OpenImageIO's
// reader knows neither the older run lengths nor what the header says of exposure, colors and orientation.
#include "io/image_read.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace gll {
namespace {

// No line of a header comes near this.
constexpr std::size_t longest_line = 65536;

// Exactly as many numbers, with blanks between.
template <std::size_t count>
std::array<double, count> numbersOf(std::string_view text, std::string_view key, const std::string& name) {
    std::array<double, count> numbers{};
    std::string_view rest = trimmed(text);
    for (double& number : numbers) {
        const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (read.ec != std::errc() || !std::isfinite(number))
            throw fileError(name, "says " + inQuotes(std::string(key).append(text)) + ", which holds no " +
                                      std::to_string(count) + " number" + (count > 1 ? "s" : "") +
                                      ", correct or remove the line");
        rest = trimmed(rest.substr(static_cast<std::size_t>(read.ptr - rest.data())));
    }
    return numbers;
}

struct Header {
    int width = 0;
    int height = 0;
    // The first axis of the size line is the one that lines follow each other along.
    bool lines_are_rows = true;
    bool x_falls = false; // "-X": from right to left
    bool y_falls = true;  // "-Y": from top to bottom
    bool xyz = false;
    std::array<double, 3> gain = {1, 1, 1}; // what pixels were multiplied by
    std::optional<Primaries> primaries;
};

void readSizeLine(std::string_view line, Header& header, const std::string& name) {
    std::string_view rest = line;
    std::string axes;
    std::array<int, 2> extents{};
    for (int& extent : extents) {
        rest = trimmed(rest);
        if (rest.size() < 3 || (rest[0] != '-' && rest[0] != '+') || (rest[1] != 'X' && rest[1] != 'Y'))
            break;
        axes += rest.substr(0, 2);
        rest = trimmed(rest.substr(2));
        const auto number = std::from_chars(rest.data(), rest.data() + rest.size(), extent);
        if (number.ec != std::errc()) extent = -1;
        rest.remove_prefix(static_cast<std::size_t>(number.ptr - rest.data()));
    }
    if (axes.size() != 4 || axes[1] == axes[3])
        throw fileError(name, "has the size line " + inQuotes(line.substr(0, 40)) +
                                  ", a line as '-Y height +X width' is read; export it again");
    header.lines_are_rows = axes[1] == 'Y';
    header.y_falls = axes[header.lines_are_rows ? 0 : 2] == '-';
    header.x_falls = axes[header.lines_are_rows ? 2 : 0] == '-';
    header.height = extents[header.lines_are_rows ? 0 : 1];
    header.width = extents[header.lines_are_rows ? 1 : 0];
}

Header readHeader(ByteReader& reader, std::vector<std::string>& warnings, const std::string& name) {
    Header header;
    for (;;) {
        const std::string_view line = reader.takeUntil('\n', longest_line);
        if (trimmed(line).empty()) break;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) continue;
        const std::string_view key = line.substr(0, equals + 1);
        const std::string_view value = trimmed(line.substr(equals + 1));
        if (key == "FORMAT=") {
            header.xyz = value == "32-bit_rle_xyze";
            if (!header.xyz && value != "32-bit_rle_rgbe")
                throw fileError(name, "stores its pixels as " + inQuotes(value) +
                                          ", convert it to 32-bit_rle_rgbe");
        } else if (key == "EXPOSURE=" || key == "COLORCORR=") { // these multiply, where there are several
            std::array<double, 3> factors{};
            if (key == "EXPOSURE=")
                factors.fill(numbersOf<1>(value, key, name)[0]);
            else
                factors = numbersOf<3>(value, key, name);
            for (std::size_t c = 0; c < 3; ++c) {
                header.gain[c] *= factors[c];
                if (!(header.gain[c] > 1e-30 && header.gain[c] < 1e30))
                    throw fileError(name, "says " + inQuotes(line) +
                                              ", which leaves no light to divide out, "
                                              "correct or remove the line");
            }
        } else if (key == "PRIMARIES=") {
            const auto xy = numbersOf<8>(value, key, name);
            header.primaries = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
        } else if (key == "PIXASPECT=") {
            if (const double aspect = numbersOf<1>(value, key, name)[0]; std::abs(aspect - 1) > 0.001)
                warnings.push_back(name + ": PIXASPECT " + std::to_string(aspect) +
                                   " is left out, its pixels are read as square");
        }
    }
    readSizeLine(trimmed(reader.takeUntil('\n', longest_line)), header, name);
    checkSize(header.width, header.height, 3 * sizeof(float), name);
    return header;
}

using Rgbe = std::array<std::uint8_t, 4>;

Rgbe take4(ByteReader& reader) {
    const std::string_view bytes = reader.take(4);
    Rgbe pixel{};
    for (std::size_t i = 0; i < 4; ++i)
        pixel[i] = static_cast<std::uint8_t>(bytes[i]);
    return pixel;
}

// Pixels one by one; 1, 1, 1, n repeats the one before n times, the next such n * 256 times, and so on.
void readOldLine(ByteReader& reader, std::vector<Rgbe>& line, std::size_t from, const std::string& name) {
    unsigned shift = 0;
    for (std::size_t i = from; i < line.size();) {
        const Rgbe pixel = take4(reader);
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[i++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 32 ? std::size_t(pixel[3]) << shift : line.size() + 1;
        if (i == 0 || count > line.size() - i)
            throw fileError(name, "repeats a pixel past its line, the file is damaged: export it again");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(i), count, line[i - 1]);
        i += count;
        shift += 8;
    }
}

void readLine(ByteReader& reader, std::vector<Rgbe>& line, const std::string& name) {
    if (line.size() < 8 || line.size() > 0x7fff) return readOldLine(reader, line, 0, name);
    line[0] = take4(reader);
    const auto [two, also_two, high, low] = line[0];
    if (two != 2 || also_two != 2 || high >= 128) {
        if (two == 1 && also_two == 1 && high == 1)
            throw fileError(name, "repeats a pixel before its first, the file is damaged: export it again");
        return readOldLine(reader, line, 1, name);
    }
    if ((std::size_t(high) << 8 | low) != line.size())
        throw fileError(name, "has a line of " + std::to_string(high << 8 | low) + " pixels in " +
                                  std::to_string(line.size()) + ", the file is damaged: export it again");
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t i = 0; i < line.size();) {
            const std::size_t code = reader.byte();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128 : code;
            if (count == 0 || count > line.size() - i)
                throw fileError(name, "has a run past its line, the file is damaged: export it again");
            std::uint8_t value = run ? reader.byte() : std::uint8_t(0);
            for (std::size_t k = 0; k < count; ++k) {
                if (!run) value = reader.byte();
                line[i++][channel] = value;
            }
        }
}

} // namespace

Image decodeHdr(std::string_view bytes, const std::string& name) {
    Image image;
    ByteReader head(bytes, "inside its header", name);
    const Header header = readHeader(head, image.warnings, name);
    ByteReader reader(bytes.substr(head.at()), "before its last row", name);
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const std::size_t lines = header.lines_are_rows ? height : width;
    std::vector<Rgbe> line(header.lines_are_rows ? width : height);
    // A pixel and a few repeats of it make the shortest line.
    if (reader.left() / (4 * std::min<std::size_t>(line.size(), 2)) < lines)
        throw fileError(name, "ends before its last row, fetch it again");

    std::array<double, 256> scale{}; // of an exponent; 0 is black
    for (int e = 1; e < 256; ++e)
        scale[static_cast<std::size_t>(e)] = std::ldexp(1.0, e - 136);
    std::vector<float> pixels(width * height * 3);
    for (std::size_t i = 0; i < lines; ++i) {
        readLine(reader, line, name);
        for (std::size_t k = 0; k < line.size(); ++k) {
            std::size_t x = header.lines_are_rows ? k : i;
            std::size_t y = header.lines_are_rows ? i : k;
            if (header.x_falls) x = width - 1 - x;
            if (!header.y_falls) y = height - 1 - y;
            for (std::size_t c = 0; c < 3; ++c)
                pixels[(y * width + x) * 3 + c] =
                    static_cast<float>(line[k][c] * scale[line[k][3]] / header.gain[c]);
        }
    }

    // Radiance's XYZ has the white of equal energy; without a word on primaries, pixels are taken as BT.709,
    // as all do who are not Radiance (whose own differ by 0.01).
    Primaries primaries = header.primaries.value_or(bt709_primaries);
    if (header.xyz) primaries = xyz_primaries;
    try {
        if (!nearlyEqual(primaries, bt709_primaries)) transform(pixels, 3, bt709From(primaries));
    } catch (const std::invalid_argument& error) {
        throw fileError(name, "names " + std::string(error.what()) + ", correct or remove PRIMARIES");
    }
    image.width = header.width;
    image.height = header.height;
    image.channels = 3;
    image.color_space = ColorSpace::linear;
    image.pixels = std::move(pixels);
    return image;
}

} // namespace gll
