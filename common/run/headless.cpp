// Headless rendering: the frames asked for, one after the other, each from its own settings alone.
#include "run/headless.hpp"

#include "budget/budget.hpp"
#include "run/cost.hpp"
#include "rung/capture.hpp"
#include "rung/nearest.hpp"
#include "rung/usage_error.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gll {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int) {
    interrupted = 1;
    std::signal(SIGINT, SIG_DFL); // a second Ctrl-C ends the program at once
}

// Right after a pass was drawn: overwrites pixels where that was asked for, and copies the target of one
// pass.
class PassProbe final : public PassObserver {
  public:
    explicit PassProbe(const FrameRequest& request)
        : target_(request.target), targets_(request.targets), waiting_(request.injections) {}

    void after(const DrawnPass& pass) override {
        std::erase_if(waiting_, [&](const Injection& injection) { return inject(injection, pass); });
        if (pass.name == target_) image = readTexture(pass.target->texture(0));
        if (!targets_.empty()) saveTargets(pass);
    }

    std::optional<Image> image;

    // Throws UsageError where an injection found no pass.
    void requireDone(const std::vector<DrawnPass>& passes) const {
        if (waiting_.empty()) return;
        std::vector<std::string> names = targetNames(passes);
        for (const DrawnPass& pass : passes)
            names.push_back(pass.name);
        throw UsageError("--inject " + waiting_.front().name + ": with these settings there is " +
                         joined(names) + didYouMean(waiting_.front().name, names));
    }

  private:
    static bool inject(const Injection& injection, const DrawnPass& pass) {
        const auto& attachments = pass.target->attachments();
        for (std::size_t i = 0; i < attachments.size(); ++i) {
            if (injection.name != attachments[i].name && (injection.name != pass.name || i > 0)) continue;
            const glm::ivec2 size = pass.target->size();
            if (injection.pixel.x >= size.x || injection.pixel.y >= size.y)
                throw UsageError("--inject " + injection.name + ": there it is " + std::to_string(size.x) +
                                 "x" + std::to_string(size.y) + " pixels");
            if (formatInfo(attachments[i].format).is_depth)
                throw UsageError("--inject " + injection.name + ": is depth; name a colour target");
            pass.target->texture(i).setTexel({injection.pixel.x, size.y - 1 - injection.pixel.y},
                                             injection.value);
            return true;
        }
        return false;
    }

    // 003_bright.exr, or 003_geometry.albedo.exr where a pass draws several.
    void saveTargets(const DrawnPass& pass) {
        const auto& attachments = pass.target->attachments();
        for (std::size_t i = 0; i < attachments.size(); ++i) {
            char number[8];
            std::snprintf(number, sizeof number, "%03d_", ++saved_ % 1000);
            const std::string name =
                number + pass.name + (attachments.size() > 1 ? "." + attachments[i].name : "") + ".exr";
            saveImage(targets_ / name, forFile(readTexture(pass.target->texture(i)), ".exr"));
        }
    }

    std::string target_;
    std::filesystem::path targets_;
    int saved_ = 0;
    std::vector<Injection> waiting_;
};

// Whether the frame of a request is also the one that another, which came right before it, has rendered. The
// same target again is rendered again: whoever asks for it twice compares.
bool isSameFrame(FrameRequest request, const FrameRequest& before) {
    if (request.isSequence() || request.cost || !request.targets.empty() || request.target == before.target)
        return false;
    request.target = before.target;
    request.out = before.out;
    request.readings = before.readings;
    request.batch_line = before.batch_line;
    return request == before;
}

// A target, or what is presented, as it is when the frame ends. Nothing where there is no such target.
std::optional<Image> imageAtEnd(const Renderer& renderer, const std::string& target) {
    if (target.empty()) return renderer.image();
    const Texture* texture = findTarget(renderer.passes(), target);
    return texture ? std::optional(renderer.image(*texture)) : std::nullopt;
}

Image renderImage(Renderer& renderer, const FrameRequest& request, int frame) {
    PassProbe probe(request);
    const auto& passes = renderer.render(frame, request.size, &probe);
    probe.requireDone(passes);
    if (std::optional<Image> image = imageAtEnd(renderer, request.target)) return *image;
    if (probe.image) return *probe.image;
    std::vector<std::string> names = targetNames(passes);
    for (const DrawnPass& pass : passes)
        names.push_back(pass.name);
    throw UsageError("--target " + request.target + ": with these settings there is " + joined(names) +
                     didYouMean(request.target, names));
}

