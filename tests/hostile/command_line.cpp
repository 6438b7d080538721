// Wrong options, settings, sizes, frames and targets: refused with exit code 2 before anything is rendered.
#include "hostile/hostile.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <utility>

namespace gll::test {
namespace {

class CommandLine : public testing::TestWithParam<Refusal> {};

TEST_P(CommandLine, isRefusedInOneLine) { checkRefusal(GetParam()); }

Refusal setting(const char* name, const std::string& assignment, std::vector<std::string> parts) {
    return {name, {"--headless", "--set", assignment}, 2, std::move(parts)};
}
Refusal size(const char* name, const std::string& text) {
    return {name, {"--headless", "--size", text}, 2, {"--size"}};
}
Refusal frame(const char* name, const std::string& text) {
    return {name, {"--headless", "--frame", text}, 2, {"--frame"}};
}
Refusal frames(const char* name, const std::string& text) {
    return {name, {"--frames", text, "--out", "f%d.png"}, 2, {"--frames"}};
}
Refusal out(const char* name, const std::string& text) { return {name, {"--out", text}, 2, {"--out"}}; }

INSTANTIATE_TEST_SUITE_P(
    Options, CommandLine,
    testing::Values(
        Refusal{"unknownOption", {"--headles"}, 2, {"--headles", "--help", "did you mean --headless?"}},
        Refusal{"unknownShortOption", {"-x"}, 2, {"-x"}}, Refusal{"strayWord", {"bloom"}, 2, {"bloom"}},
        Refusal{"severalUnknownOptions", {"--a", "--b\nc"}, 2, {"--a"}},
        Refusal{"optionWithoutItsValue", {"--size"}, 2, {"--size"}},
        Refusal{"emptyTarget", {"--headless", "--target", ""}, 2, {"--target"}},
        Refusal{"emptyBatch", {"--batch="}, 2, {"--batch"}},
        Refusal{"unknownContext", {"--context", "vulkan"}, 2, {"--context", "vulkan"}},
        Refusal{"windowAndHeadless", {"--headless", "--context", "window"}, 2, {"--headless"}},
        Refusal{"windowAndOut", {"--context", "window", "--out", "a.png"}, 2, {"--context window"}},
        Refusal{"unknownPreset", {"--headless", "--preset", "best"}, 2, {"best", "original"}},
        Refusal{
            "unknownTarget", {"--target", "hdd", "--size", "8x8"}, 2, {"hdd", "bloom0", "did you mean hdr?"}},
        Refusal{"unknownPassOfAnInjection",
                {"--inject", "scen:1,1:nan", "--out", "a.png", "--size", "8x8"},
                2,
                {"--inject scen", "did you mean scene?"}},
        Refusal{"readingsOfARungWithout", {"--readings", "--size", "8x8"}, 2, {"--readings"}},
        Refusal{"unknownCounter", {"--cost", "--counter", "guess"}, 2, {"--counter"}},
        Refusal{"frameAndFrames", {"--frame", "1", "--frames", "1..2", "--out", "%d.png"}, 2, {"--frame"}}),
    RefusalName());

INSTANTIATE_TEST_SUITE_P(
    Settings, CommandLine,
    testing::Values(setting("unknown", "intensty=1", {"intensty", "--settings", "did you mean intensity?"}),
                    setting("withoutEquals", "intensity", {"KEY=VALUE"}),
                    setting("withoutValue", "intensity=", {"intensity"}),
                    setting("withoutName", "=1", {"unknown setting"}),
                    setting("belowItsRange", "intensity=-0.1", {"intensity", "0 to 100"}),
                    setting("aboveItsRange", "intensity=100.1", {"intensity", "0 to 100"}),
                    setting("notANumber", "intensity=nan", {"intensity", "nan"}),
                    setting("infinite", "intensity=inf", {"intensity", "inf"}),
                    setting("beyondDouble", "intensity=1e999", {"intensity"}),
                    setting("words", "intensity=much", {"intensity", "much"}),
                    setting("numberWithATail", "intensity=1.0f", {"intensity", "1.0f"}),
                    setting("fractionForInteger", "levels=2.5", {"levels", "whole"}),
                    setting("tooManyLevels", "levels=9", {"levels", "1 to 8"}),
                    setting("noLevels", "levels=0", {"levels", "1 to 8"}),
                    setting("tooManyInstances", "instances=1000001", {"instances"}),
                    setting("neitherOnNorOff", "bloom=maybe", {"bloom", "maybe"}),
                    setting("unknownChoice", "tone_map=aces", {"tone_map", "did you mean aces_narkowicz?"}),
                    setting("twoLines", "tone_map=a\nb", {"tone_map"})),
    RefusalName());

INSTANTIATE_TEST_SUITE_P(Sizes, CommandLine,
                         testing::Values(size("zeroWidth", "0x5"), size("zeroHeight", "5x0"),
                                         size("huge", "99999x99999"), size("tooManyPixels", "16384x16384"),
                                         size("tooWide", "16385x1"), size("negative", "-1x5"),
                                         size("oneNumber", "640"), size("threeNumbers", "6x4x8"),
                                         size("fraction", "6.5x4"), size("empty", "x"),
                                         size("beyondInteger", "99999999999999999999x1"),
                                         size("capital", "640X480"), size("nothing", ""),
                                         size("spaces", "640 x 480")),
                         RefusalName());

INSTANTIATE_TEST_SUITE_P(
    Frames, CommandLine,
    testing::Values(frame("zero", "0"), frame("negative", "-1"), frame("words", "first"),
                    frame("notANumber", "nan"), frame("fraction", "1.5"),
                    frame("beyondInteger", "99999999999"), frames("backwards", "5..1"), frames("one", "5"),
                    frames("fromZero", "0..5"), frames("openEnd", "5.."), frames("noStep", "1..5:0"),
                    frames("emptyStep", "1..5:"), frames("threeDots", "1...5"),
                    Refusal{"severalIntoOneFile", {"--frames", "1..2", "--out", "a.png"}, 2, {"%d"}}),
    RefusalName());

INSTANTIATE_TEST_SUITE_P(Names, CommandLine,
                         testing::Values(out("noExtension", "frame"), out("unknownExtension", "frame.jpg"),
                                         out("dot", "."), out("empty", ""), out("string", "%s.png"),
                                         out("longNumber", "%123d.png"), out("twoNumbers", "%d_%d.png"),
                                         out("loneMark", "100%.png"), out("stored", "%n.png")),
                         RefusalName());

TEST(CommandLineWindow, withoutADisplayNamesHeadless) {
    for (const char* display : {"", ":4711"}) {
        const TemporaryFolder folder;
        for (const bool explicitly : {true, false}) {
            Command command = rungCommand(folder, {});
            if (explicitly) command.arguments = {"--context", "window"};
            if (*display != '\0') command.environment["DISPLAY"] = display;
            expectRefusal(run(command), 1, {"--headless"});
        }
        EXPECT_EQ(folder.listing(), std::vector<std::string>());
    }
}

// tutorials/run starts every rung with --or-picture: which command lines need a window is the program's to
// know.
TEST(CommandLineOrPicture, rendersTheHeadlessFrameWhereNoWindowCanBeOpened) {
    const TemporaryFolder folder;
    const std::string name = rungProgram().filename().string();
    for (const char* display : {"", ":4711"}) {
        Command command = rungCommand(folder, {"--or-picture", "--size", "40x30"});
        if (*display != '\0') command.environment["DISPLAY"] = display;
        const Result result = run(command);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        const std::filesystem::path picture = folder.path() / (name + ".png");
        EXPECT_NE(result.err.find("the picture is " + picture.string()), std::string::npos) << result.err;
        EXPECT_EQ(folder.listing(), std::vector<std::string>{name + ".png"});
        runToSuccess(rungCommand(folder, {"--headless", "--size", "40x30", "--out", "headless.png"}));
        EXPECT_EQ(contents(picture), contents(folder.path() / "headless.png"));
        std::filesystem::remove(picture);
        std::filesystem::remove(folder.path() / "headless.png");
    }
}

TEST(CommandLineOrPicture, leavesNoPictureWhereNoWindowWasAskedFor) {
    const std::vector<std::vector<std::string>> lines{
        {"--help"},
        {"--version"},
        {"--settings"},
        {"--settings", "--json"},
        {"--cost", "--counter", "cpu", "--size", "8x8"},
        {"--budget", "flip=1", "--counter", "cpu", "--size", "8x8"}};
    for (std::vector<std::string> line : lines) {
        const TemporaryFolder folder;
        line.emplace_back("--or-picture");
        const Result result = run(rungCommand(folder, line));
        EXPECT_EQ(result.exit_code, 0) << line[0] << ": " << result.err;
        EXPECT_EQ(result.err, "") << line[0];
        EXPECT_EQ(folder.listing(), std::vector<std::string>()) << line[0];
    }
}

TEST(CommandLineOrPicture, namesNoFileThatOtherOptionsName) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& line :
         std::vector<std::vector<std::string>>{{"--out", "a.png"},
                                               {"--inject", "scene:4,4:nan", "--out", "b.png"},
                                               {"--target", "hdr", "--out", "c.exr"},
                                               {"--frames", "1..1", "--out", "d.png"}}) {
        std::vector<std::string> all{"--or-picture", "--size", "8x8"};
        all.insert(all.end(), line.begin(), line.end());
        runToSuccess(rungCommand(folder, all));
    }
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"a.png", "b.png", "c.exr", "d.png"}));
}

TEST(CommandLineOrPicture, excusesNoMistake) {
    for (const auto& [line, exit_code] :
         std::vector<std::pair<std::vector<std::string>, int>>{{{"--context", "window"}, 1},
                                                               {{"--readings"}, 2},
                                                               {{"--set", "intensty=1"}, 2},
                                                               {{"--siez", "8x8"}, 2}}) {
        const TemporaryFolder folder;
        std::vector<std::string> all = line;
        all.emplace_back("--or-picture");
        expectRefusal(run(rungCommand(folder, all)), exit_code, {});
        EXPECT_EQ(folder.listing(), std::vector<std::string>());
    }
}

} // namespace
} // namespace gll::test
