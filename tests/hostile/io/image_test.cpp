// Image files that lie, break off or are no images: each must end in an error that names the file and the
// trouble. The list grows: what once crashed a reader stays here.
#include "io/image.hpp"

#include "exr_maker.hpp"
#include "jpeg_maker.hpp"
#include "png_maker.hpp"
#include "test_files.hpp"

#include <sys/stat.h>

#include <cstdint>
#include <string_view>
#include <utility>

using namespace gll;
using namespace gll::test;
using namespace std::string_literals;

namespace {

void refuses(const TemporaryFolder& folder, const std::string& bytes,
             std::initializer_list<std::string_view> parts) {
    const auto path = folder.write("bad", bytes);
    expectError(path, parts, [&] { loadImage(path); });
}

std::string hdr(const std::string& size, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
}

std::string pngClaiming(std::uint32_t width, std::uint32_t height) {
    return png(width, height, 8, 6, std::string(5, '\0')); // the rows of one pixel
}

Image sample(bool eight_bits) {
    Image image;
    image.width = 40;
    image.height = 30;
    image.channels = 3;
    if (eight_bits) {
        std::vector<std::uint8_t> samples(3600);
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] = static_cast<std::uint8_t>(i * i / 7);
        image.pixels = samples;
    } else {
        std::vector<float> samples(3600);
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] = static_cast<float>(i * i % 1009);
        image.pixels = samples;
    }
    return image;
}

} // namespace

TEST(HostileImage, WhatIsNoFileIsNotOpened) {
    const TemporaryFolder folder;
    const auto missing = folder.path() / "missing.png";
    expectError(missing, {"no such file"}, [&] { loadImage(missing); });
    expectError(folder.path(), {"is a folder"}, [&] { loadImage(folder.path()); });
    const auto fifo = folder.path() / "fifo.png";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    expectError(fifo, {"not a regular file"}, [&] { loadImage(fifo); }); // opening it would wait for ever
    expectError("/dev/zero", {"not a regular file"}, [&] { loadImage("/dev/zero"); });
}

TEST(HostileImage, OtherFormatsAreRefusedWhateverTheirName) {
    const TemporaryFolder folder;
    refuses(folder, "", {"is empty"});
    refuses(folder, "\x89", {"is no PNG, JPEG, Radiance HDR, EXR, BMP"});
    refuses(folder, "GIF89a\x01\0\x01\0\0\0\0;"s, {"is no PNG"});
    refuses(folder, "II*\0\x08\0\0\0\0\0\0\0\0\0"s, {"is no PNG"});
    refuses(folder, "P6 1 1 255\nabc", {"is no PNG"});
    refuses(folder, "<svg/>", {"is no PNG"});
}

TEST(HostileImage, FilesCutOffAnywhereAreRefused) {
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "a.hdr", "a.exr"}) {
        saveImage(folder.path() / name, sample(name == "a.png"s));
        const std::string whole = bytesOf(folder.path() / name);
        for (std::size_t length = 0; length < whole.size(); length += 1 + length / 16)
            refuses(folder, whole.substr(0, length), {});
        refuses(folder, whole.substr(0, whole.size() - 1), {});
    }
}

TEST(HostileImage, ATruncatedJpegIsNotFilledWithGrey) {
    const TemporaryFolder folder;
    const std::string head = jpegWithoutEnd(1);
    const Image image = loadImage(folder.write("good.jpg", head + "\xff\xd9"));
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(image.pixels), std::vector<std::uint8_t>(64, 128));
    for (std::size_t length = 3; length <= head.size(); ++length)
        refuses(folder, head.substr(0, length), {"ends before its last row"});
}

TEST(HostileImage, JpegsOfOtherKindsAreNamed) {
    const TemporaryFolder folder;
    refuses(folder, jpegWithoutEnd(1, "", 0xc3) + "\xff\xd9", {"lossless"});
    std::string twelve_bits = jpeg(1);
    twelve_bits[twelve_bits.find("\xff\xc0") + 4] = 12;
    refuses(folder, twelve_bits, {"12 bits"});
    std::string huge = jpeg(1);
    huge.replace(huge.find("\xff\xc0") + 5, 4, "\xff\xff\xff\xff");
    refuses(folder, huge, {"65535x65535"});
    std::string no_height = jpeg(1);
    no_height.replace(no_height.find("\xff\xc0") + 5, 2, "\0\0"s);
    refuses(folder, no_height, {"8x0"});
}

