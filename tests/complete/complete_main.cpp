// Says which golden cases are missing. Usage: complete TESTS_FOLDER RUNG...
#include "complete/complete.hpp"
#include "support/process.hpp"

#include <cstdio>
#include <utility>

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
            std::vector<std::string> sentences = test::missingCases(
                listed, suites.at(0).cases, test::readExcuses(tests / "complete/excused.json", rung));
            for (std::string& sentence : test::ungroupedCases(rung, suites.at(0).cases))
                sentences.push_back(std::move(sentence));
            for (const std::string& sentence : sentences) {
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
