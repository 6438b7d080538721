// Reading suites: what a case says, where suite.json is looked for, and what is refused.
#include "frame_check/render.hpp"

#include "pictures.hpp"
#include "support/messages.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

using frame_check::Case;
using frame_check::readSuites;
using frame_check::Suite;

std::string whyNoSuite(const TemporaryFolder& folder) {
    return messageOf<std::runtime_error>([&] { readSuites(folder.path()); });
}

TEST(Suite, isReadFromItsFolderWithWhatTheOneAboveSays) {
    const TemporaryFolder folder;
    folder.write("suite.json", R"({"defaults": {"frame": 60, "size": "320x240"}, "rule": "exact",
                                   "environment": {"A": "1", "B": null}, "timeout_s": 5})");
    folder.write("one/b.json", R"({"frame": 1, "rule": "count",
        "blessed": [{"hash": "12", "renderer": "r", "date": "2026-01-02"}]})");
    folder.write("one/a.json", "{}");
    folder.write("two/c.json", "{}");
    folder.write("neither/picture.png", "");
    const std::vector<Suite> suites = readSuites(folder.path());
    ASSERT_EQ(suites.size(), 2U);
    EXPECT_EQ(suites[0].name, "one");
    ASSERT_EQ(suites[0].cases.size(), 2U);
    const Case& a = suites[0].cases[0];
    const Case& b = suites[0].cases[1];
    EXPECT_EQ(a.settings.dump(), R"({"frame":60,"size":"320x240"})");
    EXPECT_EQ(b.settings.dump(), R"({"frame":1,"size":"320x240"})");
    EXPECT_EQ(suites[0].ruleOf(a).text(), "exact");
    EXPECT_EQ(suites[0].ruleOf(b).text(), "count");
    EXPECT_TRUE(b.isBlessed("12"));
    EXPECT_FALSE(b.isBlessed("13"));
    EXPECT_NE(b.blessingFor("r"), nullptr);
    EXPECT_EQ(suites[0].environment.at("A"), "1");
    EXPECT_EQ(suites[0].environment.at("B"), std::nullopt);
}

TEST(Suite, takesARuleOfTheCommandLineForEveryCase) {
    const TemporaryFolder folder;
    folder.write("a.json", R"({"rule": "count"})");
    const Suite suite = readSuites(folder.path(), {.rule = frame_check::ruleFromText("exact")})[0];
    EXPECT_EQ(suite.ruleOf(suite.cases[0]).text(), "exact");
}

TEST(Suite, saysWhichFileIsWrong) {
    const TemporaryFolder folder;
    EXPECT_CONTAINS(whyNoSuite(folder), "holds no case");
    for (const auto& [json, why] : std::vector<std::pair<std::string, std::string>>{
             {"", "parse error"},
             {"[]", "no JSON object"},
             {R"({"out": "a.png"})", "not its to say"},
             {R"({"rule": "flip=0.01"})", "say why"},
             {R"({"command": "cp"})", "wants a list"},
             {R"({"blessed": [{"hash": "1"}]})", "renderer"},
             {R"({"blessed": [{"hash": "1", "renderer": "", "date": "", "picture": "../a.png"}]})",
              "lie beside"},
             {R"({"a": )" + std::string(40, '[') + std::string(40, ']') + "}", "nested too deeply"}}) {
        folder.write("a.json", json);
        EXPECT_CONTAINS(whyNoSuite(folder), "a.json: ");
        EXPECT_CONTAINS(whyNoSuite(folder), why);
    }
    folder.write("a.json", "{}");
    EXPECT_EQ(whyNoSuite(folder), "");
    for (const auto& [json, why] : std::vector<std::pair<std::string, std::string>>{
             {R"({"comand": ["a"]})", "\"comand\" with this value is no key"},
             {R"({"command": ["a"], "batch": ["a"]})", "keep one"},
             {R"({"timeout_s": 0})", "1 to 86400"},
             {R"({"format": "gif"})", "png, exr or hdr"},
             {R"({"rule": {"rmse": 0.01}})", "say why"}}) {
        folder.write("suite.json", json);
        EXPECT_CONTAINS(whyNoSuite(folder), "suite.json: ");
        EXPECT_CONTAINS(whyNoSuite(folder), why);
    }
}

TEST(Suite, missesACaseThatIsGoneAndFindsPicturesThatNothingComparesWith) {
    const CopyingSuite copying;
    copying.writeCase("a", "{}");
    std::filesystem::create_directories(copying.path());
    saveImage(copying.path() / "a.png", grey(8, 8));
    EXPECT_EQ(problemsOf(copying.suite()), std::vector<std::string>{}) << "without a list, nothing is missed";
    addToList(copying.suite(), "a");
    addToList(copying.suite(), "a");
    EXPECT_EQ(problemsOf(copying.suite()), std::vector<std::string>{});
    addToList(copying.suite(), "b");
    copying.writeCase("c", "{}");
    saveImage(copying.path() / "d.png", grey(8, 8));
    const std::vector<std::string> problems = problemsOf(copying.suite());
    ASSERT_EQ(problems.size(), 3U);
    EXPECT_CONTAINS(problems[0], "b: the case is gone");
    EXPECT_CONTAINS(problems[1], "c: is not in ");
    EXPECT_CONTAINS(problems[2], "d.png: no case compares with it");
}

TEST(Suite, namesTheFilesOfItsCasesFromTheirFolderAndRepeatsThemInTheShell) {
    const TemporaryFolder folder;
    folder.write("suite.json", R"({"program": "cat", "batch": ["{program}", "{batch}"], "files": ["image"],
                                   "environment": {"LC_ALL": "C"}})");
    folder.write("cases/a.json", R"({"image": "../it's.exr", "preset": "original"})");
    const Suite suite = readSuites(folder.path() / "cases")[0];
    const std::string line = commandLine(suite, suite.cases[0]);
    EXPECT_CONTAINS(line, R"("image":")" + folder.path().string() + R"(/it'\''s.exr")");
    EXPECT_CONTAINS(line, R"("preset":"original")");
    EXPECT_CONTAINS(line, "> a.jsonl && LC_ALL=C cat a.jsonl");
}

TEST(Commands, fillInSettingsAndSplitLists) {
    const TemporaryFolder folder;
    folder.write("a.json", R"({"command": ["draw", "{words}", "--at={x},{y}", "{not a word}", "-o", "{out}"],
                               "words": ["one", "two words"], "x": 3, "y": "4.50"})");
    const Suite suite = readSuites(folder.path())[0];
    EXPECT_EQ(commandLine(suite, suite.cases[0]), "draw one 'two words' --at=3,4.50 '{not a word}' -o a.png");
    folder.write("a.json", R"({"command": ["draw", "{wrods}"], "words": "x"})");
    EXPECT_CONTAINS(messageOf<std::runtime_error>([&] {
                        const Suite other = readSuites(folder.path())[0];
                        commandLine(other, other.cases[0]);
                    }),
                    "{wrods} stands for nothing here; there is folder, name, out, words");
}

} // namespace
} // namespace gll::test
