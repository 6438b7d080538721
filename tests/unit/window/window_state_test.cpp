// Windows as files: what is written is read again, and what is wrong is said with its key.
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "window/window_state.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <stdexcept>

namespace gll::test {
namespace {

class WindowStateTest : public testing::Test {
  protected:
    std::string errorOf(const std::string& text) {
        const auto file = folder.write("state.json", text);
        std::string message = messageOf<std::runtime_error>([&] { (void)readWindowState(file); });
        if (message.starts_with(file.string())) message.erase(0, file.string().size());
        return message;
    }
    TemporaryFolder folder;
};

TEST_F(WindowStateTest, whatIsWrittenIsReadAgain) {
    WindowState state;
    state.preferences = {
        .panel = false, .strip = true, .panel_em = 30.5, .text_size = 1.25, .waits_for_display = false};
    state.rung = "05_hdr_bloom";
    state.picture = {801, 603};
    state.frame = 77;
    state.is_playing = false;
    state.speed = 0.25;
    state.loop = Timeline::Loop{10, 20};
    state.sets_a = {"levels=3", "tone_map=agx"};
    state.sets_b = {"levels=1"};
    state.edits_b = true;
    state.comparison = "flip";
    state.divider = 0.75;
    state.inspected = PassTarget{"geometry", "normal"};
    state.files.mesh = "/a path/cat's.obj";
    const std::string text = windowStateJson(state);
    const WindowState read = readWindowState(folder.write("state.json", text));
    EXPECT_EQ(windowStateJson(read), text);
    EXPECT_EQ(read.files.mesh, state.files.mesh);
    EXPECT_EQ(read.loop, state.loop);
    EXPECT_EQ(read.inspected, state.inspected);
}

TEST_F(WindowStateTest, whatIsLeftOutIsAsByDefault) {
    const WindowState read = readWindowState(folder.write("state.json", "{}"));
    EXPECT_EQ(windowStateJson(read), windowStateJson(WindowState{}));
}

TEST_F(WindowStateTest, whatIsWrongIsSaidWithItsKey) {
    EXPECT_EQ(errorOf(R"({"frame": 0})"),
              ": frame is no number from 1 to 10000000; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"frame": 1.5})"), ": frame is no whole number; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"frame": "x"})"),
              ": frame is no number from 1 to 10000000; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"panel": 1})"), ": panel is neither true nor false; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"a": [1]})"), ": a is no list of texts; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"loop": 3})"), ": loop is no JSON object; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"loop": {"first": 1, "lats": 2}})"),
              ": loop: lats is no key of a window; mend it, or remove the file");
    EXPECT_EQ(
        errorOf(R"({"comparison": "sideways"})"),
        ": comparison is none of off, divider, blink, difference and flip; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"picture": {"width": 0}})"),
              ": picture: width is no number from 1 to 16384; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"files": {"mesh": 7}})"), ": files: mesh is no text; mend it, or remove the file");
    EXPECT_EQ(errorOf(R"({"wrong": 1})"), ": wrong is no key of a window; mend it, or remove the file");
    EXPECT_EQ(errorOf("[]"), " is no JSON object; mend it, or remove the file");
    EXPECT_NE(errorOf("{").find("is no JSON"), std::string::npos);
    EXPECT_NE(errorOf("").find("is no JSON"), std::string::npos);
    EXPECT_NE(errorOf(std::string(2 << 20, ' ')).find("larger than 1 MiB"), std::string::npos);
    EXPECT_NE(messageOf<std::runtime_error>([&] { (void)readWindowState(folder / "none.json"); }), "");
}

TEST_F(WindowStateTest, preferencesAreRememberedForAllWindows) {
    const char* before = std::getenv("XDG_CONFIG_HOME");
    const std::string kept = before == nullptr ? "" : before;
    setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
    EXPECT_EQ(rememberedPreferences().panel_em, WindowPreferences().panel_em);
    rememberPreferences({.panel_em = 40, .text_size = 2});
    EXPECT_EQ(rememberedPreferences().panel_em, 40);
    EXPECT_EQ(rememberedPreferences().text_size, 2);
    std::filesystem::create_directories(folder / "broken" / "gl-ladder");
    folder.write("broken/gl-ladder/window.json", "{\"panel_em\": \"wide\"}");
    setenv("XDG_CONFIG_HOME", (folder / "broken").c_str(), 1);
    EXPECT_EQ(rememberedPreferences().panel_em, WindowPreferences().panel_em);
    setenv("XDG_CONFIG_HOME", "/proc/nowhere", 1);
    rememberPreferences({}); // cannot be, and is no error
    kept.empty() ? unsetenv("XDG_CONFIG_HOME") : setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
}

} // namespace
} // namespace gll::test
