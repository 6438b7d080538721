// Shader files: what includes and definitions make of them, and what they may not do.
#include "gl_test.hpp"

#include <stdexcept>

namespace gll::test {
namespace {

namespace fs = std::filesystem;

std::size_t countOf(const std::string& text, std::string_view part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

class ShaderSourceTest : public testing::Test {
  protected:
    ShaderSource read(const std::string& file, const Defines& defines = {}) const {
        return readShader({root}, file, defines);
    }
    std::string errorOf(const std::string& file) const {
        return messageOf<std::runtime_error>([&] { read(file); });
    }

    TemporaryFolder folder;
    fs::path root = folder.path() / "shaders";
};

TEST_F(ShaderSourceTest, includesAreFoundUnderTheRootNotBesideTheFile) {
    folder.write("shaders/stage/a.frag", "#version 330 core\n#include \"lib/x.glsl\"\nlast\n");
    folder.write("shaders/lib/x.glsl", "included\n");
    const ShaderSource source = read("stage/a.frag");
    EXPECT_EQ(source.text, "#version 330 core\n#line 2 0\n#line 100001 1\nincluded\n#line 3 0\nlast\n");
    ASSERT_EQ(source.files.size(), 2U);
    EXPECT_EQ(source.files[0].name, "stage/a.frag");
    EXPECT_EQ(source.files[1].name, "lib/x.glsl");
    EXPECT_EQ(source.files[1].path, fs::canonical(root / "lib/x.glsl"));
}

TEST_F(ShaderSourceTest, aFileIsPutInOnceEvenThroughACircle) {
    folder.write("shaders/a.frag", "#version 330 core\n#include \"x.glsl\"\n#include \"y.glsl\"\n");
    folder.write("shaders/x.glsl", "#include \"y.glsl\"\nin x\n");
    folder.write("shaders/y.glsl", "#include \"x.glsl\"\n#include \"y.glsl\"\nin y\n");
    const ShaderSource source = read("a.frag");
    EXPECT_EQ(countOf(source.text, "in x"), 1U);
    EXPECT_EQ(countOf(source.text, "in y"), 1U);
}

TEST_F(ShaderSourceTest, aFileIsPutInOnceHoweverItsPathIsSpelt) {
    folder.write("shaders/a.frag",
                 "#version 330 core\n#include \"lib/x.glsl\"\n#include \"lib/../lib/./x.glsl\"\n");
    folder.write("shaders/lib/x.glsl", "in x\n");
    EXPECT_EQ(countOf(read("a.frag").text, "in x"), 1U);
}

TEST_F(ShaderSourceTest, sixteenIncludesDeepAreReadAndSeventeenAreNot) {
    const auto chain = [&](int length) {
        for (int i = 0; i < length; ++i)
            folder.write("shaders/" + std::to_string(i),
                         "#include \"" + std::to_string(i + 1) + "\"\nlevel\n");
        folder.write("shaders/" + std::to_string(length), "deepest\n");
    };
    chain(16);
    EXPECT_EQ(countOf(read("0").text, "deepest"), 1U);
    chain(17);
    EXPECT_EQ(errorOf("0"), "16:1: includes go more than 16 deep");
}

TEST_F(ShaderSourceTest, nothingOutsideTheRootIsRead) {
    folder.write("secret.glsl", "secret\n");
    folder.write("shaders/dots.frag", "#version 330 core\n#include \"../secret.glsl\"\n");
    folder.write("shaders/lib/deep_dots.frag", "#version 330 core\n#include \"lib/../../secret.glsl\"\n");
    folder.write("shaders/absolute.frag",
                 "#version 330 core\n#include \"" + (folder.path() / "secret.glsl").string() + "\"\n");
    fs::create_symlink("../secret.glsl", root / "link.glsl");
    folder.write("shaders/linked.frag", "#version 330 core\n#include \"link.glsl\"\n");
    fs::create_directory_symlink("..", root / "up");
    folder.write("shaders/linked_folder.frag", "#version 330 core\n#include \"up/secret.glsl\"\n");
    for (const char* file :
         {"dots.frag", "lib/deep_dots.frag", "absolute.frag", "linked.frag", "linked_folder.frag"}) {
        const std::string message = errorOf(file);
        EXPECT_TRUE(message.starts_with(std::string(file) + ":2: ")) << message;
        EXPECT_CONTAINS(message, "lies outside the shader folder");
    }
    EXPECT_CONTAINS(errorOf("../secret.glsl"), "lies outside the shader folder");
    // A folder whose name merely begins like the root's is outside of it too.
    folder.write("shaders_too/x.glsl", "secret\n");
    EXPECT_CONTAINS(errorOf("../shaders_too/x.glsl"), "lies outside the shader folder");
}

TEST_F(ShaderSourceTest, aLinkThatStaysInsideTheRootIsRead) {
    folder.write("shaders/lib/x.glsl", "in x\n");
    fs::create_symlink("lib/x.glsl", root / "y.glsl");
    folder.write("shaders/a.frag", "#version 330 core\n#include \"y.glsl\"\n");
    EXPECT_EQ(countOf(read("a.frag").text, "in x"), 1U);
}

TEST_F(ShaderSourceTest, aMissingFileNamesWhoAskedAndEveryPathTried) {
    folder.write("one/a.frag", "#version 330 core\n\n#include \"lib/gone.glsl\"\n");
    const std::string message = messageOf<std::runtime_error>([&] {
        readShader({folder.path() / "one", folder.path() / "two"}, "a.frag");
    });
    EXPECT_EQ(message, "a.frag:3: shader file lib/gone.glsl not found; tried " +
                           (folder.path() / "one/lib/gone.glsl").string() + ", " +
                           (folder.path() / "two/lib/gone.glsl").string());
}

TEST_F(ShaderSourceTest, theFirstRootThatHasAFileProvidesIt) {
    folder.write("one/x.glsl", "from one\n");
    folder.write("two/x.glsl", "from two\n");
    folder.write("two/y.glsl", "from two\n");
    const std::vector<fs::path> roots = {folder.path() / "one", folder.path() / "two"};
    EXPECT_EQ(readShader(roots, "x.glsl").text, "from one\n");
    EXPECT_EQ(readShader(roots, "y.glsl").text, "from two\n");
}

TEST_F(ShaderSourceTest, definitionsStandAfterTheVersionInTheirOrder) {
    folder.write("shaders/a.frag", "// a comment may come first\n#version 330 core\nlast\n");
    EXPECT_EQ(read("a.frag", {{"A", "1"}, {"B", "A"}}).text,
              "// a comment may come first\n#version 330 core\n#define A 1\n#define B A\n#line 3 0\nlast\n");
}

TEST_F(ShaderSourceTest, anIncludedFileMayNotSetTheVersion) {
    folder.write("shaders/a.frag", "#version 330 core\n#include \"x.glsl\"\n");
    folder.write("shaders/x.glsl", "\n#version 330 core\n");
    EXPECT_EQ(errorOf("a.frag"), "x.glsl:2: #version belongs into the stage alone");
}

TEST_F(ShaderSourceTest, anIncludeWithoutAQuotedNameIsAnError) {
    for (const char* statement : {"#include <x.glsl>", "#include", "#include \"\"", "#include \"x.glsl"}) {
        folder.write("shaders/a.frag", std::string("#version 330 core\n") + statement + "\n");
        EXPECT_EQ(errorOf("a.frag"), "a.frag:2: write #include \"lib/name.glsl\"") << statement;
    }
}

TEST_F(ShaderSourceTest, linesThatEndAsOnWindowsAndFilesWithoutALastNewlineAreRead) {
    folder.write("shaders/a.frag", "#version 330 core\r\n#include \"x.glsl\"\r\nlast");
    folder.write("shaders/x.glsl", "in x");
    EXPECT_EQ(read("a.frag").text, "#version 330 core\n#line 2 0\n#line 100001 1\nin x\n#line 3 0\nlast\n");
}

TEST_F(ShaderSourceTest, aFolderIsNotAShaderAndAHugeFileNeither) {
    folder.write("shaders/lib/x.glsl", "");
    EXPECT_CONTAINS(errorOf("lib"), "shader file lib not found; tried ");
    folder.write("shaders/huge.glsl", std::string((1 << 20) + 1, '\n'));
    EXPECT_CONTAINS(errorOf("huge.glsl"), "larger than 1 MiB");
}

// From here on with a compiler: what its complaints become.
class ShaderErrorTest : public GlTest {
  protected:
    std::string errorOf(const std::string& fragment_file, const Defines& defines = {}) {
        return messageOf<std::runtime_error>(
            [&] { ShaderLibrary({folder.path()}).program("full.vert", fragment_file, defines); });
    }
    void SetUp() override { folder.write("full.vert", full_screen_vertex); }

    TemporaryFolder folder;
};

TEST_F(ShaderErrorTest, aCompileErrorNamesTheFileAndLineItIsIn) {
    folder.write("lib/good.glsl", "float two() {\n    return 2.0;\n}\n");
    folder.write("lib/bad.glsl", "// first\n\nfloat broken() { return undeclared; }\n");
    folder.write("in_include.frag", "#version 330 core\n#include \"lib/good.glsl\"\n#include "
                                    "\"lib/bad.glsl\"\nout vec4 c;\nvoid main() { c = vec4(1); }\n");
    folder.write("after_includes.frag", "#version 330 core\n#include \"lib/good.glsl\"\nout vec4 c;\n"
                                        "void main() { c = vec4(undeclared); }\n");
    folder.write("on_line_two.frag", "#version 330 core\nundeclared x;\nvoid main() {}\n");
    EXPECT_TRUE(errorOf("in_include.frag").starts_with("lib/bad.glsl:3: ")) << errorOf("in_include.frag");
    EXPECT_TRUE(errorOf("after_includes.frag").starts_with("after_includes.frag:4: "))
        << errorOf("after_includes.frag");
    EXPECT_TRUE(errorOf("on_line_two.frag", {{"A", "1"}, {"B", "2"}}).starts_with("on_line_two.frag:2: "))
        << "definitions must not shift lines: " << errorOf("on_line_two.frag", {{"A", "1"}, {"B", "2"}});
    EXPECT_CONTAINS(errorOf("in_include.frag"), "undeclared");
}

TEST_F(ShaderErrorTest, aStageThatDoesNotFitTheOtherSaysThatItDoesNotLink) {
    folder.write("a.frag", "#version 330 core\nin vec3 uv;\nout vec4 c;\nvoid main() { c = uv.xyzz; }\n");
    EXPECT_TRUE(errorOf("a.frag").starts_with("a.frag: does not link: ")) << errorOf("a.frag");
}

TEST_F(ShaderErrorTest, aDefinitionSelectsTheVariantAndEachIsCompiledOnce) {
    folder.write("a.frag",
                 "#version 330 core\n#if KIND == 1\nuniform float one;\n#else\nuniform float "
                 "other;\n#define one other\n#endif\nout vec4 c;\nvoid main() { c = vec4(one); }\n");
    ShaderLibrary library({folder.path()});
    const Program& one = library.program("full.vert", "a.frag", {{"KIND", "1"}});
    const Program& other = library.program("full.vert", "a.frag", {{"KIND", "2"}});
    EXPECT_TRUE(one.uniforms().contains("one"));
    EXPECT_TRUE(other.uniforms().contains("other"));
    EXPECT_EQ(&one, &library.program("full.vert", "a.frag", {{"KIND", "1"}}));
}

TEST_F(ShaderErrorTest, aShaderThatFailedIsTriedAgainWhenAskedForAgain) {
    folder.write("a.frag", "#version 330 core\nbroken\n");
    ShaderLibrary library({folder.path()});
    EXPECT_THROW(library.program("full.vert", "a.frag"), std::runtime_error);
    EXPECT_THROW(library.program("full.vert", "a.frag"), std::runtime_error);
    folder.write("a.frag", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }\n");
    EXPECT_NO_THROW(library.program("full.vert", "a.frag"));
}

} // namespace
} // namespace gll::test
