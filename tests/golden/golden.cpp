// Renders a rung's golden cases in one process and compares them with the blessed pictures; or blesses them.
// Run by ctest for comparing and by tests/bless for blessing; a run that compares never writes a golden.
#include "golden/case.hpp"
#include "golden/complete.hpp"
#include "golden/report.hpp"
#include "support/comparison.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace {
using namespace gll;
using namespace gll::test;
namespace fs = std::filesystem;

struct Task {
    fs::path program;      // the rung
    fs::path goldens;      // the folder with its cases
    fs::path output;       // the folder for frames, the report and warnings
    bool complete = false; // every setting has to have its cases
};

// Frames are only comparable from one rasteriser, so that is no choice of the environment's.
const std::map<std::string, std::optional<std::string>> rasteriser = {{"GALLIUM_DRIVER", "llvmpipe"},
                                                                      {"LIBGL_ALWAYS_SOFTWARE", "1"}};

Result runRung(const Task& task, std::vector<std::string> arguments) {
    return runToSuccess({task.program, std::move(arguments), rasteriser});
}

struct Drawn {
    std::optional<Image> image;
    std::string error = {}; // why there is none
};

// All frames from one process, because starting one takes longer than a frame. A case that cannot be drawn
// does not stop the others.
std::vector<Drawn> renderAll(const Task& task, const std::vector<GoldenCase>& cases) {
    const TemporaryFolder folder;
    const auto frameFile = [&](std::size_t i) { return folder / (std::to_string(i + 1) + ".png"); };
    std::string lines;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        nlohmann::ordered_json line = batchLine(cases[i], task.goldens);
        line["out"] = frameFile(i).string();
        lines += line.dump() + "\n";
    }
    const fs::path batch = folder.write("batch.jsonl", lines);
    const Result result = run({task.program, {"--context", "osmesa", "--batch", batch.string()}, rasteriser},
                              std::chrono::seconds(110));
    std::map<std::string, std::string> errors; // by the number of the line
    std::string last_line;
    std::istringstream messages(result.err);
    const std::string before = "error: " + batch.string() + ":";
    for (std::string line; std::getline(messages, line); last_line = line)
        if (const auto at = line.find(before); at != std::string::npos) {
            const auto number = at + before.size();
            const auto colon = line.find(':', number);
            errors[line.substr(number, colon - number)] = line.substr(std::min(colon + 2, line.size()));
        }
    std::vector<Drawn> drawn;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto error = errors.find(std::to_string(i + 1));
        if (error != errors.end())
            drawn.push_back({.image = {}, .error = error->second});
        else if (fs::exists(frameFile(i)))
            drawn.push_back({.image = loadImage(frameFile(i))});
        else
            drawn.push_back({.image = {},
                             .error = task.program.filename().string() + " ended with " +
                                      std::to_string(result.exit_code) + " before it: " + last_line});
    }
    return drawn;
}

std::string rendererOf(const Task& task) {
    const auto json = nlohmann::json::parse(runRung(task, {"--settings", "--json"}).out);
    if (!json.contains("renderer")) throw std::runtime_error("no OpenGL context: " + json.dump());
    return json.at("renderer");
}

// Pictures without a description would never be compared with anything.
std::vector<std::string> orphans(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".png" &&
            !fs::exists(fs::path(entry.path()).replace_extension(".json")))
            names.push_back(entry.path().filename().string());
    return names;
}

