// Puts one small fault after the other into a copy of the shaders and sees whether a golden frame shows it:
// frames that let faults through check nothing. A fault that can change no frame is excused by name in
// excused.json. Ends with a table by folder of shaders, and fails where less than 97 % of the faults that can
// be seen are killed in one of them; of fewer than 34 faults, where one survives.
//     tests/run -L mutation                              one fault in twenty: minutes
//     build/release/bin/mutation --sample 8 ...         a quick look, in every run
//     build/release/bin/mutation --only lib/ --share 1   every fault of some files
#include "frame_check/rule.hpp"
#include "mutation/mutants.hpp"
#include "mutation/rendering.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <thread>

namespace {
using namespace gll;
using namespace gll::test;
namespace fs = std::filesystem;

enum class Verdict { killed, survived, excused, invalid };

struct Outcome {
    Mutant mutant;
    Verdict verdict = Verdict::survived;
    std::string by; // the case that shows it, or how much the frames differ
    double seconds = 0;
};

struct Excuse {
    std::string file; // the whole file where no line is named
    std::string line;
    std::string becomes;

    bool covers(const Mutant& mutant) const {
        return file == mutant.file && (line.empty() || (line == mutant.before && becomes == mutant.after));
    }
};

struct Task {
    fs::path root;
    fs::path programs;
    std::string only;
    std::size_t sample = 0; // so many in all; 0: by share
    double share = 0.05;    // of a file's faults
    std::uint64_t seed = 1;
    unsigned jobs = 1;
};

std::vector<const frame_check::Case*> pointersTo(const frame_check::Suite& suite,
                                                 const std::vector<std::size_t>& cases) {
    std::vector<const frame_check::Case*> pointers;
    for (const std::size_t i : cases)
        pointers.push_back(&suite.cases[i]);
    return pointers;
}

std::vector<std::size_t> allOf(const Rung& rung) {
    std::vector<std::size_t> all(rung.suite.cases.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    return all;
}

// One thread for a frame's pixels: the jobs are what goes on at once.
frame_check::SuiteChanges changesFor(const fs::path& program) {
    return {.program = program.string(), .environment = {{"LP_NUM_THREADS", "0"}}};
}

class Runner {
  public:
    explicit Runner(const Task& task) : task_(task), goldens_(task.root / "tests/golden") {
        for (const auto& entry : fs::directory_iterator(goldens_))
            if (const std::string name = entry.path().filename();
                fs::exists(task.programs / name) && entry.is_directory())
                rungs_.push_back(
                    {.name = name,
                     .suite = frame_check::readSuites(entry.path(), changesFor(task.programs / name)).at(0),
                     .references = {},
                     .shaders = shadersOf(task.root, name)});
        if (rungs_.empty()) throw std::runtime_error(task.programs.string() + ": holds no rung with goldens");
        std::sort(rungs_.begin(), rungs_.end(), [](const Rung& a, const Rung& b) { return a.name < b.name; });
        readExcuses();
        findMutants();
        for (Rung& rung : rungs_)
            loadReferences(rung);
    }

    std::vector<Outcome> run() {
        std::vector<std::thread> threads;
        std::string error;
        for (unsigned i = 0; i < task_.jobs; ++i)
            threads.emplace_back([&] {
                try {
                    work();
                } catch (const std::exception& caught) {
                    const std::lock_guard lock(mutex_);
                    error = caught.what();
                }
            });
        for (std::thread& thread : threads)
            thread.join();
        if (!error.empty()) throw std::runtime_error(error);
        return outcomes_;
    }

    std::size_t possible() const { return possible_; }
    const std::vector<std::string>& staleExcuses() const { return stale_; }

  private:
    void readExcuses() {
        const fs::path file = task_.root / "tests/mutation/excused.json";
        for (const auto& json : nlohmann::json::parse(readText(file))) {
            if (json.at("why").get<std::string>().empty())
                throw std::runtime_error(file.string() + ": an excuse without a reason");
            excuses_.push_back({json.at("file"), json.value("line", ""), json.value("becomes", "")});
        }
    }

    // Stable: which faults are chosen depends on the faults alone, so that a change of one line leaves the
    // others be.
    std::uint64_t rank(const Mutant& mutant) const {
        std::uint64_t hash = 0xcbf29ce484222325 ^ task_.seed; // FNV-1a, as pixelHash()
        for (const std::string& text : {mutant.file, mutant.before, mutant.after})
            for (const char c : text)
                hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
        hash ^= hash >> 29; // so short texts differ in the high bits too
        return hash * 0xbf58476d1ce4e5b9;
    }

    void findMutants() {
        const fs::path shaders = task_.root / "shaders";
        std::vector<Mutant> all;
        for (const auto& entry : fs::recursive_directory_iterator(shaders)) {
            if (!entry.is_regular_file()) continue;
            const std::string file = entry.path().lexically_relative(shaders).string();
            std::vector<Mutant> here = mutantsOf(file, readText(entry.path()));
            for (const Excuse& excuse : excuses_)
                if (excuse.file == file &&
                    std::none_of(here.begin(), here.end(), [&](const Mutant& m) { return excuse.covers(m); }))
                    stale_.push_back(file + ": no such fault: " + excuse.line + " -> " + excuse.becomes);
            possible_ += here.size();
            if (file.find(task_.only) == std::string::npos) continue;
            if (task_.sample == 0) {
                std::sort(here.begin(), here.end(),
                          [&](const Mutant& a, const Mutant& b) { return rank(a) < rank(b); });
                const auto wanted =
                    static_cast<std::size_t>(std::ceil(task_.share * static_cast<double>(here.size())));
                here.resize(std::min(here.size(), std::max<std::size_t>(wanted, 3)));
            }
            all.insert(all.end(), std::make_move_iterator(here.begin()), std::make_move_iterator(here.end()));
        }
        for (const Excuse& excuse : excuses_)
            if (!fs::exists(shaders / excuse.file)) stale_.push_back(excuse.file + ": is not there");
        if (task_.sample > 0) {
            std::erase_if(all, [&](const Mutant& m) { return isExcused(m); });
            std::sort(all.begin(), all.end(),
                      [&](const Mutant& a, const Mutant& b) { return rank(a) < rank(b); });
            all.resize(std::min(all.size(), task_.sample));
        }
        std::sort(all.begin(), all.end(), [](const Mutant& a, const Mutant& b) {
            return std::tie(a.file, a.line) < std::tie(b.file, b.line);
        });
        mutants_ = std::move(all);
    }

    bool isExcused(const Mutant& mutant) const {
        return std::any_of(excuses_.begin(), excuses_.end(),
                           [&](const Excuse& e) { return e.covers(mutant); });
    }

    void loadReferences(Rung& rung) const {
        if (std::none_of(mutants_.begin(), mutants_.end(),
                         [&](const Mutant& m) { return rung.shaders.contains(m.file); }))
            return;
        const std::string renderer = frame_check::rendererOf(rung.suite);
        if (std::all_of(rung.suite.cases.begin(), rung.suite.cases.end(),
                        [&](const frame_check::Case& golden) {
                            return !golden.blessed.empty() && golden.blessed[0].renderer == renderer;
                        })) {
            for (const frame_check::Case& golden : rung.suite.cases)
                rung.references.push_back(loadImage(rung.suite.pictureOf(golden.name)));
            return;
        }
        const Copy copy(task_.root, {rung});
        const frame_check::Suite suite = copy.suite(rung);
        frame_check::Rendering rendering(suite, pointersTo(suite, allOf(rung)));
        for (const frame_check::Case& golden : rung.suite.cases) {
            const frame_check::Frame frame = rendering.next();
            if (!frame.error.empty())
                throw std::runtime_error(rung.name + ", " + golden.name + ": " + frame.error);
            rung.references.push_back(loadImage(frame.file));
        }
    }

    void work() {
        const Copy copy(task_.root, rungs_);
        for (;;) {
            Mutant mutant;
            {
                const std::lock_guard lock(mutex_);
                if (next_ >= mutants_.size()) return;
                mutant = mutants_[next_++];
            }
            const auto begin = std::chrono::steady_clock::now();
            Outcome outcome{.mutant = mutant, .by = {}};
            copy.write(mutant.file, mutant.text);
            judge(copy, outcome);
            copy.write(mutant.file, readText(task_.root / "shaders" / mutant.file));
            if (outcome.verdict == Verdict::survived && isExcused(mutant)) outcome.verdict = Verdict::excused;
            outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            const std::lock_guard lock(mutex_);
            if (outcome.verdict == Verdict::killed && isExcused(mutant))
                stale_.push_back(mutant.file + ": " + outcome.by + " shows it: " + mutant.after);
            say(outcome);
            outcomes_.push_back(std::move(outcome));
        }
    }

    void judge(const Copy& copy, Outcome& outcome) {
        // Of a shader that no frame is drawn with, there is nothing to see.
        if (std::any_of(excuses_.begin(), excuses_.end(), [&](const Excuse& excuse) {
                return excuse.line.empty() && excuse.covers(outcome.mutant);
            }))
            return;
        std::size_t most_differing = 0;
        bool is_drawn = false; // with the fault in it
        bool fails = false;
        for (const auto& [rung, cases] : order(outcome.mutant)) {
            const frame_check::Suite suite = copy.suite(*rung);
            frame_check::Rendering rendering(suite, pointersTo(suite, cases));
            for (const std::size_t i : cases) {
                const frame_check::Frame frame = rendering.next();
                if (rendering.hangs()) {
                    outcome.by = rung->name + " hangs";
                    outcome.verdict = Verdict::killed;
                    return;
                }
                if (!frame.error.empty()) {
                    fails = true;
                    continue;
                }
                is_drawn = true;
                const frame_check::Measurement measurement{
                    .comparison = measure::compare(rung->references[i], loadImage(frame.file))};
                most_differing = std::max(most_differing, measurement.comparison.differing());
                if (frame_check::satisfies(suite.ruleOf(suite.cases[i]), measurement)) continue;
                outcome.by = rung->name + " " + rung->suite.cases[i].name;
                outcome.verdict = Verdict::killed;
                const std::lock_guard lock(mutex_);
                kills_.push_back({outcome.mutant.file, outcome.mutant.line, rung, i});
                return;
            }
            if (!fails) continue;
            // The shader compiles, but the rung now sets a uniform that it does not use any more: a fault
            // that is seen.
            const bool is_seen = rendering.messages().find("no uniform named") != std::string::npos;
            outcome.by = is_seen ? rung->name + " misses a uniform" : "";
            outcome.verdict = is_seen ? Verdict::killed : Verdict::invalid;
            return;
        }
        outcome.by = !is_drawn             ? "no rung draws with it"
                     : most_differing == 0 ? "no pixel differs"
                                           : "tolerated, pixels differing: " + std::to_string(most_differing);
    }

    // The rungs that use the shader and their cases, those first that showed a fault nearby, then the small
    // ones.
    std::vector<std::pair<const Rung*, std::vector<std::size_t>>> order(const Mutant& mutant) {
        const std::lock_guard lock(mutex_);
        std::vector<std::pair<double, std::pair<const Rung*, std::vector<std::size_t>>>> ordered;
        for (const Rung& rung : rungs_) {
            if (!rung.shaders.contains(mutant.file)) continue;
            std::vector<std::pair<double, std::size_t>> cases;
            for (std::size_t i = 0; i < rung.suite.cases.size(); ++i) {
                const Image& reference = rung.references[i];
                double score = 1e4 + double(reference.width) * double(reference.height) / 1e3;
                for (const Kill& kill : kills_)
                    if (kill.rung == &rung && kill.index == i && kill.file == mutant.file)
                        score = std::min<double>(score, std::abs(kill.line - mutant.line));
                cases.emplace_back(score, i);
            }
            std::sort(cases.begin(), cases.end());
            std::vector<std::size_t> indices;
            for (const auto& [score, i] : cases)
                indices.push_back(i);
            // A shader's own rung first.
            const double own = mutant.file.starts_with(rung.name) ? 0 : 1e3;
            ordered.push_back({cases.front().first + own, {&rung, indices}});
        }
        std::stable_sort(ordered.begin(), ordered.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::pair<const Rung*, std::vector<std::size_t>>> result;
        for (auto& [score, rung] : ordered)
            result.push_back(std::move(rung));
        return result;
    }

    static void say(const Outcome& outcome) {
        constexpr const char* words[] = {"killed", "SURVIVED", "excused", "invalid"};
        std::printf("%-8s %s:%d %s: %s (%.1f s)\n", words[static_cast<std::size_t>(outcome.verdict)],
                    outcome.mutant.file.c_str(), outcome.mutant.line, outcome.mutant.operation.c_str(),
                    outcome.by.c_str(), outcome.seconds);
        if (outcome.verdict == Verdict::survived)
            std::printf("    %s\n    %s\n", outcome.mutant.before.c_str(), outcome.mutant.after.c_str());
        std::fflush(stdout);
    }

    struct Kill {
        std::string file;
        int line;
        const Rung* rung;
        std::size_t index;
    };

    const Task& task_;
    fs::path goldens_;
    std::vector<Rung> rungs_;
    std::vector<Excuse> excuses_;
    std::vector<Mutant> mutants_;
    std::vector<std::string> stale_;
    std::size_t possible_ = 0;
    std::mutex mutex_;
    std::size_t next_ = 0;
    std::vector<Kill> kills_;
    std::vector<Outcome> outcomes_;
};

// A table by folder. Returns whether each folder's goldens show at least 97 % of the faults that can be seen,
// or, of so few that one is more than 3 %, all.
bool report(const std::vector<Outcome>& outcomes) {
    constexpr double wanted = 0.97;
    std::map<std::string, std::map<Verdict, int>> folders;
    for (const Outcome& outcome : outcomes)
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
    Task task;
    app.add_option("--root", task.root, "the project")->required();
    app.add_option("--programs", task.programs, "the folder with the rungs' programs")->required();
    app.add_option("--only", task.only, "shaders whose name holds this");
    app.add_option("--sample", task.sample, "so many faults in all, of those that are not excused");
    app.add_option("--share", task.share, "of each file's faults, 0 to 1; at least three");
    app.add_option("--seed", task.seed, "which ones");
    app.add_option("--jobs", task.jobs, "rungs at once")->check(CLI::Range(1, 64));
    app.footer("Ends with a table of killed, survived and excused faults by folder, and killed % of those "
               "not excused.\n"
               "Fails where a folder has less than 97 %, and where an excuse is stale.");
    CLI11_PARSE(app, argc, argv);
    try {
        Runner runner(task);
        const std::vector<Outcome> outcomes = runner.run();
        const bool is_good = report(outcomes);
        for (const std::string& excuse : runner.staleExcuses())
            std::printf("excused.json: stale: %s\n", excuse.c_str());
        std::printf("%zu of %zu faults tried\n", outcomes.size(), runner.possible());
        return is_good && runner.staleExcuses().empty() ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mutation: error: %s\n", error.what());
        return 1;
    }
}
