// Images in and out: what is written comes back, and every format's values mean what image.hpp says.
// Broken files are in tests/hostile.
#include "io/image.hpp"

#include "jpeg_maker.hpp"
#include "png_maker.hpp"
#include "test_files.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>

using namespace gll;
using namespace gll::test;
using namespace std::string_literals;

namespace {

Image floatImage(int width, int height, int channels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    std::vector<float> samples(static_cast<std::size_t>(width * height * channels));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = std::exp2(float(i % 23) - 11.0F);
    image.pixels = samples;
    return image;
}

Image byteImage(int width, int height, int channels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.color_space = ColorSpace::srgb;
    std::vector<std::uint8_t> samples(static_cast<std::size_t>(width * height * channels));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::uint8_t>(i * 37);
    image.pixels = samples;
    return image;
}

const std::vector<float>& floats(const Image& image) { return std::get<std::vector<float>>(image.pixels); }
const std::vector<std::uint8_t>& bytes(const Image& image) {
    return std::get<std::vector<std::uint8_t>>(image.pixels);
}

} // namespace

TEST(Image, APngReturnsItsPixelsExactlyForEveryNumberOfChannels) {
    const TemporaryFolder folder;
    for (int channels = 1; channels <= 4; ++channels) {
        const Image image = byteImage(7, 5, channels);
        saveImage(folder.path() / "a.png", image);
        const Image back = loadImage(folder.path() / "a.png");
        EXPECT_EQ(back.width, 7);
        EXPECT_EQ(back.height, 5);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.color_space, ColorSpace::srgb);
        EXPECT_EQ(bytes(back), bytes(image));
    }
}

TEST(Image, AlphaDoesNotTouchTheColourBesideIt) {
    const TemporaryFolder folder;
    Image image = byteImage(1, 1, 4);
    image.pixels = std::vector<std::uint8_t>{200, 100, 50, 0};
    saveImage(folder.path() / "a.png", image);
    EXPECT_EQ(bytes(loadImage(folder.path() / "a.png")), bytes(image));
}

TEST(Image, ASixteenBitPngIsReadAsFloatsOfZeroToOne) {
    const TemporaryFolder folder;
    const Image image = loadImage(folder.write("a.png", png(3, 1, 16, 0, "\0\0\0\x33\x33\xff\xff"s)));
    EXPECT_EQ(image.color_space, ColorSpace::srgb);
    EXPECT_EQ(image.channels, 1);
    EXPECT_EQ(floats(image), (std::vector<float>{0.0F, 0.2F, 1.0F}));
}

TEST(Image, PalettesAndFewBitsAreExpandedToEight) {
    const TemporaryFolder folder;
    const std::string palette = pngChunk("PLTE", "\x0a\x14\x1e\xff\x80\x01");
    const Image coloured = loadImage(folder.write("a.png", png(3, 1, 8, 3, "\0\1\0\1"s, palette)));
    EXPECT_EQ(coloured.channels, 3);
    EXPECT_EQ(bytes(coloured), (std::vector<std::uint8_t>{255, 128, 1, 10, 20, 30, 255, 128, 1}));
    const Image grey = loadImage(folder.write("b.png", png(4, 1, 2, 0, "\0\x1b"s))); // 0 1 2 3
    EXPECT_EQ(bytes(grey), (std::vector<std::uint8_t>{0, 85, 170, 255}));
}

TEST(Image, AGammaChunkDoesNotChangeThePixels) {
    const TemporaryFolder folder;
    const std::string gamma = pngChunk("gAMA", bigEndian32(100000));
    const Image image = loadImage(folder.write("a.png", png(2, 1, 8, 0, "\0\x40\x80"s, gamma)));
    EXPECT_EQ(bytes(image), (std::vector<std::uint8_t>{64, 128}));
    ASSERT_EQ(image.warnings.size(), 1u);
    EXPECT_NE(image.warnings[0].find("a.png: gAMA 1.0"), std::string::npos) << image.warnings[0];
    const std::string usual = pngChunk("gAMA", bigEndian32(45455));
    EXPECT_TRUE(loadImage(folder.write("a.png", png(2, 1, 8, 0, "\0\x40\x80"s, usual))).warnings.empty());
}