TEST(HostileImage, AProgressiveJpegOfAThousandScansIsNotGoneThrough) {
    const TemporaryFolder folder;
    const std::string size = "\x20\0\x20\0"s; // 8192x8192
    std::string bytes = "\xff\xd8" + jpegSegment(0xc2, "\x08" + size + "\x01\x01\x11\0"s);
    for (int i = 0; i < 1000; ++i)
        bytes += jpegSegment(0xda, "\x01\x01\0\0\0\0"s) + "\x7f";
    refuses(folder, bytes + "\xff\xd9", {"too many scans"});
}

TEST(HostileImage, APngThatNeedsAnUnknownChunkSaysWhich) {
    const TemporaryFolder folder;
    refuses(folder, png(1, 1, 8, 0, "\0\1"s, pngChunk("CgBI", "abcd")), {"'CgBI'"});
    std::string transparent = pngChunk("tRNS", "\0\1"s);
    EXPECT_EQ(loadImage(folder.write("a.png", png(1, 1, 8, 0, "\0\1"s, transparent))).channels, 2);
    transparent.back() ^= 1; // its checksum: without it the picture would lose its alpha
    refuses(folder, png(1, 1, 8, 0, "\0\1"s, transparent), {"does not decode", "CRC"});
    refuses(folder, png(1, 1, 8, 0, "\0\1"s, pngChunk("iCCP", std::string(100, 'x'))), {"'iCCP'"});
}

TEST(HostileImage, SizesOutsideTheLimitsAreRefusedBeforeMemoryIsAskedFor) {
    const TemporaryFolder folder;
    refuses(folder, hdr("-Y 100000 +X 100000", ""), {"100000x100000"});
    refuses(folder, hdr("-Y -5 +X -7", "abcd"), {"-7x-5"});
    refuses(folder, hdr("-Y 0 +X 4", "abcd"), {"4x0"});
    refuses(folder, hdr("-Y 99999999999999999999 +X 4", "abcd"), {"4x-1"});
    refuses(folder, hdr("-Y 16384 +X 16384", "abcd"), {"512 MiB"});
    refuses(folder, hdr("-Y 4000 +X 4000", "abcd"), {"ends before its last row"});
    refuses(folder, pngClaiming(100000, 100000), {"100000x100000"});
    refuses(folder, pngClaiming(0xffffffffu, 0x7fffffff), {"4294967295x"});
    refuses(folder, pngClaiming(16384, 16384), {"512 MiB"});
    refuses(folder, pngClaiming(0, 7), {"0x7"});
    refuses(folder, pngClaiming(300, 300), {"does not decode whole"});
}

TEST(HostileImage, AnExrWithAHugeDataWindowIsRefused) {
    const TemporaryFolder folder;
    saveImage(folder.path() / "a.exr", sample(false));
    const std::string whole = bytesOf(folder.path() / "a.exr");
    const std::size_t window = whole.find("dataWindow\0box2i\0"s) + 21;
    for (const auto& [right, bottom] :
         {std::pair("\xff\xff\xff\x7f", "\xff\xff\xff\x7f"), {"\x9f\x86\x01\0", "\x9f\x86\x01\0"}}) {
        std::string lying = whole;
        lying.replace(window + 8, 4, right, 4);
        lying.replace(window + 12, 4, bottom, 4);
        refuses(folder, lying, {"bad"});
    }
    std::string negative = whole; // its left edge lies right of its right edge
    negative.replace(window, 4, "\xff\0\0\0", 4);
    refuses(folder, negative, {"bad"});
}

TEST(HostileImage, ExrsThatHoldNoPictureSayWhatTheyHold) {
    const TemporaryFolder folder;
    ExrPart part;
    constexpr std::uint32_t deep = 0x800;
    refuses(folder, exr({part}, deep), {"deep", "flatten"});
    part.channels = {"BY", "RY", "Y"};
    refuses(folder, exr({part}), {"luminance and chroma", "RY"});
    part.sampling = 2;
    refuses(folder, exr({part}), {"luminance and chroma"});
    part.channels = {"Y"};
    refuses(folder, exr({part}), {"'Y'", "subsampled"});
    part.sampling = 1;
    part.channels = {"N.x", "N.y", "Z"};
    refuses(folder, exr({part}), {"'N.x', 'N.y', 'Z'", "neither R, G, B nor Y"});
    part.channels = {"Y"};
    part.channel_type = 0;
    refuses(folder, exr({part}), {"'Y'", "not half or float"});
    part.channel_type = 3;
    refuses(folder, exr({part}), {"'Y'", "no known type"});
    part.channels = {};
    refuses(folder, exr({part}), {"no channels"});
    ExrPart left, right;
    left.name = "a";
    right.name = "b";
    left.type = right.type = "deepscanline";
    refuses(folder, exr({left, right}), {"deep"});
}

