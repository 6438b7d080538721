// Image files that lie, break off or are no images: each must end in an error that names the file and the
// trouble. The list grows: what once crashed a reader stays here.
#include "io/image.hpp"

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
    refuses(folder, "\x89", {"is no PNG, JPEG, Radiance HDR or EXR"});
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
    // 8x8 grey, all coefficients zero; made by hand from the JPEG specification's baseline segments.
    const std::string quantisation = "\xff\xdb\x00\x43\x00"s + std::string(64, '\x01');
    const std::string frame = "\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00"s;
    const std::string dc = "\xff\xc4\x00\x14\x00\x01"s + std::string(15, '\0') + "\0"s;
    const std::string ac = "\xff\xc4\x00\x14\x10\x01"s + std::string(15, '\0') + "\0"s;
    const std::string scan =
        "\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00\x3f"s; // codes '0' '0', filled up with ones
    const std::string head = "\xff\xd8"s + quantisation + frame + dc + ac + scan;
    const Image image = loadImage(folder.write("good.jpg", head + "\xff\xd9"));
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(image.pixels), std::vector<std::uint8_t>(64, 128));
    for (std::size_t length = 3; length <= head.size(); ++length)
        refuses(folder, head.substr(0, length), {"ends before its last row"});
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

TEST(HostileImage, HdrHeadersThatMeanSomethingElseAreRefused) {
    const TemporaryFolder folder;
    refuses(folder, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", {"RGBE"});
    refuses(folder, hdr("+Y 1 +X 1", "abcd"), {"'+Y 1 +X 1'", "-Y height +X width"});
    refuses(folder, hdr("+X 1 -Y 1", "abcd"), {"-Y height +X width"});
    refuses(folder, hdr("", ""), {"-Y height +X width"});
    refuses(folder, "#?RADIANCE\n", {"ends inside its header"});
    refuses(folder, "#?RADIANCE\n" + std::string(200000, 'x'), {"ends inside its header"});
    refuses(folder, hdr("-Y 1 +X 8", "\x02\x02\x00\x07\x88\x80\x88\x80\x88\x80\x88\x80"s), {"bad"});
    refuses(folder, hdr("-Y 1 +X 8", "\x02\x02\x00\x08\xff\x80\xff\x80\xff\x80\xff\x80"s), {"bad"});
}
