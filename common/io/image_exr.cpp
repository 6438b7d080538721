// The header of an EXR, after "OpenEXR File Layout" of openexr.com. OpenEXR asks memory for what it claims
// and OpenImageIO acts on attributes of any name, so both are given a header that holds what the pixels need
// only.
#include "io/image_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

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
    std::size_t bytes_per_pixel = 0;
    for (const Channel& channel : part.channels)
        bytes_per_pixel += channel.bytes();
    part.data = windowOf(need("dataWindow", "box2i"), "dataWindow", bytes_per_pixel, name);
    part.display = windowOf(need("displayWindow", "box2i"), "displayWindow", 4, name);

    if (tiled) {
        ByteReader tiles = numbersOf(need("tiles", "tiledesc"));
        const long long width = tiles.little(4);
        const long long height = tiles.little(4);
        checkSize(width, height, bytes_per_pixel, name + ": a tile");
        const long long count =
            ((part.data.width() + width - 1) / width) * ((part.data.height() + height - 1) / height);
        if (static_cast<std::size_t>(count) > file_bytes / 8) // each has an offset
            throw fileError(name, "ends before its last tile, fetch it again");
        constexpr long long most_tiles = 1 << 18; // the largest picture in tiles of 32x32: a second or so
        if (count > most_tiles)
            throw fileError(name, "is cut into " + std::to_string(count) + " tiles, at most " +
                                      std::to_string(most_tiles) + " are read; export it in larger ones");
    }
    if (const Attribute* count = find("chunkCount", "int"))
        if (numbersOf(*count).little(4) > file_bytes / 8)
            throw fileError(name, "ends before its last chunk, fetch it again");
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
    clean.bytes += bytes.substr(reader.at());

    clean.part = static_cast<int>(flat - parts.begin());
    clean.data = flat->data;
    clean.display = flat->display;
    clean.primaries = flat->primaries;
    clean.cube_map = flat->cube_map;
    if (parts.size() > 1)
        clean.warnings.push_back(name + ": has " + std::to_string(parts.size()) + " parts, " +
                                 inQuotes(flat->name) + " is read");
    clean.channels = pictureChannels(*flat, clean.warnings, name);
    if (std::abs(flat->pixel_aspect - 1) > 0.001F)
        clean.warnings.push_back(name + ": its pixels are " + std::to_string(flat->pixel_aspect) +
                                 " times as wide as high, they are read as square");
    return clean;
}

} // namespace gll
