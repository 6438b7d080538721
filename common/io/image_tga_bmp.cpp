// The two plain formats that old models keep their textures in. OpenImageIO 2.4 reads both past their ends.
#include "io/image_read.hpp"

#include <algorithm>
#include <bit>

namespace gll {
namespace {

using Color = std::array<std::uint8_t, 4>; // RGBA

std::uint8_t byteOf(std::uint64_t value, std::uint64_t most) {
    return most == 0 ? std::uint8_t(0) : static_cast<std::uint8_t>((value * 255 + most / 2) / most);
}

Image imageOf(int width, int height, int channels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.color_space = ColorSpace::srgb;
    image.pixels =
        std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                  static_cast<std::size_t>(channels));
    return image;
}

void put(Image& image, int x, int y, const Color& color) {
    auto& bytes = std::get<std::vector<std::uint8_t>>(image.pixels);
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
        channels;
    std::copy_n(color.begin(), channels, bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

const Color& entryOf(const std::vector<Color>& palette, std::size_t index, const std::string& name) {
    if (index >= palette.size())
        throw fileError(name, "uses color " + std::to_string(index) + " of a palette of " +
                                  std::to_string(palette.size()) + ", the file is damaged: export it again");
    return palette[index];
}

// A TGA's pixel or palette entry of 8 (grey), 15, 16, 24 or 32 bits.
Color tgaColor(ByteReader& reader, unsigned bits) {
    const std::uint32_t value = reader.little((bits + 7) / 8);
    if (bits == 8) return {std::uint8_t(value), std::uint8_t(value), std::uint8_t(value), 255};
    if (bits <= 16)
        return {byteOf(value >> 10 & 31, 31), byteOf(value >> 5 & 31, 31), byteOf(value & 31, 31),
                byteOf(value >> 15, 1)};
    return {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value),
            std::uint8_t(bits == 32 ? value >> 24 : 255)};
}

// The bits of a BMP's pixel that are one channel.
struct Mask {
    std::uint32_t bits = 0;
    std::uint8_t of(std::uint32_t pixel) const {
        const int shift = std::countr_zero(bits);
        return bits == 0 ? std::uint8_t(0) : byteOf((pixel & bits) >> shift, bits >> shift);
    }
};

struct BmpHeader {
    int width = 0;
    int height = 0;
    bool top_down = false;
    unsigned bits = 0;
    std::uint32_t compression = 0;
    std::array<Mask, 4> masks{}; // RGBA
    std::vector<Color> palette;
};

constexpr std::uint32_t bmp_rle8 = 1, bmp_rle4 = 2, bmp_fields = 3, bmp_alpha_fields = 6;

BmpHeader readBmpHeader(ByteReader& reader, const std::string& name) {
    BmpHeader header;
    const std::uint32_t size = reader.little(4);
    ByteReader rest(reader.take(std::max<std::size_t>(size, 4) - 4), "inside its header", name);
    std::uint32_t palette_size = 0;
    const bool old = size == 12; // OS/2
    if (!old && size < 40) throw fileError(name, "is a BMP of an unknown version, export it as a PNG");
    const auto extent = [&] { return old ? static_cast<long long>(rest.little(2)) : rest.signed32(); };
    const long long width = extent();
    const long long signed_height = extent();
    header.top_down = signed_height < 0;
    const long long height = header.top_down ? -signed_height : signed_height;
    checkSize(width, height, 4, name);
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
    rest.take(2); // planes
    header.bits = rest.little(2);
    if (!old) {
        header.compression = rest.little(4);
        rest.take(12);
        palette_size = rest.little(4);
        rest.take(4);
    }

    const unsigned bits = header.bits;
    const bool fits = (header.compression == 0 &&
                       (bits == 1 || bits == 4 || bits == 8 || bits == 16 || bits == 24 || bits == 32)) ||
                      (header.compression == bmp_rle8 && bits == 8 && !header.top_down) ||
                      (header.compression == bmp_rle4 && bits == 4 && !header.top_down) ||
                      ((header.compression == bmp_fields || header.compression == bmp_alpha_fields) &&
                       (bits == 16 || bits == 32));
    if (!fits)
        throw fileError(name, "is a BMP of " + std::to_string(bits) + " bits with compression " +
                                  std::to_string(header.compression) +
                                  ", which is not read: save it as a PNG");
    if (header.compression == bmp_fields || header.compression == bmp_alpha_fields) {
        // Inside the header from version 4 (and 52, 56) on, behind it before that.
        ByteReader& masks = size >= 52 ? rest : reader;
        const bool has_alpha = size >= 56 || (size < 52 && header.compression == bmp_alpha_fields);
        for (std::size_t c = 0; c < (has_alpha ? 4u : 3u); ++c)
            header.masks[c].bits = masks.little(4);
    } else if (bits == 16) {
        header.masks = {{{0x7c00}, {0x3e0}, {0x1f}, {0}}};
    } else if (bits == 32) {
        header.masks = {{{0xff0000}, {0xff00}, {0xff}, {0}}}; // the fourth byte means nothing
    }
    if (bits <= 8) {
        const std::uint32_t most = 1u << bits;
        if (palette_size > most)
            throw fileError(name, "has a palette of " + std::to_string(palette_size) + " colors for " +
                                      std::to_string(bits) + " bits, export it again");
        header.palette.resize(palette_size > 0 ? palette_size : most);
        for (Color& color : header.palette) {
            const std::uint32_t value = reader.little(3);
            color = {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value), 255};
            if (!old) reader.take(1);
        }
    }
    return header;
}

// Palette indices, row 0 the first in the file; what a delta leaves out is index 0.
std::vector<std::uint8_t> unpackRle(ByteReader& reader, const BmpHeader& header, const std::string& name) {
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    std::vector<std::uint8_t> indices(width * height);
    const bool half_bytes = header.compression == bmp_rle4;
    std::size_t x = 0;
    std::size_t y = 0;
    const auto put_index = [&](std::uint8_t pair, std::size_t i) {
        const int index = !half_bytes ? pair : i % 2 == 0 ? pair >> 4 : pair & 15;
        if (x < width && y < height) indices[y * width + x] = static_cast<std::uint8_t>(index);
        ++x; // rows of odd widths may be filled up
    };
    for (;;) {
        const std::size_t count = reader.byte();
        const std::uint8_t value = reader.byte();
        if (count > 0) {
            for (std::size_t i = 0; i < count; ++i)
                put_index(value, i);
        } else if (value == 0) {
            x = 0;
            ++y;
        } else if (value == 1) {
            return indices;
        } else if (value == 2) {
            x += reader.byte();
            y += reader.byte();
        } else {
            const std::size_t length = half_bytes ? (value + 1u) / 2 : value;
            const std::string_view literals = reader.take(length + length % 2);
            for (std::size_t i = 0; i < value; ++i)
                put_index(static_cast<std::uint8_t>(literals[half_bytes ? i / 2 : i]), i);
        }
        if (x > width + 1 || y > height)
            throw fileError(name, "has a run past its picture, the file is damaged: export it again");
    }
}

} // namespace

