// What an EXR means beside its numbers: windows, channels, parts, levels, chromaticities.
#include "exr_maker.hpp"
#include "test_files.hpp"

#include "io/image.hpp"

using namespace gll;
using namespace gll::test;

namespace {

Image load(const std::string& bytes) {
    const TemporaryFolder folder;
    return loadImage(folder.write("a.exr", bytes));
}

const std::vector<float>& floatsOf(const Image& image) { return std::get<std::vector<float>>(image.pixels); }

// R, G, B, A and others tell themselves apart and the place they were written for.
float marked(const std::string& channel, int x, int y) {
    const std::string all = "RGBA";
    const std::size_t index = all.find(channel.back());
    return static_cast<float>((index == std::string::npos ? 50 : static_cast<int>(index)) + 10 * x + 100 * y);
}

bool says(const Image& image, std::string_view words) {
    for (const std::string& line : image.warnings)
        if (line.find(words) != std::string::npos && line.find("a.exr: ") != std::string::npos) return true;
    return false;
}

ExrPart rgb(int width, int height) {
    ExrPart part;
    part.sized(width, height).value = marked;
    return part;
}

} // namespace

TEST(Exr, ThePictureIsTheDisplayWindowAndIsTransparentWhereTheFileHasNoPixels) {
    ExrPart part = rgb(1, 1);
    part.channels = {"A", "B", "G", "R"};
    part.data = {-1, 1, 1, 2};
    part.display = {0, 0, 2, 1};
    const Image image = load(exr({part}));
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    const std::vector<float> expected = {0,   0,   0,   0,   0,   0,   0,   0,   0, 0, 0, 0, // above the data
                                         100, 101, 102, 103, 110, 111, 112, 113, 0, 0, 0, 0};
    EXPECT_EQ(floatsOf(image), expected);
}

TEST(Exr, APictureWhoseDataLiesElsewhereIsEmpty) {
    ExrPart part = rgb(1, 1);
    part.data = {10, 10, 11, 11};
    part.display = {0, 0, 1, 0};
    EXPECT_EQ(floatsOf(load(exr({part}))), std::vector<float>(6, 0.0F));
}

TEST(Exr, ColorsAreFoundByNameAmongOtherChannelsWhichAreSaid) {
    ExrPart part = rgb(2, 1);
    part.channels = {"A", "B", "G", "R", "Y", "Z", "normal.X"};
    const Image image = load(exr({part}));
    EXPECT_EQ(floatsOf(image), (std::vector<float>{0, 1, 2, 3, 10, 11, 12, 13}));
    EXPECT_TRUE(says(image, "left out: 'Y', 'Z', 'normal.X'")) << image.warnings.at(0);
}

TEST(Exr, TheFirstLayerStandsInWhereThereIsNoPictureWithoutOne) {
    ExrPart part = rgb(1, 1);
    part.channels = {"diffuse.B", "diffuse.G", "diffuse.R", "mask", "specular.B", "specular.G", "specular.R"};
    const Image image = load(exr({part}));
    EXPECT_EQ(floatsOf(image), (std::vector<float>{0, 1, 2}));
    EXPECT_TRUE(says(image, "'diffuse.R', 'diffuse.G', 'diffuse.B' are read, left out: 'mask'"));
}

TEST(Exr, OneChannelOfAnyNameIsGreyAndIsSaidUnlessItIsLuminance) {
    ExrPart part = rgb(1, 1);
    part.channels = {"Y"};
    EXPECT_TRUE(load(exr({part})).warnings.empty());
    part.channels = {"Z"};
    const Image image = load(exr({part}));
    EXPECT_EQ(image.channels, 1);
    EXPECT_TRUE(says(image, "'Z' is read as grey"));
}

TEST(Exr, TilesAreReadAndOfLevelsTheFinest) {
    for (const bool levels : {false, true}) {
        ExrPart part = rgb(5, 3);
        part.tile = 2;
        const std::vector<float> expected = floatsOf(load(exr({rgb(5, 3)})));
        part.levels = levels;
        EXPECT_EQ(floatsOf(load(exr({part}))), expected);
    }
}