int check(const Task& task) {
    const std::string rung = task.program.filename().string();
    const std::vector<GoldenCase> cases = readCases(task.goldens);
    if (cases.empty()) throw std::runtime_error(task.goldens.string() + ": no golden case; see tests/bless");
    fs::remove_all(task.output);
    fs::create_directories(task.output);
    const std::vector<Drawn> frames = renderAll(task, cases);
    std::vector<ReportEntry> entries;
    std::string warnings;
    int failures = 0;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const GoldenCase& golden = cases[i];
        if (!frames[i].image) {
            std::printf("%s failed: cannot be drawn: %s\n", golden.name.c_str(), frames[i].error.c_str());
            ++failures;
            continue;
        }
        ++compared;
        const Image& frame = *frames[i].image;
        const std::string hash = pixelHash(frame);
        const fs::path reference_file = task.goldens / (golden.name + ".png");
        const bool has_reference = fs::exists(reference_file) && !golden.blessed.empty();
        // A picture that is not the one its .json blesses would lead whoever looks at it astray.
        if (has_reference && !golden.isBlessed(pixelHash(loadImage(reference_file)))) {
            std::printf("%s failed: its .png is none that its .json blesses\n", golden.name.c_str());
            ++failures;
        }
        if (has_reference && golden.isBlessed(hash)) continue;

        ReportEntry entry{
            .name = golden.name, .request = golden.request.dump(), .image = golden.name + ".new.png"};
        saveImage(task.output / entry.image, frame);
        if (!has_reference) {
            entry.verdict = "failed: there is no blessed picture; look at the frame, then tests/bless " +
                            rung + " " + golden.name;
            ++failures;
            std::printf("%s %s\n", golden.name.c_str(), entry.verdict.c_str());
            entries.push_back(entry);
            continue;
        }
        const Image reference = loadImage(reference_file);
        const Comparison comparison = compare(reference, frame);
        const bool tolerable = comparison.tolerable();
        entry.verdict =
            (tolerable ? "warning, tolerated: " : "failed: ") + comparison.summary() + ", hash " + hash;
        failures += tolerable ? 0 : 1;
        if (tolerable) warnings += rung + ", " + golden.name + ": " + entry.verdict + "\n";
        std::printf("%s %s\n%s", golden.name.c_str(), entry.verdict.c_str(), comparison.map().c_str());
        entry.reference = golden.name + ".reference.png";
        entry.difference = golden.name + ".difference.png";
        fs::copy_file(reference_file, task.output / entry.reference);
        saveImage(task.output / entry.difference, amplifiedDifference(reference, frame));
        entries.push_back(entry);
    }
    std::vector<std::string> missing = differencesToList(task.goldens, cases);
    if (task.complete) {
        const auto listed = nlohmann::json::parse(runRung(task, {"--settings", "--json"}).out);
        const auto more =
            missingCases(listed, cases, readExcuses(task.goldens.parent_path() / "excused.json", rung));
        missing.insert(missing.end(), more.begin(), more.end());
    }
    for (const std::string& what : missing) {
        std::printf("%s\n", what.c_str());
        ++failures;
    }
    for (const std::string& name : orphans(task.goldens)) {
        std::printf("%s failed: there is no .json beside it\n", name.c_str());
        ++failures;
    }
    std::printf("%zu frames of %s: %zu as blessed, %d failed\n", cases.size(), rung.c_str(),
                compared - entries.size(), failures);
    // Nobody reads what a test says that passes: tests/run prints this at its end.
    if (!warnings.empty()) std::ofstream(task.output / "warnings.txt") << warnings;
    if (!entries.empty()) {
        std::printf("drawn by %s\n", rendererOf(task).c_str());
        writeReport(task.output / "index.html", rung + ", golden frames", entries);
        std::printf("see %s\n", (task.output / "index.html").c_str());
    }
    return failures == 0 ? 0 : 1;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

// Adds the hash of this renderer's frame and keeps the picture, which is another renderer's, however far the
// two differ: both were looked at. A renderer that has its hash already is drawing something else now.
void blessAlso(const Task& task, GoldenCase golden, const Image& frame, const std::string& renderer) {
    const std::string hash = pixelHash(frame);
    const fs::path picture = task.goldens / (golden.name + ".png");
    if (!fs::exists(picture) || golden.blessed.empty())
        throw std::runtime_error(golden.name + ": --also adds to a blessed picture, and there is none");
    if (golden.isBlessed(hash)) {
        std::printf("%s: blessed already\n", golden.name.c_str());
        return;
    }
    if (golden.isBlessedFor(renderer))
        throw std::runtime_error(golden.name + ": has a hash of " + renderer +
                                 " already, and draws another frame now; without --also, it is replaced");
    std::printf("%s: %s; its hash on %s added\n", golden.name.c_str(),
                compare(loadImage(picture), frame).summary().c_str(), renderer.c_str());
    golden.blessed.push_back({hash, renderer, today()});
    writeCase(task.goldens / (golden.name + ".json"), golden);
}

void blessOne(const Task& task, GoldenCase golden, const Image& frame, const std::string& renderer) {
    const fs::path picture = task.goldens / (golden.name + ".png");
    const std::string hash = pixelHash(frame);
    const bool is_new = !fs::exists(picture) || golden.blessed.empty();
    if (!is_new && golden.isBlessed(hash)) {
        std::printf("%s: blessed already\n", golden.name.c_str());
        return;
    }
    if (!is_new) {
        const Comparison comparison = compare(loadImage(picture), frame);
        std::printf("%s: %s\n%s", golden.name.c_str(), comparison.summary().c_str(),
                    comparison.map().c_str());
        // The same picture as another renderer draws it: both are right, and the picture stays.
        if (comparison.tolerable() && !golden.isBlessedFor(renderer))
            return blessAlso(task, std::move(golden), frame, renderer);
    }
    golden.blessed = {{hash, renderer, today()}};
    fs::create_directories(task.goldens);
    saveImage(picture, frame);
    writeCase(task.goldens / (golden.name + ".json"), golden);
    addToList(task.goldens, golden.name);
    std::printf("%s: %s\n", golden.name.c_str(), is_new ? "new picture" : "picture replaced");
}

