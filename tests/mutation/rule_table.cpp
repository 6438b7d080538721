// How many faults in shaders each rule misses, and how many frames it calls different that only another
// processor or another rasteriser drew: the table of tests/README.md. Every rule is tried as it is published,
// and at the setting where it has as many false alarms as ours.
//     build/release/bin/rule_table --root . --programs build/release/bin --page tests/README.md
// Takes a quarter of an hour; --jobs 2 half of it.
#include "mutation/ladder.hpp"
#include "mutation/rules.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {
using namespace gll;
using namespace gll::test;
using namespace gll::frame_check;
namespace fs = std::filesystem;
using Frames = std::vector<std::optional<Image>>; // one a case

// Pages hold the table between these.
const std::string begin_mark = "<!-- rule_table -->\n";
const std::string end_mark = "<!-- /rule_table -->\n";

bool isComparable(const Image& image) {
    return image.channels == 3 && std::holds_alternative<std::vector<std::uint8_t>>(image.pixels);
}

// Softpipe takes a hundred times as long as llvmpipe.
constexpr std::size_t rasteriser_step = 4;

// One case in `step`.
std::vector<const Case*> pointersTo(const Suite& suite, std::size_t step = 1) {
    std::vector<const Case*> cases;
    for (std::size_t i = 0; i < suite.cases.size(); i += step)
        cases.push_back(&suite.cases[i]);
    return cases;
}

// A setting of a rule, and what came of it.
struct Trial {
    double setting = 0;
    std::size_t missed = 0;
    std::size_t alarms_of_processor = 0;
    std::size_t alarms_of_rasteriser = 0;
};

struct Row {
    NamedRule rule;
    std::array<Trial, 2> trials = {}; // as published; with as many false alarms as ours
};

class Table {
  public:
    Table(const Ladder& ladder, const MutationOptions& options)
        : ladder_(ladder), options_(options), references_(ladder.suites().size()) {
        for (const NamedRule& rule : namedRules())
            rows_.push_back({.rule = rule, .trials = {Trial{.setting = rule.setting}, Trial{}}});
    }

