// Faults in shaders of a program that is none of ours: it is told of {shaders}, and "draws" the picture that
// is there for the shader's checksum.
#include "frame_check/mutate.hpp"

#include "pictures.hpp"
#include "support/messages.hpp"
#include "support/process.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

using frame_check::Mutant;

constexpr const char* tone = "float tone(float x) {\n    return x * 0.5;\n}\n";

class Mutate : public testing::Test {
  protected:
    // `tells`: how the program finds its shaders.
    explicit Mutate(const std::string& tells = R"("command": ["sh", "draw", "{shaders}", "{out}"])") {
        folder_.write("shaders/tone.frag", tone);
        folder_.write("shaders/unused.frag", "float unused = -1.0;\n");
        folder_.write("shaders/README.md", "a * b\n");
        folder_.write("draw", "cp \"" + folder_.path().string() +
                                  "/drawn/$(cksum < \"$1/tone.frag\" | cut -d ' ' -f 1).png\" \"$2\"\n");
        folder_.write("suite.json", "{" + tells + R"(, "shaders": "shaders"})");
        folder_.write("cases/a.json", "{}");
        draws(tone, grey());
        for (const Mutant& mutant : frame_check::mutantsOf("tone.frag", tone))
            faults_[mutant.operation] = mutant.text;
        EXPECT_EQ(faults_.size(), 3U) << "factor, arithmetic, constant";
        const Result blessed = frameCheck({"--bless", "--all", "--because", "the first look"});
        EXPECT_EQ(blessed.exit_code, 0) << blessed.err << blessed.out;
    }

    void draws(const std::string& shader, const Image& image) const {
        const auto file = folder_.write("shader", shader);
        const Result sum =
            run({"/bin/sh", {"-c", "cksum < '" + file.string() + "' | cut -d ' ' -f 1 | tr -d '\\n'"}});
        std::filesystem::create_directories(folder_ / "drawn");
        saveImage(folder_ / "drawn" / (sum.out + ".png"), image);
    }

    Result frameCheck(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"--suite", (folder_ / "cases").string()});
        return run({FRAME_CHECK, arguments, {{"CI", std::nullopt}, {"GITHUB_ACTIONS", std::nullopt}}});
    }
    Result mutate(std::vector<std::string> arguments = {}) const {
        arguments.insert(arguments.begin(), {"--mutate", (folder_ / "shaders").string(), "--share", "1"});
        return frameCheck(arguments);
    }

    TemporaryFolder folder_;
    std::map<std::string, std::string> faults_; // the whole shader, by the kind of the fault
};

TEST_F(Mutate, saysWhichFaultsNoCaseShows) {
    draws(faults_.at("factor"), changed(76800, 60));
    draws(faults_.at("constant"), changed(9, 1)); // within the rule
    const Result result =
        mutate({"--only", "tone"}); // of "arithmetic" there is no picture: it does not "compile"
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_CONTAINS(result.out, "seen      tone.frag:2 factor: return x * 0.5; -> return x ;: cases a\n");
    EXPECT_CONTAINS(result.out, "MISSED    tone.frag:2 constant: return x * 0.5; -> return x * (1.1 * 0.5);: "
                                "tolerated, pixels differing: 9\n");
    EXPECT_CONTAINS(result.out, "not drawn tone.frag:2 arithmetic");
    EXPECT_CONTAINS(result.out, "3 of 5 faults tried, seed 1: 1 seen, 1 missed, 0 excused, 1 not drawn\n");
    EXPECT_EQ(contents(folder_ / "shaders/tone.frag"), tone) << "only a copy has faults";
    const Result quiet = mutate({"--only", "tone", "--quiet"});
    EXPECT_EQ(quiet.out.find("seen "), quiet.out.rfind("seen ")) << quiet.out;
}

TEST_F(Mutate, endsWith0WhereAllAreSeenOrExcused) {
    for (const auto& [operation, text] : faults_)
        draws(text, changed(76800, 60));
    Result result = mutate();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_CONTAINS(result.out, "MISSED    unused.frag:1 sign");
    EXPECT_CONTAINS(result.out, "unused.frag: no case is drawn with it");
    const std::string excuses =
        folder_.write("excused.json", R"([{"file": "unused.frag", "why": "kept for later"}])").string();
    result = mutate({"--excused", excuses, "--jobs", "2"});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_CONTAINS(result.out, "3 seen, 0 missed, 2 excused, 0 not drawn");
    folder_.write("excused.json", R"([{"file": "tone.frag", "line": "return x * 0.5;",
        "becomes": "return x ;", "why": "it was so once"}, {"file": "unused.frag", "why": "kept"}])");
    result = mutate({"--excused", excuses});
    EXPECT_EQ(result.exit_code, 1) << "an excuse for what a case shows";
    EXPECT_CONTAINS(result.out, "stale: tone.frag: cases a shows it");
}

class MutateByEnvironment : public Mutate {
  protected:
    MutateByEnvironment()
        : Mutate(
              R"("command": ["sh", "-c", "sh ./draw \"$SHADERS\" {out}"], "environment": {"SHADERS": "{shaders}"})") {
    }
};

TEST_F(MutateByEnvironment, tellsTheProgram) {
    draws(faults_.at("factor"), changed(76800, 60));
    const Result result = mutate({"--only", "tone"});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_CONTAINS(result.out, "1 seen, 0 missed, 0 excused, 2 not drawn");
}

TEST_F(Mutate, needsASuiteThatPassesAndIsToldOfTheShaders) {
    const auto fails = [&](const std::vector<std::string>& arguments, const std::string& why) {
        const Result result = mutate(arguments);
        EXPECT_EQ(result.exit_code, 2) << result.out;
        EXPECT_CONTAINS(result.err, why);
    };
    fails({"--only", "README"}, "no fault can be put into a file there");
    fails({"--only", "tone"}, "no fault came to a frame");
    fails({"none"}, "no case there is called so");
    draws(tone, changed(76800, 60));
    fails({}, "cases/a: fails without any fault");
    folder_.write("suite.json", R"({"command": ["true"], "shaders": "shaders"})");
    fails({}, "tells its program nothing of {shaders}");
    EXPECT_CONTAINS(frameCheck({"--mutate", "/none"}).err, "no such folder of shaders");
}

} // namespace
} // namespace gll::test
