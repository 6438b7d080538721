// The header and the chunks of an EXR, after "OpenEXR File Layout" of openexr.com. OpenEXR asks memory for
// what the header claims and OpenImageIO acts on attributes of any name, so both are given a header that
// holds what the pixels need only. Where a chunk holds less than its rows, OpenEXR draws what memory held
// before.
#include "io/image_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <zlib.h>

namespace gll {
namespace {

using namespace std::string_view_literals;

struct Attribute {
    std::string_view type;
    std::string_view value;
};
using Attributes = std::map<std::string, Attribute, std::less<>>;

constexpr std::array pixel_attributes = {"channels"sv,           "compression"sv,       "dataWindow"sv,
                                         "displayWindow"sv,      "lineOrder"sv,         "pixelAspectRatio"sv,
                                         "screenWindowCenter"sv, "screenWindowWidth"sv, "tiles"sv};
constexpr std::array part_attributes = {"name"sv, "type"sv, "version"sv, "chunkCount"sv,
                                        "maxSamplesPerPixel"sv};

bool contains(const auto& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

struct Channel {
    std::string name;
    int type = 0; // 0 whole number, 1 half, 2 float
    bool subsampled = false;
    std::size_t bytes() const { return type == 1 ? 2 : 4; }
};

struct Part {
    std::string name;
    bool deep = false;
    int compression = 0;
    int tile_width = 0, tile_height = 0; // 0 for scan lines
    std::size_t chunk_count = 0;         // as the header claims it; only files of several parts need to
    std::size_t bytes_per_pixel = 0;
    PixelWindow data, display;
    std::vector<Channel> channels;
    std::optional<Primaries> primaries;
    bool cube_map = false;
    float pixel_aspect = 1;
};

// One part's attributes: all into the map, those that the pixels need to `kept` too. The room of the others
// becomes one attribute that means nothing, so that every offset in the file stays true.
Attributes readHeader(ByteReader& reader, std::string_view bytes, bool multi_part, std::string& kept,
                      const std::string& name) {
    constexpr std::size_t longest_name = 255;
    Attributes attributes;
    std::size_t room = 0;
    for (;;) {
        const std::size_t begin = reader.at();
        const std::string_view key = reader.takeUntil('\0', longest_name);
        if (key.empty()) break;
        const std::string_view type = reader.takeUntil('\0', longest_name);
        const std::string_view value = reader.take(reader.little(4));
        const bool needed = contains(pixel_attributes, key) || (multi_part && contains(part_attributes, key));
        if (type.empty() || (!attributes.emplace(key, Attribute{type, value}).second && needed))
            throw fileError(name,
                            "its header says " + inQuotes(key) + " twice or without a type, export it again");
        if (needed)
            kept += bytes.substr(begin, reader.at() - begin);
        else
            room += reader.at() - begin;
    }
    if (room > 0) {
        constexpr std::size_t frame = 8; // name, type, size: the least that any attribute takes
        kept += "-\0-\0"sv;
        for (std::size_t i = 0; i < 4; ++i)
            kept += static_cast<char>((room - frame) >> 8 * i & 255);
        kept.append(room - frame, '\0');
    }
    kept += '\0';
    return attributes;
}

PixelWindow windowOf(const Attribute& attribute, const std::string& key, std::size_t bytes_per_pixel,
                     const std::string& name) {
    ByteReader reader(attribute.value, "inside its header", name);
    PixelWindow window;
    for (int* edge : {&window.left, &window.top, &window.right, &window.bottom})
        *edge = reader.signed32();
    constexpr int farthest = (1 << 30) - 1; // OpenEXR itself goes no farther
    for (const int edge : {window.left, window.top, window.right, window.bottom})
        if (edge < -farthest || edge > farthest)
            throw fileError(name, "its " + key + " lies too far out, the file may be damaged");
    checkSize(1LL + window.right - window.left, 1LL + window.bottom - window.top, bytes_per_pixel, name);
    return window;
}

std::vector<Channel> channelsOf(const Attribute& attribute, const std::string& name) {
    ByteReader reader(attribute.value, "inside its list of channels", name);
    std::vector<Channel> channels;
    for (;;) {
        Channel channel;
        channel.name = reader.takeUntil('\0', 255);
        if (channel.name.empty()) break;
        channel.type = reader.signed32();
        reader.take(4);
        const std::int32_t x_sampling = reader.signed32();
        channel.subsampled = reader.signed32() != 1 || x_sampling != 1;
        if (channel.type < 0 || channel.type > 2)
            throw fileError(name,
                            "channel " + inQuotes(channel.name) + " has no known type, export it again");
        channels.push_back(std::move(channel));
    }
    if (channels.empty()) throw fileError(name, "has no channels, export it again");
    return channels;
}

Part partOf(const Attributes& attributes, bool tiled, std::size_t file_bytes, const std::string& name) {
    const auto find = [&](std::string_view key, std::string_view type) -> const Attribute* {
        const auto found = attributes.find(key);
        return found != attributes.end() && found->second.type == type ? &found->second : nullptr;
    };
    const auto need = [&](std::string_view key, std::string_view type) -> const Attribute& {
        const Attribute* found = find(key, type);
        if (found == nullptr)
            throw fileError(name, "its header lacks " + inQuotes(key) + ", export it again");
        return *found;
    };
    const auto numbersOf = [&](const Attribute& attribute) {
        return ByteReader(attribute.value, "inside its header", name);
    };

    Part part;
    if (const Attribute* type = find("type", "string")) {
        part.deep = type->value.starts_with("deep");
        tiled = tiled || type->value.ends_with("tile") || type->value.ends_with("tiledimage");
    }
    if (const Attribute* part_name = find("name", "string")) part.name = part_name->value;
    part.channels = channelsOf(need("channels", "chlist"), name);
    std::size_t& bytes_per_pixel = part.bytes_per_pixel;
    for (const Channel& channel : part.channels)
        bytes_per_pixel += channel.bytes();
    part.compression = numbersOf(need("compression", "compression")).byte();
    part.data = windowOf(need("dataWindow", "box2i"), "dataWindow", bytes_per_pixel, name);
    part.display = windowOf(need("displayWindow", "box2i"), "displayWindow", 4, name);

    if (tiled) {
        ByteReader tiles = numbersOf(need("tiles", "tiledesc"));
        const long long width = tiles.little(4);
        const long long height = tiles.little(4);
        checkSize(width, height, bytes_per_pixel, name + ": a tile");
        part.tile_width = static_cast<int>(width);
        part.tile_height = static_cast<int>(height);
        const long long count =
            ((part.data.width() + width - 1) / width) * ((part.data.height() + height - 1) / height);
        if (static_cast<std::size_t>(count) > file_bytes / 8) // each has an offset
            throw fileError(name, "ends before its last tile, fetch it again");
        constexpr long long most_tiles = 1 << 18; // the largest picture in tiles of 32x32: a second or so
        if (count > most_tiles)
            throw fileError(name, "is cut into " + std::to_string(count) + " tiles, at most " +
                                      std::to_string(most_tiles) + " are read; export it in larger ones");
    }
    if (const Attribute* count = find("chunkCount", "int")) {
        part.chunk_count = numbersOf(*count).little(4);
        if (part.chunk_count > file_bytes / 8)
            throw fileError(name, "ends before its last chunk, fetch it again");
    }
    if (const Attribute* aspect = find("pixelAspectRatio", "float"))
        part.pixel_aspect = numbersOf(*aspect).float32();
    if (const Attribute* environment = find("envmap", "envmap"))
        part.cube_map = numbersOf(*environment).byte() == 1;
    if (const Attribute* chromaticities = find("chromaticities", "chromaticities")) {
        ByteReader reader = numbersOf(*chromaticities);
        Primaries& primaries = part.primaries.emplace();
        for (auto* xy : {&primaries.red, &primaries.green, &primaries.blue, &primaries.white})
            for (double& coordinate : *xy)
                coordinate = reader.float32();
    }
    return part;
}

std::string listOf(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < 8; ++i)
        list += (i > 0 ? ", " : "") + inQuotes(names[i]);
    return names.size() > 8 ? list + " and " + std::to_string(names.size() - 8) + " more" : list;
}

// The channels that make a picture, by name, and a word on those that are left out.
std::vector<std::string> pictureChannels(const Part& part, std::vector<std::string>& warnings,
                                         const std::string& name) {
    std::vector<std::string> all;
    for (const Channel& channel : part.channels)
        all.push_back(channel.name);
    const auto has = [&](const std::string& channel) { return contains(all, channel); };

    std::vector<std::string> layers = {""}; // what stands before R, G and B, with its dot
    for (const std::string& channel : all)
        if (channel.ends_with(".R")) layers.push_back(channel.substr(0, channel.size() - 1));
    std::vector<std::string> chosen;
    for (const std::string& layer : layers) {
        for (const auto& names :
             {std::vector{"R", "G", "B", "A"}, {"R", "G", "B"}, {"Y", "A"}, {"R", "G"}, {"Y"}}) {
            chosen.clear();
            for (const char* channel : names)
                chosen.push_back(layer + channel);
            if (std::all_of(chosen.begin(), chosen.end(), has)) break;
            chosen.clear();
        }
        if (!chosen.empty()) break;
    }
    if (chosen.empty() && all.size() == 1) chosen = all; // one of any name: a mask, a depth
    if (chosen.empty())
        throw fileError(name, "has the channels " + listOf(all) + " and neither R, G, B nor Y, export those");
    if (chosen[0].ends_with('Y') && (has("RY") || has("BY")))
        throw fileError(name, "stores luminance and chroma (Y, RY, BY), export it as R, G, B");

    std::vector<std::string> left_out;
    for (const Channel& channel : part.channels) {
        const bool is_chosen = contains(chosen, channel.name);
        if (channel.subsampled)
            throw fileError(name, "channel " + inQuotes(channel.name) +
                                      " is subsampled, export it in full resolution");
        if (is_chosen && channel.type == 0)
            throw fileError(name,
                            "channel " + inQuotes(channel.name) + " is not half or float, export it as one");
        if (!is_chosen) left_out.push_back(channel.name);
    }
    if (!left_out.empty())
        warnings.push_back(name + ": " + listOf(chosen) + " are read, left out: " + listOf(left_out));
    else if (chosen.size() == 1 && chosen[0] != "Y" && chosen[0] != "R")
        warnings.push_back(name + ": its one channel " + inQuotes(chosen[0]) + " is read as grey");
    return chosen;
}

// How many bytes a run-length coded chunk is unpacked to: -n and n bytes as they are, or n and a byte that
// stands n + 1 times.
std::size_t unpackedRunLength(std::string_view packed) {
    std::size_t size = 0;
    for (std::size_t at = 0; at < packed.size();) {
        const auto count = static_cast<signed char>(packed[at++]);
        const std::size_t length = static_cast<std::size_t>(count < 0 ? -count : count + 1);
        const std::size_t needed = count < 0 ? length : 1;
        if (packed.size() - at < needed) return 0;
        at += needed;
        size += length;
    }
    return size;
}

// How many bytes a deflated chunk is unpacked to, 0 where it is broken; `most` and one more at the most.
std::size_t unpackedDeflate(std::string_view packed, std::size_t most) {
    std::vector<unsigned char> room(most + 1);
    uLongf size = room.size();
    const int result = uncompress(room.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), // NOLINT
                                  packed.size());
    return result == Z_OK ? size : 0;
}

// The chunks of the finest level are where the table says, belong to the rows or the tile that they stand for
// and hold all of their bytes. `table` is the place of the part's first offset.
void checkChunks(std::string_view bytes, std::size_t table, std::optional<std::size_t> part_number,
                 const Part& part, const std::string& name) {
    enum { none, rle, zips, zip };
    constexpr std::array<int, 10> rows_of_compression = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    const auto compression = static_cast<std::size_t>(part.compression);
    if (compression >= rows_of_compression.size())
        throw fileError(name, "is packed in a way that is not known here, export it with ZIP");
    const bool tiled = part.tile_width > 0;
    const int width = tiled ? part.tile_width : part.data.width();
    const int height = tiled ? part.tile_height : rows_of_compression[compression];
    const auto broken = [&](const std::string& which) {
        return fileError(name, "does not decode whole, fetch or export it again (" + which + ")");
    };

    if (table > bytes.size()) throw broken("it has no table of its chunks");
    ByteReader offsets(bytes.substr(table), "inside the table of its chunks", name);
    for (int top = 0; top < part.data.height(); top += height) {
        for (int left = 0; left < part.data.width(); left += width) {
            const std::string which =
                tiled ? "tile " + std::to_string(left / width) + "," + std::to_string(top / height)
                      : "row " + std::to_string(part.data.top + top);
            const std::uint64_t low = offsets.little(4);
            const std::uint64_t offset = low | static_cast<std::uint64_t>(offsets.little(4)) << 32;
            if (offset == 0 || offset > bytes.size()) throw broken("the place of " + which + " is not known");
            ByteReader chunk(bytes.substr(offset), "inside " + which, name);
            bool expected = !part_number || chunk.little(4) == *part_number;
            if (tiled) {
                for (const int coordinate : {left / width, top / height, 0, 0})
                    expected = chunk.signed32() == coordinate && expected;
            } else {
                expected = chunk.signed32() == part.data.top + top && expected;
            }
            if (!expected) throw broken(which + " is not where the table says");
            const std::string_view packed = chunk.take(chunk.little(4));
            const std::size_t whole = static_cast<std::size_t>(std::min(width, part.data.width() - left)) *
                                      static_cast<std::size_t>(std::min(height, part.data.height() - top)) *
                                      part.bytes_per_pixel;
            std::size_t unpacked = whole;                      // the other ways to pack notice by themselves
            if (packed.size() >= whole || compression == none) // what packing makes no smaller stays unpacked
                unpacked = packed.size();
            else if (packed.empty())
                unpacked = 0;
            else if (compression == rle)
                unpacked = unpackedRunLength(packed);
            else if (compression == zips || compression == zip)
                unpacked = unpackedDeflate(packed, whole);
            if (unpacked != whole)
                throw broken(which + " holds " + std::to_string(unpacked) + " of its " +
                             std::to_string(whole) + " bytes");
        }
    }
}

} // namespace

