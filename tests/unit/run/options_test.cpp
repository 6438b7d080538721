// The command line and the batch file: what they accept, their defaults, and where errors point to.
#include "run/options.hpp"
#include "rung/usage_error.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

namespace gll::test {
namespace {

class OptionsTest : public testing::Test {
  protected:
    std::optional<Options> parse(std::vector<std::string> words) {
        words.insert(words.begin(), "99_test");
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        return parseOptions(static_cast<int>(words.size()), arguments.data(), info, settings);
    }
    std::string errorOf(const std::vector<std::string>& words) {
        return messageOf<UsageError>([&] { parse(words); });
    }
    std::string batch(std::string_view text) { return folder.write("batch.jsonl", text).string(); }

    TemporaryFolder folder;
    Settings settings;
    Number knee = settings.number("knee", 0.6, 0, 100, "help");
    Toggle bloom = settings.toggle("bloom", true, "help");
    RungInfo info{.name = "99_test", .summary = "A test."};
};

TEST_F(OptionsTest, withoutArgumentsAWindowBeginsAtTheFirstFrame) {
    const Options options = parse({}).value();
    EXPECT_EQ(options.context, ContextKind::window);
    EXPECT_EQ(options.request.size, glm::ivec2(640, 480));
    EXPECT_EQ(options.request.first_frame, 1);
    EXPECT_EQ(options.request.preset, "original");
    EXPECT_TRUE(options.request.out.empty());
    EXPECT_FALSE(options.is_batch);
}

TEST_F(OptionsTest, headlessWithoutMoreWritesFrameSixtyUnderTheRungsName) {
    const Options options = parse({"--headless"}).value();
    EXPECT_EQ(options.context, ContextKind::headless);
    EXPECT_EQ(options.request.first_frame, 60);
    EXPECT_EQ(options.request.last_frame, 60);
    EXPECT_EQ(options.request.out, "99_test.png");
    EXPECT_EQ(parse({"--frames", "1..3"})->request.out, "99_test_%04d.png");
}

TEST_F(OptionsTest, aBudgetNamesOneKindOfErrorAndALimitInItsRange) {
    EXPECT_EQ(parse({"--budget", "flip=0.01"})->budget->kind, Budget::Kind::flip);
    EXPECT_EQ(parse({"--budget", "flip=0.01"})->budget->limit, 0.01);
    EXPECT_EQ(parse({"--budget", "rmse=1"})->budget->kind, Budget::Kind::rmse);
    EXPECT_EQ(parse({"--budget", "ev=16"})->budget->kind, Budget::Kind::ev);
    EXPECT_EQ(parse({"--budget", "ev=16"})->context, ContextKind::headless);
    EXPECT_TRUE(parse({"--budget", "ev=16"})->request.out.empty());
    for (const char* wrong :
         {"flip", "flip=", "flip=0", "flip=1.1", "flip=nan", "flip=0.1x", "ev=17", "psnr=40"})
        EXPECT_NE(errorOf({"--budget", wrong}).find("--budget"), std::string::npos) << wrong;
    EXPECT_NE(errorOf({"--budget", "flip=0.1", "--cost"}).find("excludes"), std::string::npos);
}

TEST_F(OptionsTest, whatWritesOrMeasuresNeedsNoWindow) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--out", "a.png"},
                                               {"--frames", "1..2"},
                                               {"--target", "hdr"},
                                               {"--targets", "passes"},
                                               {"--readings"},
                                               {"--cost"}})
        EXPECT_EQ(parse(words)->context, ContextKind::headless) << words[0];
    EXPECT_EQ(parse({"--context", "egl"})->context, ContextKind::egl);
    EXPECT_EQ(parse({"--context", "osmesa"})->context, ContextKind::osmesa);
    EXPECT_EQ(parse({"--frame", "7"})->context, ContextKind::window);
}

