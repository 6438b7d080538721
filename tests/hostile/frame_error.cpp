// Frames that frame_error cannot compare: said in one line that names the file, never averaged away.
#include "hostile/hostile.hpp"
#include "io/image.hpp"

#include <limits>

namespace gll::test {
namespace {

Image image(int width, int height, bool linear) {
    Image result;
    result.width = width;
    result.height = height;
    result.channels = 3;
    result.color_space = linear ? ColorSpace::linear : ColorSpace::srgb;
    const auto samples = static_cast<std::size_t>(width * height * 3);
    if (linear)
        result.pixels = std::vector<float>(samples, 0.5F);
    else
        result.pixels = std::vector<std::uint8_t>(samples, 128);
    return result;
}

class FrameError : public testing::Test {
  protected:
    FrameError() {
        saveImage(folder / "frame.png", image(8, 6, false));
        saveImage(folder / "frame.exr", image(8, 6, true));
    }
    void expectRefused(const std::string& one, const std::string& other,
                       const std::vector<std::string>& parts) {
        const auto before = folder.listing();
        const Result result = run(rungCommand(folder, {one, other, "--map", "map.png", "--json"}));
        expectRefusal(result, 1, parts);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(folder.listing(), before);
    }
    void expectMeasured(const std::string& one, const std::string& other) {
        const Result result = run(rungCommand(folder, {one, other, "--json"}));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out.find("\"hdr_flip_mean\""), std::string::npos) << result.out;
    }

    TemporaryFolder folder;
};

TEST_F(FrameError, refusesFilesItCannotRead) {
    expectRefused("no.png", "frame.png", {"no.png"});
    expectRefused("frame.png", "no.png", {"no.png"});
    folder.write("text.png", "not a picture\n");
    expectRefused("frame.png", "text.png", {"text.png", "PNG"});
    folder.write("empty.exr", "");
    expectRefused("empty.exr", "frame.exr", {"empty.exr"});
    std::filesystem::create_directory(folder / "folder.png");
    expectRefused("folder.png", "frame.png", {"folder.png"});
    folder.write("lies.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n");
    expectRefused("lies.hdr", "frame.exr", {"lies.hdr", "100000x100000"});
}

TEST_F(FrameError, refusesSizesThatDiffer) {
    saveImage(folder / "turned.png", image(6, 8, false));
    expectRefused("turned.png", "frame.png", {"turned.png", "6x8", "frame.png", "8x6"});
    saveImage(folder / "lower.png", image(8, 5, false));
    expectRefused("lower.png", "frame.png", {"lower.png", "8x5", "frame.png", "8x6"});
    saveImage(folder / "one.exr", image(1, 1, true));
    expectRefused("frame.exr", "one.exr", {"8x6", "1x1"});
}

TEST_F(FrameError, refusesKindsThatDiffer) {
    expectRefused("frame.png", "frame.exr", {"frame.png", "display values", "frame.exr", "linear light"});
    expectRefused("frame.exr", "frame.png", {"linear light", "display values"});
}

TEST_F(FrameError, namesThePixelThatIsNoNumber) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const struct {
        float value;
        const char* name;
    } bad[] = {
        {std::numeric_limits<float>::quiet_NaN(), "nan"}, {infinity, "infinite"}, {-infinity, "infinite"}};
    for (const auto& [value, name] : bad) {
        Image broken = image(8, 6, true);
        std::get<std::vector<float>>(broken.pixels)[(4 * 8 + 5) * 3 + 1] = value;
        saveImage(folder / "broken.exr", broken);
        expectRefused("broken.exr", "frame.exr", {"broken.exr: pixel (5, 4): green is ", name});
        expectRefused("frame.exr", "broken.exr", {"broken.exr: pixel (5, 4): green is ", name});
    }
}

TEST_F(FrameError, refusesFramesThatWouldTakeAllMemory) {
    saveImage(folder / "huge.png", [] {
        Image huge = image(1, 1, false);
        huge.width = 8192;
        huge.height = 4097;
        huge.channels = 1;
        huge.pixels = std::vector<std::uint8_t>(std::size_t(8192) * 4097);
        return huge;
    }());
    expectRefused("huge.png", "frame.png", {"huge.png", "8192x4097"});
}

TEST_F(FrameError, measuresWhatIsOnlyOdd) {
    saveImage(folder / "one.png", image(1, 1, false));
    expectMeasured("one.png", "one.png");
    saveImage(folder / "line.exr", image(301, 1, true));
    expectMeasured("line.exr", "line.exr");
    Image extreme = image(8, 6, true);
    auto& values = std::get<std::vector<float>>(extreme.pixels);
    values[0] = std::numeric_limits<float>::max();
    values[1] = -std::numeric_limits<float>::max();
    values[2] = std::numeric_limits<float>::denorm_min();
    saveImage(folder / "extreme.exr", extreme);
    expectMeasured("extreme.exr", "frame.exr");
    expectMeasured("frame.exr", "extreme.exr");
    Image black = image(8, 6, true);
    black.pixels = std::vector<float>(8 * 6 * 3);
    saveImage(folder / "black.exr", black);
    expectMeasured("frame.exr", "black.exr");
    expectMeasured("black.exr", "frame.exr");
}

TEST_F(FrameError, refusesToWriteWhereItCannot) {
    const Result result = run(rungCommand(folder, {"frame.png", "frame.png", "--map", "no/map.png"}));
    expectRefusal(result, 1, {"no/map.png"});
    EXPECT_EQ(result.out, "");
}

TEST_F(FrameError, refusesToWriteTheMapOntoAFrame) {
    const std::string before = contents(folder / "frame.png");
    saveImage(folder / "other.png", image(8, 6, false));
    std::filesystem::create_symlink("frame.png", folder / "link.png");
    for (const auto& [frame, reference, map] :
         std::vector<std::array<std::string, 3>>{{"frame.png", "other.png", "frame.png"},
                                                 {"other.png", "frame.png", "./frame.png"},
                                                 {"frame.png", "other.png", "link.png"}})
        expectRefusal(run(rungCommand(folder, {frame, reference, "--map", map})), 2, {map, "overwritten"});
    EXPECT_EQ(contents(folder / "frame.png"), before);
}

TEST_F(FrameError, refusesWrongUsage) {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"frame.png"},
        {"frame.png", "frame.png", "frame.png"},
        {"frame.png", "frame.png", "--no-such-option"},
        {"frame.png", "frame.png", "--map"},
        {"frame.png", "frame.png", "--map", "map.exr"},
        {"frame.png", "frame.png", "--pixels-per-degree", "0"},
        {"frame.png", "frame.png", "--pixels-per-degree", "nan"},
        {"frame.png", "frame.png", "--pixels-per-degree", "far"},
    };
    for (const auto& arguments : wrong)
        expectRefusal(run(rungCommand(folder, arguments)), 2, {"see --help"});
}

} // namespace
} // namespace gll::test
