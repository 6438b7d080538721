// Writes what fuzz_image starts from: a small file of every format and kind that is read, with metadata.
// image_seeds FOLDER; the folder must exist.
#include "exr_maker.hpp"
#include "io/image.hpp"
#include "jpeg_maker.hpp"
#include "png_maker.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

using namespace gll::test;
using namespace std::string_literals;

int main(int argc, char** argv) {
    if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
        std::fprintf(stderr, "image_seeds: error: name one folder that exists\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const auto write = [&](const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    };

    const std::string words = pngChunk("tEXt", "tiff:RowsPerStrip\0"
                                               "0"s) +
                              pngChunk("gAMA", bigEndian32(100000)) + pngChunk("iCCP", "Display P3\0\0x"s) +
                              pngChunk("eXIf", "MM\0\x2a\0\0\0\x8"s);
    write("grey.png", png(3, 1, 8, 0, "\0\1\2\3"s, words));
    write("rgba16.png", png(1, 1, 16, 6, "\0\1\2\3\4\5\6\7\x08"s, words));
    write("palette.png", png(3, 1, 4, 3, "\0\x01\x10"s, pngChunk("PLTE", "abcdef") + pngChunk("tRNS", "a")));
    write("interlaced.png", png(3, 2, 8, 0, "\0\1\0\3\0\2\0\4\5\6"s, words, true));

    const std::string segments = jpegSegment(0xe0, "JFIF\0\1\1\0\0\1\0\1\0\0"s) +
                                 jpegSegment(0xe1, "Exif\0\0MM\0\x2a\0\0\0\x8\0\0\0\0\0\0"s) +
                                 jpegSegment(0xe2, "ICC_PROFILE\0\1\1x"s) + jpegSegment(0xfe, "words") +
                                 jpegSegment(0xee, "Adobe\0\x64\0\0\0\0\2"s);
    for (const int components : {1, 3, 4})
        write("baseline" + std::to_string(components) + ".jpg", jpeg(components, segments));
    write("progressive.jpg", jpegWithoutEnd(1, segments, 0xc2) + "\xff\xd9");

    ExrPart part;
    part.sized(5, 3).more = exrAttribute("tiff:RowsPerStrip", "int", int32Bytes(0)) +
                            exrAttribute("envmap", "envmap", "\1") +
                            exrAttribute("chromaticities", "chromaticities", std::string(32, '\x3e'));
    write("lines.exr", exr({part}));
    part.tile = 2;
    part.levels = true;
    write("levels.exr", exr({part}));
    part.name = "a";
    ExrPart second = part;
    second.name = "b";
    second.tile = 0;
    second.channels = {"A", "diffuse.B", "diffuse.G", "diffuse.R"};
    write("parts.exr", exr({part, second}));
    gll::Image image{.width = 40, .height = 20, .channels = 3};
    image.pixels = std::vector<float>(2400, 0.5F);
    gll::saveImage(folder / "zip.exr", image, false);

    const std::string head = "#?RADIANCE\nEXPOSURE=2\nCOLORCORR=1 1 2\nPRIMARIES=.6 .3 .3 .6 .1 .1 .3 .3\n"
                             "FORMAT=32-bit_rle_xyze\n\n";
    write("flat.hdr", head + "+X 1 -Y 2\n\x80\x80\x80\x81\x80\x80\x80\x82");
    write("old.hdr", head + "-Y 1 +X 9\n\x80\x80\x80\x81\1\1\1\x08");
    write("runs.hdr", head + "-Y 1 +X 8\n\2\2\0\x08\x88\x80\x88\x80\x08\1\2\3\4\5\6\7\x08\x88\x81"s);

    const auto tga = [](int type, int bits, const std::string& map) {
        return "\0"s + static_cast<char>(type % 8 == 1) + static_cast<char>(type) + map +
               "\0\0\0\0\2\0\2\0"s + static_cast<char>(bits) + '\x28';
    };
    write("color.tga", tga(2, 32, "\0\0\0\0\0"s) + std::string(16, 'a'));
    write("palette.tga", tga(9, 8, "\0\0\2\0\x18"s) + "abcdef\x81\0\1\0\1"s);
    const auto bmp = [](int bits, int compression, int colors, const std::string& rest) {
        return "BM"s + std::string(8, '\0') + int32Bytes(54 + 4 * colors) + int32Bytes(40) + int32Bytes(2) +
               int32Bytes(2) + "\1\0"s + static_cast<char>(bits) + '\0' + int32Bytes(compression) +
               std::string(12, '\0') + int32Bytes(colors) + std::string(4, '\0') + rest;
    };
    write("color.bmp", bmp(24, 0, 0, std::string(16, 'a')));
    write("fields.bmp", bmp(16, 3, 3, "\0\xf8\0\0\xe0\7\0\0\x1f\0\0\0abcdabcd"s));
    write("rle8.bmp", bmp(8, 1, 2, "abc\0def\0\2\1\0\0\0\2\1\0\1\1\0\1"s));
    write("rle4.bmp", bmp(4, 2, 2, "abc\0def\0\2\1\0\0\0\3\x10\x10\0\1"s));
}
