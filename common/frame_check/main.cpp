// frame_check: whether frames are what somebody accepted. Two pictures, or a suite of cases that it draws
// itself.
#include "frame_check/bless.hpp"
#include "frame_check/check.hpp"
#include "frame_check/mutate.hpp"
#include "frame_check/report.hpp"
#include "frame_check/review.hpp"
#include "frame_check/say.hpp"
#include "process/temporary_folder.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <optional>
#include <stdexcept>

namespace gll::frame_check {
namespace {

struct Options {
    std::vector<std::string> words; // NEW REF, or cases
    std::string suite;
    std::string rule;
    std::string program;
    std::vector<std::string> variables;
    std::vector<std::string> environment;
    std::string report;
    std::string junit;
    std::string warnings;
    bool github = false;
    bool quiet = false;
    bool reviews = false;
    bool blesses = false;
    bool all = false;
    BlessOptions bless;
    std::string shaders; // to put faults into
    std::string excused;
    MutationOptions mutation;
};

// Wrong usage, as opposed to what cannot be compared; both end with 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::pair<std::string, std::string> keyAndValue(const std::string& option, const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(option + " " + text + ": write NAME=VALUE");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

SuiteChanges changesIn(const Options& options) {
    SuiteChanges changes;
    changes.program = options.program;
    for (const std::string& text : options.variables)
        changes.variables.insert(keyAndValue("--with", text));
    for (const std::string& text : options.environment)
        changes.environment.insert(keyAndValue("--env", text));
    if (!options.rule.empty()) {
        changes.rule = ruleFromText(options.rule);
        if (changes.rule->isLoosened())
            throw UsageError(
                "--rule " + options.rule +
                ": would loosen every case; write it into the cases that need it, with their reason");
    }
    return changes;
}

std::vector<SuiteResult> checkAll(const Options& options) {
    const CheckOptions check_options{.patterns = options.words,
                                     .keeps_maps = !options.report.empty() || options.reviews};
    std::vector<SuiteResult> results;
    if (options.suite.empty()) {
        SuiteResult pair{.name = ""};
        pair.cases.push_back(check(options.words.at(0), options.words.at(1),
                                   options.rule.empty() ? Rule{} : ruleFromText(options.rule),
                                   !options.report.empty()));
        results.push_back(std::move(pair));
        std::fputs(line(results.back().cases.back()).c_str(), stdout);
        return results;
    }
    std::size_t chosen = 0;
    for (const Suite& suite : readSuites(options.suite, changesIn(options))) {
        SuiteResult result = check(suite, check_options);
        chosen += result.cases.size();
        for (const CaseResult& one : result.cases)
            if (!options.quiet || one.outcome != Outcome::same) std::fputs(line(one).c_str(), stdout);
        for (const std::string& problem : result.problems)
            std::printf("%-12s %s\n", word(Outcome::incomparable).c_str(),
                        (suite.name + "/" + problem).c_str());
        if (!result.renderer.empty()) std::printf("drawn by %s\n", result.renderer.c_str());
        std::fflush(stdout);
        results.push_back(std::move(result));
    }
    if (chosen == 0) throw std::runtime_error(options.suite + ": no case there is called so");
    return results;
}

std::string titleOf(const Options& options) {
    if (options.suite.empty())
        return std::filesystem::path(options.words.at(0)).filename().string() + " against " +
               std::filesystem::path(options.words.at(1)).filename().string();
    return "Frames of " + std::filesystem::canonical(options.suite).filename().string();
}

int checkAndSay(const Options& options) {
    if (options.reviews) requirePerson();
    std::optional<FolderRemoval> removal(std::in_place);
    std::vector<SuiteResult> results = checkAll(options);
    const Counts counts = countsOf(results);
    if (!options.suite.empty()) std::puts(counts.text().c_str());
    const char* runner = std::getenv("GITHUB_ACTIONS");
    if (options.github || (runner != nullptr && std::string(runner) == "true"))
        std::fputs(annotations(results).c_str(), stdout);
    if (!options.report.empty()) writeReport(options.report, titleOf(options), results);
    if (!options.junit.empty()) writeJunit(options.junit, results);
    if (!options.warnings.empty()) writeWarnings(options.warnings, results);
    if (std::fflush(stdout) != 0) throw std::runtime_error("stdout: cannot be written, make room there");
    if (options.reviews) {
        removal.reset(); // a review has its own way of ending
        review(results,
               {.title = titleOf(options), .changes = changesIn(options), .adds = options.bless.adds});
    }
    return countsOf(results).exitCode();
}

int blessSuite(Options options) {
    options.bless.names = options.words;
    if (options.suite.empty()) throw UsageError("--bless needs --suite DIR");
    if (options.words.empty() && !options.all)
        throw UsageError("--bless: name the cases whose frames you have looked at, or say --all");
    const FolderRemoval removal;
    const SuiteChanges changes = changesIn(options);
    std::vector<Suite> suites = readSuites(options.suite, changes, options.bless.makes);
    if (suites.size() > 1) throw UsageError("--bless: name one suite of " + options.suite);
    return bless(std::move(suites.front()), options.bless) ? 0 : 1;
}

// The suites with the chosen cases only, which have to be there and to pass with a copy of the shaders.
std::vector<Suite> suitesToMutate(const Options& options) {
    std::vector<Suite> suites = readSuites(options.suite, changesIn(options));
    for (Suite& suite : suites)
        std::erase_if(suite.cases, [&](const Case& one) { return !isChosen(suite, one, options.words); });
    std::erase_if(suites, [](const Suite& suite) { return suite.cases.empty(); });
    if (suites.empty()) throw std::runtime_error(options.suite + ": no case there is called so");
    const ShaderCopy copy(options.shaders);
    for (const Suite& suite : suites) {
        if (!isToldOfShaders(suite))
            throw UsageError(
                suite.settings.string() +
                ": tells its program nothing of {shaders}, a folder; write that into \"command\", "
                "\"batch\" or \"environment\", as man frame_check says");
        const SuiteResult checked =
            check(options.mutation.within(suite, copy.path()), {.looks_at_targets = false});
        for (const CaseResult& one : checked.cases) {
            if (one.outcome == Outcome::same || one.outcome == Outcome::tolerated) continue;
            std::fputs(line(one).c_str(), stdout);
            throw std::runtime_error(one.fullName() +
                                     ": fails without any fault; bring the suite to pass before");
        }
    }
    return suites;
}

void sayOutcome(const MutationOutcome& outcome, bool quiet) {
    constexpr const char* words[] = {"seen", "MISSED", "excused", "not drawn"};
    if (quiet && outcome.verdict != Verdict::survived) return;
    const Mutant& mutant = outcome.mutant;
    std::printf("%-9s %s:%d %s: %s -> %s: %s\n", words[static_cast<std::size_t>(outcome.verdict)],
                mutant.file.c_str(), mutant.line, mutant.operation.c_str(), mutant.before.c_str(),
                mutant.after.c_str(), outcome.by.c_str());
    std::fflush(stdout);
}

int mutateSuite(Options options) {
    if (options.suite.empty())
        throw UsageError("--mutate needs --suite DIR, whose frames should show the faults");
    if (!std::filesystem::is_directory(options.shaders))
        throw UsageError("--mutate " + options.shaders + ": there is no such folder of shaders");
    const FolderRemoval removal;
    MutationOptions& mutation = options.mutation;
    mutation.shaders = options.shaders;
    mutation.within = [](const Suite& suite, const std::filesystem::path& folder) {
        Suite there = suite;
        there.variables["shaders"] = (folder / "shaders").string();
        return there;
    };
    mutation.on_outcome = [&](const MutationOutcome& outcome) { sayOutcome(outcome, options.quiet); };
    if (!options.excused.empty()) mutation.excuses = readExcuses(options.excused);
    if (chooseMutants(mutation).mutants.empty())
        throw std::runtime_error(options.shaders +
                                 ": no fault can be put into a file there that is to be tried; "
                                 "GLSL is looked for in .glsl, .vert, .frag, .vs, .fs and the like");
    const MutationResult result = mutate(suitesToMutate(options), mutation);
    for (const std::string& shader : result.unused)
        std::printf("%s: no case is drawn with it\n", shader.c_str());
    for (const std::string& shader : result.silent)
        std::printf("%s: warning: a frame is drawn even where it does not compile, so that such faults count "
                    "as seen\n",
                    shader.c_str());
    for (const std::string& excuse : result.stale)
        std::printf("%s: stale: %s\n", options.excused.c_str(), excuse.c_str());
    const std::size_t missed = result.count(Verdict::survived);
    const std::size_t seen = result.count(Verdict::killed);
    std::printf("%zu of %zu faults tried, seed %llu: %zu seen, %zu missed, %zu excused, %zu not drawn\n",
                result.outcomes.size(), result.possible, static_cast<unsigned long long>(mutation.seed), seen,
                missed, result.count(Verdict::excused), result.count(Verdict::invalid));
    if (seen + missed == 0)
        throw std::runtime_error("no fault came to a frame, so that nothing is known; try more");
    return missed > 0 || !result.stale.empty() ? 1 : 0;
}

void addMutationOptions(CLI::App& app, Options& options) {
    const std::string group = "Faults in shaders";
    app.add_option("--mutate", options.shaders,
                   "Put small faults into a copy of this folder's shaders, one after the other, and say "
                   "which ones no "
                   "case of the suite shows")
        ->type_name("FOLDER")
        ->group(group);
    app.add_option("--sample", options.mutation.sample,
                   "So many faults in all, of those that are not excused")
        ->check(CLI::Range(1, 1'000'000))
        ->type_name("N")
        ->group(group);
    app.add_option("--share", options.mutation.share, "Or this share of each file's, at least three (0.05)")
        ->check(CLI::Range(1e-6, 1.0))
        ->type_name("X")
        ->group(group);
    app.add_option("--seed", options.mutation.seed, "Which ones (1)")->type_name("N")->group(group);
    app.add_option("--only", options.mutation.only, "Only in files whose name holds this")
        ->type_name("TEXT")
        ->group(group);
    app.add_option("--jobs", options.mutation.jobs, "So many at once (1)")
        ->check(CLI::Range(1, 256))
        ->type_name("N")
        ->group(group);
    app.add_option("--excused", options.excused, "Faults that no frame can show, with their reasons")
        ->type_name("FILE.json")
        ->group(group);
}

void addOptions(CLI::App& app, Options& options) {
    app.add_option("word", options.words, "NEW REFERENCE: two pictures; with --suite: cases, as patterns");
    app.add_option("--suite", options.suite, "Check the cases of this folder, or of those in it")
        ->type_name("DIR");
    app.add_option("--rule", options.rule,
                   "What a frame that is not the same is held to: count, exact, flip=X "
                   "or rmse=X; of a suite count or exact, in place of the cases' own")
        ->type_name("RULE");
    app.add_option("--program", options.program, "What {program} stands for in the suite's commands")
        ->type_name("FILE");
    app.add_option("--with", options.variables, "What {NAME} stands for; may be repeated")
        ->type_name("NAME=VALUE")
        ->take_all()
        ->expected(1);
    app.add_option("--env", options.environment, "For the suite's programs; may be repeated")
        ->type_name("NAME=VALUE")
        ->take_all()
        ->expected(1);
    app.add_option("--report", options.report,
                   "Write a page of all that is not the same, which needs no network")
        ->type_name("FILE.html");
    app.add_option("--junit", options.junit, "Write the results as JUnit's XML")->type_name("FILE.xml");
    app.add_option("--warnings", options.warnings,
                   "Write a line for each tolerated case; no file where none is")
        ->type_name("FILE");
    app.add_flag("--github", options.github,
                 "Say GitHub's annotations, too (also where GITHUB_ACTIONS=true)");
    app.add_flag("--quiet", options.quiet, "No line for cases that are the same");
    app.add_flag(
        "--review", options.reviews,
        "Then show the report in a browser of this machine, with buttons that accept; never where CI is set");
    app.add_flag("--bless", options.blesses,
                 "Accept the cases' frames as they are drawn now; never where CI is set");
    app.add_option("--because", options.bless.because, "With --bless: why they are right")->type_name("TEXT");
    app.add_flag("--all", options.all, "With --bless: every case");
    app.add_flag("--also", options.bless.adds,
                 "With --bless or --review: beside what other renderers drew, which stays");
    app.add_flag("--new", options.bless.makes, "With --bless: make the case, which is not there yet");
    app.add_option("--setting", options.bless.settings,
                   "With --new: a setting of the case; KEY may be OUTER.INNER; may be repeated")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
    addMutationOptions(app, options);
    app.set_version_flag("--version", "frame_check " GLLADDER_VERSION " (GL Ladder)");
    app.footer("Ends with 0 where every frame is the same or within its rule, 1 where one is not, 2 where "
               "one cannot be compared, and on wrong usage. man frame_check says how to write a suite.");
}

int fail(const std::string& what) {
    std::fprintf(stderr, "frame_check: error: %s\n", what.c_str());
    return 2;
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Says whether frames are what somebody accepted: frame_check NEW REFERENCE for two pictures (PNG, "
        "JPEG, HDR, EXR), frame_check --suite DIR for a folder of cases.",
        "frame_check");
    addOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + ", see --help");
    }
    try {
        if (options.reviews && (options.blesses || options.suite.empty()))
            throw UsageError(
                "--review needs --suite DIR, and blesses what you accept there; leave --bless out");
        if (!options.shaders.empty()) {
            if (options.reviews || options.blesses)
                throw UsageError("--mutate writes nothing; leave the rest out");
            return mutateSuite(options);
        }
        if (options.suite.empty() && !options.blesses && options.words.size() != 2)
            throw UsageError("give two pictures, NEW and REFERENCE, or --suite DIR; see --help");
        return options.blesses ? blessSuite(options) : checkAndSay(options);
    } catch (const std::bad_alloc&) {
        return fail("out of memory; compare smaller pictures, or fewer at once");
    } catch (const std::exception& error) {
        return fail(error.what());
    }
}

} // namespace
} // namespace gll::frame_check

int main(int argc, char** argv) { return gll::frame_check::run(argc, argv); }
