// Broken shader files. The rung finds shaders from its own place, so it is copied beside a copy of them to
// break.
#include "hostile/hostile.hpp"

#include <fstream>
#include <memory>
#include <sstream>

namespace gll::test {
namespace {
namespace fs = std::filesystem;

class Shaders : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        installation_ = std::make_unique<TemporaryFolder>();
        fs::create_directory(*installation_ / "bin");
        program_ = *installation_ / "bin" / rungProgram().filename();
        fs::copy_file(rungProgram(), program_);
    }
    static void TearDownTestSuite() { installation_.reset(); }

    void SetUp() override {
        // Built in build/PRESET/bin, three folders under the root.
        const fs::path root = rungProgram().parent_path().parent_path().parent_path().parent_path();
        fs::remove_all(shaders_);
        fs::copy(root / "shaders", shaders_, fs::copy_options::recursive);
    }

    // Puts text before the first line that begins with `before`; returns that line's number.
    static int insert(const fs::path& file, const std::string& before, const std::string& text) {
        std::ifstream stream(file);
        std::string all;
        std::string line;
        int number = 0;
        for (int i = 1; std::getline(stream, line); ++i) {
            if (number == 0 && line.starts_with(before)) {
                number = i;
                all += text + "\n";
            }
            all += line + "\n";
        }
        EXPECT_NE(number, 0) << file << " has no line that begins with " << before;
        std::ofstream(file) << all;
        return number;
    }

    static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

    Result render() const {
        Command command = rungCommand(folder_, {"--size", "8x8", "--out", "frame.png"});
        command.program = program_;
        command.environment["GLLADDER_ROOT"] = std::nullopt;
        return run(command);
    }
    void expectRefused(const std::vector<std::string>& parts) const {
        expectRefusal(render(), 1, parts);
        EXPECT_EQ(folder_.listing(), std::vector<std::string>());
    }

    // The last stage of the rung, and a file that it includes.
    fs::path stage() const { return shaders_ / "lib" / "present.frag"; }
    static std::string stageName() { return "lib/present.frag"; }

    static inline std::unique_ptr<TemporaryFolder> installation_;
    static inline fs::path program_;
    const fs::path shaders_ = *installation_ / "shaders";
    TemporaryFolder folder_;
};

TEST_F(Shaders, thatAreWholeRender) {
    const Result result = render();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(folder_.listing(), std::vector<std::string>{"frame.png"});
}

TEST_F(Shaders, thatAreAllMissingNameEveryPathTried) {
    fs::remove_all(shaders_);
    expectRefused({"not found; tried", (*installation_ / "bin").string()});
}

TEST_F(Shaders, thatMissOneFileNameIt) {
    fs::remove(stage());
    expectRefused({stageName() + " not found", stage().string()});
}

TEST_F(Shaders, withASyntaxErrorNameFileAndLine) {
    const int line = insert(stage(), "void main", "float broken = ;");
    expectRefused({stageName() + ":" + std::to_string(line) + ": ", "syntax error"});
}

TEST_F(Shaders, withASyntaxErrorInAnIncludedFileNameThatFileAndLine) {
    const int line = insert(shaders_ / "lib/encode.glsl", "vec3 encode", "float broken = ;");
    expectRefused({"lib/encode.glsl:" + std::to_string(line) + ": ", "syntax error"});
}

TEST_F(Shaders, withASyntaxErrorAfterTheirIncludesNameTheirOwnLine) {
    const int line = insert(stage(), "// end excerpt", "int after = undeclared_name;");
    expectRefused({stageName() + ":" + std::to_string(line) + ": ", "undeclared_name"});
}

TEST_F(Shaders, thatIncludeInACircleIncludeEachFileOnce) {
    insert(shaders_ / "lib/encode.glsl", "vec3 encode", "#include \"lib/tone_map.glsl\"");
    insert(shaders_ / "lib/tone_map.glsl", "vec3", "#include \"lib/encode.glsl\"");
    EXPECT_EQ(render().exit_code, 0);
}

TEST_F(Shaders, thatIncludeTooDeepAreRefused) {
    for (int i = 0; i < 40; ++i)
        write(shaders_ / ("lib/deep" + std::to_string(i) + ".glsl"),
              "#include \"lib/deep" + std::to_string(i + 1) + ".glsl\"\n");
    insert(stage(), "void main", "#include \"lib/deep0.glsl\"");
    expectRefused({"deep", ":1: "});
}

TEST_F(Shaders, thatIncludeAFileThatIsNotThereNameBothFiles) {
    const int line = insert(stage(), "void main", "#include \"lib/nothing.glsl\"");
    expectRefused({stageName() + ":" + std::to_string(line) + ": ", "lib/nothing.glsl not found"});
}

TEST_F(Shaders, thatIncludeAFolderAreRefused) {
    insert(stage(), "void main", "#include \"lib\"");
    expectRefused({"lib not found"});
}

TEST_F(Shaders, thatIncludeOutsideTheirFolderAreRefused) {
    write(*installation_ / "outside.glsl", "\n");
    fs::create_symlink(*installation_ / "outside.glsl", shaders_ / "lib/link.glsl");
    const fs::path whole = folder_ / "whole";
    fs::copy_file(stage(), whole);
    for (const std::string& file : {std::string("../outside.glsl"), std::string("lib/../../outside.glsl"),
                                    std::string("/etc/passwd"), std::string("lib/link.glsl")}) {
        fs::copy_file(whole, stage(), fs::copy_options::overwrite_existing);
        insert(stage(), "void main", "#include \"" + file + "\"");
        expectRefusal(render(), 1, {stageName(), file, "outside"});
    }
    EXPECT_EQ(folder_.listing(), std::vector<std::string>{"whole"});
}

TEST_F(Shaders, withABrokenIncludeLineNameItsPlace) {
    const int line = insert(stage(), "void main", "#include <lib/encode.glsl>");
    expectRefused({stageName() + ":" + std::to_string(line) + ": "});
}

TEST_F(Shaders, thatAreEmptyAreRefused) {
    write(stage(), "");
    expectRefused({stageName()});
}

TEST_F(Shaders, thatAreNoiseAreRefused) {
    std::string noise;
    for (unsigned i = 1, value = 1; i < 4096; ++i, value = value * 1664525U + 1013904223U)
        noise += static_cast<char>(value >> 24);
    write(stage(), noise);
    expectRefused({stageName()});
}

TEST_F(Shaders, thatAreEnormousAreRefused) {
    write(stage(), std::string(2 << 20, '\n'));
    expectRefused({"present.frag", "1 MiB"});
}

TEST_F(Shaders, thatLackAUniformNameIt) {
    insert(stage(), "void main", "#define intensity 0.7");
    expectRefused({stageName(), "intensity"});
}

} // namespace
} // namespace gll::test
