// Checking suites: each outcome, and that no case stops another.
#include "frame_check/check.hpp"

#include "frame_check/bless.hpp"
#include "frame_check/report.hpp"
#include "frame_check/say.hpp"
#include "pictures.hpp"
#include "support/messages.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace gll::test {
namespace {

using frame_check::CaseResult;
using frame_check::Outcome;
using frame_check::SuiteResult;

std::string blessedJson(const Image& image, const std::string& more = "") {
    return R"("blessed": [{"hash": ")" + measure::pixelHash(image) +
           R"(", "renderer": "a copying machine", "date": "2026-01-02")" + more + "}]";
}

// A case whose reference is the grey picture.
void addCase(const CopyingSuite& copying, const std::string& name, const Image& drawn,
             const std::string& rule = "") {
    copying.writeCase(name,
                      "{" + (rule.empty() ? "" : "\"rule\": " + rule + ", ") + blessedJson(grey()) + "}");
    saveImage(copying.path() / (name + ".png"), grey());
    copying.draws(name, drawn);
}

SuiteResult checked(const CopyingSuite& copying, const std::vector<std::string>& patterns = {}) {
    return check(copying.suite(), {.patterns = patterns});
}

const CaseResult& resultOf(const SuiteResult& checked, const std::string& name) {
    return *std::find_if(checked.cases.begin(), checked.cases.end(),
                         [&](const CaseResult& one) { return one.name == name; });
}

TEST(Check, hasAnOutcomeForEachCase) {
    const CopyingSuite copying;
    addCase(copying, "as_blessed", grey());
    addCase(copying, "tolerated", changed(1, 1));
    addCase(copying, "different", changed(1, 17));
    addCase(copying, "exact", changed(1, 1), R"("exact")");
    addCase(copying, "loosened", changed(1, 17), R"({"count": {"codes": 17}, "because": "an edge"})");
    addCase(copying, "another_size", grey(160, 120));
    addCase(copying, "not_drawn", grey());
    std::filesystem::remove(copying.drawn() / "not_drawn.png");
    addCase(copying, "unreadable", grey());
    std::filesystem::resize_file(copying.drawn() / "unreadable.png", 60);
    addCase(copying, "no_reference", grey());
    std::filesystem::remove(copying.path() / "no_reference.png");
    addCase(copying, "other_reference", grey());
    saveImage(copying.path() / "other_reference.png", changed(1, 1));
    copying.writeCase("never_blessed", "{}");
    copying.draws("never_blessed", grey());

    const SuiteResult result = checked(copying);
    EXPECT_EQ(result.cases.size(), 11U);
    const auto outcome = [&](const char* name) { return resultOf(result, name).outcome; };
    const auto why = [&](const char* name) { return resultOf(result, name).why; };
    EXPECT_EQ(outcome("as_blessed"), Outcome::same);
    EXPECT_EQ(outcome("tolerated"), Outcome::tolerated);
    EXPECT_EQ(outcome("different"), Outcome::different);
    EXPECT_EQ(outcome("exact"), Outcome::different);
    EXPECT_EQ(outcome("loosened"), Outcome::tolerated);
    EXPECT_EQ(outcome("another_size"), Outcome::incomparable);
    EXPECT_CONTAINS(why("another_size"),
                    "is 160x120, 3 channels of 8-bit display values, the reference is 320x240");
    EXPECT_EQ(outcome("not_drawn"), Outcome::incomparable);
    EXPECT_CONTAINS(why("not_drawn"), "cannot be drawn: cp ended with 1: ");
    EXPECT_EQ(outcome("unreadable"), Outcome::incomparable);
    EXPECT_EQ(outcome("no_reference"), Outcome::incomparable);
    EXPECT_CONTAINS(why("no_reference"),
                    "there is no blessed picture; look at the frame, which --report FILE.html shows, then");
    EXPECT_EQ(outcome("other_reference"), Outcome::incomparable);
    EXPECT_CONTAINS(why("other_reference"), "other_reference.png is none that other_reference.json blesses");
    EXPECT_EQ(outcome("never_blessed"), Outcome::incomparable);
    EXPECT_EQ(result.renderer, "a copying machine");

    const frame_check::Counts counts = frame_check::countsOf({result});
    EXPECT_EQ(counts.text(), "11 frames: 1 same, 2 tolerated, 2 different, 6 not compared");
    EXPECT_EQ(counts.exitCode(), 2);
    EXPECT_EQ(frame_check::countsOf({checked(copying, {"different"})}).exitCode(), 1);
    EXPECT_EQ(frame_check::countsOf({checked(copying, {"as_*", "cases/toler?ted"})}).exitCode(), 0);
    EXPECT_EQ(checked(copying, {"as_*", "cases/toler?ted"}).cases.size(), 2U);
    EXPECT_TRUE(checked(copying, {"DIFFERENT"}).cases.empty());
}