TEST_F(OptionsTest, optionsThatExcludeEachOtherAreRefused) {
    EXPECT_CONTAINS(errorOf({"--frame", "1", "--frames", "1..2"}), "exclude each other");
    EXPECT_CONTAINS(errorOf({"--headless", "--context", "window"}), "exclude each other");
    EXPECT_CONTAINS(errorOf({"--frames", "1..2", "--targets", "passes"}), "is for one frame");
    EXPECT_CONTAINS(errorOf({"--context", "window", "--out", "a.png"}), "--context window");
    EXPECT_CONTAINS(errorOf({"--context", "window", "--cost"}), "--context window");
    EXPECT_EQ(errorOf({"--headless", "--context", "egl"}), "");
}

TEST_F(OptionsTest, sizesAreTwoWholeNumbersWithinLimits) {
    EXPECT_EQ(parseSize("1x1"), glm::ivec2(1, 1));
    EXPECT_EQ(parseSize("16384x4096"), glm::ivec2(16384, 4096)); // 64 Mi pixels
    for (const char* text :
         {"", "x", "640", "640x", "x480", "0x5", "5x0", "-1x5", "640x480x3", "640X480", "6 x5", "640x 480",
          "1.5x2", "16385x1", "99999x99999", "16384x4097", "99999999999x1", "+6x4", "0x10"})
        EXPECT_THROW(parseSize(text), UsageError) << text;
    EXPECT_CONTAINS(errorOf({"--size", "0x5"}), "not a whole number from 1 to 16384");
}

TEST_F(OptionsTest, anEmptyValueIsNotTakenForNoValue) {
    EXPECT_NE(errorOf({"--size", ""}), "");
    EXPECT_NE(errorOf({"--frame", ""}), "");
    EXPECT_NE(errorOf({"--frames", ""}), "");
    EXPECT_NE(errorOf({"--batch", ""}), "");
    EXPECT_NE(errorOf({"--out", ""}), "");
    EXPECT_NE(errorOf({"--target", ""}), "");
}

TEST_F(OptionsTest, framesCountFromOne) {
    EXPECT_EQ(parse({"--frame", "10000000"})->request.first_frame, 10'000'000);
    for (const char* text : {"0", "-1", "10000001", "1.5", "x", "1e3"})
        EXPECT_CONTAINS(errorOf({"--frame", text}), "not a whole number from 1 to 10000000");
}

TEST_F(OptionsTest, frameRangesHaveAnEndAndMayHaveAStep) {
    const FrameRequest range = parse({"--frames", "3..9:2"})->request;
    EXPECT_EQ(range.first_frame, 3);
    EXPECT_EQ(range.last_frame, 9);
    EXPECT_EQ(range.step, 2);
    EXPECT_TRUE(range.isSequence());
    EXPECT_EQ(parse({"--frames", "3..9"})->request.step, 1);
    EXPECT_FALSE(parse({"--frames", "3..3"})->request.isSequence());
    for (const char* text : {"3", "3..", "..9", "9..3", "0..3", "1..3:0", "1..3:", "1..3:-1", "1...3",
                             "1..3..5", "a..b", ":1..3"})
        EXPECT_NE(errorOf({"--frames", text}), "") << text;
}

TEST_F(OptionsTest, anInjectionIsAPassAPixelAndAnyFloat) {
    const FrameRequest request = parse({"--inject", "scene:3,14:-inf", "--inject", "hdr:0,0:1e9"})->request;
    ASSERT_EQ(request.injections.size(), 2U);
    EXPECT_EQ(request.injections[0].name, "scene");
    EXPECT_EQ(request.injections[0].pixel, glm::ivec2(3, 14));
    EXPECT_EQ(request.injections[0].value, -std::numeric_limits<float>::infinity());
    EXPECT_EQ(request.injections[1].value, 1e9F);
    EXPECT_TRUE(std::isnan(parseInjection("a:1,2:nan").value));
    for (const char* text : {"scene", "scene:1,2", "scene:1:2", "scene:1,2:", "scene:1,2:bright",
                             "scene:-1,2:0", ":1,2:3", "scene:1,2,3:4", "::", ":", "scene:16384,0:1"})
        EXPECT_NE(errorOf({"--inject", text}), "") << text;
}

