// The hostile tests' main and what they share.
#include "hostile/hostile.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <utility>

namespace gll::test {
namespace {

std::filesystem::path rung_program;

} // namespace

const std::filesystem::path& rungProgram() { return rung_program; }

Command rungCommand(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    return {.program = rungProgram(),
            .arguments = std::move(arguments),
            .environment = {{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", std::nullopt}},
            .folder = folder.path()};
}

void expectRefusal(const Result& result, int exit_code, const std::vector<std::string>& parts) {
    EXPECT_FALSE(result.timed_out);
    EXPECT_FALSE(result.signalled) << "signal " << result.exit_code - 128;
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n'));
    EXPECT_TRUE(result.err.starts_with(rungProgram().filename().string() + ": error: ")) << result.err;
    for (const std::string& part : parts)
        EXPECT_NE(result.err.find(part), std::string::npos) << "\"" << part << "\" in: " << result.err;
}

void PrintTo(const Refusal& refusal, std::ostream* stream) {
    for (const std::string& argument : refusal.arguments)
        *stream << argument << ' ';
}

void checkRefusal(const Refusal& refusal) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = refusal.arguments;
    for (std::string& argument : arguments)
        if (const auto place = argument.find("{}"); place != std::string::npos)
            argument.replace(place, 2, folder.path().string());
    expectRefusal(run(rungCommand(folder, arguments)), refusal.exit_code, refusal.parts);
    EXPECT_EQ(folder.listing(), std::vector<std::string>());
}

} // namespace gll::test

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc != 2) {
        std::fprintf(stderr, "usage: hostile [--gtest_...] RUNG\n");
        return 2;
    }
    gll::test::rung_program = argv[1];
    return RUN_ALL_TESTS();
}