TEST(Check, passesAFrameAsAnotherRendererDrewItByItsPicture) {
    const CopyingSuite copying;
    const Image other = changed(38400, 40);
    copying.writeCase("a", R"({"blessed": [{"hash": ")" + measure::pixelHash(grey()) +
                               R"(", "renderer": "one", "date": ""}, {"hash": ")" +
                               measure::pixelHash(other) +
                               R"(", "renderer": "two", "date": "", "picture": "a.2.png"}]})");
    saveImage(copying.path() / "a.png", grey());
    saveImage(copying.path() / "a.2.png", other);
    copying.draws("a", changed(500, 90, other)); // nearer to the second picture
    const SuiteResult result = checked(copying);
    EXPECT_EQ(result.cases[0].outcome, Outcome::different) << "more pixels than half a percent";
    EXPECT_EQ(result.cases[0].reference_renderer, "two") << "the nearest is what is shown";
    Image near = other;
    std::get<std::vector<std::uint8_t>>(near.pixels).back() = 101;
    copying.draws("a", near);
    EXPECT_EQ(checked(copying).cases[0].outcome, Outcome::tolerated);
    EXPECT_EQ(problemsOf(copying.suite()), std::vector<std::string>{});
}

TEST(Check, ofASuiteWhoseProgramIsNotThereComparesNothing) {
    const TemporaryFolder folder;
    folder.write("suite.json", R"({"program": "../no/such/program", "batch": ["{program}", "{batch}"]})");
    folder.write("a.json", "{" + blessedJson(grey()) + "}");
    saveImage(folder / "a.png", grey());
    const SuiteResult result = check(frame_check::readSuites(folder.path())[0], {});
    EXPECT_EQ(result.cases[0].outcome, Outcome::incomparable);
    EXPECT_CONTAINS(result.cases[0].why, "no/such/program: is no program to run; build it, or say --program");
}

TEST(Check, ofASuiteWhoseProgramLiesBesideItSaysHowItIsNamed) {
    const TemporaryFolder folder;
    folder.write("suite.json", R"({"program": "draw", "command": ["{program}", "{out}"]})");
    folder.write("a.json", "{" + blessedJson(grey()) + "}");
    saveImage(folder / "a.png", grey());
    std::filesystem::permissions(folder.write("draw", "#!/bin/sh\n"), std::filesystem::perms::owner_all);
    const SuiteResult result = check(frame_check::readSuites(folder.path())[0], {});
    EXPECT_CONTAINS(result.cases[0].why, "write \"./draw\"");
}

// A program for batches: copies what a line names, stops at a case called "crash".
constexpr const char* copying_program = R"sh(#!/bin/sh
number=0
while read -r line; do
    number=$((number + 1))
    name=$(echo "$line" | sed 's/.*"copy":"\([^"]*\)".*/\1/')
    out=$(echo "$line" | sed 's/.*"out":"\([^"]*\)".*/\1/')
    targets=$(echo "$line" | sed -n 's/.*"targets":"\([^"]*\)".*/\1/p')
    case $name in
    *crash*) echo "lost my way" >&2; kill -SEGV $$ ;;
    *refused*) echo "error: $1:$number: no such scene" >&2; continue ;;
    *hang*) sleep 60 ;;
    esac
    cp "$name" "$out"
    if [ -n "$targets" ]; then
        cp "$name" "$targets/01_first.png"
        cp "$(dirname "$name")/../cases/reference.png" "$targets/00_before.png"
        cp "$name" "$targets/02_last.png"
    fi
