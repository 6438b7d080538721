// What blessing writes: hashes and pictures, with who drew them and why they were accepted.
#include "frame_check/bless.hpp"

#include "frame_check/check.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

void requireReason(const BlessOptions& options) {
    requirePerson();
    if (options.because.find_first_not_of(" \t\n") == std::string::npos)
        throw std::runtime_error("say why the frames are right: --because TEXT");
}

// A number, true, false, a list or an object where it reads as one, else the text itself.
Json valueIn(const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() || value.is_null() || value.is_string() ? Json(text) : value;
}

Json settingsIn(const std::vector<std::string>& settings, Json result) {
    for (const std::string& setting : settings) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("--setting " + setting + ": write KEY=VALUE");
        const std::string key = setting.substr(0, equals);
        // What is within a setting keeps its spelling: 1.50 stays 1.50.
        const auto dot = key.find('.');
        if (dot != std::string::npos) {
            result[key.substr(0, dot)][key.substr(dot + 1)] = setting.substr(equals + 1);
            continue;
        }
        const auto is_this = [&](const std::string& other) { return other.starts_with(key + "="); };
        if (std::count_if(settings.begin(), settings.end(), is_this) > 1) {
            if (!result[key].is_array()) result[key] = Json::array();
            result[key].push_back(valueIn(setting.substr(equals + 1)));
        } else {
            result[key] = valueIn(setting.substr(equals + 1));
        }
    }
    return result;
}

// The cases to bless, a new one added to the suite.
std::vector<const Case*> chosenCases(Suite& suite, const BlessOptions& options) {
    if (options.makes) {
        if (options.names.size() != 1) throw std::runtime_error("settings describe one new case; name it");
        const std::string& name = options.names.front();
        if (options.adds)
            throw std::runtime_error("--also adds to cases that are there, and this makes a new one");
        if (name.empty() || name.find('/') != std::string::npos || name[0] == '.')
            throw std::runtime_error("\"" + name + "\" is no name for a case, which becomes a file's");
        if (suite.find(name) != nullptr)
            throw std::runtime_error(name + " is there already; change its .json instead");
        suite.cases.push_back({.name = name, .settings = settingsIn(options.settings, suite.defaults)});
        return {&suite.cases.back()};
    }
    if (!options.settings.empty()) throw std::runtime_error("--setting describes a new case; add --new");
    std::vector<const Case*> cases;
    if (options.names.empty())
        for (const Case& one : suite.cases)
            cases.push_back(&one);
    for (const std::string& name : options.names) {
        const Case* one = suite.find(name);
        if (one == nullptr)
            throw std::runtime_error(name + ": there is no such case in " + suite.folder.string() +
                                     "; --new makes one");
        cases.push_back(one);
    }
    if (cases.empty()) throw std::runtime_error(suite.folder.string() + ": holds no case to bless");
    return cases;
}

struct Drawn {
    std::optional<Image> image = {};
    Json targets = {};
    std::string error = {};
};

std::vector<Drawn> draw(const Suite& suite, const std::vector<const Case*>& cases, bool wants_targets) {
    std::vector<Drawn> drawn;
    Rendering rendering(suite, cases, wants_targets);
    while (!rendering.atEnd()) {
        const Frame frame = rendering.next();
        Drawn one{.error = frame.error};
        if (frame.error.empty()) {
            one.image = loadImage(frame.file);
            if (!frame.targets.empty()) one.targets = targetHashes(frame.targets);
        }
        drawn.push_back(std::move(one));
    }
    return drawn;
}

// What depends on chance, on the frame before or on a program that is being changed is no reference.
void requireAlike(const Suite& suite, const Case& one, const Image& first, const Image& again,
                  const std::string& how, const std::string& what_to_do) {
    const Measurement twice = measure(first, again, false);
    if (!satisfies(suite.ruleOf(one), twice))
        throw std::runtime_error("is not " + how + ", " + twice.line() + "; " + what_to_do);
}

class Blesser {
  public:
    Blesser(const Suite& suite, const BlessOptions& options)
        : suite_(suite), options_(options), renderer_(rendererOf(suite)), cpu_(cpuFeatures()) {}

    // What became of it, in words; throws where it is not accepted.
    std::string bless(Case one, const Drawn& drawn) const {
        const Image& image = *drawn.image;
        Blessing blessing{.hash = measure::pixelHash(image),
                          .renderer = renderer_,
                          .date = today(),
                          .because = options_.because,
                          .cpu = cpu_,
                          .targets = drawn.targets};
        const fs::path picture = suite_.pictureOf(one.name);
        const bool is_new = picture.empty() || one.blessed.empty();
        if (options_.adds && is_new)
            throw std::runtime_error("--also adds to a blessed picture, and there is none");
        if (!is_new && one.isBlessed(blessing.hash)) return blessedAlready(std::move(one), blessing);
        if (is_new) return replace(std::move(one), blessing, image, "new picture");

        const Measurement measurement = measure(loadImage(picture), image, false);
        const std::string how = measurement.line() + "\n" + measurement.comparison.map();
        // The same picture as another renderer draws it: both are right, and the picture stays.
        const bool is_near = satisfies(suite_.ruleOf(one), measurement);
        const bool is_known = one.blessingFor(renderer_) != nullptr;
        if (options_.adds && is_known)
            throw std::runtime_error("has a hash of " + renderer_ +
                                     " already, and draws another frame now; without --also, it is replaced");
        if (!options_.adds && (is_known || !is_near))
            return replace(std::move(one), blessing, image, how + "picture replaced");
        if (!is_near) {
            blessing.picture = freeName(one.name);
            saveImage(suite_.folder / blessing.picture, image);
        }
        one.blessed.push_back(blessing);
        writeCase(suite_.fileOf(one.name), one);
        return how + "hash on " + renderer_ + " added" + (is_near ? "" : ", and its picture");
    }

