// Says which golden cases are missing. Usage: complete TESTS_FOLDER RUNG...
#include "complete/complete.hpp"
#include "support/process.hpp"

#include <cstdio>

int main(int argc, char** argv) {
    using namespace gll;
    namespace fs = std::filesystem;
    if (argc < 3) {
        std::fprintf(stderr, "usage: complete TESTS_FOLDER RUNG...\n");
        return 2;
    }
    try {
        const fs::path tests = argv[1];
        int failures = 0;
        for (int i = 2; i < argc; ++i) {
            const fs::path program = argv[i];
            const std::string rung = program.filename().string();
            const auto suites = frame_check::readSuites(tests / "golden" / rung);
            const auto listed =
                nlohmann::json::parse(test::runToSuccess({program, {"--settings", "--json"}}).out);
            for (const std::string& sentence : test::missingCases(
                     listed, suites.at(0).cases, test::readExcuses(tests / "complete/excused.json", rung))) {
                std::printf("%s: %s\n", rung.c_str(), sentence.c_str());
                ++failures;
            }
        }
        return failures == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "complete: error: %s\n", error.what());
        return 1;
    }
}