TEST(HostileImage, ExrHeadersThatLieAreRefusedBeforeOpenExrSeesThem) {
    const TemporaryFolder folder;
    ExrPart part;
    const std::string good = exr({part});
    const auto withPart = [](auto&& change) {
        ExrPart changed;
        change(changed);
        std::string header = "\x76\x2f\x31\x01" + littleEndian(2 | (changed.tile > 0 ? 0x200 : 0), 4);
        changed.data = changed.display = {0, 0, 0, 0}; // its pixels are of no matter
        return header + changed.header(false);
    };
    for (const char* key : {"channels", "dataWindow", "displayWindow"}) {
        std::string lacking = good;
        lacking[lacking.find(key)] = 'x';
        refuses(folder, lacking, {key});
        refuses(folder, withPart([&](ExrPart& p) { p.more = exrAttribute(key, "int", int32Bytes(0)); }),
                {key});
    }
    refuses(folder, withPart([](ExrPart& p) { p.more = exrAttribute("a\n\x1b[m", "", ""); }), {"'a??[m'"});
    for (const auto& [side, claimed] :
         {std::pair(-1, "4294967295x1"), {0, "0x1"}, {0x7fffffff, "2147483647x1"}}) {
        std::string tiled = withPart([](ExrPart& p) { p.tile = 1; });
        tiled.replace(tiled.find("tiledesc") + 13, 4, int32Bytes(side));
        refuses(folder, tiled, {"a tile", claimed});
    }
    refuses(folder, good.substr(0, 4) + littleEndian(3, 4) + good.substr(8), {"unknown version"});
    refuses(folder, good.substr(0, 4) + littleEndian(0x2002, 4) + good.substr(8), {"unknown version"});

    part.data = {0, 0, 16383, 16383};
    part.tile = 1;
    std::string tiny_tiles = "\x76\x2f\x31\x01" + littleEndian(0x202, 4);
    ExrPart one = part;
    one.data = one.display;
    tiny_tiles += one.header(false);
    const std::size_t window = tiny_tiles.find("dataWindow\0box2i\0"s) + 21;
    tiny_tiles.replace(window + 8, 8, int32Bytes(4095) + int32Bytes(4095));
    refuses(folder, tiny_tiles, {"last tile"});
    tiny_tiles.replace(window + 8, 8, int32Bytes(1023) + int32Bytes(511));
    refuses(folder, tiny_tiles + std::string(8 * 1024 * 512, '\0'), {"524288 tiles", "larger"});
    std::string far = good;
    const std::size_t place = far.find("dataWindow\0box2i\0"s) + 21;
    far.replace(place, 4, int32Bytes(-2147483647 - 1));
    refuses(folder, far, {"dataWindow", "too far out"});
    std::string chromaticities;
    for (int i = 0; i < 8; ++i)
        chromaticities += floatBytes(0.3F);
    ExrPart colorless;
    colorless.more = exrAttribute("chromaticities", "chromaticities", chromaticities);
    refuses(folder, exr({colorless}), {"chromaticities", "no colors"});
    colorless.more = exrAttribute("chromaticities", "chromaticities", "abc");
    refuses(folder, exr({colorless}), {"ends inside its header"});
    std::vector<ExrPart> many(300);
    for (std::size_t i = 0; i < many.size(); ++i)
        many[i].name = std::to_string(i);
    refuses(folder, exr(many), {"256 parts"});
}