  private:
    // The targets of a frame that is as it was may be what this version of the program was not asked for
    // before.
    std::string blessedAlready(Case one, const Blessing& now) const {
        for (Blessing& before : one.blessed) {
            if (before.hash != now.hash || before.renderer != now.renderer || !now.targets.is_object() ||
                (before.targets == now.targets && before.cpu == now.cpu))
                continue;
            before.targets = now.targets;
            before.cpu = now.cpu; // which may round targets otherwise where the frame is the same
            writeCase(suite_.fileOf(one.name), one);
            return "blessed already; its intermediate targets are noted";
        }
        return "blessed already";
    }

    std::string replace(Case one, const Blessing& blessing, const Image& image,
                        const std::string& what) const {
        std::string gone; // by other renderers, whose frames nobody here can look at
        for (const Blessing& before : one.blessed) {
            if (!before.picture.empty()) fs::remove(suite_.folder / before.picture);
            if (before.renderer == renderer_) continue;
            gone += (gone.empty() ? "" : ", ") +
                    (before.renderer.empty() ? "an unnamed renderer" : before.renderer) +
                    (before.picture.empty() ? "" : " (" + before.picture + ")");
        }
        const fs::path picture = suite_.pictureOf(one.name);
        saveImage(picture.empty() ? suite_.folder / (one.name + "." + suite_.format) : picture, image);
        one.blessed = {blessing};
        writeCase(suite_.fileOf(one.name), one);
        addToList(suite_, one.name);
        return what + (gone.empty() ? ""
                                    : "; gone with it is what was blessed of " + gone +
                                          ": look at it anew, and add it there by --also");
    }

    // NAME.2.png, NAME.3.png, ...
    std::string freeName(const std::string& name) const {
        for (int number = 2;; ++number) {
            std::string file =
                name + "." + std::to_string(number) + suite_.pictureOf(name).extension().string();
            if (!fs::exists(suite_.folder / file)) return file;
        }
    }

    const Suite& suite_;
    const BlessOptions& options_;
    std::string renderer_;
    std::string cpu_;
};

} // namespace

bool bless(Suite suite, const BlessOptions& options) {
    requireReason(options);
    std::vector<const Case*> cases = chosenCases(suite, options);
    const Blesser blesser(suite, options);
    const std::vector<Drawn> frames = draw(suite, cases, hasTargets(suite));
    // Once more from the last to the first: a frame that depends on chance, or on the one before, is no
    // reference.
    std::reverse(cases.begin(), cases.end());
    std::vector<Drawn> again = draw(suite, cases, false);
    std::reverse(cases.begin(), cases.end());
    std::reverse(again.begin(), again.end());
    bool all = true;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        std::string became;
        try {
            for (const Drawn* drawn : {std::as_const(frames).data() + i, std::as_const(again).data() + i})
                if (!drawn->image) throw std::runtime_error("cannot be drawn: " + drawn->error);
            requireAlike(suite, *cases[i], *frames[i].image, *again[i].image, "the same twice",
                         "mend what it depends on, or give it a rule that allows for it");
            became = blesser.bless(*cases[i], frames[i]);
        } catch (const std::exception& error) {
            became = std::string("NOT BLESSED: ") + error.what();
            all = false;
        }
        std::printf("%s: %s\n", cases[i]->name.c_str(), became.c_str());
    }
    return all;
}

void requirePerson() {
    const char* ci = std::getenv("CI");
    if (ci != nullptr && *ci != '\0' && std::string(ci) != "false")
        throw std::runtime_error("blessing is for people who have looked at the pictures; CI is set here");
}

std::string accept(const Suite& suite, const std::string& name, const Image& shown,
                   const BlessOptions& options) {
    requireReason(options);
    const Case* one = suite.find(name);
    if (one == nullptr) throw std::runtime_error("the case is gone from " + suite.folder.string());
    const Drawn again = draw(suite, {one}, hasTargets(suite)).front();
    if (!again.image) throw std::runtime_error("cannot be drawn again: " + again.error);
    requireAlike(suite, *one, shown, *again.image, "drawn again as it is shown",
                 "begin the review anew where the program has changed, or mend what the frame depends on");
    Drawn accepted{.image = shown};
    if (measure::pixelHash(*again.image) == measure::pixelHash(shown)) accepted.targets = again.targets;
    return Blesser(suite, options).bless(*one, accepted);
}

std::string cpuFeatures() {
    std::string text;
#if defined(__x86_64__) || defined(__i386__)
    const auto add = [&](bool has, const char* name) {
        text += has ? (text.empty() ? "" : " ") + std::string(name) : "";
    };
    add(__builtin_cpu_supports("sse4.1") != 0, "sse4.1");
    add(__builtin_cpu_supports("avx") != 0, "avx");
    add(__builtin_cpu_supports("avx2") != 0, "avx2");
    add(__builtin_cpu_supports("fma") != 0, "fma");
    add(__builtin_cpu_supports("avx512f") != 0, "avx512f");
#endif
    if (const char* caps = std::getenv("GALLIUM_OVERRIDE_CPU_CAPS"))
        text += std::string(text.empty() ? "" : ", ") + "GALLIUM_OVERRIDE_CPU_CAPS=" + caps;
    return text;
}

} // namespace gll::frame_check