TEST(Image, AProfileThatIsNotSrgbIsSaid) {
    const TemporaryFolder folder;
    const auto warnings = [&](const std::string& chunks) {
        return loadImage(folder.write("a.png", png(2, 1, 8, 0, "\0\x40\x80"s, chunks))).warnings;
    };
    EXPECT_TRUE(warnings(pngChunk("iCCP", "sRGB IEC61966-2.1\0\0damaged"s)).empty());
    ASSERT_EQ(warnings(pngChunk("iCCP", "Display P3\0\0damaged"s)).size(), 1u);
    EXPECT_NE(warnings(pngChunk("iCCP", "Display P3\0\0"s))[0].find("'Display P3'"), std::string::npos);
    const std::string profile = jpegSegment(0xe2, "ICC_PROFILE\0\1\1Adobe RGB"s);
    EXPECT_EQ(loadImage(folder.write("a.jpg", jpeg(3, profile))).warnings.size(), 1u);
}

TEST(Image, TransparencyOfAPaletteOrOfOneColorIsAlpha) {
    const TemporaryFolder folder;
    const std::string palette = pngChunk("PLTE", "\x0a\x14\x1e\xff\x80\x01") + pngChunk("tRNS", "\x40");
    EXPECT_EQ(bytes(loadImage(folder.write("a.png", png(2, 1, 8, 3, "\0\0\1"s, palette)))),
              (std::vector<std::uint8_t>{10, 20, 30, 64, 255, 128, 1, 255}));
    const std::string one_grey = pngChunk("tRNS", "\0\x40"s);
    const Image grey = loadImage(folder.write("b.png", png(2, 1, 8, 0, "\0\x40\x80"s, one_grey)));
    EXPECT_EQ(grey.channels, 2);
    EXPECT_EQ(bytes(grey), (std::vector<std::uint8_t>{64, 0, 128, 255}));
}

TEST(Image, GreyWithAlphaInSixteenBitsKeepsBoth) {
    const TemporaryFolder folder;
    const Image image = loadImage(folder.write("a.png", png(1, 1, 16, 4, "\0\x33\x33\0\0"s)));
    EXPECT_EQ(image.channels, 2);
    EXPECT_EQ(floats(image), (std::vector<float>{0.2F, 0.0F}));
}

