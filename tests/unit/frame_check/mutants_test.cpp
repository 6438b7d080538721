// Which faults a line of GLSL can have, and what is left alone.
#include "frame_check/mutants.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace gll::test {
namespace {

using frame_check::Mutant;
using frame_check::mutantsOf;

// "operation: what the line becomes", of every fault.
std::vector<std::string> faultsOf(const std::string& text) {
    std::vector<std::string> faults;
    for (const Mutant& mutant : mutantsOf("test.frag", text))
        faults.push_back(mutant.operation + ": " + mutant.after);
    return faults;
}

void expectFaults(const std::string& text, std::vector<std::string> expected) {
    std::vector<std::string> faults = faultsOf(text);
    std::sort(faults.begin(), faults.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(faults, expected) << text;
}

TEST(Mutants, swapAndDropTerms) {
    expectFaults("float a = b + c * d;", {"arithmetic: float a = b - c * d;", "term: float a = b ;",
                                          "arithmetic: float a = b + c / d;", "factor: float a = b + c ;"});
}

TEST(Mutants, takeASignAway) { expectFaults("float a = -b;", {"sign: float a = b;"}); }

TEST(Mutants, scaleConstantsButNotThoseThatOnlyKeepADivisionFinite) {
    expectFaults("float a = 0.5;", {"constant: float a = (1.1 * 0.5);"});
    expectFaults("float a = 1e-6;", {});
    expectFaults("uint a = 0x9E3779B1u;", {});
    expectFaults("int a = 3;", {"constant: int a = 4;"});
}

TEST(Mutants, turnComparisonsAndTakeBranches) {
    expectFaults("if (a < b) c = d;", {"never: if (false) c = d;", "negated: if (!(a < b)) c = d;",
                                       "comparison: if (a >= b) c = d;", "statement: if (a < b) ;"});
    expectFaults("a = b ? c : d;", {"branch: a = (c);", "branch: a = (d);", "statement: ;"});
}

TEST(Mutants, exchangeChannelsAndFunctions) {
    expectFaults("x = y.rgb;", {"channel: x = y.bgr;", "statement: ;"});
    expectFaults("float x = min(y.x, z);", {"channel: float x = min(y.y, z);",
                                            "function: float x = max(y.x, z);", "bypass: float x = (y.x);"});
}

TEST(Mutants, sampleBesideThePlace) {
    expectFaults("vec4 c = texture(source, uv);", {"sample: vec4 c = texture(source, uv + 0.02);"});
}

TEST(Mutants, leaveTheInterfaceAndThePreprocessorAlone) {
    expectFaults("#if A + 1 > 2\nuniform vec2 size[2 + 1]; // a - b\n/* a * b */ in vec2 uv;\n#endif\n", {});
}

// Others' shaders may hold anything, and a fault before the first bracket or beyond the last must not be one
// here.
TEST(Mutants, takeWhateverAFileHolds) {
    const std::vector<std::string> pieces = {"if", "(", ")", "{",   "}",     "[",   "]",  "?",
                                             ":",  "=", "-", "*",   "1e999", "0.5", "a",  ".",
                                             "x",  ";", ",", "mix", "//",    "/*",  "\n", "99999999999"};
    std::uint64_t state = 1;
    for (int round = 0; round < 3000; ++round) {
        std::string text;
        for (int i = 0; i < 12; ++i) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            text += pieces[(state >> 33) % pieces.size()] + ((state >> 20) % 2 == 0 ? " " : "");
        }
        for (const Mutant& mutant : mutantsOf("any.frag", text))
            EXPECT_NE(mutant.text, text);
    }
}

TEST(Mutants, sayTheLineAndHoldTheWholeText) {
    const std::vector<Mutant> mutants = mutantsOf("a.frag", "one;\nfloat a = -b;\ntwo;\n");
    ASSERT_EQ(mutants.size(), 1U);
    EXPECT_EQ(mutants[0].line, 2);
    EXPECT_EQ(mutants[0].before, "float a = -b;");
    EXPECT_EQ(mutants[0].text, "one;\nfloat a = b;\ntwo;\n");
}

} // namespace
} // namespace gll::test