CleanExr cleanExr(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, "inside its header", name);
    CleanExr clean;
    clean.bytes = reader.take(4);
    const std::uint32_t version = reader.little(4);
    clean.bytes += bytes.substr(4, 4);
    constexpr std::uint32_t tiled_flag = 0x200, deep_flag = 0x800, multi_part_flag = 0x1000;
    const bool multi_part = (version & multi_part_flag) != 0;
    if ((version & 255) != 2 || (version & ~0x1effu) != 0)
        throw fileError(name, "is an EXR of an unknown version, export it as version 2");

    std::vector<Part> parts;
    for (;;) {
        Attributes attributes = readHeader(reader, bytes, multi_part, clean.bytes, name);
        if (multi_part && attributes.empty()) break;
        parts.push_back(partOf(attributes, (version & tiled_flag) != 0, bytes.size(), name));
        constexpr std::size_t most_parts = 256;
        if (parts.size() > most_parts)
            throw fileError(name,
                            "has more than " + std::to_string(most_parts) + " parts, export one of them");
        if (!multi_part) break;
    }
    if (!multi_part && (version & deep_flag) != 0) parts[0].deep = true;
    const auto flat = std::find_if(parts.begin(), parts.end(), [](const Part& part) { return !part.deep; });
    if (flat == parts.end()) throw fileError(name, "is a deep EXR, flatten it");
    const std::size_t first_table = reader.at();
    clean.bytes += bytes.substr(first_table);

    clean.part = static_cast<int>(flat - parts.begin());
    clean.data = flat->data;
    clean.display = flat->display;
    clean.primaries = flat->primaries;
    clean.cube_map = flat->cube_map;
    if (parts.size() > 1)
        clean.warnings.push_back(name + ": has " + std::to_string(parts.size()) + " parts, " +
                                 inQuotes(flat->name) + " is read");
    clean.channels = pictureChannels(*flat, clean.warnings, name);
    std::size_t chunks_before = 0;
    for (auto before = parts.begin(); before != flat; ++before)
        chunks_before += before->chunk_count;
    checkChunks(bytes, first_table + 8 * chunks_before,
                multi_part ? std::optional(static_cast<std::size_t>(flat - parts.begin())) : std::nullopt,
                *flat, name);
    if (std::abs(flat->pixel_aspect - 1) > 0.001F)
        clean.warnings.push_back(name + ": its pixels are " + std::to_string(flat->pixel_aspect) +
                                 " times as wide as high, they are read as square");
    return clean;
}

} // namespace gll