TEST(Image, AnInterlacedPngHasItsPixelsInPlace) {
    const TemporaryFolder folder;
    // Adam7 of 3x2: pass 1 has (0, 0), pass 4 (2, 0), pass 6 (1, 0), pass 7 the row below.
    const std::string passes = "\0\1"s + "\0\3"s + "\0\2"s + "\0\4\5\6"s;
    const Image image = loadImage(folder.write("a.png", png(3, 2, 8, 0, passes, "", true)));
    EXPECT_EQ(bytes(image), (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
}

// OpenImageIO 2.4 divides by this number of rows, and reads as many at a time.
TEST(Image, WordsInAPictureThatOpenImageIoWouldActOnDoNothing) {
    const TemporaryFolder folder;
    // A TIFF with RowsPerStrip (278) = 0, as Exif is written in hexadecimal into a text chunk.
    const std::string exif =
        "\nexif\n      32\n4578696600004d4d002a000000080001011600040000000100000000"s + "00000000\n";
    for (const std::string& chunk :
         {pngChunk("tEXt", "tiff:RowsPerStrip\0"
                           "0"s),
          pngChunk("tEXt", "tiff:RowsPerStrip\0"
                           "2147483647"s),
          pngChunk("tEXt", "Raw profile type exif\0"s + exif), pngChunk("eXIf", "MM\0\x2a\0\0\0\x8"s),
          pngChunk("iTXt", "XML:com.adobe.xmp\0\0\0\0\0<x tiff:RowsPerStrip=\"0\"/>"s)}) {
        const Image image = loadImage(folder.write("a.png", png(2, 1, 16, 0, "\0\0\0\xff\xff"s, chunk)));
        EXPECT_EQ(floats(image), (std::vector<float>{0, 1}));
    }
    const std::string exif_segment =
        jpegSegment(0xe1, "Exif\0\0MM\0\x2a\0\0\0\x8\0\1\1\x16\0\4\0\0\0\1\0\0\0\0\0\0\0\0"s);
    for (const std::string& segment : {exif_segment, jpegSegment(0xe1, "Exif"), jpegSegment(0xfe, "")})
        EXPECT_EQ(bytes(loadImage(folder.write("a.jpg", jpeg(1, segment)))),
                  std::vector<std::uint8_t>(64, 128));
}

TEST(Image, AJpegInInksIsTurnedToRgbAndThatIsSaid) {
    const TemporaryFolder folder;
    EXPECT_TRUE(loadImage(folder.write("a.jpg", jpeg(3))).warnings.empty());
    const Image image = loadImage(folder.write("a.jpg", jpeg(4)));
    EXPECT_EQ(bytes(image), std::vector<std::uint8_t>(192, 64)); // 128 / 255 of 128, ink and black
    ASSERT_EQ(image.warnings.size(), 1u);
    EXPECT_NE(image.warnings[0].find("CMYK"), std::string::npos);
}

TEST(Image, AFullFloatExrReturnsItsPixelsExactlyWithInfinityAndNan) {
    const TemporaryFolder folder;
    Image image = floatImage(9, 4, 3);
    auto& samples = std::get<std::vector<float>>(image.pixels);
    samples[0] = -3.5F;
    samples[1] = std::numeric_limits<float>::infinity();
    samples[2] = std::numeric_limits<float>::quiet_NaN();
    saveImage(folder.path() / "a.exr", image);
    const Image back = loadImage(folder.path() / "a.exr");
    EXPECT_EQ(back.color_space, ColorSpace::linear);
    EXPECT_TRUE(std::isnan(floats(back)[2]));
    for (std::size_t i = 0; i < samples.size(); ++i)
        EXPECT_TRUE(i == 2 || floats(back)[i] == samples[i]) << i;
}

TEST(Image, AnExrHoldsAnyNumberOfChannels) {
    const TemporaryFolder folder;
    for (int channels = 1; channels <= 4; ++channels) {
        const Image image = floatImage(3, 3, channels);
        saveImage(folder.path() / "a.exr", image);
        EXPECT_EQ(floats(loadImage(folder.path() / "a.exr")), floats(image)) << channels;
    }
}

TEST(Image, AHalfExrIsWithinAHalfFloatsPrecision) {
    const TemporaryFolder folder;
    Image image = floatImage(4, 4, 3);
    for (float& sample : std::get<std::vector<float>>(image.pixels))
        sample *= 1.2345F;
    saveImage(folder.path() / "a.exr", image, false);
    const Image back = loadImage(folder.path() / "a.exr");
    for (std::size_t i = 0; i < floats(image).size(); ++i)
        EXPECT_NEAR(floats(back)[i] / floats(image)[i], 1.0F, 0x1p-11f);
}

TEST(Image, AnHdrKeepsEachPixelsLargestChannelToOneIn256) {
    const TemporaryFolder folder;
    for (const int width : {5, 40}) { // narrower than 8 pixels: flat; wider: run-length encoded
        const Image image = floatImage(width, 6, 3);
        saveImage(folder.path() / "a.hdr", image);
        const Image back = loadImage(folder.path() / "a.hdr");
        EXPECT_EQ(back.color_space, ColorSpace::linear);
        ASSERT_EQ(floats(back).size(), floats(image).size());
        for (std::size_t i = 0; i < floats(image).size(); i += 3) {
            const float largest = std::max({floats(image)[i], floats(image)[i + 1], floats(image)[i + 2]});
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(floats(back)[i + k], floats(image)[i + k], largest / 128.0F);
        }
    }
}

TEST(Image, AFlatHdrByHandHasTheValuesOfItsSharedExponents) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"s +
                                                "\x80\x40\x20\x81"s + "\x80\x80\x80\x8b"s);
    const Image image = loadImage(path);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.channels, 3);
    EXPECT_EQ(floats(image), (std::vector<float>{1.0F, 0.5F, 0.25F, 1024.0F, 1024.0F, 1024.0F}));
}

TEST(Image, ARunLengthHdrByHandUnpacksItsRunsAndItsLiterals) {
    const TemporaryFolder folder;
    const std::string row = "\x02\x02\x00\x08"s + "\x88\x80"s         // red: a run of eight 128
                            + "\x08\x00\x20\x40\x60\x80\xa0\xc0\xe0"s // green: eight literals
                            + "\x84\x00\x84\x80"s                     // blue: two runs of four
                            + "\x88\x81"s;                            // exponent: 2^(129 - 128)
    const Image image =
        loadImage(folder.write("a.hdr", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n"s + row));
    ASSERT_EQ(floats(image).size(), 24u);
    for (std::size_t x = 0; x < 8; ++x) {
        EXPECT_EQ(floats(image)[x * 3], 1.0F);
        EXPECT_EQ(floats(image)[x * 3 + 1], float(x) * 0.25F);
        EXPECT_EQ(floats(image)[x * 3 + 2], x < 4 ? 0.0F : 1.0F);
    }
}

TEST(Image, RowZeroIsTheTop) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n"s +
                                                "\x80\x80\x80\x81"s + "\x80\x80\x80\x82"s);
    EXPECT_EQ(floats(loadImage(path))[0], 1.0F);
    EXPECT_EQ(floats(loadImage(path))[3], 2.0F);
}

