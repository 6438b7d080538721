// What a Radiance picture's header and its older run lengths mean.
#include "test_files.hpp"

#include "io/image.hpp"

#include <array>

using namespace gll;
using namespace gll::test;
using namespace std::string_literals;

namespace {

Image loadHdr(const std::string& bytes) {
    const TemporaryFolder folder;
    return loadImage(folder.write("a.hdr", bytes));
}
std::vector<float> floatsOf(const std::string& bytes) {
    return std::get<std::vector<float>>(loadHdr(bytes).pixels);
}

const std::string one = "\x80\x80\x80\x81"s; // 1, 1, 1
const std::string format = "FORMAT=32-bit_rle_rgbe\n";

// A pixel of red = `red`, at exponent 2^(137 - 136): red * 2.
std::string red(int value) { return std::string(1, static_cast<char>(value)) + "\x00\x00\x89"s; }

} // namespace

TEST(Hdr, AnyMagicLineEndsAndBlanksAreReadAsWritersWriteThem) {
    const std::vector<float> expected(3, 1.0F);
    EXPECT_EQ(floatsOf("#?AUTOPANO\n" + format + "\n-Y 1 +X 1\n" + one), expected);
    EXPECT_EQ(floatsOf("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\r\n" + one), expected);
    EXPECT_EQ(floatsOf("#?RADIANCE\nFORMAT= 32-bit_rle_rgbe \n\n-Y 1 +X 1\n" + one), expected);
    EXPECT_EQ(floatsOf("#?RGBE\n# a remark\nVIEW= -vtv\npfilt -x 1\n" + format + "\n-Y  1  +X  1 \n" + one),
              expected);
}

TEST(Hdr, OlderRunLengthsRepeatThePixelBefore) {
    const std::string head = "#?RADIANCE\n" + format + "\n-Y 2 +X ";
    const auto run = [](int count) { return "\x01\x01\x01"s + static_cast<char>(count); };
    // 300 = 1 + 43 + 256 * 1; the second line is written out of a run of 0 and one of 299.
    const std::vector<float> pixels =
        floatsOf(head + "300\n" + red(3) + run(43) + run(1) + red(5) + run(43) + run(1));
    for (std::size_t i = 0; i < 300; ++i) {
        EXPECT_EQ(pixels[i * 3], 6.0F) << i;
        EXPECT_EQ(pixels[(300 + i) * 3], 10.0F) << i;
    }
    // The count starts over behind a pixel; lines under 8 pixels have run lengths too.
    const std::vector<float> narrow =
        floatsOf(head + "5\n" + red(1) + run(1) + red(2) + run(2) + red(3) + run(4));
    const std::vector<float> expected = {2, 2, 4, 4, 4, 6, 6, 6, 6, 6};
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_EQ(narrow[i * 3], expected[i]) << i;
}

TEST(Hdr, ExposuresAndColorCorrectionsAreDividedOut) {
    const std::vector<float> pixel = floatsOf("#?RADIANCE\nEXPOSURE=2\nEXPOSURE= 4.0\nCOLORCORR= 0.5 1 2\n"
                                              "\tEXPOSURE=9\n" + // the history of another picture
                                              format +
                                              "\n-Y 1 +X 1\n" + one);
    EXPECT_EQ(pixel, (std::vector<float>{0.25F, 0.125F, 0.0625F}));
}

TEST(Hdr, PicturesAreUprightWhateverTheOrientationOfTheirLines) {
    const auto reds = [](const std::string& size) {
        const std::vector<float> pixels = floatsOf("#?RADIANCE\n" + format + "\n" + size + "\n" + red(1) +
                                                   red(2) + red(3) + red(4) + red(5) + red(6));
        std::vector<float> values;
        for (std::size_t i = 0; i < pixels.size(); i += 3)
            values.push_back(pixels[i] / 2);
        return values;
    };
    EXPECT_EQ(reds("-Y 2 +X 3"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(reds("+Y 2 +X 3"), (std::vector<float>{4, 5, 6, 1, 2, 3}));
    EXPECT_EQ(reds("-Y 2 -X 3"), (std::vector<float>{3, 2, 1, 6, 5, 4}));
    EXPECT_EQ(reds("+Y 2 -X 3"), (std::vector<float>{6, 5, 4, 3, 2, 1}));
    EXPECT_EQ(reds("+X 3 -Y 2"), (std::vector<float>{1, 3, 5, 2, 4, 6}));
    EXPECT_EQ(reds("-X 3 +Y 2"), (std::vector<float>{6, 4, 2, 5, 3, 1}));
}

TEST(Hdr, PrimariesAndXyzAreCarriedOverAndWhiteStaysWhite) {
    const auto near = [](const std::vector<float>& color, const std::array<float, 3>& expected) {
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], expected[c], 1e-3) << c;
    };
    near(floatsOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + one), {1, 1, 1});
    const std::string bt2020 = "PRIMARIES= 0.708 0.292 0.17 0.797 0.131 0.046 0.3127 0.3290\n";
    near(floatsOf("#?RADIANCE\n" + bt2020 + format + "\n-Y 1 +X 1\n" + one), {1, 1, 1});
    near(floatsOf("#?RADIANCE\n" + bt2020 + format + "\n-Y 1 +X 1\n" + "\x80\x00\x00\x81"s),
         {1.6605F, -0.1246F, -0.0182F});
}

TEST(Hdr, PixelsThatAreNotSquareAreSaid) {
    const Image image = loadHdr("#?RADIANCE\nPIXASPECT=2\n" + format + "\n-Y 1 +X 1\n" + one);
    ASSERT_EQ(image.warnings.size(), 1u);
    EXPECT_NE(image.warnings[0].find("a.hdr: PIXASPECT 2"), std::string::npos);
}
