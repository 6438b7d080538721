// frame_check as people and CI call it: exit codes, and one line that says what is wrong.
#include "frame_check/bless.hpp"
#include "pictures.hpp"
#include "support/messages.hpp"
#include "support/process.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace gll::test {
namespace {

Result frameCheck(const std::vector<std::string>& arguments,
                  const std::map<std::string, std::optional<std::string>>& environment = {}) {
    auto all = environment;
    all.insert({"GITHUB_ACTIONS", std::nullopt});
    return run({FRAME_CHECK, arguments, all});
}

TEST(FrameCheck, ofTwoPicturesEndsWith0Or1Or2) {
    const TemporaryFolder folder;
    const std::string reference = (folder / "reference.png").string();
    const std::string near = (folder / "near.png").string();
    const std::string far = (folder / "far.png").string();
    saveImage(reference, grey());
    saveImage(near, changed(3, 1));
    saveImage(far, changed(3, 60));
    Result result = frameCheck({near, reference});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_CONTAINS(result.out, "tolerated    near.png");
    EXPECT_CONTAINS(result.out, "differ 3 (0.00391 %)  worst 1 at (0,0)  RMSE 1.42e-05  PSNR 97.0 dB  FLIP ");
    result = frameCheck({far, reference, "--github"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_CONTAINS(result.out, "DIFFERENT    far.png");
    EXPECT_CONTAINS(result.out, "worst: (0,0) by 60 (1,0) by 60");
    EXPECT_CONTAINS(result.out, "::error title=frame far.png DIFFERENT::differ 3");
    EXPECT_EQ(frameCheck({far, reference, "--rule", "rmse=0.01"}).exit_code, 0);
    EXPECT_EQ(frameCheck({near, reference, "--rule", "exact"}).exit_code, 1);
    result = frameCheck({(folder / "none.png").string(), reference});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_CONTAINS(result.out, "NOT COMPARED none.png");
    EXPECT_CONTAINS(result.out, "none.png: ");
}

TEST(FrameCheck, refusesWrongUsageInOneLineAndEndsWith2) {
    const TemporaryFolder folder;
    for (const auto& [arguments, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{}, "give two pictures"},
             {{"a.png", "b.png", "--rule", "ssim=1"}, "is no rule"},
             {{"--suite", folder.path().string(), "--rule", "flip=0.01"}, "would loosen every case"},
             {{"--bless", "a"}, "needs --suite"},
             {{"--suite", folder.path().string(), "--bless"}, "--all"},
             {{"--no-such-option"}, "--help"}}) {
        const Result result = frameCheck(arguments);
        EXPECT_EQ(result.exit_code, 2) << why;
        EXPECT_CONTAINS(result.err, "frame_check: error: ");
        EXPECT_CONTAINS(result.err, why);
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
}

TEST(FrameCheck, leavesNoTemporaryFolderWhereASignalEndsIt) {
    const CopyingSuite copying;
    const std::string suite = copying.path().string();
    const std::string picture = (copying.drawn() / "a.png").string();
    copying.writeCase("a",
                      R"({"command": ["sh", "-c", "cp )" + picture + R"( {out}; sleep 0.2", "{shaders}"]})");
    copying.draws("a", grey());
    ASSERT_EQ(frameCheck({"--suite", suite, "--bless", "a", "--because", "x", "--with", "shaders=none"},
                         {{"CI", std::nullopt}})
                  .exit_code,
              0);
    const TemporaryFolder shaders;
    const TemporaryFolder temporary;
    shaders.write("a.frag", "void main() { color = a * 0.25 + b * 0.5 - c; }\n");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--with", "shaders=none"}, {"--mutate", shaders.path().string()}})
        for (const int number : {SIGINT, SIGTERM, SIGHUP})
            for (const int later_ms : {0, 300}) {
                std::vector<std::string> all{"--suite", suite};
                all.insert(all.end(), arguments.begin(), arguments.end());
                Process process({FRAME_CHECK, all, {{"TMPDIR", temporary.path().string()}}});
                while (temporary.listing().empty() && !process.poll())
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                if (arguments[0] == "--mutate")
                    std::this_thread::sleep_for(std::chrono::milliseconds(later_ms));
                process.signal(number);
                const ProcessResult result = process.wait(std::chrono::seconds(20));
                EXPECT_TRUE(result.signalled) << result.out << result.err;
                EXPECT_EQ(result.exit_code, 128 + number) << result.out << result.err;
                EXPECT_EQ(temporary.listing(), std::vector<std::string>()) << arguments[0] << " " << number;
            }
}

#ifdef __SANITIZE_ADDRESS__
constexpr double slower = 20; // than a release build, at most
#elif !defined(NDEBUG)
constexpr double slower = 4;
#else
constexpr double slower = 1;
#endif

Image noise(int width, int height, unsigned seed) {
    Image image{
        .width = width, .height = height, .channels = 3, .color_space = ColorSpace::srgb, .pixels = {}};
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random() >> 24); });
    image.pixels = std::move(bytes);
    return image;
}