done <"$1"
)sh";

// A suite of a batch, whose cases copy pictures of drawn/.
class BatchSuite {
  public:
    BatchSuite() {
        namespace fs = std::filesystem;
        fs::permissions(folder_.write("program", copying_program), fs::perms::owner_all);
        folder_.write("suite.json",
                      R"({"program": "program", "batch": ["./program", "{batch}"], "files": ["copy"],
            "targets": "targets", "timeout_s": 1, "renderer": ["echo", "{\"renderer\": \"a copying machine\"}"]})");
        fs::create_directories(folder_ / "drawn");
        fs::create_directories(folder_ / "cases");
    }
    void add(const std::string& name, const Image& drawn, const std::string& more = "") const {
        folder_.write("cases/" + name + ".json",
                      R"({"copy": "../drawn/)" + name + ".png\", " + blessedJson(grey(), more) + "}");
        saveImage(folder_ / ("cases/" + name + ".png"), grey());
        saveImage(folder_ / ("drawn/" + name + ".png"), drawn);
    }
    SuiteResult check() const {
        return frame_check::check(frame_check::readSuites(folder_ / "cases")[0], {});
    }

  private:
    TemporaryFolder folder_;
};

TEST(Batch, drawsAllCasesInOneProcessAndSaysWhichLineWasRefused) {
    const BatchSuite batch;
    batch.add("a", grey());
    batch.add("b_refused", grey());
    batch.add("c", changed(1, 1));
    const SuiteResult result = batch.check();
    EXPECT_EQ(result.cases[0].outcome, Outcome::same);
    EXPECT_CONTAINS(result.cases[1].why, "cannot be drawn: no such scene");
    EXPECT_EQ(result.cases[2].outcome, Outcome::tolerated);
}

TEST(Batch, thatCrashesHasComparedWhatWasDrawnBefore) {
    const BatchSuite batch;
    batch.add("a", grey());
    batch.add("b_crash", grey());
    batch.add("c", grey());
    const SuiteResult result = batch.check();
    EXPECT_EQ(result.cases[0].outcome, Outcome::same);
    EXPECT_CONTAINS(result.cases[1].why, "program was ended by signal 11: lost my way");
    EXPECT_EQ(result.cases[2].outcome, Outcome::incomparable);
}

TEST(Batch, thatHangsIsEnded) {
    const BatchSuite batch;
    batch.add("a", grey());
    batch.add("b_hang", grey());
    const SuiteResult result = batch.check();
    EXPECT_EQ(result.cases[0].outcome, Outcome::same);
    EXPECT_CONTAINS(result.cases[1].why, "program was ended after 1 s");
}

TEST(Targets, nameTheFirstThatDiffers) {
    const BatchSuite batch;
    const std::string hash = measure::pixelHash(grey());
    batch.add("reference", grey());
    batch.add("x", changed(10, 100),
              R"(, "cpu": ")" + frame_check::cpuFeatures() + R"(", "targets": {"before": ")" + hash +
                  R"(", "first": ")" + hash + R"(", "last": ")" + hash + "\"}");
    const SuiteResult result = batch.check();
    const CaseResult& x = resultOf(result, "x");
    ASSERT_EQ(x.targets.size(), 3U);
    EXPECT_EQ(x.targets[0].name, "before") << "in order of their files' names, without their numbers";
    EXPECT_FALSE(x.targets[0].differs);
    EXPECT_EQ(x.firstDifferent(), "first");
    EXPECT_CONTAINS(frame_check::line(x), "first target that differs: first");
}

