// Programs whose files change while they are in use: rebuilt in place, and as they were where that fails.
#include "gl_test.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

namespace fs = std::filesystem;

class ShaderLibraryTest : public GlTest {
  protected:
    void SetUp() override {
        folder.write("full.vert", full_screen_vertex);
        folder.write("lib/level.glsl", "float level() { return 0.25; }\n");
        folder.write("lib/unused.glsl", "float nothing() { return 0.0; }\n");
        writeStage("level()");
    }
    void writeStage(const std::string& value) {
        folder.write("a.frag", "#version 330 core\n#include \"lib/level.glsl\"\nout vec4 c;\n"
                               "void main() { c = vec4(" +
                                   value + "); }\n");
    }
    void writeLevel(const std::string& value) {
        folder.write("lib/level.glsl", "float level() { return " + value + "; }\n");
    }
    bool changed(const std::string& file) { return library.changed({fs::weakly_canonical(folder / file)}); }
    const Program& program() { return library.program("full.vert", "a.frag"); }
    float drawn() {
        const Framebuffer target({{"out", Format::r32f}}, {1, 1});
        draw(target, {.program = program(), .uniforms = uniforms});
        return pixelOf(target.color(), 0, 0).r;
    }

    TemporaryFolder folder;
    ShaderLibrary library{{folder.path()}};
    std::vector<UniformSetting> uniforms;
};

TEST_F(ShaderLibraryTest, aChangedIncludeAndAChangedStageShowInTheSameProgram) {
    const Program& before = program();
    EXPECT_EQ(drawn(), 0.25F);
    writeLevel("0.5");
    EXPECT_EQ(drawn(), 0.25F) << "nobody said that a file has changed";
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.5F);
    writeStage("2.0 * level()");
    EXPECT_TRUE(changed("a.frag"));
    EXPECT_EQ(drawn(), 1.0F);
    folder.write("full.vert", std::string(full_screen_vertex) + "// the same\n");
    EXPECT_TRUE(changed("full.vert"));
    EXPECT_EQ(&program(), &before);
    EXPECT_EQ(library.generation(), 3);
}

TEST_F(ShaderLibraryTest, whatNoProgramWasMadeFromChangesNothing) {
    program();
    EXPECT_FALSE(changed("lib/unused.glsl"));
    EXPECT_FALSE(changed("nowhere.glsl"));
    EXPECT_EQ(library.generation(), 0);
}

TEST_F(ShaderLibraryTest, whatAMendedStageIncludesAnewIsKnownFromThenOn) {
    program();
    folder.write("a.frag", "#version 330 core\n#include \"lib/unused.glsl\"\nout vec4 c;\n"
                           "void main() { c = vec4(nothing()); }\n");
    changed("a.frag");
    program();
    EXPECT_TRUE(changed("lib/unused.glsl"));
    program();
    EXPECT_FALSE(changed("lib/level.glsl")) << "is no longer included";
}

TEST_F(ShaderLibraryTest, aBrokenFileLeavesTheLastGoodProgramAndSaysWhereItIsBroken) {
    EXPECT_EQ(drawn(), 0.25F);
    folder.write("lib/level.glsl", "// broken\r\nfloat level() { return undeclared; }\r\n");
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.25F);
    ASSERT_EQ(library.errors().size(), 1U);
    const ShaderError error = library.errors().front();
    EXPECT_EQ(error.file, "lib/level.glsl");
    EXPECT_EQ(error.line, 2);
    EXPECT_CONTAINS(error.complaint, "undeclared");
    EXPECT_EQ(error.source_line, "float level() { return undeclared; }");
    EXPECT_EQ(std::string(error.what()), "lib/level.glsl:2: " + error.complaint);

    writeLevel("0.5");
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.5F);
    EXPECT_TRUE(library.errors().empty());
}

TEST_F(ShaderLibraryTest, anErrorInWhatSeveralProgramsIncludeIsToldOnce) {
    folder.write("b.frag", "#version 330 core\n#include \"lib/level.glsl\"\nout vec4 c;\n"
                           "void main() { c = vec4(-level()); }\n");
    const auto ask = [&] {
        program();
        library.program("full.vert", "b.frag");
        library.program("full.vert", "a.frag", {{"VARIANT", "1"}});
    };
    ask();
    writeLevel("undeclared");
    changed("lib/level.glsl");
    ask();
    EXPECT_EQ(library.errors().size(), 1U);
}

TEST_F(ShaderLibraryTest, whatIsNotAskedForAgainIsNotCompiledAndHasNoError) {
    program();
    writeStage("undeclared");
    changed("a.frag");
    EXPECT_TRUE(library.errors().empty());
}

