// Each frame against its blessed hashes first, then against pictures under the case's rule.
#include "frame_check/check.hpp"

#include "frame_check/bless.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fnmatch.h>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;

// A picture to compare with, and what drew it.
struct Reference {
    fs::path file;
    Image image;
    std::string renderer;
};

// The case's own picture first. Throws std::runtime_error where there is none, or one that is not blessed: it
// would lead whoever looks at it astray.
std::vector<Reference> referencesOf(const Suite& suite, const Case& one) {
    const fs::path own = suite.pictureOf(one.name);
    if (own.empty() || one.blessed.empty())
        throw std::runtime_error(
            "there is no blessed picture; look at the frame, which --report FILE.html shows, then " +
            blessLine(suite, one));
    std::vector<Reference> references;
    const auto add = [&](const fs::path& file) {
        Image image = loadImage(file);
        const std::string hash = measure::pixelHash(image);
        const auto by = std::find_if(one.blessed.begin(), one.blessed.end(),
                                     [&](const Blessing& blessing) { return blessing.hash == hash; });
        if (by == one.blessed.end())
            throw std::runtime_error(file.filename().string() + " is none that " + one.name +
                                     ".json blesses; bring back what was blessed, or bless again");
        references.push_back({file, std::move(image), by->renderer});
    };
    add(own);
    for (const Blessing& blessing : one.blessed)
        if (!blessing.picture.empty()) add(suite.folder / blessing.picture);
    return references;
}

// Compares with each reference until one is near enough; else with the one that is nearest.
void compareWith(const std::vector<Reference>& references, const Image& image, const Rule& rule,
                 bool keeps_map, CaseResult& result) {
    for (const Reference& reference : references) {
        Measurement measurement = measure(reference.image, image, keeps_map);
        const bool passes = satisfies(rule, measurement);
        const bool is_nearer =
            !result.measurement || !result.measurement->comparison.comparable() ||
            (measurement.comparison.comparable() &&
             measurement.comparison.differing() < result.measurement->comparison.differing());
        if (!passes && !is_nearer) continue;
        result.reference = reference.file;
        result.reference_renderer = reference.renderer;
        result.measurement = std::move(measurement);
        if (passes) break;
    }
    const Measurement& nearest = *result.measurement;
    result.why = nearest.comparison.incomparable;
    result.outcome = !nearest.comparison.comparable() ? Outcome::incomparable
                     : nearest.comparison.identical() ? Outcome::same
                     : satisfies(rule, nearest)       ? Outcome::tolerated
                                                      : Outcome::different;
}

void judge(const Suite& suite, const Case& one, const Frame& frame, bool keeps_map, CaseResult& result) {
    result.frame = frame.file;
    const std::vector<Reference> references = referencesOf(suite, one);
    result.reference = references.front().file;
    result.reference_renderer = references.front().renderer;
    if (!frame.error.empty()) throw std::runtime_error("cannot be drawn: " + frame.error);
    const Image image = loadImage(frame.file);
    result.hash = measure::pixelHash(image);
    if (one.isBlessed(result.hash)) {
        result.outcome = Outcome::same;
        return;
    }
    compareWith(references, image, suite.ruleOf(one), keeps_map, result);
}

void describe(const Suite& suite, const Case& one, CaseResult& result) {
    result.settings = one.settings.is_object() ? one.settings.dump() : "{}";
    result.bless_line = blessLine(suite, one);
    try {
        result.render_line = commandLine(suite, one);
    } catch (const std::exception& error) {
        result.render_line = error.what();
    }
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Draws what differs again, with its intermediate targets, and finds those that are not what they were when
// the frame was blessed on this renderer.
void findTargets(const Suite& suite, SuiteResult& checked) {
    const std::string cpu = cpuFeatures();
    std::vector<CaseResult*> results;
    std::vector<const Case*> cases;
    for (CaseResult& result : checked.cases) {
        const Case* one = suite.find(result.name);
        if (result.outcome != Outcome::different || one == nullptr) continue;
        const Blessing* blessing = one->blessingFor(checked.renderer);
        // Another processor may round a target otherwise that is no cause of anything.
        if (blessing == nullptr || !blessing->targets.is_object() || blessing->cpu != cpu) continue;
        results.push_back(&result);
        cases.push_back(one);
    }
    if (cases.empty()) return;
    Rendering rendering(suite, cases, true);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Frame frame = rendering.next();
        if (!frame.error.empty()) continue;
        const nlohmann::ordered_json blessed = cases[i]->blessingFor(checked.renderer)->targets;
        const nlohmann::ordered_json drawn = targetHashes(frame.targets);
        for (const auto& [name, hash] : drawn.items())
            results[i]->targets.push_back({name, !blessed.contains(name) || blessed.at(name) != hash});
        for (const auto& [name, hash] : blessed.items())
            if (!drawn.contains(name)) results[i]->targets.push_back({name, true});
    }
}

} // namespace