// Says how far a long run is, on a terminal, once two seconds have gone.
class Progress {
  public:
    ~Progress() { clear(); }
    Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void say(const std::string& what) {
        if (asked_by_window_) std::fprintf(stderr, "%s\n", what.c_str());
        if (!on_terminal_) return;
        const auto now = std::chrono::steady_clock::now();
        if (now - start_ < std::chrono::seconds(2) || now - last_ < std::chrono::milliseconds(200)) return;
        last_ = now;
        shown_ = true;
        std::fprintf(stderr, "\r%s\033[K", what.c_str());
    }
    void clear() {
        if (shown_) std::fputs("\r\033[K", stderr);
        shown_ = false;
    }

  private:
    bool on_terminal_ = isatty(fileno(stderr)) != 0;
    bool asked_by_window_ = std::getenv(progress_variable) != nullptr;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point last_ = start_;
};

// The renderer of some files, made anew where a line of a batch names others.
class RendererOfFiles {
  public:
    RendererOfFiles(Context& context, const RungInfo& info) : context_(context), info_(info) {}

    Renderer& operator()(const RungFiles& files) {
        if (!renderer_ || files != given_) {
            renderer_.reset();
            renderer_.emplace(context_, info_, files);
            given_ = files;
        }
        return *renderer_;
    }

  private:
    Context& context_;
    const RungInfo& info_;
    std::optional<Renderer> renderer_;
    RungFiles given_;
};

std::vector<FrameRequest> requestsOf(const Options& options) {
    return options.is_batch ? options.batch : std::vector<FrameRequest>{options.request};
}

std::size_t frameCount(const FrameRequest& request) {
    return static_cast<std::size_t>((request.last_frame - request.first_frame) / request.step) + 1;
}

// A folder that is not there or not writable is an error before rendering, not after.
void checkWritable(const std::filesystem::path& out) {
    const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw std::runtime_error(out.string() + ": the folder " + folder.string() +
                                 " is not there; make it first");
    if (std::filesystem::is_directory(out, error)) throw std::runtime_error(out.string() + ": is a folder");
}

// What a rung was given is never written over, under whatever name.
void checkNoInput(const std::filesystem::path& out, const RungFiles& files) {
    std::error_code ignored; // of a file that is not there yet
    for (const FileOption& option : file_options)
        if (const auto& file = files.*option.file;
            !file.empty() && std::filesystem::equivalent(out, file, ignored))
            throw UsageError("--out " + out.string() + ": is what the frame is made from, name another file");
}

// As lines of text, or as one line of JSON.
void printReadings(const std::vector<Reading>& readings, const FrameRequest& request, int frame, bool json) {
    if (json) {
        nlohmann::ordered_json line{{"frame", frame}, {"size", {request.size.x, request.size.y}}};
        for (const Reading& reading : readings)
            line["readings"][reading.name] = reading.value; // null where it is no finite number
        std::printf("%s\n", line.dump().c_str());
        return;
    }
    std::printf("frame %d, %dx%d\n", frame, request.size.x, request.size.y);
    for (const Reading& reading : readings)
        std::printf("  %-20s %10.6g %s\n", reading.name.c_str(), reading.value, reading.unit.c_str());
}

// is_drawn: the renderer's last frame is the one asked for.
void renderRequest(Renderer& renderer, const FrameRequest& request, bool is_drawn, const Options& options,
                   const RungInfo& info, Settings& settings, const std::function<void()>& rendered) {
    request.applyTo(settings);
    if (!request.out.empty()) checkWritable(request.outFor(request.first_frame));
    if (!request.targets.empty()) checkWritable(request.targets / "001.exr");
    for (int frame = request.first_frame; frame <= request.last_frame && interrupted == 0;
         frame += request.step) {
        std::optional<Image> image;
        if (is_drawn) image = imageAtEnd(renderer, request.target);
        if (!image && (!request.out.empty() || request.readings))
            image = renderImage(renderer, request, frame);
        if (!request.out.empty()) {
            const std::filesystem::path out = request.outFor(frame);
            checkNoInput(out, request.files);
            saveImage(out, forFile(*image, out.extension().string()));
            if (!options.json)
                std::printf("%s: frame %d, %dx%d\n", out.c_str(), frame, request.size.x, request.size.y);
        }
        if (request.readings) {
            const std::vector<Reading> readings = renderer.readings();
            if (readings.empty()) throw UsageError("--readings: " + info.name + " has none");
            printReadings(readings, request, frame, options.json);
        }
        if (request.cost) {
            const CostReport report =
                measureCost(renderer, info, frame, request.size, options.counter, request.passes_only);
            std::fputs((options.json ? costJson(report) : costTable(report)).c_str(), stdout);
        }
        rendered();
    }
    std::fflush(stdout);
}