TEST_F(ShaderLibraryTest, errorsOfIncludesHaveTheirPlaceToo) {
    program();
    folder.write("a.frag", "#version 330 core\n\n#include lib/level.glsl\nvoid main() {}\n");
    changed("a.frag");
    program();
    ASSERT_EQ(library.errors().size(), 1U);
    EXPECT_EQ(library.errors()[0].line, 3);
    EXPECT_EQ(library.errors()[0].source_line, "#include lib/level.glsl");
}

TEST_F(ShaderLibraryTest, anErrorBehindAWarningIsFound) {
    const ShaderSource source{"", {{"a.frag", {}, "one\ntwo\nthree\n"}}};
    const ShaderError error =
        source.firstComplaint("0:1(2): warning: not so good\n0:3(1): error: this is it\n0:2(1): error: no\n");
    EXPECT_EQ(std::string(error.what()), "a.frag:3: error: this is it");
    EXPECT_EQ(error.source_line, "three");
    EXPECT_EQ(std::string(source.firstComplaint("0(2) : error C1008: nvidia's\n").what()),
              "a.frag:2: error C1008: nvidia's");
    EXPECT_EQ(std::string(source.firstComplaint("no place\n").what()), "a.frag: no place");
}

TEST_F(ShaderLibraryTest, aFileThatIsGoneWhileItIsSavedIsWaitedFor) {
    EXPECT_EQ(drawn(), 0.25F);
    fs::rename(folder / "lib/level.glsl", folder / "lib/level.glsl~");
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.25F);
    EXPECT_TRUE(library.errors().empty());
    writeLevel("0.5");
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.5F);
}

TEST_F(ShaderLibraryTest, anIncludeThatNeverWasThereIsAnErrorUntilItAppears) {
    EXPECT_EQ(drawn(), 0.25F);
    folder.write("a.frag", "#version 330 core\n#include \"lib/later.glsl\"\nout vec4 c;\n"
                           "void main() { c = vec4(later()); }\n");
    for (int save = 0; save < 2; ++save) { // saving it again mends nothing
        EXPECT_TRUE(changed("a.frag"));
        EXPECT_EQ(drawn(), 0.25F);
        ASSERT_EQ(library.errors().size(), 1U);
        EXPECT_TRUE(std::string(library.errors()[0].what()).starts_with("a.frag:2: shader file lib/later"));
    }
    folder.write("lib/later.glsl", "float later() { return 0.75; }\n");
    EXPECT_TRUE(changed("lib/later.glsl"));
    EXPECT_EQ(drawn(), 0.75F);
    EXPECT_TRUE(library.errors().empty());
}

TEST_F(ShaderLibraryTest, aProgramThatNeverWasThrowsItsErrorAndIsMadeWhenItsFileIsMended) {
    writeLevel("undeclared");
    try {
        program();
        FAIL() << "made from a broken file";
    } catch (const ShaderError& error) {
        EXPECT_EQ(error.file, "lib/level.glsl");
        EXPECT_EQ(error.line, 1);
    }
    EXPECT_TRUE(library.errors().empty()) << "it was thrown";
    writeLevel("0.5");
    EXPECT_TRUE(changed("lib/level.glsl"));
    EXPECT_EQ(drawn(), 0.5F);
}

TEST_F(ShaderLibraryTest, uniformsThatAnEditTookAwayMayStillBeSetAndThoseItAddedMustBe) {
    folder.write("a.frag", "#version 330 core\nuniform float gain;\nuniform float taps[4];\nout vec4 c;\n"
                           "void main() { c = vec4(gain * taps[3]); }\n");
    uniforms = {{"gain", 0.5F}, {"taps", std::vector<float>{1, 1, 1, 4}}};
    EXPECT_EQ(drawn(), 2.0F);
    folder.write("a.frag", "#version 330 core\nuniform float taps[4];\nout vec4 c;\n"
                           "void main() { c = vec4(taps[1]); }\n");
    changed("a.frag");
    EXPECT_EQ(drawn(), 1.0F);
    folder.write("a.frag", "#version 330 core\nuniform float taps[4];\nuniform float bias;\nout vec4 c;\n"
                           "void main() { c = vec4(taps[1] + bias); }\n");
    changed("a.frag");
    EXPECT_EQ(messageOf<std::invalid_argument>([&] { drawn(); }),
              "a.frag: uniform bias was not set: give it a value where the pass is drawn");
    uniforms.push_back({"biass", 1.0F});
    EXPECT_CONTAINS(messageOf<std::invalid_argument>([&] { drawn(); }), "no uniform named biass");
    folder.write("a.frag", "#version 330 core\nuniform float gain;\nuniform float taps[4];\nout vec4 c;\n"
                           "void main() { c = vec4(gain * taps[3]); }\n");
    changed("a.frag");
    uniforms.pop_back();
    EXPECT_EQ(drawn(), 2.0F) << "what was taken away and came back";
    uniforms[1].value = std::vector<float>(5);
    EXPECT_CONTAINS(messageOf<std::invalid_argument>([&] { drawn(); }), "fewer elements");
}

} // namespace
} // namespace gll::test