// What tests/README.md says of noise, of which every pixel differs, with as much again for a busy machine.
TEST(FrameCheck, ofALargePictureTakesSecondsAndLessThanAGibibyte) {
    const TemporaryFolder folder;
    saveImage(folder / "a.png", noise(3840, 2160, 1));
    saveImage(folder / "b.png", noise(3840, 2160, 2));
    const Result result = frameCheck({(folder / "a.png").string(), (folder / "b.png").string()});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_CONTAINS(result.out, "(100 %)");
    EXPECT_LT(result.cpu_seconds, 2 * 2 * slower);
    EXPECT_LT(result.peak_memory_kib, slower * (1 << 20));
    RecordProperty("cpu_seconds", std::to_string(result.cpu_seconds));
}

TEST(FrameCheck, ofTwoHundredCasesTakesSeconds) {
    const CopyingSuite copying;
    const std::string suite = copying.path().string();
    for (int i = 0; i < 200; ++i)
        copying.writeCase("case_" + std::to_string(i), R"({"command": ["cp", ")" +
                                                           (copying.drawn() / "all.png").string() +
                                                           R"(", "{out}"]})");
    copying.draws("all", noise(320, 240, 1));
    ASSERT_EQ(frameCheck({"--suite", suite, "--bless", "--all", "--because", "x", "--quiet"},
                         {{"CI", std::nullopt}})
                  .exit_code,
              0);
    copying.draws("all", noise(320, 240, 2));
    const Result result = frameCheck({"--suite", suite});
    EXPECT_CONTAINS(result.out, "200 frames: 0 same, 0 tolerated, 200 different");
    EXPECT_LT(result.cpu_seconds, 2 * 10 * slower);
    EXPECT_LT(result.peak_memory_kib, slower * (1 << 20));
    RecordProperty("cpu_seconds", std::to_string(result.cpu_seconds));
}

TEST(FrameCheck, ofASuiteSaysALineACaseAndNeverBlessesInCi) {
    const CopyingSuite copying;
    const std::string suite = copying.path().string();
    copying.writeCase("a", "{}");
    copying.writeCase("b", "{}");
    copying.draws("a", grey());
    copying.draws("b", grey());
    Result result = frameCheck({"--suite", suite, "--bless", "a", "b", "--because", "x"}, {{"CI", "true"}});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_CONTAINS(result.err, "CI is set here");
    result = frameCheck({"--suite", suite, "--bless", "a", "b", "--because", "x"}, {{"CI", std::nullopt}});
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    copying.draws("b", changed(50, 1));
    result = frameCheck({"--suite", suite, "--warnings", (copying.path() / "w.txt").string()},
                        {{"GITHUB_ACTIONS", "true"}});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_CONTAINS(result.out, "same         cases/a");
    EXPECT_CONTAINS(result.out, "tolerated    cases/b");
    EXPECT_CONTAINS(result.out, "drawn by a copying machine");
    EXPECT_CONTAINS(result.out, "2 frames: 1 same, 1 tolerated, 0 different, 0 not compared");
    EXPECT_CONTAINS(result.out, "::warning file=");
    EXPECT_CONTAINS(contents(copying.path() / "w.txt"), "cases/b: warning");
    result = frameCheck({"--suite", suite, "no_such_case"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_CONTAINS(result.err, "no case there is called so");
}

} // namespace
} // namespace gll::test