// Searches, prints, and adds what was found to the request, which then renders it. False where Ctrl-C came
// first.
bool applyBudget(Renderer& renderer, FrameRequest& request, const Options& options, const RungInfo& info,
                 Settings& settings, Progress& progress) {
    request.applyTo(settings);
    const auto result = searchBudget(
        renderer, request, *options.budget, counterName(options.counter), info, settings,
        [&](const std::string& what) { progress.say("budget: " + what); }, [] { return interrupted != 0; });
    progress.clear();
    if (!result) return false;
    std::fputs((options.json ? budgetJson(*result, info) : budgetText(*result)).c_str(), stdout);
    std::fflush(stdout);
    for (const auto& [name, value] : result->set)
        request.sets.push_back(name + "=" + value);
    return true;
}

std::string range(const Setting& setting) {
    Setting bound = setting;
    switch (setting.kind) {
    case Setting::Kind::toggle:
        return "on, off";
    case Setting::Kind::choice:
        return joined(setting.choices);
    case Setting::Kind::number:
    case Setting::Kind::integer:
        break;
    }
    bound.value = setting.min;
    const std::string from = bound.text();
    bound.value = setting.max;
    return from + " to " + bound.text();
}

nlohmann::ordered_json settingJson(const Setting& setting) {
    constexpr const char* kinds[] = {"number", "integer", "toggle", "choice"};
    nlohmann::ordered_json json{{"name", setting.name},
                                {"kind", kinds[static_cast<std::size_t>(setting.kind)]},
                                {"help", setting.help}};
    if (!setting.owner.empty()) json["owner"] = setting.owner;
    constexpr const char* roles[] = {"", "orbit_yaw", "orbit_pitch", "orbit_zoom"};
    if (setting.role != Setting::Role::none) json["role"] = roles[static_cast<std::size_t>(setting.role)];
    json["group"] = group_names[static_cast<std::size_t>(setting.group)];
    for (const Setting::Need& need : setting.needs) {
        auto& any = json["needs"].emplace_back(nlohmann::ordered_json::array());
        for (const auto& [other, values] : need)
            any.push_back({{"setting", other}, {"values", values}});
    }
    Setting at_default = setting;
    at_default.value = setting.default_value;
    switch (setting.kind) {
    case Setting::Kind::toggle:
        json["default"] = setting.default_value != 0;
        break;
    case Setting::Kind::choice:
        json["default"] = at_default.text();
        json["choices"] = setting.choices;
        break;
    case Setting::Kind::number:
    case Setting::Kind::integer:
        json["default"] = setting.default_value;
        json["min"] = setting.min;
        json["max"] = setting.max;
        break;
    }
    return json;
}

// What is drawn with some settings, or why that is not known.
struct Drawn {
    std::vector<std::string> targets = {};
    std::vector<std::string> passes = {};
    std::string renderer = {};
    std::string unknown = {};
};

Drawn drawnBy(RendererOfFiles& rendererFor, const FrameRequest& request) {
    Drawn result;
    try {
        Renderer& small = rendererFor(request.files);
        const auto& drawn = small.render(1, {64, 64});
        const GlInfo& gl = small.context().info();
        result.renderer = gl.renderer + ", " + gl.version;
        result.targets = targetNames(drawn);
        for (const DrawnPass& pass : drawn)
            result.passes.push_back(pass.name);
    } catch (const std::runtime_error& error) {
        return {.unknown = error.what()};
    }
    return result;
}