TEST(Results, areSaidInJUnitsXmlAndAsAnnotations) {
    const CopyingSuite copying;
    addCase(copying, "a<b", changed(1, 17));
    addCase(copying, "fine", grey());
    addCase(copying, "nearly", changed(1, 1));
    copying.writeCase("new", "{}");
    const SuiteResult result = checked(copying);
    const TemporaryFolder folder;
    frame_check::writeJunit(folder / "made/junit.xml", {result});
    const std::string xml = contents(folder / "made/junit.xml");
    EXPECT_CONTAINS(xml, R"(<testsuite name="cases" tests="4" failures="1" errors="1")");
    EXPECT_CONTAINS(xml, R"(<testcase classname="cases" name="a&lt;b")");
    EXPECT_CONTAINS(xml, R"(<failure message="differ 1 (0.0013 %)  worst 17 at (0,0))");
    EXPECT_CONTAINS(xml, "<error message=\"there is no blessed picture");
    EXPECT_CONTAINS(xml, "<system-out>warning, tolerated: differ 1");
    EXPECT_CONTAINS(xml, "to draw it: cp ");

    const std::string said = frame_check::annotations({result});
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3);
    EXPECT_CONTAINS(said, "::error file=" + (copying.path() / "a<b.json").string() +
                              ",title=frame cases/a<b DIFFERENT::differ 1 (0.0013 %25)");
    EXPECT_CONTAINS(said, "::warning file=");

    frame_check::writeWarnings(folder / "warnings.txt", {result});
    EXPECT_CONTAINS(contents(folder / "warnings.txt"), "cases/nearly: warning, tolerated: differ 1");
    frame_check::writeWarnings(folder / "warnings.txt", {});
    EXPECT_FALSE(std::filesystem::exists(folder / "warnings.txt"));
}

// What follows a word in a page, up to a double quote.
std::vector<std::string> afterEach(const std::string& word, const std::string& page) {
    std::vector<std::string> found;
    for (auto at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) {
        const auto begin = at + word.size();
        found.push_back(page.substr(begin, page.find('"', begin) - begin));
    }
    return found;
}

TEST(Report, isOneFileThatHoldsItsPicturesAndNothingThatASuiteSaysAsPartOfThePage) {
    const CopyingSuite copying;
    addCase(copying, "different", changed(1, 17));
    addCase(copying, "fine", grey());
    addCase(copying, "not_drawn", grey());
    std::filesystem::remove(copying.drawn() / "not_drawn.png");
    copying.writeCase("new", R"({"note": "</script><script>alert(1)</script>"})");
    copying.draws("new", grey(8, 8));
    const TemporaryFolder folder;
    frame_check::writeReport(folder / "made/report.html", "Frames <of> \"cases\"",
                             {frame_check::check(copying.suite(), {.keeps_maps = true})});
    const std::string page = contents(folder / "made/report.html");
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_EQ(page.find("src="), std::string::npos);
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    // Frame, reference and FLIP of one, the reference of another, the frame of the third.
    EXPECT_EQ(afterEach("<script type=\"text/plain\" id=\"", page).size(), 5U);
    EXPECT_EQ(afterEach("\"outcome\":\"", page),
              (std::vector<std::string>{"different", "incomparable", "incomparable"}));
    EXPECT_CONTAINS(page, R"("same":["cases/fine"])");
    EXPECT_CONTAINS(page, R"("histogram":[[17,1]],"worst":[[0,0,17]])");
    EXPECT_CONTAINS(page, R"("rule_codes":[2,16],"rule_pixels":[384,8])");
    const std::string reference = contents(copying.path() / "different.png");
    EXPECT_CONTAINS(page, "iVBORw0KGgo") << "a PNG as it is in its file";
}

TEST(Report, ofLinearLightHoldsHalvesInTwoPictures) {
    const TemporaryFolder folder;
    Image light{.width = 4, .height = 1, .channels = 3, .color_space = ColorSpace::linear, .pixels = {}};
    light.pixels = std::vector<float>{1, 2, 65504, 1e-7F, -1, 0, 70000, 0.1F, 3, 4, 5, 6};
    saveImage(folder / "a.exr", light);
    saveImage(folder / "b.exr", light);
    SuiteResult pair;
    pair.cases.push_back(frame_check::check(folder / "a.exr", folder / "b.exr", {}, true));
    pair.cases[0].outcome = Outcome::different; // to have it shown
    frame_check::writeReport(folder / "report.html", "light", {pair});
    const std::string page = contents(folder / "report.html");
    EXPECT_EQ(afterEach("\"low\":\"", page).size(), 2U);
    EXPECT_EQ(afterEach("<script type=\"text/plain\" id=\"", page).size(), 4U);
}

} // namespace
} // namespace gll::test
