// Broken batch files: refused as a whole, with the file's name and the line, before the first frame is
// rendered.
#include "hostile/hostile.hpp"

#include <ostream>
#include <sstream>

namespace gll::test {
namespace {

struct BatchCase {
    const char* name;
    std::string text; // of the file's second line
    std::vector<std::string> parts = {};
};
void PrintTo(const BatchCase& one, std::ostream* stream) { *stream << one.text.substr(0, 80); }

class Batch : public testing::TestWithParam<BatchCase> {};

TEST_P(Batch, namesFileAndLineAndRendersNothing) {
    const TemporaryFolder folder;
    const auto file = folder.write("batch.jsonl", R"({"size": "8x8", "out": "first.png"})"
                                                  "\n" +
                                                      GetParam().text + "\n");
    std::vector<std::string> parts = GetParam().parts;
    parts.push_back(file.string() + ":2: ");
    expectRefusal(run(rungCommand(folder, {"--batch", file.string()})), 2, parts);
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"batch.jsonl"});
}

INSTANTIATE_TEST_SUITE_P(
    Lines, Batch,
    testing::Values(
        BatchCase{"words", "frame 60"}, BatchCase{"list", "[1, 2]"}, BatchCase{"number", "60"},
        BatchCase{"unclosed", R"({"frame": 60)"}, BatchCase{"twoObjects", "{} {}"},
        BatchCase{"deep", std::string(100'000, '[')},
        BatchCase{"deepList", R"({"set": )" + std::string(500'000, '[') + std::string(500'000, ']') + "}"},
        BatchCase{"deepSetting",
                  R"({"set": {"intensity": )" + std::string(500'000, '[') + std::string(500'000, ']') + "}}",
                  {"intensity"}},
        BatchCase{"zeroByte", std::string("{\0}", 3)}, BatchCase{"notUnicode", "{\"out\": \"\xff\xfe.png\"}"},
        BatchCase{"unknownKey", R"({"frme": 60})", {"frme"}}, BatchCase{"keyOfTwoLines", R"({"a\nb": 60})"},
        BatchCase{"nothingToDo", R"({"frame": 60})", {"out"}},
        BatchCase{"outEmpty", R"({"out": ""})", {"out"}},
        BatchCase{"frameZero", R"({"frame": 0})", {"frame"}},
        BatchCase{"frameFraction", R"({"frame": 1.5})", {"frame"}},
        BatchCase{"frameHuge", R"({"frame": 1e99})", {"frame"}},
        BatchCase{"frameNull", R"({"frame": null})", {"frame"}},
        BatchCase{"frameList", R"({"frame": [1]})", {"frame"}},
        BatchCase{"sizeList", R"({"size": [8, 8]})", {"size"}},
        BatchCase{"sizeZero", R"({"size": "0x5"})", {"size"}},
        BatchCase{"unknownPreset", R"({"preset": "best"})", {"best"}},
        BatchCase{"setNumber", R"({"set": 3})", {"set"}},
        BatchCase{"setUnknown", R"({"set": {"intensty": 1}})", {"intensty"}},
        BatchCase{"setNull", R"({"set": {"intensity": null}})", {"intensity"}},
        BatchCase{"setObject", R"({"set": {"intensity": {"a": 1}}})", {"intensity"}},
        BatchCase{"setOutOfRange", R"({"set": {"intensity": -1}})", {"intensity"}},
        BatchCase{"setHuge", R"({"set": {"intensity": 1e308}})", {"intensity"}},
        BatchCase{"outWithZeroByte", R"({"out": "a\u0000.png"})", {"out", "zero byte"}},
        BatchCase{"imageWithZeroByte", R"({"image": "a\u0000", "out": "a.png"})", {"image", "zero byte"}},
        BatchCase{
            "targetWithZeroByte", R"({"target": "hdr\u0000", "out": "a.png"})", {"target", "zero byte"}},
        BatchCase{"setWithZeroByte", R"({"set": {"intensity": "1\u0000"}, "out": "a.png"})", {"zero byte"}},
        BatchCase{"injectWithZeroByte", R"({"inject": "scene:1,1:1\u0000", "out": "a.png"})", {"zero byte"}},
        BatchCase{"imageNumber", R"({"image": 5, "out": "a.png"})", {"\"image\" wants a text"}},
        BatchCase{"imageEmpty", R"({"image": "", "out": "a.png"})", {"\"image\" is empty"}},
        BatchCase{"imageMisspelt", R"({"imge": "a.png", "out": "b.png"})", {"did you mean image?"}},
        BatchCase{"costWord", R"({"cost": "yes"})", {"cost"}},
        BatchCase{"outExtension", R"({"out": "a.jpg"})", {"a.jpg"}},
        BatchCase{"outPattern", R"({"out": "%s.png"})", {"%s.png"}}, BatchCase{"outNumber", R"({"out": 3})"},
        BatchCase{"sequenceIntoOneFile", R"({"frames": "1..2", "out": "a.png"})", {"%d"}}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(BatchFile, isListedLineByLine) {
    const TemporaryFolder folder;
    const auto listed = [&](const std::string& lines) {
        return run(rungCommand(
            folder, {"--settings", "--json", "--batch", folder.write("batch.jsonl", lines).string()}));
    };
    const Result both = listed(R"({"set": {"bloom": "on"}})"
                               "\n"
                               R"({"set": {"bloom": "off"}, "out": "never.png"})");
    EXPECT_EQ(both.exit_code, 0) << both.err;
    std::istringstream lines(both.out);
    std::string on, off, none;
    std::getline(lines, on);
    std::getline(lines, off);
    EXPECT_FALSE(std::getline(lines, none)) << none;
    EXPECT_EQ(on, listed(R"({"set": {"bloom": "on"}})").out.substr(0, on.size()));
    EXPECT_EQ(off, listed(R"({"set": {"bloom": "off"}})").out.substr(0, off.size()));
    EXPECT_NE(on.find("\"up1\""), std::string::npos) << on;
    EXPECT_EQ(off.find("\"up1\""), std::string::npos) << off;
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"batch.jsonl"});
    expectRefusal(listed(R"({"set": {"blom": "on"}})"), 2, {"batch.jsonl:1", "did you mean bloom?"});
}

TEST(BatchFile, thatIsMissingIsNamed) {
    checkRefusal({"", {"--batch", "{}/missing.jsonl"}, 1, {"missing.jsonl"}});
}

TEST(BatchFile, thatIsAFolderIsNamed) {
    const TemporaryFolder folder;
    expectRefusal(run(rungCommand(folder, {"--batch", folder.path().string()})), 1,
                  {folder.path().string(), "folder"});
}

TEST(BatchFile, thatNeverEndsIsRefused) {
    checkRefusal({"", {"--batch", "/dev/zero"}, 1, {"/dev/zero", "64 MiB"}});
}

TEST(BatchFile, thatIsEmptyIsRefused) {
    const TemporaryFolder folder;
    const auto file = folder.write("batch.jsonl", "\n \n");
    expectRefusal(run(rungCommand(folder, {"--batch", file.string()})), 2, {"batch.jsonl"});
}

TEST(BatchFile, withATargetThatIsNotThereGoesOnWithTheNextFrame) {
    const TemporaryFolder folder;
    const auto file = folder.write("batch.jsonl", R"({"size": "8x8", "target": "hdd", "out": "first.png"})"
                                                  "\n"
                                                  R"({"size": "8x8", "out": "second.png"})");
    expectRefusal(run(rungCommand(folder, {"--batch", file.string()})), 2, {"batch.jsonl:1", "hdd"});
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"batch.jsonl", "second.png"}));
}

TEST(BatchFile, withAPictureThatIsNotThereGoesOnWithTheNextFrame) {
    const TemporaryFolder folder;
    const auto file =
        folder.write("batch.jsonl", R"({"size": "8x8", "image": "missing.png", "out": "first.png"})"
                                    "\n"
                                    R"({"size": "8x8", "out": "second.png"})");
    expectRefusal(run(rungCommand(folder, {"--batch", file.string()})), 1, {"batch.jsonl:1", "missing.png"});
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"batch.jsonl", "second.png"}));
}

} // namespace
} // namespace gll::test
