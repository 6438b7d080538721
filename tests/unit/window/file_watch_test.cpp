// Files that are saved while somebody watches, in the ways that editors save, by inotify and by looking.
#include "support/temporary_folder.hpp"
#include "window/file_watch.hpp"

#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <thread>

namespace gll::test {
namespace {

namespace fs = std::filesystem;
using Changes = std::set<fs::path>;

class FileWatchTest : public testing::TestWithParam<FileWatch::By> {
  protected:
    FileWatchTest() {
        folder.write("shaders/lib/a.glsl", "first\n");
        folder.write("shaders/b.frag", "first\n");
    }
    fs::path path(const std::string& name) const { return fs::weakly_canonical(folder / name); }

    // What is told within a while; longer than it takes to tell, where nothing is expected.
    static Changes told(FileWatch& watch, const Changes& expected) {
        Changes all;
        const auto end = std::chrono::steady_clock::now() +
                         (expected.empty() ? std::chrono::milliseconds(350) : std::chrono::seconds(10));
        while (std::chrono::steady_clock::now() < end && (expected.empty() || all != expected)) {
            all.merge(watch.changes());
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return all;
    }

    TemporaryFolder folder;
};

TEST_P(FileWatchTest, aFileWrittenInPlaceIsToldOnce) {
    FileWatch watch({folder / "shaders"}, GetParam());
    EXPECT_EQ(watch.by(), GetParam());
    EXPECT_EQ(told(watch, {}), Changes{});
    folder.write("shaders/lib/a.glsl", "second\n");
    const Changes expected{path("shaders/lib/a.glsl")};
    EXPECT_EQ(told(watch, expected), expected);
    EXPECT_EQ(told(watch, {}), Changes{});
    folder.write("shaders/lib/a.glsl", "first\n");
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_P(FileWatchTest, aFileSavedByRenamingIsTold) {
    FileWatch watch({folder / "shaders"}, GetParam());
    folder.write("a.new", "other\n");
    fs::rename(folder / "shaders/lib/a.glsl", folder / "a.old");
    EXPECT_EQ(told(watch, {}), Changes{}) << "a file that goes is not saved";
    fs::rename(folder / "a.new", folder / "shaders/lib/a.glsl");
    const Changes expected{path("shaders/lib/a.glsl")};
    EXPECT_EQ(told(watch, expected), expected);
    folder.write("a.new", "third\n");
    fs::rename(folder / "a.new", folder / "shaders/lib/a.glsl");
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_P(FileWatchTest, aTouchedFileIsTold) {
    FileWatch watch({folder / "shaders"}, GetParam());
    const timeval both[] = {{1, 0}, {1, 0}}; // of access and modification, as touch sets them
    ASSERT_EQ(utimes((folder / "shaders/b.frag").c_str(), both), 0);
    const Changes expected{path("shaders/b.frag")};
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_P(FileWatchTest, filesAndFoldersThatAppearLaterAreTold) {
    FileWatch watch({folder / "shaders"}, GetParam());
    folder.write("shaders/later/deep/c.glsl", "new\n");
    const Changes expected{path("shaders/later/deep/c.glsl")};
    EXPECT_EQ(told(watch, expected), expected);
    folder.write("shaders/later/deep/c.glsl", "newer\n");
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_P(FileWatchTest, aWatchedFolderMayAppearLaterAndBeReplaced) {
    FileWatch watch({folder / "none_yet", folder / "shaders"}, GetParam());
    folder.write("none_yet/c.frag", "new\n");
    Changes expected{path("none_yet/c.frag")};
    EXPECT_EQ(told(watch, expected), expected);

    fs::rename(folder / "shaders", folder / "shaders_old");
    EXPECT_TRUE(told(watch, {}).size() <= 1) << "c.frag at most";
    folder.write("shaders/lib/a.glsl", "of another folder\n");
    expected = {path("shaders/lib/a.glsl")};
    EXPECT_EQ(told(watch, expected), expected);
    folder.write("shaders_old/lib/a.glsl", "not ours\n");
    EXPECT_EQ(told(watch, {}), Changes{});

    fs::remove_all(folder / "shaders");
    EXPECT_EQ(told(watch, {}), Changes{});
    folder.write("shaders/lib/a.glsl", "again\n");
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_P(FileWatchTest, manyChangesAtOnceAreAllTold) {
    FileWatch watch({folder / "shaders"}, GetParam());
    Changes expected;
    for (int i = 0; i < 300; ++i)
        expected.insert(path(folder.write("shaders/many/" + std::to_string(i) + ".glsl", "text\n")));
    EXPECT_EQ(told(watch, expected), expected);
}

INSTANTIATE_TEST_SUITE_P(By, FileWatchTest, testing::Values(FileWatch::By::inotify, FileWatch::By::looking),
                         [](const auto& by) {
                             return by.param == FileWatch::By::inotify ? "inotify" : "looking";
                         });

TEST_F(FileWatchTest, aFileIsToldWhenItIsClosedNotWhileItIsWritten) {
    FileWatch watch({folder / "shaders"});
    std::ofstream file(folder / "shaders/b.frag");
    file << "half" << std::flush;
    EXPECT_EQ(watch.changes(), Changes{});
    file << " and half" << std::flush;
    EXPECT_EQ(watch.changes(), Changes{});
    file.close();
    EXPECT_EQ(watch.changes(), Changes{path("shaders/b.frag")}) << "at once";
}

TEST_F(FileWatchTest, byLookingAFileThatStillGrowsIsNotTold) {
    FileWatch watch({folder / "shaders"}, FileWatch::By::looking);
    std::ofstream file(folder / "shaders/b.frag");
    for (int i = 0; i < 40; ++i) {
        file << "more\n" << std::flush;
        EXPECT_EQ(watch.changes(), Changes{});
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Changes expected{path("shaders/b.frag")};
    EXPECT_EQ(told(watch, expected), expected);
}

TEST_F(FileWatchTest, whereInotifyIsNotToBeHadItLooks) {
    rlimit files = {};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &files), 0);
    const int next = open("/dev/null", O_RDONLY | O_CLOEXEC);
    close(next);
    const rlimit none{static_cast<rlim_t>(next), files.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    FileWatch watch({folder / "shaders"});
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &files), 0);
    EXPECT_EQ(watch.by(), FileWatch::By::looking);
    const Changes all{path("shaders/b.frag"), path("shaders/lib/a.glsl")};
    EXPECT_EQ(told(watch, all), all) << "it could not even read the folder when it began";
    folder.write("shaders/b.frag", "second\n");
    const Changes expected{path("shaders/b.frag")};
    EXPECT_EQ(told(watch, expected), expected);
}

} // namespace
} // namespace gll::test