// What a row lacks would be drawn from memory, other at each run.
TEST(HostileImage, AnExrWhoseRowsLackBytesOrStandElsewhereIsRefused) {
    const TemporaryFolder folder;
    ExrPart part;
    part.sized(4, 3);
    constexpr std::size_t row_bytes = 4 * 3 * 4;
    const std::string good = exr({part});
    EXPECT_EQ(loadImage(folder.write("good", good)).height, 3);
    const std::size_t row = good.size() - 2 * (8 + row_bytes); // the second one: its number, size and pixels
    const std::size_t table = good.size() - 3 * (8 + row_bytes) - 3 * 8;
    const auto changed = [&](std::size_t at, const std::string& to) {
        return std::string(good).replace(at, to.size(), to);
    };
    for (const int size : {0, 1, static_cast<int>(row_bytes) - 4})
        refuses(folder, changed(row + 4, int32Bytes(size)), {"does not decode whole", "row 1"});
    refuses(folder, changed(row, int32Bytes(2)), {"does not decode whole", "row 1"});
    refuses(folder, changed(table + 8, good.substr(table, 8)), {"does not decode whole", "row 1"});
    refuses(folder, changed(table + 8, std::string(8, '\0')), {"does not decode whole", "row 1"});

    // Packed: the row's 48 bytes stored by zlib (RFC 1950, 1951) or in runs, or fewer of them.
    const auto packed = [&](char compression, const std::string& bytes) {
        std::string file = good.substr(0, row + 4) + littleEndian(bytes.size(), 4) + bytes;
        const std::string third = good.substr(row + 8 + row_bytes);
        file.replace(table + 16, 8, littleEndian(file.size(), 8));
        file.replace(file.find("compression\0compression\0"s) + 28, 1, 1, compression);
        return file + third;
    };
    const std::string zlib_zeros = "\x78\x9c\x63\x60\x20\x0d\x00\x00\x00\x30\x00\x01"s; // 48 zeros
    const std::string zlib_ten = "\x78\x9c\x63\x60\x80\x01\x00\x00\x0a\x00\x01"s;       // 10 zeros
    EXPECT_EQ(loadImage(folder.write("good", packed(2, zlib_zeros))).height, 3);
    EXPECT_EQ(loadImage(folder.write("good", packed(1, "\x2f\x00"s))).height, 3);
    refuses(folder, packed(2, zlib_ten), {"does not decode whole", "row 1 holds 10 of its 48 bytes"});
    refuses(folder, packed(1, "\x09\x00"s), {"does not decode whole", "row 1 holds 10 of its 48 bytes"});
    for (char compression = 1; compression < 10; ++compression)
        refuses(folder, packed(compression, ""), {"does not decode whole"});

    part.tile = 2;
    std::string tiled = exr({part});
    EXPECT_EQ(loadImage(folder.write("good", tiled)).width, 4);
    const std::size_t last_tile = tiled.size() - (20 + 2 * 3 * 4); // two pixels of the last row
    tiled.replace(last_tile + 16, 4, int32Bytes(8));
    refuses(folder, tiled, {"does not decode whole", "tile 1,1"});
}

TEST(HostileImage, HdrHeadersThatMeanSomethingElseAreRefused) {
    const TemporaryFolder folder;
    refuses(folder, "#?RADIANCE\nFORMAT=32-bit_spectrum\n\n-Y 1 +X 1\nabcd",
            {"'32-bit_spectrum'", "32-bit_rle_rgbe"});
    refuses(folder, hdr("+Y 1 +Y 1", "abcd"), {"'+Y 1 +Y 1'", "-Y height +X width"});
    refuses(folder, hdr("1 1", "abcd"), {"-Y height +X width"});
    refuses(folder, hdr("", ""), {"-Y height +X width"});
    refuses(folder, "#?RADIANCE\n", {"ends inside its header"});
    refuses(folder, "#?RADIANCE\n" + std::string(200000, 'x'), {"ends inside its header"});
    for (const char* line :
         {"EXPOSURE=", "EXPOSURE=a", "EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=1e40",
          "COLORCORR=1 1", "COLORCORR=1 0 1", "PRIMARIES=1 2 3", "PIXASPECT=x"})
        refuses(folder, "#?RADIANCE\n"s + line + "\n\n-Y 1 +X 1\nabcd", {line});
    refuses(folder, "#?RADIANCE\nPRIMARIES=1 1 1 1 1 1 1 1\n\n-Y 1 +X 1\nabcd", {"PRIMARIES"});
}

TEST(HostileImage, HdrRunsPastTheirLineAreRefused) {
    const TemporaryFolder folder;
    refuses(folder, hdr("-Y 1 +X 8", "\x02\x02\x00\x07\x88\x80\x88\x80\x88\x80\x88\x80"s),
            {"a line of 7 pixels in 8"});
    refuses(folder, hdr("-Y 1 +X 8", "\x02\x02\x00\x08\xff\x80\xff\x80\xff\x80\xff\x80"s),
            {"run past its line"});
    refuses(folder, hdr("-Y 1 +X 8", "\x02\x02\x00\x08\x00\x00\x00\x00\x00\x00\x00\x00"s),
            {"run past its line"});
    refuses(folder, hdr("-Y 1 +X 8", "\x01\x01\x01\x08\x00\x00\x00\x00"s), {"before its first"});
    refuses(folder, hdr("-Y 1 +X 3", "\x01\x01\x01\x03\x00\x00\x00\x00"s), {"past its line"});
    refuses(folder, hdr("-Y 1 +X 9", "\x05\x01\x01\x80\x01\x01\x01\x09"s), {"past its line"});
    const std::string nothing = "\x01\x01\x01\x00"s; // as often as one likes: 0 pixels each
    std::string idle = "\x05\x01\x01\x80";
    for (int i = 0; i < 3; ++i)
        idle += nothing;
    refuses(folder, hdr("-Y 1 +X 9", idle + "\x01\x01\x01\x01"), {"past its line"});
    refuses(folder, hdr("-Y 1 +X 9", idle), {"before its last row"});
}