    void run() {
        forEachSuite([&](std::size_t place) { references_[place] = drawn(ladder_.suites()[place], {}, 1); });
        std::fprintf(stderr, "drawn without a fault\n");
        std::vector<std::vector<double>> of_processor = alarms({{"GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1"}}, 1);
        std::vector<std::vector<double>> of_rasteriser =
            alarms({{"GALLIUM_DRIVER", "softpipe"}}, rasteriser_step);
        const std::size_t ours = above(of_processor.front(), rows_.front().trials[0].setting);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            Row& row = rows_[i];
            row.trials[1].setting =
                row.rule.knob.empty() ? row.rule.setting : settingFor(of_processor[i], ours);
            for (Trial& trial : row.trials) {
                trial.alarms_of_processor = above(of_processor[i], trial.setting);
                trial.alarms_of_rasteriser = above(of_rasteriser[i], trial.setting);
            }
        }
        frames_ = of_processor.front().size();
        frames_of_rasteriser_ = of_rasteriser.front().size();
        std::fprintf(stderr, "%s", text().c_str());
        tryFaults();
    }

    std::string text() const {
        std::string result = "| rule | setting | faults missed of " + std::to_string(faults_) +
                             " | false alarms on another processor, of " + std::to_string(frames_) +
                             " | on another rasteriser, of " + std::to_string(frames_of_rasteriser_) +
                             " |\n|---|---|---:|---:|---:|\n";
        for (const Row& row : rows_)
            for (const Trial& trial : row.trials) {
                const bool is_published = &trial == row.trials.data();
                if (!is_published && row.rule.knob.empty()) continue;
                char setting[64];
                std::snprintf(setting, sizeof setting, "%.3g", trial.setting);
                result += "| " + (is_published ? row.rule.name : "") + " | " +
                          (is_published ? row.rule.published : row.rule.knob + " " + setting) + " | " +
                          share(trial.missed, faults_) + " | " + share(trial.alarms_of_processor, frames_) +
                          " | " + share(trial.alarms_of_rasteriser, frames_of_rasteriser_) + " |\n";
            }
        return result;
    }

  private:
    static std::string share(std::size_t count, std::size_t total) {
        char text[64];
        std::snprintf(text, sizeof text, "%zu (%.0f %%)", count,
                      100 * static_cast<double>(count) /
                          static_cast<double>(std::max<std::size_t>(total, 1)));
        return text;
    }

    static std::size_t above(const std::vector<double>& values, double setting) {
        return static_cast<std::size_t>(
            std::count_if(values.begin(), values.end(), [&](double value) { return value > setting; }));
    }

    // The smallest setting with at most so many alarms.
    static double settingFor(std::vector<double>& values, std::size_t alarms) {
        std::sort(values.begin(), values.end(), std::greater<>());
        return alarms < values.size() ? values[alarms] : 0;
    }

    template <class Call>
    void forEachSuite(const Call& call) const {
        inParallel([&, next = std::size_t(0)](std::mutex& mutex, unsigned) mutable {
            std::size_t place = 0;
            {
                const std::lock_guard lock(mutex);
                if (next >= ladder_.suites().size()) return false;
                place = next++;
            }
            call(place);
            return true;
        });
    }

    // Calls until there is nothing more to do, from several threads.
    template <class Step>
    void inParallel(Step step) const {
        std::mutex mutex;
        std::string error;
        std::vector<std::thread> threads;
        for (unsigned job = 0; job < options_.jobs; ++job)
            threads.emplace_back([&, job] {
                try {
                    while (step(mutex, job)) {
                    }
                } catch (const std::exception& caught) {
                    const std::lock_guard lock(mutex);
                    error = caught.what();
                }
            });
        for (std::thread& thread : threads)
            thread.join();
        if (!error.empty()) throw std::runtime_error(error);
    }

    // None where a case is not 8-bit RGB, as all these rules want it, or cannot be drawn.
    static Frames drawn(Suite suite, const std::map<std::string, std::optional<std::string>>& environment,
                        std::size_t step) {
        for (const auto& [name, value] : environment)
            suite.environment[name] = value;
        suite.timeout = std::chrono::hours(1); // softpipe takes its time
        Frames frames;
        Rendering rendering(suite, pointersTo(suite, step));
        while (!rendering.atEnd()) {
            const Frame frame = rendering.next();
            frames.emplace_back();
            if (!frame.error.empty()) {
                std::fprintf(stderr, "%s/%s: %s\n", suite.name.c_str(),
                             suite.cases[step * (frames.size() - 1)].name.c_str(), frame.error.c_str());
                continue;
            }
            Image image = loadImage(frame.file);
            if (isComparable(image)) frames.back() = std::move(image);
        }
        return frames;
    }

    // What each rule measures of each frame that is drawn in this environment, by rule.
    std::vector<std::vector<double>>
    alarms(const std::map<std::string, std::optional<std::string>>& environment, std::size_t step) const {
        std::vector<std::vector<double>> measured(rows_.size());
        std::mutex mutex;
        forEachSuite([&](std::size_t place) {
            const Frames frames = drawn(ladder_.suites()[place], environment, step);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                if (!frames[i] || !references_[place][i * step]) continue;
                const Pair pair(*references_[place][i * step], *frames[i]);
                std::vector<double> values;
                for (const Row& row : rows_)
                    values.push_back(row.rule.measure(pair));
                const std::lock_guard lock(mutex);
                for (std::size_t k = 0; k < values.size(); ++k)
                    measured[k].push_back(values[k]);
            }
        });
        return measured;
    }

    void tryFaults() {
        // Whole before any thread runs a program, as mutate() has it.
        std::deque<ShaderCopy> copies;
        for (unsigned i = 0; i < options_.jobs; ++i) {
            copies.emplace_back(options_.shaders);
            for (const Suite& suite : ladder_.suites())
                options_.within(suite, copies.back().path());
        }
        const std::vector<Mutant> mutants = chooseMutants(options_).mutants;
        std::size_t next = 0;
        inParallel([&](std::mutex& mutex, unsigned job) {
            const ShaderCopy& copy = copies[job];
            std::size_t mine = 0;
            {
                const std::lock_guard lock(mutex);
                if (next >= mutants.size()) return false;
                mine = next++;
            }
            copy.write(mutants[mine].file, mutants[mine].text);
            const auto seen = seenBy(copy, mutants[mine]);
            copy.restore(mutants[mine].file);
            const std::lock_guard lock(mutex);
            std::fprintf(stderr, "%zu of %zu: %s:%d %s\n", mine + 1, mutants.size(),
                         mutants[mine].file.c_str(), mutants[mine].line,
                         seen ? "shown" : "changes no frame, or draws none");
            if (!seen) return true;
            ++faults_;
            for (std::size_t i = 0; i < rows_.size(); ++i)
                for (std::size_t k = 0; k < 2; ++k)
                    rows_[i].trials[k].missed += (*seen)[2 * i + k] ? 0 : 1;
            return true;
        });
    }

    // By which trials a fault is seen in any frame of the first rung that shows it at all, a shader's own
    // before those that take it over; none where no pixel differs, or where it does not compile.
    std::optional<std::vector<bool>> seenBy(const ShaderCopy& copy, const Mutant& mutant) const {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < ladder_.suites().size(); ++i)
            if (options_.draws_with(ladder_.suites()[i], mutant.file)) places.push_back(i);
        std::stable_partition(places.begin(), places.end(), [&](std::size_t i) {
            return mutant.file.starts_with(ladder_.suites()[i].name);
        });
        for (const std::size_t place : places) {
            std::vector<bool> seen(2 * rows_.size());
            bool differs = false;
            const Suite suite = options_.within(ladder_.suites()[place], copy.path());
            Rendering rendering(suite, pointersTo(suite));
            for (std::size_t i = 0; !rendering.atEnd(); ++i) {
                const Frame frame = rendering.next();
                if (!frame.error.empty()) {
                    std::fprintf(stderr, "    %s: %s\n", suite.name.c_str(), frame.error.c_str());
                    return std::nullopt;
                }
                if (!references_[place][i]) continue;
                const Image image = loadImage(frame.file);
                if (measure::compare(*references_[place][i], image).identical()) continue;
                differs = true;
                look(Pair(*references_[place][i], image), seen);
                if (std::find(seen.begin(), seen.end(), false) == seen.end()) break;
            }
            if (differs) return seen;
        }
        return std::nullopt;
    }

    void look(const Pair& pair, std::vector<bool>& seen) const {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (seen[2 * i] && seen[2 * i + 1]) continue;
            const double value = rows_[i].rule.measure(pair);
            for (std::size_t k = 0; k < 2; ++k)
                if (value > rows_[i].trials[k].setting) seen[2 * i + k] = true;
        }
    }

    const Ladder& ladder_;
    const MutationOptions& options_;
    std::vector<Row> rows_;
    std::vector<Frames> references_; // by suite, without a fault, on this processor
    std::size_t frames_ = 0;
    std::size_t frames_of_rasteriser_ = 0;
    std::size_t faults_ = 0;
};

