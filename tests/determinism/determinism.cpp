// The same frame bit for bit: again, with any number of threads, through OSMesa and EGL, after other sizes
// and frames, in a sequence, from another folder, in German, in every build of the project. Without AVX:
// within the case's rule. Usage: determinism prepare LOCALES RUNG, which makes the German; determinism
// LOCALES RUNG GOLDENS OUTPUT
#include "frame_check/bless.hpp"
#include "frame_check/suite.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace {
using namespace gll;
using namespace gll::test;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* german = "de_DE.UTF-8";
constexpr const char* without_avx = "sse4.1"; // what GALLIUM_OVERRIDE_CPU_CAPS leaves of the processor

struct Picture {
    std::string file;
    Json line;               // of --batch, without "out"
    std::string equals = {}; // the picture of the same run that it has to equal
};

// One run of the rung. Members that are off leave it as it is usually called.
struct Way {
    std::string name;
    int threads = 4; // of the rasteriser, LP_NUM_THREADS
    bool through_egl = false;
    bool elsewhere = false; // from another folder
    bool in_german = false;
    bool backwards = false; // the pictures from the last to the first, each thus after others
    bool without_avx = false;
};
const Way usual{.name = "usual"};

// Frames that are beyond their rule without AVX, and why. Fused multiplication and addition goes with it, so
// that the last bit of a coordinate is another, and what is drawn there jumps with that bit.
const std::string far_bricks = "far bricks are read without mipmaps, and many texels fall into a pixel";
const std::string edges = "edges of shadows, occluders and bricks fall right on a pixel";
const std::map<std::string, std::string> beyond_without_avx = {{"06_gbuffer/frame_060", far_bricks},
                                                               {"06_gbuffer/recommended", far_bricks},
                                                               {"07_shadow_map/frame_060", edges},
                                                               {"07_shadow_map/recommended", edges},
                                                               {"08_ssao/frame_060", edges}};

class Rung {
  public:
    Rung(fs::path locales, const fs::path& rung, const fs::path& goldens)
        : locales_(std::move(locales)), rung_(fs::absolute(rung)),
          suite_(frame_check::readSuites(goldens).front()),
          listed_(Json::parse(runToSuccess({rung_, {"--settings", "--json"}}).out)) {
        addPictures();
    }

    // Whether all is as it should be; says what is not.
    bool check() {
        draw(usual, pictures_);
        for (const Picture& picture : pictures_)
            if (!picture.equals.empty() && !isSame(usual, picture.equals, usual, picture.file))
                is_right_ = false;
        checkBuilds();
        checkAllAtOnce();
        // Some rungs with one thread, the others with two: four and none were tried above.
        const Way fewer{.name = "fewer threads", .threads = rung_.filename().string()[1] % 2 == 0 ? 1 : 2};
        draw(fewer, {pictures_.front()});
        if (!isSame(usual, pictures_.front().file, fewer, pictures_.front().file)) is_right_ = false;
        checkWithoutAvx();
        return is_right_;
    }

    // Why frames of other builds were not compared; empty where they were.
    const std::string& note() const { return note_; }

  private:
    // Sizes that no row of SIMD lanes or tile divides evenly, so that edges would show; then every target.
    void addPictures() {
        for (const char* name : {"frame_060", "recommended", "mipmapped_glossy_floor", "cascades"})
            if (const frame_check::Case* one = suite_.find(name)) {
                cases_.push_back(one);
                pictures_.push_back({one->name + ".png", one->settings});
            }
        if (cases_.empty()) throw std::runtime_error(suite_.folder.string() + ": has no case frame_060");
        pictures_.push_back({"odd.png", {{"frame", 1}, {"size", "641x479"}}});
        pictures_.push_back({"tiny.png", {{"frame", 180}, {"size", "2x3"}}});
        pictures_.push_back({"run_%d.png", {{"frames", "3..9:3"}, {"size", "64x48"}}});
        pictures_.push_back({"alone.png", {{"frame", 9}, {"size", "64x48"}}, "run_9.png"});
        for (const std::string target : listed_.at("targets"))
            pictures_.push_back({target + ".exr", {{"frame", 60}, {"size", "167x111"}, {"target", target}}});
        // Every number written out as it is by default: a comma in place of its point would make it another.
        Json spelled = cases_.front()->settings;
        for (const Json& setting : listed_.at("settings"))
            if (setting.at("kind") == "number")
                spelled["set"].push_back(setting.at("name").get<std::string>() + "=" +
                                         setting.at("default").dump());
        pictures_.push_back({"spelled.png", spelled, pictures_.front().file});
        pictures_.push_back({"again.png", pictures_.front().line, pictures_.front().file});
    }