TEST(HostileImage, TgasAndBmpsThatLieAreRefused) {
    const TemporaryFolder folder;
    const auto refusesTga = [&](const std::string& bytes, std::initializer_list<std::string_view> parts) {
        const auto path = folder.write("bad.tga", bytes);
        expectError(path, parts, [&] { loadImage(path); });
    };
    const auto tga = [](int map, int type, const std::string& map_info, const std::string& size, int bits) {
        return "\0"s + static_cast<char>(map) + static_cast<char>(type) + map_info + "\0\0\0\0"s + size +
               static_cast<char>(bits) + '\0';
    };
    const std::string none = "\0\0\0\0\0"s;
    const std::string one = "\1\0\1\0"s;
    refusesTga(tga(0, 2, none, one, 24) + "ab", {"before its last row"});
    refusesTga(tga(0, 10, none, one, 24) + "\x80"
                                           "ab",
               {"before its last row"});
    refusesTga(tga(0, 2, none, "\xff\xff\xff\xff", 24) + "abc", {"65535x65535"});
    refusesTga(tga(0, 2, none, "\0\0\1\0"s, 24) + "abc", {"0x1"});
    refusesTga(tga(0, 2, none, "\0\x20\0\x20"s, 24) + "abc", {"before its last row"});
    refusesTga(tga(0, 2, none, one, 8) + "abc", {"type 2, 8 bits"});
    refusesTga(tga(0, 32, none, one, 8) + "abc", {"type 32"});
    refusesTga(tga(0, 1, none, one, 8) + "abc", {"type 1"});
    refusesTga(tga(1, 1, "\0\0\1\0\x18"s, one, 8) + "abc\1", {"color 1 of a palette of 1"});
    refusesTga(tga(1, 1, "\0\0\xff\xff\x18"s, one, 8) + "abc\0"s, {"before its last row"});
    refuses(folder, tga(0, 2, none, one, 24) + "abc", {"named .tga"}); // by its name only

    const auto bmp = [](int width, int height, int bits, int compression, int colors,
                        const std::string& rest) {
        return "BM"s + std::string(8, '\0') + littleEndian(54, 4) + littleEndian(40, 4) + int32Bytes(width) +
               int32Bytes(height) + "\1\0"s + littleEndian(static_cast<std::uint64_t>(bits), 2) +
               int32Bytes(compression) + std::string(12, '\0') + int32Bytes(colors) + "\0\0\0\0"s + rest;
    };
    refuses(folder, "BM", {"before its last row"});
    refuses(folder, bmp(1, 1, 24, 0, 0, "ab"), {"before its last row"});
    refuses(folder, bmp(1, -2147483647 - 1, 24, 0, 0, "abcd"), {"1x2147483648"});
    refuses(folder, bmp(-1, 1, 24, 0, 0, "abcd"), {"-1x1"});
    refuses(folder, bmp(8192, 8192, 24, 0, 0, "abcd"), {"before its last row"});
    refuses(folder, bmp(1, 1, 24, 1, 0, "abcd"), {"24 bits with compression 1"});
    refuses(folder, bmp(1, 1, 0, 5, 0, "abcd"), {"compression 5"});
    refuses(folder, bmp(1, -1, 8, 1, 2, "abcdabcd"), {"compression 1"});
    refuses(folder, bmp(1, 1, 8, 0, 257, std::string(2000, 'a')), {"palette of 257"});
    refuses(folder, bmp(1, 1, 8, 0, -1, std::string(2000, 'a')), {"palette of 4294967295"});
    refuses(folder, bmp(1, 1, 8, 0, 1, "abcd"),
            {"palette of 1"}); // its pixels begin at its palette: index 97
    refuses(folder, bmp(1, 1, 8, 1, 1, "\5\0\1\0"s), {"run past its picture"});
    std::string unknown = bmp(1, 1, 24, 0, 0, "abcd");
    unknown[14] = 20;
    refuses(folder, unknown, {"unknown version"});
    unknown[17] = '\x7f';
    refuses(folder, unknown, {"before its last row"});
}
