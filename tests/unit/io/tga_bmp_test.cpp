// TGA and BMP by hand: every kind that is read, down to its pixels.
#include "exr_maker.hpp"
#include "test_files.hpp"

#include "io/image.hpp"

#include <cstdint>

using namespace gll;
using namespace gll::test;
using namespace std::string_literals;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(const std::string& name, const std::string& bytes, int channels, int width = 2,
              int height = 2) {
    const TemporaryFolder folder;
    const Image image = loadImage(folder.write(name, bytes));
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.channels, channels);
    EXPECT_EQ(image.color_space, ColorSpace::srgb);
    return std::get<Bytes>(image.pixels);
}

std::string tga(int type, int bits, int descriptor, const std::string& rest, int width = 2, int height = 2,
                const std::string& map = "\0\0\0\0\0"s) {
    return "\0"s + static_cast<char>(map[2] != 0 || map[3] != 0) + static_cast<char>(type) + map +
           "\0\0\0\0"s + littleEndian(static_cast<std::uint64_t>(width), 2) +
           littleEndian(static_cast<std::uint64_t>(height), 2) + static_cast<char>(bits) +
           static_cast<char>(descriptor) + rest;
}

// A header of 40 bytes, whatever follows it, then the pixels.
std::string bmp(int bits, int compression, const std::string& between, const std::string& pixels,
                int width = 2, int height = 2, int colors = 0) {
    return "BM"s + std::string(8, '\0') + littleEndian(54 + between.size(), 4) + littleEndian(40, 4) +
           int32Bytes(width) + int32Bytes(height) + "\1\0"s +
           littleEndian(static_cast<std::uint64_t>(bits), 2) +
           littleEndian(static_cast<std::uint64_t>(compression), 4) + std::string(12, '\0') +
           littleEndian(static_cast<std::uint64_t>(colors), 4) + std::string(4, '\0') + between + pixels;
}

const std::string palette2 = "\x03\x02\x01\0"s + "\x06\x05\x04\0"s; // 1, 2, 3 and 4, 5, 6 as blue, green, red

} // namespace