    fs::path fileOf(const Way& way, const std::string& picture) const { return folder_ / way.name / picture; }

    void draw(const Way& way, std::vector<Picture> pictures) const {
        if (way.backwards) std::reverse(pictures.begin(), pictures.end());
        fs::create_directories(folder_ / way.name);
        std::string lines;
        for (const Picture& picture : pictures) {
            Json line = picture.line;
            line["out"] = fileOf(way, picture.file).string();
            lines += line.dump() + "\n";
        }
        const fs::path batch = folder_.write(way.name + ".jsonl", lines);
        Command command{.program = rung_, .arguments = {"--headless", "--batch", batch.string()}};
        if (way.through_egl) command.arguments.insert(command.arguments.end(), {"--context", "egl"});
        command.environment["LP_NUM_THREADS"] = std::to_string(way.threads);
        if (way.elsewhere) command.folder = folder_.path();
        if (way.in_german) {
            command.environment["LC_ALL"] = german;
            command.environment["LOCPATH"] = locales_.string();
        }
        if (way.without_avx) command.environment["GALLIUM_OVERRIDE_CPU_CAPS"] = without_avx;
        runToSuccess(command);
    }

    // Says where it is not.
    bool isSame(const Way& way, const std::string& picture, const Way& other_way,
                const std::string& other) const {
        const std::string bytes = contents(fileOf(way, picture));
        if (!bytes.empty() && bytes == contents(fileOf(other_way, other))) return true;
        const auto comparison =
            measure::compare(loadImage(fileOf(way, picture)), loadImage(fileOf(other_way, other)));
        if (comparison.identical()) return true;
        std::printf("%s/%s and %s/%s DIFFER: %s\n%s", way.name.c_str(), picture.c_str(),
                    other_way.name.c_str(), other.c_str(),
                    comparison.comparable() ? comparison.summary().c_str() : comparison.incomparable.c_str(),
                    comparison.comparable() ? comparison.map().c_str() : "");
        return false;
    }

    // Draws all pictures this way; whether they are the usual ones, up to the first that is not.
    bool isUsual(const Way& way) const {
        draw(way, pictures_);
        return std::all_of(pictures_.begin(), pictures_.end(), [&](const Picture& picture) {
            return isSame(usual, written(picture), way, written(picture));
        });
    }

    // Many differences from the usual in one run, because each run costs a start; only where a picture is
    // another is each difference tried by itself.
    void checkAllAtOnce() {
        if (isUsual({.name = "all at once",
                     .threads = 0,
                     .through_egl = true,
                     .elsewhere = true,
                     .in_german = true,
                     .backwards = true}))
            return;
        is_right_ = false;
        for (const Way& way :
             {Way{.name = "no threads", .threads = 0}, Way{.name = "EGL", .through_egl = true},
              Way{.name = "from another folder", .elsewhere = true},
              Way{.name = "in German", .in_german = true}, Way{.name = "backwards", .backwards = true}})
            std::printf("by itself, %s: %s\n", way.name.c_str(), isUsual(way) ? "the same" : "ANOTHER");
    }

    // Of a sequence, its last.
    static std::string written(const Picture& picture) {
        return picture.line.contains("frames") ? "run_9.png" : picture.file;
    }

    // A hash that was blessed on this renderer and processor is the frame of every build: release, debug and
    // sanitized ones each compare with it.
    void checkBuilds() {
        const std::string renderer = listed_.at("renderer");
        const std::string cpu = frame_check::cpuFeatures();
        for (const frame_check::Case* one : cases_) {
            const std::string hash = measure::pixelHash(loadImage(fileOf(usual, one->name + ".png")));
            const auto here =
                std::find_if(one->blessed.begin(), one->blessed.end(), [&](const auto& blessing) {
                    return blessing.renderer == renderer && blessing.cpu == cpu;
                });
            if (one->isBlessed(hash)) continue;
            if (here == one->blessed.end()) {
                note_ = "no hash is blessed on " + renderer + ", " + cpu +
                        ": frames of other builds are not compared";
                continue;
            }
            std::printf("%s: %s is not %s, which another build drew on this renderer and processor\n",
                        one->name.c_str(), hash.c_str(), here->hash.c_str());
            is_right_ = false;
        }
    }