TEST_F(OptionsTest, aCounterInTheNameIsFilledIn) {
    FrameRequest request;
    const auto outFor = [&](const char* name, int frame) {
        request.out = name;
        return request.outFor(frame).string();
    };
    EXPECT_EQ(outFor("a_%d.png", 7), "a_7.png");
    EXPECT_EQ(outFor("a_%04d.png", 7), "a_0007.png");
    EXPECT_EQ(outFor("a_%04d.png", 123456), "a_123456.png");
    EXPECT_EQ(outFor("dir_%d/a.png", 7), "dir_7/a.png");
    EXPECT_EQ(outFor("a.png", 7), "a.png");
}

TEST_F(OptionsTest, aNameWithAnotherPercentSignOrTwoCountersIsRefused) {
    for (const char* name : {"%s.png", "%d%d.png", "100%.png", "a%.png", "%123d.png", "%n.exr", "%5.3d.png",
                             "%%d.png", "%x.png", "%-4d.png"})
        EXPECT_CONTAINS(errorOf({"--out", name}), "only one %d") << name;
    EXPECT_CONTAINS(errorOf({"--out", "a.png", "--frames", "1..2"}), "several frames need a %d");
    EXPECT_EQ(errorOf({"--out", "a.png", "--frames", "1..1"}), "");
}

TEST_F(OptionsTest, onlyNamesOfPictureFilesAreTaken) {
    for (const char* name : {"a.png", "a.exr", "a.hdr"})
        EXPECT_EQ(errorOf({"--out", name}), "") << name;
    for (const char* name : {"a", "a.jpg", "a.PNG", ".png", "a.png/", "png"})
        EXPECT_CONTAINS(errorOf({"--out", name}), "must end in .png, .exr or .hdr") << name;
}

TEST_F(OptionsTest, settingsAndPresetsAreCheckedBeforeAnythingIsRendered) {
    EXPECT_CONTAINS(errorOf({"--set", "kneee=1"}), "unknown setting \"kneee\"");
    EXPECT_CONTAINS(errorOf({"--set", "knee=nan"}), "is not a number from 0 to 100");
    EXPECT_CONTAINS(errorOf({"--set", "knee"}), "write KEY=VALUE");
    EXPECT_CONTAINS(errorOf({"--preset", "none"}), "unknown preset \"none\"");
    EXPECT_EQ(errorOf({"--preset", "seed"}), "") << "the original's former name";
    EXPECT_EQ(errorOf({"--batch", batch(R"({"out": "a.png", "preset": "seed"})")}), "");
    EXPECT_EQ(errorOf({"--set", "knee=1", "--set", "bloom=off"}), "");
    EXPECT_EQ(settings.commandLine(), "") << "checking must not set";
    EXPECT_EQ(parse({"--set", "knee=1", "--set", "bloom=off"})->request.sets,
              (std::vector<std::string>{"knee=1", "bloom=off"}));
}

TEST_F(OptionsTest, whatIsUnknownIsRefused) {
    EXPECT_CONTAINS(errorOf({"--no-such"}), "--help lists the options");
    EXPECT_NE(errorOf({"stray"}), "");
    EXPECT_NE(errorOf({"--context", "vulkan"}), "");
    EXPECT_NE(errorOf({"--counter", "sundial"}), "");
    EXPECT_NE(errorOf({"--size"}), "");
    EXPECT_NE(errorOf({"--mesh", "a.obj"}), "") << "this rung takes no files";
    info.takes = {"mesh", "floor", "environment"};
    EXPECT_EQ(parse({"--mesh", "a.obj"})->request.files.mesh, "a.obj");
}