std::string CaseResult::firstDifferent() const {
    const auto found =
        std::find_if(targets.begin(), targets.end(), [](const Target& target) { return target.differs; });
    return found == targets.end() ? "" : found->name;
}

bool isChosen(const Suite& suite, const Case& one, const std::vector<std::string>& patterns) {
    return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
               return fnmatch(pattern.c_str(), one.name.c_str(), 0) == 0 ||
                      fnmatch(pattern.c_str(), (suite.name + "/" + one.name).c_str(), 0) == 0;
           });
}

SuiteResult check(const Suite& suite, const CheckOptions& options) {
    SuiteResult checked{.name = suite.name};
    std::vector<const Case*> cases;
    for (const Case& one : suite.cases)
        if (isChosen(suite, one, options.patterns)) cases.push_back(&one);
    if (options.patterns.empty()) checked.problems = problemsOf(suite);
    if (cases.empty()) return checked;
    std::shared_ptr<Rendering> rendering;
    std::string cannot_start;
    try {
        rendering = std::make_shared<Rendering>(suite, cases);
    } catch (const std::exception& error) {
        cannot_start = error.what();
    }
    checked.frames = rendering;
    bool all_same = true;
    for (const Case* one : cases) {
        const auto begin = std::chrono::steady_clock::now();
        CaseResult result{.suite = suite.name,
                          .name = one->name,
                          .rule = suite.ruleOf(*one),
                          .json_file = suite.fileOf(one->name)};
        try {
            const Frame frame = rendering ? rendering->next() : Frame{.error = cannot_start};
            judge(suite, *one, frame, options.keeps_maps, result);
        } catch (const std::exception& error) {
            result.why = error.what();
        }
        if (result.outcome != Outcome::same) {
            all_same = false;
            describe(suite, *one, result);
        }
        result.seconds = secondsSince(begin);
        checked.cases.push_back(std::move(result));
    }
    if (all_same) return checked;
    try {
        checked.renderer = rendererOf(suite);
        if (options.looks_at_targets && hasTargets(suite)) findTargets(suite, checked);
    } catch (const std::exception& error) {
        checked.problems.push_back(error.what());
    }
    return checked;
}

CaseResult check(const fs::path& frame, const fs::path& reference, const Rule& rule, bool keeps_map) {
    const auto begin = std::chrono::steady_clock::now();
    CaseResult result{.name = frame.filename().string(), .rule = rule};
    result.frame = frame;
    result.reference = reference;
    try {
        const Image image = loadImage(frame);
        result.hash = measure::pixelHash(image);
        std::vector<Reference> references;
        references.push_back({reference, loadImage(reference), ""});
        compareWith(references, image, rule, keeps_map, result);
    } catch (const std::exception& error) {
        result.why = error.what();
    }
    result.seconds = secondsSince(begin);
    return result;
}

nlohmann::ordered_json targetHashes(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    auto hashes = nlohmann::ordered_json::object();
    for (const fs::path& file : files) {
        std::string name = file.stem().string();
        const auto digits = std::find_if_not(name.begin(), name.end(), [](char c) {
            return std::isdigit(static_cast<unsigned char>(c)) != 0;
        });
        if (digits != name.begin() && digits != name.end() && *digits == '_')
            name.erase(name.begin(), digits + 1);
        hashes[name] = measure::pixelHash(loadImage(file));
    }
    return hashes;
}

} // namespace gll::frame_check