    // An excuse that is not needed on the renderer and processor that the goldens are from is none.
    void checkWithoutAvx() {
        const Way way{.name = "without AVX", .without_avx = true};
        draw(way, {pictures_.begin(), pictures_.begin() + static_cast<std::ptrdiff_t>(cases_.size())});
        for (const frame_check::Case* one : cases_) {
            const std::string file = one->name + ".png";
            const frame_check::Measurement measurement =
                frame_check::measure(loadImage(fileOf(usual, file)), loadImage(fileOf(way, file)), false);
            const auto excuse = beyond_without_avx.find(suite_.name + "/" + one->name);
            const bool is_excused = excuse != beyond_without_avx.end();
            const bool is_within = frame_check::satisfies(suite_.ruleOf(*one), measurement);
            std::printf("%s without AVX: %s%s\n", one->name.c_str(), measurement.line().c_str(),
                        is_within    ? ""
                        : is_excused ? ("; " + excuse->second).c_str()
                                     : "; BEYOND ITS RULE");
            if (!is_within && !is_excused) {
                std::fputs(measurement.comparison.map().c_str(), stdout);
                is_right_ = false;
            }
            if (is_within && is_excused && note_.empty() && !measurement.comparison.identical()) {
                std::puts("that is WITHIN ITS RULE, take it out of beyond_without_avx");
                is_right_ = false;
            }
        }
    }

    fs::path locales_;
    fs::path rung_;
    frame_check::Suite suite_;
    Json listed_;
    std::vector<const frame_check::Case*> cases_;
    std::vector<Picture> pictures_;
    TemporaryFolder folder_;
    bool is_right_ = true;
    std::string note_;
};

// German from the sources of Debian's package locales, whether or not this machine has it; and a look at
// whether what is to change something does.
void prepare(const fs::path& locales, const fs::path& rung) {
    fs::remove_all(locales);
    fs::create_directories(locales);
    runToSuccess(
        {"/usr/bin/localedef", {"--no-archive", "-i", "de_DE", "-f", "UTF-8", (locales / german).string()}});
    setenv("LOCPATH", locales.c_str(), 1);
    if (std::setlocale(LC_ALL, german) == nullptr || std::string(std::localeconv()->decimal_point) != ",")
        throw std::runtime_error(locales.string() + ": is no German, whose numbers have a comma");
    const auto rendererWith = [&](const std::optional<std::string>& caps) -> std::string {
        return Json::parse(
                   runToSuccess({rung, {"--settings", "--json"}, {{"GALLIUM_OVERRIDE_CPU_CAPS", caps}}}).out)
            .at("renderer");
    };
    const std::string narrow = rendererWith(without_avx);
    std::printf("without AVX: %s\n", narrow.c_str());
    // A processor that has no AVX draws no other frames.
    if (narrow == rendererWith(std::nullopt) && frame_check::cpuFeatures().find("avx") != std::string::npos)
        throw std::runtime_error("GALLIUM_OVERRIDE_CPU_CAPS changes nothing");
}

int run(const std::vector<std::string>& words) {
    if (words.size() == 3 && words[0] == "prepare") {
        prepare(words[1], words[2]);
        return 0;
    }
    if (words.size() != 4) {
        std::fprintf(stderr,
                     "usage: determinism prepare LOCALES RUNG, or determinism LOCALES RUNG GOLDENS OUTPUT\n");
        return 2;
    }
    Rung rung(words[0], words[1], words[2]);
    const bool is_right = rung.check();
    // tests/run shows what tests that passed have to say where they leave it in such a file.
    const fs::path warnings = fs::path(words[3]) / "warnings.txt";
    fs::remove(warnings);
    if (!rung.note().empty()) {
        fs::create_directories(warnings.parent_path());
        if (std::FILE* file = std::fopen(warnings.c_str(), "w"); file != nullptr) {
            std::fprintf(file, "%s: %s\n", fs::path(words[1]).filename().c_str(), rung.note().c_str());
            std::fclose(file);
        }
    }
    return is_right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "determinism: error: %s\n", error.what());
        return 1;
    }
}
