// Puts one small fault after the other into a copy of the ladder's shaders and sees whether a golden frame
// shows it: frames that let faults through check nothing. The engine is that of frame_check --mutate; here
// stands what it knows of rungs. A fault that can change no frame is excused by name in excused.json. Ends
// with a table by folder of shaders, and fails where less than 97 % of the faults that can be seen are killed
// in one of them; of fewer than 34 faults, where one survives.
//     tests/run -L mutation                              one fault in twenty: minutes
//     build/release/bin/mutation --sample 8 ...         a quick look, in every run
//     build/release/bin/mutation --only lib/ --share 1   every fault of some files
#include "mutation/ladder.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

namespace {
using namespace gll::frame_check;

void say(const MutationOutcome& outcome) {
    constexpr const char* words[] = {"killed", "SURVIVED", "excused", "invalid"};
    std::printf("%-8s %s:%d %s: %s (%.1f s)\n", words[static_cast<std::size_t>(outcome.verdict)],
                outcome.mutant.file.c_str(), outcome.mutant.line, outcome.mutant.operation.c_str(),
                outcome.by.c_str(), outcome.seconds);
    if (outcome.verdict == Verdict::survived)
        std::printf("    %s\n    %s\n", outcome.mutant.before.c_str(), outcome.mutant.after.c_str());
    std::fflush(stdout);
}

// A table by folder. Returns whether each folder's goldens show at least 97 % of the faults that can be seen,
// or, of so few that one is more than 3 %, all.
bool report(const std::vector<MutationOutcome>& outcomes) {
    constexpr double wanted = 0.97;
    std::map<std::string, std::map<Verdict, int>> folders;
    for (const MutationOutcome& outcome : outcomes)
        ++folders[outcome.mutant.file.substr(0, outcome.mutant.file.find('/'))][outcome.verdict];
    bool is_good = true;
    std::printf("\n%-18s %7s %9s %8s %8s\n", "shaders/", "killed", "survived", "excused", "killed %");
    for (auto& [folder, count] : folders) {
        const int real = count[Verdict::killed] + count[Verdict::survived];
        const double share = real == 0 ? 1 : double(count[Verdict::killed]) / real;
        std::printf("%-18s %7d %9d %8d %8.1f%s\n", folder.c_str(), count[Verdict::killed],
                    count[Verdict::survived], count[Verdict::excused], 100 * share,
                    share < wanted ? "  too few" : "");
        is_good = is_good && share >= wanted;
    }
    return is_good;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Puts small faults into the shaders and sees which ones the golden frames show.",
                 "mutation");
    std::filesystem::path root;
    std::filesystem::path programs;
    MutationOptions options;
    app.add_option("--root", root, "the project")->required();
    app.add_option("--programs", programs, "the folder with the rungs' programs")->required();
    app.add_option("--only", options.only, "shaders whose name holds this");
    app.add_option("--sample", options.sample, "so many faults in all, of those that are not excused");
    app.add_option("--share", options.share, "of each file's faults, 0 to 1; at least three");
    app.add_option("--seed", options.seed, "which ones");
    app.add_option("--jobs", options.jobs, "rungs at once")->check(CLI::Range(1, 64));
    app.footer("Ends with a table of killed, survived and excused faults by folder, and killed % of those "
               "not excused.\n"
               "Fails where a folder has less than 97 %, and where an excuse is stale.");
    CLI11_PARSE(app, argc, argv);
    try {
        const gll::test::Ladder ladder(root, programs);
        ladder.complete(options);
        options.on_outcome = say;
        const MutationResult result = mutate(ladder.suites(), options);
        const bool is_good = report(result.outcomes);
        for (const std::string& excuse : result.stale)
            std::printf("excused.json: stale: %s\n", excuse.c_str());
        std::printf("%zu of %zu faults tried\n", result.outcomes.size(), result.possible);
        return is_good && result.stale.empty() ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mutation: error: %s\n", error.what());
        return 1;
    }
}