TEST(Tga, TrueColorStandsFromTheBottomUpOrFromAnyCornerThatItsHeaderNames) {
    const std::string four = "\3\2\1"
                             "\6\5\4"
                             "\x09\x08\x07"
                             "\x0c\x0b\x0a";
    EXPECT_EQ(bytesOf("a.tga", tga(2, 24, 0, four), 3), (Bytes{7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(bytesOf("a.TGA", tga(2, 24, 0x20, four), 3), (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
    EXPECT_EQ(bytesOf("a.tga", tga(2, 24, 0x30, four), 3), (Bytes{4, 5, 6, 1, 2, 3, 10, 11, 12, 7, 8, 9}));
}

TEST(Tga, TheFourthByteIsAlphaOnlyWhereTheHeaderSaysSo) {
    const std::string two = "\3\2\1\x80"
                            "\6\5\4\xff";
    EXPECT_EQ(bytesOf("a.tga", tga(2, 32, 0x28, two, 2, 1), 4, 2, 1), (Bytes{1, 2, 3, 128, 4, 5, 6, 255}));
    EXPECT_EQ(bytesOf("a.tga", tga(2, 32, 0x20, two, 2, 1), 3, 2, 1), (Bytes{1, 2, 3, 4, 5, 6}));
}

TEST(Tga, SixteenBitsAreFiveForEachColor) {
    EXPECT_EQ(bytesOf("a.tga", tga(2, 16, 0x20, "\x00\x7c\xe3\x83"s, 2, 1), 3, 2, 1),
              (Bytes{255, 0, 0, 0, 255, 25}));
    EXPECT_EQ(bytesOf("a.tga", tga(2, 16, 0x21, "\x00\x7c\xe3\x83"s, 2, 1), 4, 2, 1),
              (Bytes{255, 0, 0, 0, 0, 255, 25, 255}));
}

TEST(Tga, GreyIsOneChannelAndPalettesAreLookedUpFromTheirFirstEntryOn) {
    EXPECT_EQ(bytesOf("a.tga", tga(3, 8, 0x20, "\1\2\3\4"), 1), (Bytes{1, 2, 3, 4}));
    const std::string map = "\5\0\2\0\x18"s; // two entries from 5 on, of 24 bits
    EXPECT_EQ(bytesOf("a.tga", tga(1, 8, 0x20, "\3\2\1\6\5\4\6\5\5\6"s, 2, 2, map), 3),
              (Bytes{4, 5, 6, 1, 2, 3, 1, 2, 3, 4, 5, 6}));
}

TEST(Tga, RunsAndLiteralsMayCrossRows) {
    EXPECT_EQ(bytesOf("a.tga",
                      tga(10, 24, 0x20,
                          "\x82\3\2\1"
                          "\0\6\5\4"s),
                      3),
              (Bytes{1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(bytesOf("a.tga", tga(11, 8, 0x20, "\2\1\2\3\x80\4"s), 1), (Bytes{1, 2, 3, 4}));
}

TEST(Bmp, TrueColorHasRowsOfWholeWordsFromTheBottomUp) {
    const std::string rows = "\3\2\1\6\5\4\0\0"s + "\x09\x08\x07\x0c\x0b\x0a\0\0"s;
    EXPECT_EQ(bytesOf("a", bmp(24, 0, "", rows), 3), (Bytes{7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(bytesOf("a", bmp(24, 0, "", rows, 2, -2), 3), (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(Bmp, TheFourthByteIsAlphaOnlyWhereAMaskSaysSo) {
    EXPECT_EQ(bytesOf("a", bmp(32, 0, "", "\3\2\1\0\6\5\4\0"s, 2, 1), 3, 2, 1), (Bytes{1, 2, 3, 4, 5, 6}));
    const std::string masks =
        "\0\0\0\xff"s + "\0\0\xff\0"s + "\0\xff\0\0"s + "\xff\0\0\0"s; // R highest, A lowest
    EXPECT_EQ(bytesOf("a", bmp(32, 6, masks, "\x80\3\2\1\xff\6\5\4"s, 2, 1), 4, 2, 1),
              (Bytes{1, 2, 3, 128, 4, 5, 6, 255}));
}

TEST(Bmp, SixteenBitsAreFiveForEachColorOrWhatTheMasksSay) {
    EXPECT_EQ(bytesOf("a", bmp(16, 0, "", "\x00\x7c\xe3\x03"s, 2, 1), 3, 2, 1),
              (Bytes{255, 0, 0, 0, 255, 25}));
    const std::string masks = "\x00\xf8\0\0"s + "\xe0\x07\0\0"s + "\x1f\0\0\0"s; // 5, 6, 5
    EXPECT_EQ(bytesOf("a", bmp(16, 3, masks, "\x00\xf8\x20\x00"s, 2, 1), 3, 2, 1),
              (Bytes{255, 0, 0, 0, 4, 0}));
}

TEST(Bmp, PalettesOfOneFourAndEightBitsAreLookedUp) {
    EXPECT_EQ(bytesOf("a", bmp(1, 0, palette2, "\x40\0\0\0"s, 2, 1), 3, 2, 1), (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(bytesOf("a", bmp(4, 0, palette2, "\x10\0\0\0"s, 2, 1, 2), 3, 2, 1), (Bytes{4, 5, 6, 1, 2, 3}));
    EXPECT_EQ(bytesOf("a", bmp(8, 0, palette2, "\1\0\0\0"s, 2, 1, 2), 3, 2, 1), (Bytes{4, 5, 6, 1, 2, 3}));
}

TEST(Bmp, TheOldestHeaderHasAPaletteOfThreeBytes) {
    const std::string old = "BM"s + std::string(8, '\0') + littleEndian(32, 4) + littleEndian(12, 4) +
                            "\2\0\1\0\1\0\1\0"s + "\3\2\1\6\5\4"s + "\x40\0\0\0"s;
    EXPECT_EQ(bytesOf("a", old, 3, 2, 1), (Bytes{1, 2, 3, 4, 5, 6}));
}

TEST(Bmp, RunLengthsOfBothKindsAreUnpacked) {
    // A run of two, the end of the row, a step of one to the right, one literal, the end.
    const std::string eight = "\2\1"s + "\0\0"s + "\0\2\1\0"s + "\1\1"s + "\0\1"s;
    EXPECT_EQ(bytesOf("a", bmp(8, 1, palette2, eight, 2, 2, 2), 3),
              (Bytes{1, 2, 3, 4, 5, 6, 4, 5, 6, 4, 5, 6}));
    const std::string literals = "\0\3\1\0\1\0"s + "\0\1"s;
    EXPECT_EQ(bytesOf("a", bmp(8, 1, palette2, literals, 3, 1, 2), 3, 3, 1),
              (Bytes{4, 5, 6, 1, 2, 3, 4, 5, 6}));
    const std::string four = "\3\x01"s + "\0\0"s + "\0\3\x10\x10"s + "\0\1"s;
    EXPECT_EQ(bytesOf("a", bmp(4, 2, palette2, four, 3, 2, 2), 3, 3, 2),
              (Bytes{4, 5, 6, 1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 1, 2, 3}));
}