int bless(const Task& task, const std::vector<std::string>& names, const nlohmann::ordered_json& settings,
          bool also) {
    const char* ci = std::getenv("CI");
    if (ci != nullptr && *ci != '\0' && std::string(ci) != "false")
        throw std::runtime_error("blessing is for people who have looked at the pictures; CI is set here");
    std::vector<GoldenCase> cases;
    if (!settings.empty()) {
        if (also)
            throw std::runtime_error("--also adds to cases that are there, and settings describe a new one");
        if (names.size() != 1) throw std::runtime_error("settings describe one new case; name it");
        if (fs::exists(task.goldens / (names[0] + ".json")))
            throw std::runtime_error(names[0] + " is there already; change its .json instead");
        cases = {{.name = names[0], .request = settings, .blessed = {}}};
        if (!cases[0].request.contains("frame")) cases[0].request["frame"] = 60;
        if (!cases[0].request.contains("size")) cases[0].request["size"] = "320x240";
    } else if (names.empty()) {
        cases = readCases(task.goldens);
    } else {
        for (const std::string& name : names)
            cases.push_back(readCase(task.goldens / (name + ".json")));
    }
    if (cases.empty()) throw std::runtime_error(task.goldens.string() + ": no case to bless");
    const std::vector<Drawn> frames = renderAll(task, cases);
    const std::string renderer = rendererOf(task);
    int failures = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (frames[i].image) {
            (also ? blessAlso : blessOne)(task, cases[i], *frames[i].image, renderer);
            continue;
        }
        std::printf("%s: cannot be drawn: %s\n", cases[i].name.c_str(), frames[i].error.c_str());
        ++failures;
    }
    return failures == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Checks a rung's golden frames, or blesses them.", "golden");
    Task task;
    std::vector<std::string> names;
    bool blesses = false;
    bool also = false;
    int frame = 0;
    std::string size;
    std::string preset;
    std::string target;
    std::string image;
    std::vector<std::string> injections;
    std::vector<std::string> sets;
    app.add_option("--program", task.program, "the rung")->required();
    app.add_option("--goldens", task.goldens, "the folder with its cases")->required();
    app.add_option("--output", task.output, "the folder for frames and the report");
    app.add_flag("--complete", task.complete, "check too that every setting has its cases");
    app.add_flag("--bless", blesses, "accept the frames as they are now");
    app.add_flag("--also", also, "with --bless: add this renderer's hashes, keep the pictures")
        ->needs("--bless");
    app.add_option("--frame", frame, "of a new case: the frame");
    app.add_option("--size", size, "of a new case: WxH");
    app.add_option("--preset", preset, "of a new case: the preset");
    app.add_option("--target", target, "of a new case: the target");
    app.add_option("--image", image, "of a new case: the picture, from the case's folder");
    app.add_option("--inject", injections, "of a new case: PASS:X,Y:VALUE, may be repeated")
        ->take_all()
        ->expected(1);
    app.add_option("--set", sets, "of a new case: KEY=VALUE, may be repeated")->take_all()->expected(1);
    app.add_option("case", names, "with --bless: the cases, or all");
    CLI11_PARSE(app, argc, argv);
    try {
        nlohmann::ordered_json settings;
        if (frame != 0) settings["frame"] = frame;
        if (!size.empty()) settings["size"] = size;
        if (!preset.empty()) settings["preset"] = preset;
        if (!target.empty()) settings["target"] = target;
        if (!image.empty()) settings["image"] = image;
        if (!injections.empty()) settings["inject"] = injections;
        for (const std::string& set : sets) {
            const auto equals = set.find('=');
            if (equals == std::string::npos) throw std::runtime_error("--set " + set + ": write KEY=VALUE");
            settings["set"][set.substr(0, equals)] = set.substr(equals + 1);
        }
        if (blesses) return bless(task, names, settings, also);
        return check(task);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "golden: error: %s\n", error.what());
        return 1;
    }
}