// Truevision, "TGA File Format Specification", version 2.0 (1991).
Image decodeTga(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, "before its last row", name);
    const std::size_t id_length = reader.byte();
    const unsigned has_map = reader.byte();
    const unsigned type = reader.byte();
    const std::size_t map_first = reader.little(2);
    const std::size_t map_length = reader.little(2);
    const unsigned map_bits = reader.byte();
    reader.take(4); // where it stands on a screen
    const int width = static_cast<int>(reader.little(2));
    const int height = static_cast<int>(reader.little(2));
    const unsigned bits = reader.byte();
    const unsigned descriptor = reader.byte();

    const unsigned kind = type & 7; // 1 palette, 2 color, 3 grey; 8 more: run-length encoded
    const auto isColor = [](unsigned n) { return n == 15 || n == 16 || n == 24 || n == 32; };
    const bool fits = (type & ~8u) == kind && has_map <= 1 && (descriptor & 0xc0) == 0 &&
                      ((kind == 1 && has_map == 1 && (bits == 8 || bits == 16) && isColor(map_bits)) ||
                       (kind == 2 && isColor(bits)) || (kind == 3 && bits == 8));
    if (!fits)
        throw fileError(name, "is no TGA of a kind that is read (type " + std::to_string(type) + ", " +
                                  std::to_string(bits) + " bits), save it as a PNG");
    const unsigned alpha_bits = descriptor & 15;
    const bool has_alpha = alpha_bits > 0 && (kind == 1 ? map_bits : bits) % 16 == 0;
    const int channels = kind == 3 ? 1 : has_alpha ? 4 : 3;
    checkSize(width, height, static_cast<std::size_t>(channels), name);

    reader.take(id_length);
    std::vector<Color> palette;
    if (has_map == 1) {
        const std::size_t entry_bytes = (map_bits + 7) / 8;
        ByteReader entries(reader.take(map_length * entry_bytes), "inside its palette", name);
        if (kind == 1) {
            palette.resize(map_first);
            for (std::size_t i = 0; i < map_length; ++i)
                palette.push_back(tgaColor(entries, map_bits));
        }
    }
    const auto takeColor = [&]() -> Color {
        return kind == 1 ? entryOf(palette, reader.little(bits / 8), name) : tgaColor(reader, bits);
    };

    const bool encoded = (type & 8) != 0;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::size_t shortest = encoded ? (pixels + 127) / 128 * (1 + bits / 8) : pixels * ((bits + 7) / 8);
    if (reader.left() < shortest) throw fileError(name, "ends before its last row, fetch it again");

    Image image = imageOf(width, height, channels);
    std::size_t packet = 0; // pixels left of it
    bool run = false;
    Color color{};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            if (encoded && packet == 0) {
                const unsigned code = reader.byte();
                run = (code & 128) != 0;
                packet = (code & 127) + 1;
                if (run) color = takeColor();
            }
            if (!run) color = takeColor();
            if (encoded) --packet;
            put(image, (descriptor & 16) != 0 ? width - 1 - column : column,
                (descriptor & 32) != 0 ? row : height - 1 - row, color);
        }
    return image;
}