void print(const Drawn& drawn, const Options& options, const RungInfo& info, const Settings& settings) {
    if (options.json) {
        nlohmann::ordered_json json{{"rung", info.name}, {"summary", info.summary}};
        for (const Setting& setting : settings.all())
            json["settings"].push_back(settingJson(setting));
        for (const Settings::Preset& preset : settings.presets())
            json["presets"].push_back(
                {{"name", preset.name}, {"help", preset.help}, {"values", preset.values}});
        for (const Settings::Dial& dial : settings.dials())
            json["dials"].push_back({{"setting", dial.setting}, {"values", dial.values}});
        json["targets"] = drawn.targets;
        json["passes"] = drawn.passes;
        if (drawn.unknown.empty()) json["renderer"] = drawn.renderer;
        if (!drawn.unknown.empty()) json["targets_unknown"] = drawn.unknown;
        std::printf("%s\n", json.dump(options.is_batch ? -1 : 2).c_str());
        return;
    }
    std::printf("%s: %s\n\nsettings (--set KEY=VALUE)\n", info.name.c_str(), info.summary.c_str());
    for (const Setting& setting : settings.all()) {
        Setting at_default = setting;
        at_default.value = setting.default_value;
        std::printf("  %-18s %-18s %s\n  %-18s %-18s (%s)\n", setting.name.c_str(), at_default.text().c_str(),
                    setting.help.c_str(), "", "", range(setting).c_str());
    }
    std::printf("\npresets (--preset NAME)\n");
    for (const Settings::Preset& preset : settings.presets())
        std::printf("  %-18s %s\n", preset.name.c_str(), preset.help.c_str());
    if (!settings.dials().empty()) {
        std::printf("\nwhat --budget chooses from, the most accurate first\n");
        for (const Settings::Dial& dial : settings.dials())
            std::printf("  %-18s %s\n", dial.setting.c_str(),
                        dial.values.empty() ? "from what it is set to downwards"
                                            : joined(dial.values).c_str());
    }
    if (drawn.unknown.empty())
        std::printf("\ntargets (--target NAME: as they are when the frame ends)\n  %s\n\npasses (--target "
                    "NAME: right after the pass)\n  %s\n",
                    joined(drawn.targets).c_str(), joined(drawn.passes).c_str());
    else
        std::printf("\ntargets and passes need an OpenGL context: %s\n", drawn.unknown.c_str());
}

} // namespace

int reportError(const RungInfo& info, std::string message, int exit_code) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fprintf(stderr, "%s: error: %s\n", info.name.c_str(), message.c_str());
    return exit_code;
}

int runHeadless(const Options& options, const RungInfo& info, Settings& settings) {
    std::signal(SIGINT, onInterrupt);
    const std::unique_ptr<Context> context = makeHeadlessContext(options.context);
    RendererOfFiles rendererFor(*context, info);
    Progress progress;
    std::vector<FrameRequest> requests = requestsOf(options);
    if (options.budget &&
        !applyBudget(rendererFor(requests[0].files), requests[0], options, info, settings, progress))
        return 130;
    std::size_t total = 0;
    for (const FrameRequest& request : requests)
        total += frameCount(request);
    std::size_t done = 0;
    const auto rendered = [&] {
        progress.say("frame " + std::to_string(++done) + " of " + std::to_string(total));
    };
    int exit_code = 0;
    const auto failed = [&](const FrameRequest& request, const std::exception& error, int code) {
        progress.clear();
        reportError(info, request.batch_line + ": " + error.what(), code);
        if (exit_code == 0) exit_code = code;
        try {
            context->debugLog().check(""); // what OpenGL said of it is no error of the next frame
        } catch (const std::runtime_error&) {
        }
    };
    // Once whatever a batch counts, so that its shaders are compiled before valgrind begins to instrument.
    for (const FrameRequest& request : requests) {
        if (!options.is_batch || options.counter != CounterKind::callgrind || !request.cost ||
            request.files != requests[0].files || interrupted != 0)
            continue;
        try {
            Renderer& first = rendererFor(request.files);
            request.applyTo(settings);
            first.render(request.first_frame, request.size);
        } catch (const std::exception&) { // what is wrong with it is said when its turn has come
            try {
                context->debugLog().check("");
            } catch (const std::runtime_error&) {
            }
        }
    }
    const FrameRequest* drawn = nullptr; // of the frame that the renderer drew last
    for (const FrameRequest& request : requests) {
        if (interrupted != 0) break;
        const auto render = [&] {
            const bool is_drawn = drawn && isSameFrame(request, *drawn);
            drawn = nullptr; // until nothing has failed
            renderRequest(rendererFor(request.files), request, is_drawn, options, info, settings, rendered);
            drawn = &request;
        };
        if (!options.is_batch) {
            render();
            continue;
        }
        // The other frames of a batch are worth having without this one.
        try {
            render();
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const UsageError& error) {
            failed(request, error, 2);
        } catch (const std::exception& error) {
            failed(request, error, 1);
        }
    }
    return interrupted != 0 ? 130 : exit_code;
}

int listSettings(const Options& options, const RungInfo& info, Settings& settings) {
    std::unique_ptr<Context> context;
    std::string no_context;
    try {
        context = makeHeadlessContext(ContextKind::headless);
    } catch (const std::runtime_error& error) {
        no_context = error.what();
    }
    std::optional<RendererOfFiles> rendererFor;
    if (context) rendererFor.emplace(*context, info);
    for (const FrameRequest& request : requestsOf(options)) {
        request.applyTo(settings); // targets and passes depend on the settings
        Drawn drawn{.unknown = no_context};
        if (rendererFor) drawn = drawnBy(*rendererFor, request);
        print(drawn, options, info, settings);
    }
    return 0;
}

} // namespace gll
