// Finding shaders and assets: from the program's place, then GLLADDER_ROOT, never from the current directory.
#include "rung/resources.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

namespace fs = std::filesystem;

class ResourcesTest : public testing::Test {
  protected:
    ResourcesTest() { unsetenv("GLLADDER_ROOT"); }
    ~ResourcesTest() override { unsetenv("GLLADDER_ROOT"); }
    TemporaryFolder folder;
};

TEST_F(ResourcesTest, theLaddersOwnShadersAreFoundFromTheProgramsPlace) {
    const fs::path found = Resources().find("shaders/lib/fullscreen.vert");
    EXPECT_TRUE(found.is_absolute());
    EXPECT_TRUE(fs::is_regular_file(found));
}

TEST_F(ResourcesTest, theCurrentDirectoryIsNotLookedIn) {
    folder.write("shaders/only_here.frag", "");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const std::string message =
        messageOf<std::runtime_error>([] { Resources().find("shaders/only_here.frag"); });
    fs::current_path(before);
    EXPECT_CONTAINS(message, "shaders/only_here.frag not found; tried ");
}

TEST_F(ResourcesTest, theVariableNamesOneMoreFolderAfterTheProgramsOwn) {
    folder.write("shaders/only_here.frag", "");
    folder.write("shaders/lib/fullscreen.vert", "");
    setenv("GLLADDER_ROOT", folder.path().c_str(), 1);
    EXPECT_EQ(Resources().find("shaders/only_here.frag"), folder.path() / "shaders/only_here.frag");
    EXPECT_NE(Resources().find("shaders/lib/fullscreen.vert"), folder.path() / "shaders/lib/fullscreen.vert");
    EXPECT_EQ(Resources().shaderRoots().back(), folder.path() / "shaders");
}

TEST_F(ResourcesTest, aMissingFileNamesEveryPathTriedAndTheVariable) {
    setenv("GLLADDER_ROOT", folder.path().c_str(), 1);
    const std::string message = messageOf<std::runtime_error>([] { Resources().find("assets/no_such.obj"); });
    EXPECT_CONTAINS(message, (folder.path() / "assets/no_such.obj").string());
    EXPECT_CONTAINS(message, "GLLADDER_ROOT");
    for (const fs::path& root : Resources().shaderRoots())
        EXPECT_CONTAINS(message, (root.parent_path() / "assets/no_such.obj").string());
}

TEST_F(ResourcesTest, anEmptyVariableIsNoFolder) {
    const auto roots = Resources().shaderRoots();
    setenv("GLLADDER_ROOT", "", 1);
    EXPECT_EQ(Resources().shaderRoots(), roots);
}

} // namespace
} // namespace gll::test