// Microsoft, "Bitmap Storage" (BITMAPFILEHEADER, BITMAPCOREHEADER to BITMAPV5HEADER).
Image decodeBmp(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, "before its last row", name);
    reader.take(10);
    const std::size_t offset = reader.little(4);
    const BmpHeader header = readBmpHeader(reader, name);
    ByteReader pixels(bytes, "before its last row", name);
    pixels.take(offset);

    const unsigned bits = header.bits;
    const std::size_t row_bytes = (static_cast<std::size_t>(header.width) * bits + 31) / 32 * 4;
    if (header.compression != bmp_rle8 && header.compression != bmp_rle4 &&
        pixels.left() / row_bytes + 1 < static_cast<std::size_t>(header.height))
        throw fileError(name, "ends before its last row, fetch it again");
    Image image = imageOf(header.width, header.height, header.masks[3].bits != 0 ? 4 : 3);
    const auto rowOf = [&](int row) { return header.top_down ? row : header.height - 1 - row; };
    if (header.compression == bmp_rle8 || header.compression == bmp_rle4) {
        const std::vector<std::uint8_t> indices = unpackRle(pixels, header, name);
        std::size_t i = 0;
        for (int row = 0; row < header.height; ++row)
            for (int x = 0; x < header.width; ++x)
                put(image, x, rowOf(row), entryOf(header.palette, indices[i++], name));
        return image;
    }
    for (int row = 0; row < header.height; ++row) {
        // The last row's filling may be missing.
        const std::size_t used = (static_cast<std::size_t>(header.width) * bits + 7) / 8;
        ByteReader line(pixels.take(row + 1 < header.height
                                        ? row_bytes
                                        : std::min(row_bytes, std::max(used, pixels.left()))),
                        "before its last row", name);
        unsigned packed = 0;
        for (int x = 0; x < header.width; ++x) {
            Color color{};
            if (bits <= 8) {
                const unsigned in_byte = static_cast<unsigned>(x) * bits % 8;
                if (in_byte == 0) packed = line.byte();
                color = entryOf(header.palette, packed >> (8 - bits - in_byte) & ((1u << bits) - 1), name);
            } else {
                const std::uint32_t pixel = line.little(bits / 8);
                if (bits == 24)
                    color = {std::uint8_t(pixel >> 16), std::uint8_t(pixel >> 8), std::uint8_t(pixel), 255};
                else
                    for (std::size_t c = 0; c < 4; ++c)
                        color[c] = header.masks[c].of(pixel);
            }
            put(image, x, rowOf(row), color);
        }
    }
    return image;
}

} // namespace gll
