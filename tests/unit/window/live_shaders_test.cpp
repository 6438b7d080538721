// Rendering on while shaders are broken, mended and saved.
#include "gl/pass.hpp"
#include "rung/context.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "window/live_shaders.hpp"

#include <gtest/gtest.h>
#include <new>
#include <stdexcept>

namespace gll::test {
namespace {

constexpr const char* vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0); }\n";
constexpr const char* good = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }\n";
constexpr const char* broken = "#version 330 core\nout vec4 c;\nvoid main() { c = undeclared; }\n";

class LiveShadersTest : public testing::Test {
  protected:
    LiveShadersTest() {
        folder.write("full.vert", vertex);
        folder.write("a.frag", good);
    }
    bool attempt() {
        live.attempt([&] { library.program("full.vert", "a.frag"); });
        return live.isDrawn();
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> all;
        for (const ShaderError& error : live.errors())
            all.emplace_back(error.what());
        return all;
    }

    std::unique_ptr<Context> context = makeHeadlessContext();
    TemporaryFolder folder;
    ShaderLibrary library{{folder.path()}};
    LiveShaders live{"10_rung", library};
};

TEST_F(LiveShadersTest, aBrokenFileIsToldInTheNextFrameAndForgottenWhenItIsMended) {
    EXPECT_FALSE(live.update());
    EXPECT_TRUE(attempt());
    folder.write("a.frag", broken);
    EXPECT_TRUE(live.update()) << "at once";
    EXPECT_TRUE(attempt()) << "with the last good program";
    EXPECT_FALSE(live.update());
    ASSERT_EQ(live.errors().size(), 1U);
    EXPECT_EQ(live.errors()[0].file, "a.frag");
    EXPECT_EQ(live.errors()[0].line, 3);
    folder.write("a.frag", good);
    EXPECT_TRUE(live.update());
    EXPECT_TRUE(attempt());
    EXPECT_TRUE(live.errors().empty());
}

TEST_F(LiveShadersTest, aProgramThatNeverCouldBeMadeIsToldUntilItCan) {
    folder.write("a.frag", broken);
    EXPECT_FALSE(attempt());
    EXPECT_FALSE(attempt());
    ASSERT_EQ(live.errors().size(), 1U);
    EXPECT_EQ(live.errors()[0].source_line, "void main() { c = undeclared; }");
    live.update();
    folder.write("a.frag", good);
    EXPECT_TRUE(live.update());
    EXPECT_TRUE(attempt());
    EXPECT_TRUE(live.errors().empty());
}

TEST_F(LiveShadersTest, whateverElseGoesWrongIsToldAndTheShowGoesOn) {
    live.attempt([] { throw std::invalid_argument("a.frag: uniform gain was not set"); });
    EXPECT_FALSE(live.isDrawn());
    EXPECT_EQ(texts(), std::vector<std::string>{"a.frag: uniform gain was not set"});
    live.attempt([] { throw std::bad_alloc(); });
    ASSERT_EQ(texts().size(), 1U);
    EXPECT_CONTAINS(texts()[0], "out of memory");
    EXPECT_TRUE(attempt());
    EXPECT_TRUE(live.errors().empty());
}

TEST_F(LiveShadersTest, theTerminalHearsOfEachErrorOnceAndThatItIsMended) {
    attempt();
    folder.write("a.frag", broken);
    live.update();
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    attempt();
    attempt();
    const std::string error = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(error.starts_with("10_rung: error: a.frag:3: ")) << error;
    EXPECT_EQ(error.find('\n'), error.size() - 1) << error;
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    folder.write("a.frag", good);
    live.update();
    testing::internal::CaptureStdout();
    attempt();
    attempt();
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_TRUE(said.starts_with("mended: ")) << said;
    EXPECT_EQ(said.find('\n'), said.size() - 1) << said;
}

} // namespace
} // namespace gll::test