TEST_F(OptionsTest, whatIsMisspeltIsAnsweredWithTheNearestName) {
    EXPECT_CONTAINS(errorOf({"--headles"}), "; did you mean --headless?");
    EXPECT_CONTAINS(errorOf({"--sise=8x8"}), "; did you mean --size?");
    EXPECT_CONTAINS(errorOf({"-size", "8x8"}), "; did you mean --size?");
    EXPECT_CONTAINS(errorOf({"--blom", "off"}), "; did you mean --set bloom=VALUE?");
    EXPECT_CONTAINS(errorOf({"bloom=off"}), "; did you mean --set bloom=VALUE?");
    EXPECT_CONTAINS(errorOf({"--set", "blom=off"}), "; did you mean bloom?");
    EXPECT_CONTAINS(errorOf({"--preset", "orignal"}), "; did you mean original?");
    EXPECT_CONTAINS(errorOf({"--context", "osmesaa"}), "; did you mean osmesa?");
    EXPECT_CONTAINS(errorOf({"--counter", "callgrid"}), "; did you mean callgrind?");
    EXPECT_CONTAINS(errorOf({"--budget", "filp=0.1"}), "; did you mean flip?");
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--vulkan"}, {"--budget", "flip=2"}, {"--size"}})
        EXPECT_EQ(errorOf(words).find("did you mean"), std::string::npos) << words[0];
    const auto inBatch = [&](const char* line) { return errorOf({"--batch", batch(line)}); };
    EXPECT_CONTAINS(inBatch(R"({"fame": 1})"), "; did you mean frame?");
    EXPECT_CONTAINS(inBatch(R"({"out": "a.png", "set": {"kne": 1}})"), "; did you mean knee?");
    EXPECT_EQ(inBatch(R"({"cost": 1})").find("did you mean"), std::string::npos) << "the key is right";
}

TEST_F(OptionsTest, aRequestAsACommandLineComesBackThroughAShell) {
    FrameRequest request;
    request.size = {33, 17};
    request.first_frame = request.last_frame = 7;
    request.sets = {"knee=0.1", "bloom=off"};
    request.out = "it's $HOME & \"more\" ; *\\.png";
    request.files.image = "/some where/~a'b`c`.exr";
    Command command = headlessCommand(request, "egl");
    EXPECT_TRUE(std::filesystem::exists(command.program));
    command.program = "/usr/bin/printf";
    command.arguments.insert(command.arguments.begin(), "%s\\n");
    const ProcessResult shell = Process({.program = "/bin/sh", .arguments = {"-c", shellLine(command)}})
                                    .wait(std::chrono::seconds(10));
    std::istringstream lines(shell.out);
    std::vector<std::string> words;
    for (std::string line; std::getline(lines, line);)
        words.push_back(line);
    info.takes = {"image"};
    const Options options = parse(words).value();
    EXPECT_EQ(options.context, ContextKind::egl);
    EXPECT_EQ(options.request.size, request.size);
    EXPECT_EQ(options.request.first_frame, 7);
    EXPECT_EQ(options.request.sets, request.sets);
    EXPECT_EQ(options.request.out, request.out);
    EXPECT_EQ(options.request.files.image, request.files.image);
}

TEST_F(OptionsTest, aCommandLineNamesFilesByTheirWholePaths) {
    FrameRequest request;
    request.files.mesh = "cat.obj";
    const Command command = headlessCommand(request, "");
    EXPECT_EQ(command.arguments.back(), (std::filesystem::current_path() / "cat.obj").string());
}

TEST_F(OptionsTest, helpAndVersionArePrintedAndEndIt) {
    testing::internal::CaptureStdout();
    const bool ended = !parse({"--help"}) && !parse({"--version"});
    const std::string printed = testing::internal::GetCapturedStdout();
    EXPECT_TRUE(ended);
    EXPECT_CONTAINS(printed, "--batch");
    EXPECT_CONTAINS(printed, "99_test ");
}