void writeIntoPage(const fs::path& page, const std::string& table) {
    std::string text = contents(page);
    const auto begin = text.find(begin_mark);
    const auto end = text.find(end_mark);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        throw std::runtime_error(page.string() + ": holds no place for the table, " + begin_mark);
    text.replace(begin + begin_mark.size(), end - begin - begin_mark.size(), table);
    std::ofstream stream(page, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(page.string() + ": cannot be written");
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Counts the faults that each rule misses, and its false alarms.", "rule_table");
    fs::path root;
    fs::path programs;
    fs::path page;
    MutationOptions options{.sample = 200};
    app.add_option("--root", root, "the project")->required();
    app.add_option("--programs", programs, "the folder with the rungs' programs")->required();
    app.add_option("--sample", options.sample, "so many faults, of those that are not excused");
    app.add_option("--seed", options.seed, "which ones");
    app.add_option("--only", options.only, "shaders whose name holds this");
    app.add_option("--jobs", options.jobs, "rungs at once")->check(CLI::Range(1, 64));
    app.add_option("--page", page, "writes the table into this page, between its marks");
    CLI11_PARSE(app, argc, argv);
    try {
        const Ladder ladder(root, programs);
        ladder.complete(options);
        Table table(ladder, options);
        table.run();
        std::fputs(table.text().c_str(), stdout);
        if (!page.empty()) writeIntoPage(page, table.text());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rule_table: error: %s\n", error.what());
        return 1;
    }
}
