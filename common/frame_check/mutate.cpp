// Choosing faults, drawing with each, and looking whether a case fails.
#include "frame_check/mutate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <tuple>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;

// How files with GLSL in them end.
const std::set<std::string> endings = {".glsl", ".vert", ".frag", ".geom",  ".tesc", ".tese",
                                       ".comp", ".vs",   ".fs",   ".gs",    ".cs",   ".vsh",
                                       ".fsh",  ".gsh",  ".inc",  ".shader"};

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    return text;
}

std::uint64_t rank(const Mutant& mutant, std::uint64_t seed) {
    std::uint64_t hash = 0xcbf29ce484222325 ^ seed; // FNV-1a, as pixelHash()
    for (const std::string& text : {mutant.file, mutant.before, mutant.after})
        for (const char c : text)
            hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    hash ^= hash >> 29; // so short texts differ in the high bits too
    return hash * 0xbf58476d1ce4e5b9;
}

bool isExcused(const std::vector<Excuse>& excuses, const Mutant& mutant) {
    return std::any_of(excuses.begin(), excuses.end(), [&](const Excuse& e) { return e.covers(mutant); });
}

std::vector<const Case*> casesAt(const Suite& suite, const std::vector<std::size_t>& places) {
    std::vector<const Case*> cases;
    for (const std::size_t i : places)
        cases.push_back(&suite.cases[i]);
    return cases;
}