TEST_F(OptionsTest, aBatchLineHasTheKeysOfTheOptions) {
    const Options options =
        parse(
            {"--size", "32x16", "--set", "knee=2", "--batch",
             batch(
                 R"({"frame": 3, "out": "a.png", "set": {"knee": 0.1, "bloom": false}, "target": "hdr", "targets": "passes"}
)"
                 "\n"
                 R"({"frames": "2..8:3", "out": "b_%d.exr", "size": "8x4", "set": ["knee=1"], "readings": true, "cost": true}
)"
                 "\n")})
            .value();
    EXPECT_TRUE(options.is_batch);
    ASSERT_EQ(options.batch.size(), 2U);
    EXPECT_FALSE(options.batch[0].readings);
    EXPECT_TRUE(options.batch[1].readings);
    const FrameRequest& first = options.batch[0];
    EXPECT_EQ(first.size, glm::ivec2(32, 16)) << "the command line's stands where the line has none";
    EXPECT_EQ(first.first_frame, 3);
    EXPECT_EQ(first.last_frame, 3);
    EXPECT_EQ(first.target, "hdr");
    EXPECT_EQ(first.targets, "passes");
    EXPECT_EQ(first.sets, (std::vector<std::string>{"knee=2", "bloom=off", "knee=0.1"}));
    const FrameRequest& second = options.batch[1];
    EXPECT_EQ(second.size, glm::ivec2(8, 4));
    EXPECT_EQ(second.last_frame, 8);
    EXPECT_EQ(second.step, 3);
    EXPECT_TRUE(second.cost);
    EXPECT_FALSE(second.passes_only);
    const Options passes = parse({"--batch", batch(R"({"cost": "passes"})")}).value();
    EXPECT_TRUE(passes.batch.at(0).cost);
    EXPECT_TRUE(passes.batch.at(0).passes_only);
    EXPECT_TRUE(second.target.empty()) << "lines do not inherit from each other";
}

TEST_F(OptionsTest, aBatchLineNamesAPictureWhereTheRungTakesOne) {
    const std::string line = R"({"out": "a.png", "image": "own.exr"})";
    EXPECT_THROW(parse({"--batch", batch(line)}), UsageError);
    info.takes = {"image"};
    const Options options =
        parse({"--image", "all.exr", "--batch", batch(line + "\n{\"out\": \"b.png\"}")}).value();
    EXPECT_EQ(options.batch.at(0).files.image, "own.exr");
    EXPECT_EQ(options.batch.at(1).files.image, "all.exr");
    EXPECT_TRUE(options.batch.at(1).batch_line.ends_with(":2"));
}

TEST_F(OptionsTest, anErrorInABatchNamesTheFileAndTheLine) {
    const std::string good = R"({"out": "a.png"})";
    for (const char* bad :
         {"{", "[]", "3", "\"text\"", R"({"out": "a.jpg"})", R"({"frame": 0})", R"({"frame": 1.5})",
          R"({"size": "0x5"})", R"({"size": 5})", R"({"fame": 1})", R"({"set": {"knee": "nan"}})",
          R"({"set": {"knee": null}})", R"({"set": 5})", R"({"set": ["knee"]})", R"({"preset": "no"})",
          R"({"cost": 1})", R"({"frames": "1..2", "out": "a.png"})", R"({"out": "a.png"} trailing)",
          "{\"out\": \"\xff.png\"}"}) {
        const std::string file = batch(good + "\n\n" + bad + "\n" + good + "\n");
        const std::string message = errorOf({"--batch", file});
        EXPECT_TRUE(message.starts_with(file + ":3: ")) << bad << ": " << message;
    }
}

TEST_F(OptionsTest, aBatchLineMayNotAskForAFrameAndForFrames) {
    const std::string file = batch(R"({"frame": 9, "frames": "1..2", "out": "a_%d.png"})");
    EXPECT_CONTAINS(errorOf({"--batch", file}), "exclude each other");
}

TEST_F(OptionsTest, aBatchLineThatAsksForNothingIsAnError) {
    const std::string file = batch("{\"frame\": 3}\n");
    EXPECT_TRUE(errorOf({"--batch", file}).starts_with(file + ":1: names no"));
    EXPECT_EQ(errorOf({"--batch", file, "--out", "a.png"}), "");
    EXPECT_EQ(errorOf({"--batch", file, "--cost"}), "");
}

TEST_F(OptionsTest, aBatchThatIsEmptyMissingOrAFolderIsAnError) {
    const std::string file = batch("\n  \r\n");
    EXPECT_EQ(errorOf({"--batch", file}), file + ": no frame is asked for; write one JSON object a line");
    const auto failure = [&](const std::string& name) {
        return messageOf<std::runtime_error>([&] { parse({"--batch", name}); });
    };
    EXPECT_CONTAINS(failure((folder.path() / "gone").string()), "cannot be opened");
    EXPECT_CONTAINS(failure(folder.path().string()), "is a folder");
}

} // namespace
} // namespace gll::test
