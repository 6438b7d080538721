// Files that cannot be written: said in one line, with nothing half-written and nothing destroyed.
#include "hostile/hostile.hpp"
#include "support/temporary_folder.hpp"

#include <unistd.h>

namespace gll::test {
namespace {

TEST(Output, intoAMissingFolderIsRefused) {
    checkRefusal({"", {"--size", "8x8", "--out", "{}/no/frame.png"}, 1, {"no/frame.png", "folder"}});
}

TEST(Output, withATooLongNameIsRefused) {
    checkRefusal({"", {"--size", "8x8", "--out", "{}/" + std::string(300, 'a') + ".png"}, 1, {"aaa.png"}});
}

TEST(Output, ontoAFolderIsRefused) {
    for (const char* name : {"frame.png", "frame.exr", "frame.hdr"}) {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder / name);
        expectRefusal(run(rungCommand(folder, {"--size", "8x8", "--out", name})), 1, {name, "folder"});
        EXPECT_EQ(folder.listing(), std::vector<std::string>{name});
    }
}

TEST(Output, belowAFileIsRefused) {
    const TemporaryFolder folder;
    folder.write("file", "text");
    expectRefusal(run(rungCommand(folder, {"--size", "8x8", "--out", "file/frame.png"})), 1, {"file"});
    EXPECT_EQ(contents(folder / "file"), "text");
}

TEST(Output, intoAReadOnlyFolderIsRefused) {
    if (geteuid() == 0) GTEST_SKIP() << "nothing is read-only to root";
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "fixed");
    std::filesystem::permissions(folder / "fixed",
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    expectRefusal(run(rungCommand(folder, {"--size", "8x8", "--out", "fixed/frame.png"})), 1,
                  {"fixed/frame.png"});
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"fixed"});
}

TEST(Output, ontoAFullDiskKeepsTheOldFileAndLeavesNoPart) {
    for (const char* name : {"frame.png", "frame.exr", "frame.hdr"}) {
        const TemporaryFolder folder;
        folder.write(name, "what was there before");
        Command command = rungCommand(folder, {"--size", "128x128", "--out", name});
        command.file_limit_kib = 2;
        expectRefusal(run(command), 1, {name});
        EXPECT_EQ(folder.listing(), std::vector<std::string>{name});
        EXPECT_EQ(contents(folder / name), "what was there before");
    }
}

TEST(Output, ontoThePictureThatIsDrawnIsRefused) {
    const TemporaryFolder folder;
    ASSERT_EQ(run(rungCommand(folder, {"--size", "8x8", "--out", "2.exr"})).exit_code, 0);
    const std::string before = contents(folder / "2.exr");
    for (const char* out : {"2.exr", "./2.exr"})
        expectRefusal(run(rungCommand(folder, {"--size", "4x4", "--image", "2.exr", "--out", out})), 2,
                      {out, "name another file"});
    expectRefusal(run(rungCommand(
                      folder, {"--size", "4x4", "--image", "2.exr", "--frames", "2..3", "--out", "%d.exr"})),
                  2, {"2.exr", "name another file"});
    EXPECT_EQ(contents(folder / "2.exr"), before);
}

TEST(Output, ofAnUnknownTargetKeepsTheOldFile) {
    const TemporaryFolder folder;
    folder.write("frame.png", "what was there before");
    expectRefusal(run(rungCommand(folder, {"--size", "8x8", "--target", "hdd", "--out", "frame.png"})), 2,
                  {"hdd"});
    EXPECT_EQ(contents(folder / "frame.png"), "what was there before");
}

TEST(Output, ofTargetsIntoAMissingFolderIsRefusedBeforeAnythingIsDrawn) {
    checkRefusal({"", {"--size", "8x8", "--out", "a.png", "--targets", "none"}, 1, {"none", "folder"}});
}

TEST(Output, ofTargetsIsAPictureAPassInOrder) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "passes");
    const Result result =
        run(rungCommand(folder, {"--size", "8x8", "--out", "a.png", "--targets", "passes"}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::vector<std::string> names = folder.listing();
    ASSERT_GT(names.size(), 3U);
    EXPECT_EQ(names[0], "a.png");
    EXPECT_TRUE(names[2].starts_with("passes/001_")) << names[2];
    EXPECT_TRUE(names[3].starts_with("passes/002_")) << names[3];
    EXPECT_TRUE(names.back().ends_with(".exr"));
}

} // namespace
} // namespace gll::test