std::vector<std::size_t> allOf(const Suite& suite) {
    std::vector<std::size_t> all(suite.cases.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    return all;
}

// FLIP takes longer than all else, and only one rule asks for it.
Measurement measured(const Rule& rule, const Image& reference, const Image& image) {
    if (rule.kind == Rule::Kind::flip || rule.kind == Rule::Kind::rmse)
        return measure(reference, image, false);
    return {.comparison = measure::compare(reference, image)};
}

class Runner {
  public:
    Runner(const std::vector<Suite>& suites, const MutationOptions& options)
        : suites_(suites), options_(options), references_(suites.size()) {
        MutantChoice choice = chooseMutants(options);
        mutants_ = std::move(choice.mutants);
        result_.possible = choice.possible;
        result_.stale = std::move(choice.stale);
        for (std::size_t i = 0; i < suites.size(); ++i)
            if (!options.draws_with || std::any_of(mutants_.begin(), mutants_.end(), [&](const Mutant& m) {
                    return options.draws_with(suites[i], m.file);
                }))
                loadReferences(i);
        findCases();
    }

    MutationResult run() {
        // All that is copied is there before a thread runs a program: whatever is written while another
        // thread forks stays open for writing in its child, and a program that is open so cannot be run.
        std::deque<ShaderCopy> copies;
        for (unsigned i = 0; i < options_.jobs; ++i) {
            copies.emplace_back(options_.shaders);
            for (const Suite& suite : suites_)
                options_.within(suite, copies.back().path());
        }
        std::vector<std::thread> threads;
        std::string error;
        for (const ShaderCopy& copy : copies)
            threads.emplace_back([&] {
                try {
                    work(copy);
                } catch (const std::exception& caught) {
                    const std::lock_guard lock(mutex_);
                    error = caught.what();
                }
            });
        for (std::thread& thread : threads)
            thread.join();
        if (!error.empty()) throw std::runtime_error(error);
        return std::move(result_);
    }

  private:
    using Cases = std::vector<std::size_t>;

    struct Kill {
        std::string file;
        int line;
        std::size_t suite;
        std::size_t index;
    };

    void loadReferences(std::size_t place) {
        const Suite& suite = suites_[place];
        const ShaderCopy copy(options_.shaders);
        const Suite drawn = options_.within(suite, copy.path());
        const std::string renderer = rendererOf(drawn);
        if (std::all_of(suite.cases.begin(), suite.cases.end(), [&](const Case& one) {
                return !one.blessed.empty() && one.blessed[0].renderer == renderer;
            })) {
            for (const Case& one : suite.cases)
                references_[place].push_back(loadImage(suite.pictureOf(one.name)));
            return;
        }
        Rendering rendering(drawn, casesAt(drawn, allOf(drawn)));
        for (const Case& one : suite.cases) {
            const Frame frame = rendering.next();
            if (!frame.error.empty())
                throw std::runtime_error(suite.name + "/" + one.name + ": cannot be drawn: " + frame.error);
            references_[place].push_back(loadImage(frame.file));
        }
    }

    // Which cases a fault in a shader can show in.
    void findCases() {
        std::set<std::string> shaders;
        for (const Mutant& mutant : mutants_)
            shaders.insert(mutant.file);
        const ShaderCopy copy(options_.shaders);
        for (const std::string& shader : shaders) {
            std::map<std::size_t, Cases>& cases = cases_[shader];
            bool is_silent = false;
            if (!options_.draws_with) copy.write(shader, "no shader\n");
            for (std::size_t i = 0; i < suites_.size(); ++i) {
                Cases here;
                if (options_.draws_with)
                    here = options_.draws_with(suites_[i], shader) ? allOf(suites_[i]) : Cases();
                else
                    here = changedCases(copy, i, is_silent);
                if (!here.empty()) cases[i] = std::move(here);
            }
            if (!options_.draws_with) copy.restore(shader);
            if (cases.empty()) result_.unused.push_back(shader);
            if (is_silent) result_.silent.push_back(shader);
        }
    }

    // Where a shader is no shader at all, each case that is drawn with it has no frame, or, of a program that
    // goes on silently, another one.
    Cases changedCases(const ShaderCopy& copy, std::size_t place, bool& is_silent) const {
        const Suite suite = options_.within(suites_[place], copy.path());
        Rendering rendering(suite, casesAt(suite, allOf(suite)));
        Cases changed;
        for (std::size_t i = 0; !rendering.atEnd(); ++i) {
            const Frame frame = rendering.next();
            const bool fails = !frame.error.empty();
            if (!fails && measure::compare(references_[place][i], loadImage(frame.file)).identical())
                continue;
            changed.push_back(i);
            is_silent = is_silent || !fails;
        }
        return changed;
    }

    void work(const ShaderCopy& copy) {
        for (;;) {
            MutationOutcome outcome;
            {
                const std::lock_guard lock(mutex_);
                if (next_ >= mutants_.size()) return;
                outcome.mutant = mutants_[next_++];
            }
            const auto begin = std::chrono::steady_clock::now();
            copy.write(outcome.mutant.file, outcome.mutant.text);
            judge(copy, outcome);
            copy.restore(outcome.mutant.file);
            const bool is_excused = isExcused(options_.excuses, outcome.mutant);
            if (outcome.verdict == Verdict::survived && is_excused) outcome.verdict = Verdict::excused;
            outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            const std::lock_guard lock(mutex_);
            if (outcome.verdict == Verdict::killed && is_excused)
                result_.stale.push_back(outcome.mutant.file + ": " + outcome.by +
                                        " shows it: " + outcome.mutant.after);
            if (options_.on_outcome) options_.on_outcome(outcome);
            result_.outcomes.push_back(std::move(outcome));
        }
    }

    void judge(const ShaderCopy& copy, MutationOutcome& outcome) {
        // Of a shader that no frame is drawn with, there is nothing to see.
        if (std::any_of(options_.excuses.begin(), options_.excuses.end(), [&](const Excuse& excuse) {
                return excuse.line.empty() && excuse.covers(outcome.mutant);
            }))
            return;
        std::size_t most_differing = 0;
        bool is_drawn = false; // with the fault in it
        bool fails = false;
        for (const auto& [place, cases] : order(outcome.mutant)) {
            const Suite suite = options_.within(suites_[place], copy.path());
            Rendering rendering(suite, casesAt(suite, cases));
            for (const std::size_t i : cases) {
                const Frame frame = rendering.next();
                if (rendering.hangs()) {
                    outcome.by = suite.name + " hangs";
                    outcome.verdict = Verdict::killed;
                    return;
                }
                if (!frame.error.empty()) {
                    fails = true;
                    continue;
                }
                is_drawn = true;
                const Rule& rule = suite.ruleOf(suite.cases[i]);
                const Measurement measurement = measured(rule, references_[place][i], loadImage(frame.file));
                most_differing = std::max(most_differing, measurement.comparison.differing());
                if (satisfies(rule, measurement)) continue;
                outcome.by = suite.name + " " + suite.cases[i].name;
                outcome.verdict = Verdict::killed;
                const std::lock_guard lock(mutex_);
                kills_.push_back({outcome.mutant.file, outcome.mutant.line, place, i});
                return;
            }
            if (!fails) continue;
            // The shader compiles, but the program now sets a uniform that it does not use any more: a fault
            // that is seen.
            const bool is_seen =
                !options_.noticed.empty() && rendering.messages().find(options_.noticed) != std::string::npos;
            outcome.by = suite.name + (is_seen ? " says " + options_.noticed : " draws no frame");
            outcome.verdict = is_seen ? Verdict::killed : Verdict::invalid;
            return;
        }
        outcome.by = !is_drawn             ? "no case is drawn with it"
                     : most_differing == 0 ? "no pixel differs"
                                           : "tolerated, pixels differing: " + std::to_string(most_differing);
    }

    // The suites that use the shader and their cases, those first that showed a fault nearby, then the small
    // ones.
    std::vector<std::pair<std::size_t, Cases>> order(const Mutant& mutant) {
        const std::lock_guard lock(mutex_);
        std::vector<std::pair<double, std::pair<std::size_t, Cases>>> ordered;
        for (const auto& [place, those] : cases_.at(mutant.file)) {
            std::vector<std::pair<double, std::size_t>> cases;
            for (const std::size_t i : those) {
                const Image& reference = references_[place][i];
                double score = 1e4 + double(reference.width) * double(reference.height) / 1e3;
                for (const Kill& kill : kills_)
                    if (kill.suite == place && kill.index == i && kill.file == mutant.file)
                        score = std::min<double>(score, std::abs(kill.line - mutant.line));
                cases.emplace_back(score, i);
            }
            std::sort(cases.begin(), cases.end());
            Cases indices;
            for (const auto& [score, i] : cases)
                indices.push_back(i);
            // A shader's own suite first.
            const double own = mutant.file.starts_with(suites_[place].name) ? 0 : 1e3;
            ordered.push_back({cases.front().first + own, {place, indices}});
        }
        std::stable_sort(ordered.begin(), ordered.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::pair<std::size_t, Cases>> result;
        for (auto& [score, suite] : ordered)
            result.push_back(std::move(suite));
        return result;
    }

    const std::vector<Suite>& suites_;
    const MutationOptions& options_;
    std::vector<std::vector<Image>> references_;                // one a case, by suite
    std::map<std::string, std::map<std::size_t, Cases>> cases_; // of a shader, by suite
    std::vector<Mutant> mutants_;
    std::mutex mutex_; // of what follows
    std::size_t next_ = 0;
    std::vector<Kill> kills_;
    MutationResult result_;
};

} // namespace

std::vector<Excuse> readExcuses(const fs::path& json_file) {
    std::vector<Excuse> excuses;
    try {
        for (const auto& json : nlohmann::json::parse(readText(json_file))) {
            if (json.at("why").get<std::string>().empty())
                throw std::runtime_error("an excuse without a reason");
            excuses.push_back({json.at("file"), json.value("line", ""), json.value("becomes", "")});
        }
    } catch (const std::exception& error) {
        throw std::runtime_error(json_file.string() + ": " + error.what());
    }
    return excuses;
}

MutantChoice chooseMutants(const MutationOptions& options) {
    MutantChoice choice;
    std::vector<Mutant>& all = choice.mutants;
    const auto is_before = [&](const Mutant& a, const Mutant& b) {
        return rank(a, options.seed) < rank(b, options.seed);
    };
    for (const auto& entry : fs::recursive_directory_iterator(options.shaders)) {
        if (!entry.is_regular_file() || !endings.contains(entry.path().extension())) continue;
        const std::string file = entry.path().lexically_relative(options.shaders).string();
        std::vector<Mutant> here = mutantsOf(file, readText(entry.path()));
        for (const Excuse& excuse : options.excuses)
            if (excuse.file == file &&
                std::none_of(here.begin(), here.end(), [&](const Mutant& m) { return excuse.covers(m); }))
                choice.stale.push_back(file + ": no such fault: " + excuse.line + " -> " + excuse.becomes);
        choice.possible += here.size();
        if (file.find(options.only) == std::string::npos) continue;
        if (options.sample == 0) {
            std::sort(here.begin(), here.end(), is_before);
            const auto wanted =
                static_cast<std::size_t>(std::ceil(options.share * static_cast<double>(here.size())));
            here.resize(std::min(here.size(), std::max<std::size_t>(wanted, 3)));
        }
        all.insert(all.end(), std::make_move_iterator(here.begin()), std::make_move_iterator(here.end()));
    }
    for (const Excuse& excuse : options.excuses)
        if (!fs::exists(options.shaders / excuse.file))
            choice.stale.push_back(excuse.file + ": is not there");
    if (options.sample > 0) {
        std::erase_if(all, [&](const Mutant& m) { return isExcused(options.excuses, m); });
        std::sort(all.begin(), all.end(), is_before);
        all.resize(std::min(all.size(), options.sample));
    }
    std::sort(all.begin(), all.end(), [](const Mutant& a, const Mutant& b) {
        return std::tie(a.file, a.line) < std::tie(b.file, b.line);
    });
    return choice;
}

ShaderCopy::ShaderCopy(const fs::path& shaders) : shaders_(shaders) {
    // Not what leads nowhere, such as the lock of an editor in which one of them is open.
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(shaders, fs::directory_options::follow_directory_symlink)) {
        if (entry.is_regular_file())
            folder_.copy(entry.path(), "shaders" / fs::relative(entry.path(), shaders));
    }
}

void ShaderCopy::write(const std::string& shader, const std::string& text) const {
    folder_.write(fs::path("shaders") / shader, text);
}

void ShaderCopy::restore(const std::string& shader) const { write(shader, readText(shaders_ / shader)); }

std::size_t MutationResult::count(Verdict verdict) const {
    return static_cast<std::size_t>(
        std::count_if(outcomes.begin(), outcomes.end(),
                      [&](const MutationOutcome& one) { return one.verdict == verdict; }));
}

bool isToldOfShaders(const Suite& suite) {
    const auto tells = [](const std::string& text) { return text.find("{shaders}") != std::string::npos; };
    const auto any = [&](const std::vector<std::string>& words) {
        return std::any_of(words.begin(), words.end(), tells);
    };
    return any(suite.command) || any(suite.batch) ||
           std::any_of(suite.cases.begin(), suite.cases.end(),
                       [&](const Case& one) { return any(one.command); }) ||
           std::any_of(suite.environment.begin(), suite.environment.end(),
                       [&](const auto& variable) { return variable.second && tells(*variable.second); });
}

MutationResult mutate(const std::vector<Suite>& suites, const MutationOptions& options) {
    return Runner(suites, options).run();
}

} // namespace gll::frame_check