TEST(Image, TheReaderIsChosenByTheContentAndNotByTheName) {
    const TemporaryFolder folder;
    saveImage(folder.path() / "a.png", byteImage(3, 3, 3));
    std::filesystem::rename(folder.path() / "a.png", folder.path() / "a.exr");
    EXPECT_EQ(bytes(loadImage(folder.path() / "a.exr")), bytes(byteImage(3, 3, 3)));
}

TEST(Image, EqualPixelsMakeEqualFiles) {
    const TemporaryFolder folder;
    const auto save = [&](const std::string& prefix) {
        saveImage(folder.path() / (prefix + ".png"), byteImage(30, 20, 3));
        saveImage(folder.path() / (prefix + ".exr"), floatImage(30, 20, 3));
        saveImage(folder.path() / (prefix + ".hdr"), floatImage(30, 20, 3));
    };
    save("a");
    ::usleep(1100000); // a time of day in a file has seconds
    save("b");
    for (const char* extension : {".png", ".exr", ".hdr"})
        EXPECT_EQ(bytesOf(folder.path() / ("a"s + extension)), bytesOf(folder.path() / ("b"s + extension)))
            << extension;
}

TEST(Image, SavingReplacesAFileAndLeavesNothingElseBehind) {
    const TemporaryFolder folder;
    folder.write("a.png", "old");
    saveImage(folder.path() / "a.png", byteImage(3, 3, 3));
    EXPECT_EQ(bytes(loadImage(folder.path() / "a.png")), bytes(byteImage(3, 3, 3)));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Image, ASaveThatFailsLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.hdr", "old");
    Image image = floatImage(3, 3, 3);
    std::get<std::vector<float>>(image.pixels)[4] = -1.0F;
    expectError(path, {"negative", ".exr"}, [&] { saveImage(path, image); });
    EXPECT_EQ(bytesOf(path), "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);

    std::filesystem::create_directory(folder.path() / "b.png");
    expectError(folder.path() / "b.png", {"is a folder"},
                [&] { saveImage(folder.path() / "b.png", byteImage(2, 2, 3)); });
    expectError(folder.path() / "no/a.png", {"folder exists"},
                [&] { saveImage(folder.path() / "no/a.png", byteImage(2, 2, 3)); });
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Image, ADiskThatFillsUpCostsNeitherTheOldFileNorSpace) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.png", "old");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit hundred_bytes{.rlim_cur = 100, .rlim_max = before.rlim_max};
    const auto on_limit =
        std::signal(SIGXFSZ, SIG_IGN); // so that writing fails instead of ending the process
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &hundred_bytes), 0);
    expectError(path, {"cannot be written whole"}, [&] { saveImage(path, byteImage(64, 64, 3)); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, on_limit);
    EXPECT_EQ(bytesOf(path), "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Image, SavingRefusesPixelsThatTheFormatCannotHold) {
    const TemporaryFolder folder;
    const auto refuses = [&](const char* name, const Image& image, std::string_view what) {
        expectError(folder.path() / name, {what}, [&] { saveImage(folder.path() / name, image); });
    };
    refuses("a.png", floatImage(2, 2, 3), "8-bit");
    refuses("a.exr", byteImage(2, 2, 3), "float");
    refuses("a.hdr", floatImage(2, 2, 4), "4 channels");
    refuses("a.jpg", byteImage(2, 2, 3), ".png, .exr or .hdr");
    refuses("a", byteImage(2, 2, 3), ".png, .exr or .hdr");
    refuses("a.png", Image{}, "0 channels");
    Image lying = byteImage(2, 2, 3);
    lying.height = 3;
    refuses("a.png", lying, "12 samples");
    lying.width = 0;
    refuses("a.png", lying, "0x3");
    lying.width = max_image_extent + 1;
    refuses("a.png", lying, "16385x3");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Image, AnImageInMemoryIsReadLikeAFile) {
    const TemporaryFolder folder;
    saveImage(folder.path() / "a.png", byteImage(3, 2, 3));
    ImageSource source;
    source.name = "model.glb: /images/0";
    source.encoded = std::make_shared<const std::string>(bytesOf(folder.path() / "a.png"));
    EXPECT_EQ(bytes(loadImage(source)), bytes(byteImage(3, 2, 3)));
    ImageSource file;
    file.file = folder.path() / "a.png";
    EXPECT_EQ(bytes(loadImage(file)), bytes(byteImage(3, 2, 3)));
    source.encoded = std::make_shared<const std::string>("not an image");
    expectError("model.glb", {"/images/0", "is no PNG"}, [&] { loadImage(source); });
    EXPECT_THROW(loadImage(ImageSource{}), std::runtime_error);
}