TEST(Exr, OfSeveralPartsTheFirstIsReadAndSaid) {
    ExrPart first = rgb(2, 2);
    first.name = "left";
    ExrPart second = first;
    second.name = "right";
    second.value = [](auto&&...) { return 7.0F; };
    second.tile = 2;
    const Image image = load(exr({first, second}));
    EXPECT_EQ(floatsOf(image), floatsOf(load(exr({rgb(2, 2)}))));
    EXPECT_TRUE(says(image, "has 2 parts, 'left' is read"));
}

TEST(Exr, AttributesThatOpenImageIoWouldActOnDoNothing) {
    ExrPart part = rgb(3, 2);
    const std::vector<float> expected = floatsOf(load(exr({part})));
    for (const int rows : {0, -1, 1, 0x7fffffff}) {
        part.more = exrAttribute("tiff:RowsPerStrip", "int", int32Bytes(rows)) +
                    exrAttribute("oiio:ColorSpace", "string", "sRGB") +
                    exrAttribute("preview", "preview", int32Bytes(-1) + int32Bytes(-1)) +
                    exrAttribute("a", "b", "");
        EXPECT_EQ(floatsOf(load(exr({part}))), expected) << rows;
        part.tile = 2;
        EXPECT_EQ(floatsOf(load(exr({part}))), expected) << rows;
        part.tile = 0;
    }
}

TEST(Exr, ACubeMapIsMarkedAndALatLongMapIsNot) {
    ExrPart part = rgb(1, 6);
    part.more = exrAttribute("envmap", "envmap", std::string(1, '\1'));
    EXPECT_TRUE(load(exr({part})).cube_map);
    part.more = exrAttribute("envmap", "envmap", std::string(1, '\0'));
    EXPECT_FALSE(load(exr({part})).cube_map);
    EXPECT_FALSE(load(exr({rgb(1, 6)})).cube_map);
}

TEST(Exr, PixelsThatAreNotSquareAreSaid) {
    ExrPart part = rgb(1, 1);
    part.more = exrAttribute("pixelAspectRatio", "float", floatBytes(2));
    EXPECT_TRUE(says(load(exr({part})), "2.000000 times as wide as high"));
}

TEST(Exr, ChromaticitiesAreCarriedOverToBt709AndXyzIsTakenAsItIs) {
    const auto withPrimaries = [](const std::array<float, 8>& xy, const std::array<float, 3>& color) {
        std::string value;
        for (const float coordinate : xy)
            value += floatBytes(coordinate);
        ExrPart part;
        part.more = exrAttribute("chromaticities", "chromaticities", value);
        part.value = [color](const std::string& channel, int, int) {
            return color[channel == "R" ? 0 : channel == "G" ? 1 : 2];
        };
        return floatsOf(load(exr({part})));
    };
    const auto near = [](const std::vector<float>& color, const std::array<float, 3>& expected) {
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], expected[c], 2e-4) << c;
    };
    // BT.709 itself: not a bit changes.
    EXPECT_EQ(withPrimaries({0.64F, 0.33F, 0.3F, 0.6F, 0.15F, 0.06F, 0.3127F, 0.329F}, {0.1F, 0.7F, 1e-8F}),
              (std::vector<float>{0.1F, 0.7F, 1e-8F}));
    // XYZ of BT.709's red, IEC 61966-2-1 annex F.
    near(withPrimaries({1, 0, 0, 1, 0, 0, 1 / 3.0F, 1 / 3.0F}, {0.4124F, 0.2126F, 0.0193F}), {1, 0, 0});
    // BT.2020: ITU-R BT.2087 has the matrix from BT.709; its inverse's first column is BT.2020's red.
    near(withPrimaries({0.708F, 0.292F, 0.17F, 0.797F, 0.131F, 0.046F, 0.3127F, 0.329F}, {1, 0, 0}),
         {1.6605F, -0.1246F, -0.0182F});
    // ACES AP0 has a white of its own: what is white stays white.
    near(withPrimaries({0.7347F, 0.2653F, 0, 1, 0.0001F, -0.077F, 0.32168F, 0.33767F}, {1, 1, 1}), {1, 1, 1});
}
