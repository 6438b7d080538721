// The command line by CLI11, the batch file by nlohmann/json; both fill the same request.
#include "run/options.hpp"

#include "rung/capture.hpp"
#include "rung/nearest.hpp"
#include "rung/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#ifndef GLLADDER_VERSION
#error "the build defines GLLADDER_VERSION"
#endif

namespace gll {
namespace {

constexpr int max_extent_px = 16384;
constexpr std::size_t max_batch_bytes = std::size_t(64) << 20;
constexpr std::int64_t max_pixels = std::int64_t(64) << 20;

int parseInteger(std::string_view text, int min, int max, const std::string& what) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < min || value > max)
        throw UsageError(what + ": \"" + std::string(text) + "\" is not a whole number from " +
                         std::to_string(min) + " to " + std::to_string(max));
    return value;
}

bool isOneOf(const std::string& text, const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

// For an option that takes one of a few words.
CLI::Validator oneOf(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words)
        list += (list.empty() ? "" : ",") + word;
    return {[=](const std::string& value) {
                return isOneOf(value, words) ? ""
                                             : value + " not in {" + list + "}" + didYouMean(value, words);
            },
            "{" + list + "}"};
}

// What a word that is no option may have meant: an option, or a setting given as one.
std::string optionMeant(const CLI::App& app, Settings& settings) {
    std::vector<std::string> options;
    for (const CLI::Option* option : app.get_options())
        options.insert(options.end(), option->get_lnames().begin(), option->get_lnames().end());
    std::vector<std::string> names;
    for (const Setting& setting : settings.all())
        names.push_back(setting.name);
    const std::vector<std::string> words = app.remaining();
    for (auto word = words.rbegin(); word != words.rend(); ++word) { // CLI11 lists the last word first
        const auto begin = std::min(word->find_first_not_of('-'), word->size());
        const std::string name = word->substr(begin, word->find('=') - begin);
        if (const std::string option = nearestName(name, options); !option.empty())
            return "; did you mean --" + option + "?";
        if (const std::string setting = nearestName(name, names); !setting.empty())
            return "; did you mean --set " + setting + "=VALUE?";
    }
    return "";
}

// "A..B" or "A..B:S" into the request.
void parseFrames(const std::string& text, FrameRequest& request) {
    const auto dots = text.find("..");
    if (dots == std::string::npos) throw UsageError("--frames " + text + ": write A..B or A..B:STEP");
    const auto colon = text.find(':', dots);
    const std::string_view view = text;
    request.first_frame = parseInteger(view.substr(0, dots), 1, max_frame, "--frames");
    request.last_frame = parseInteger(view.substr(dots + 2, colon - dots - 2), 1, max_frame, "--frames");
    request.step =
        colon == std::string::npos ? 1 : parseInteger(view.substr(colon + 1), 1, max_frame, "--frames");
    if (request.last_frame < request.first_frame)
        throw UsageError("--frames " + text + ": ends before it begins");
}

void checkRequest(const FrameRequest& request) {
    if (!request.out.empty() && !isWritableImage(request.out))
        throw UsageError("--out " + request.out.string() + ": the name must end in .png, .exr or .hdr");
    if (request.isSequence() && !request.targets.empty())
        throw UsageError("--targets " + request.targets.string() +
                         ": is for one frame, and several are asked for");
    const bool counted = hasFrameNumber(request.out);
    if (request.isSequence() && !request.out.empty() && !counted)
        throw UsageError("--out " + request.out.string() +
                         ": several frames need a %d in the name, such as frame_%04d.png");
}

// Tries the request's settings, and leaves them at their defaults.
void checkSettings(const FrameRequest& request, Settings& settings) {
    try {
        request.applyTo(settings);
    } catch (...) {
        settings.reset();
        throw;
    }
    settings.reset();
}

// A value as the command line would spell it. Lists and objects have no such spelling, and are not printed
// either: nested deep enough, printing them takes all of the stack.
std::string scalarText(const std::string& key, const nlohmann::json& value) {
    if (value.is_string()) {
        auto text = value.get<std::string>();
        if (text.find('\0') != std::string::npos) // the system would read the text up to there
            throw UsageError("\"" + key + "\" holds a zero byte (\\u0000), which no name or value has");
        return text;
    }
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    if (value.is_number()) return value.dump();
    throw UsageError("\"" + key + "\" wants a text, a number, true or false");
}

const std::vector<std::string> batch_keys = {"size",   "frame",   "frames", "preset",   "set", "out",
                                             "target", "targets", "inject", "readings", "cost"};

// The options that name files which this rung takes.
std::vector<FileOption> fileOptions(const RungInfo& info) {
    std::vector<FileOption> taken;
    for (const FileOption& option : file_options)
        if (info.takes.contains(option.name)) taken.push_back(option);
    return taken;
}

std::vector<std::string> namesOf(const std::vector<FileOption>& options) {
    std::vector<std::string> names;
    for (const FileOption& option : options)
        names.emplace_back(option.name);
    return names;
}

FrameRequest parseBatchLine(const std::string& line, FrameRequest request, const RungInfo& info) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) throw UsageError("not a JSON object on one line");
    for (const auto& [key, value] : json.items()) {
        if (key == "size") {
            request.size = parseSize(scalarText(key, value));
        } else if (key == "frame") {
            request.first_frame = request.last_frame =
                parseInteger(scalarText(key, value), 1, max_frame, "frame");
        } else if (key == "frames") {
            parseFrames(scalarText(key, value), request);
        } else if (key == "preset") {
            request.preset = scalarText(key, value);
        } else if (key == "out") {
            request.out = scalarText(key, value);
        } else if (key == "target") {
            request.target = scalarText(key, value);
        } else if (key == "targets") {
            request.targets = scalarText(key, value);
        } else if (key == "inject" && value.is_string()) {
            request.injections.push_back(parseInjection(scalarText(key, value)));
        } else if (key == "inject" && value.is_array()) {
            for (const auto& one : value)
                request.injections.push_back(parseInjection(scalarText(key, one)));
        } else if (key == "readings" && value.is_boolean()) {
            request.readings = value.get<bool>();
        } else if (key == "cost" && value.is_boolean()) {
            request.cost = value.get<bool>();
            request.passes_only = false;
        } else if (key == "cost" && value == "passes") {
            request.cost = request.passes_only = true;
        } else if (key == "set" && value.is_object()) {
            for (const auto& [name, setting] : value.items())
                request.sets.push_back(name + "=" + scalarText(name, setting));
        } else if (key == "set" && value.is_array()) {
            for (const auto& setting : value)
                request.sets.push_back(scalarText(key, setting));
        } else if (const auto files = fileOptions(info); isOneOf(key, namesOf(files))) {
            if (!value.is_string()) throw UsageError("\"" + key + "\" wants a text, the name of a file");
            const std::string file = scalarText(key, value);
            if (file.empty()) throw UsageError("\"" + key + "\" is empty, name a file or leave it out");
            for (const FileOption& option : files)
                if (option.name == key) request.files.*option.file = file;
        } else {
            std::vector<std::string> keys = batch_keys;
            for (const std::string& name : namesOf(files))
                keys.push_back(name);
            throw UsageError("\"" + key + "\" with this value is no key of a batch line; there is " +
                             joined(keys) + " (set is an object or a list)" +
                             (isOneOf(key, keys) ? "" : didYouMean(key, keys)));
        }
    }
    if (json.contains("frame") && json.contains("frames"))
        throw UsageError("\"frame\" and \"frames\" exclude each other");
    checkRequest(request);
    return request;
}

// All of a file, or of a pipe; a device that never ends is refused at the limit.
std::string readBounded(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file + ": cannot be opened; --batch wants a file of JSON lines");
    std::string text;
    std::vector<char> block(std::size_t(1) << 16);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > max_batch_bytes)
            throw std::runtime_error(file + ": larger than 64 MiB; split it into several batches");
    }
    return text;
}

std::vector<FrameRequest> readBatch(const std::string& file, const FrameRequest& base, const RungInfo& info,
                                    Settings& settings, bool only_listed) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw std::runtime_error(file + ": is a folder");
    std::istringstream stream(readBounded(file));
    std::vector<FrameRequest> requests;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        try {
            requests.push_back(parseBatchLine(line, base, info));
            requests.back().batch_line = file + ":" + std::to_string(number);
            checkSettings(requests.back(), settings);
            if (!only_listed && requests.back().out.empty() && !requests.back().readings &&
                !requests.back().cost)
                throw UsageError(
                    "names no \"out\" and asks for no \"readings\" or \"cost\", so nothing would come of it");
        } catch (const UsageError& usage) {
            throw UsageError(file + ":" + std::to_string(number) + ": " + usage.what());
        }
    }
    if (requests.empty()) throw UsageError(file + ": no frame is asked for; write one JSON object a line");
    return requests;
}

ContextKind contextKind(const std::string& name) {
    if (name == "window") return ContextKind::window;
    return name == "egl" ? ContextKind::egl : ContextKind::osmesa;
}

} // namespace

Injection parseInjection(const std::string& text) {
    const auto value_at = text.rfind(':');
    const auto pixel_at =
        value_at == std::string::npos || value_at == 0 ? value_at : text.rfind(':', value_at - 1);
    if (pixel_at == std::string::npos || pixel_at == 0 || pixel_at == value_at)
        throw UsageError("--inject " + text + ": write PASS:X,Y:VALUE, such as scene:320,240:nan");
    const std::string_view pixel = std::string_view(text).substr(pixel_at + 1, value_at - pixel_at - 1);
    const auto comma = std::min(pixel.find(','), pixel.size());
    Injection injection;
    injection.name = text.substr(0, pixel_at);
    injection.pixel = {parseInteger(pixel.substr(0, comma), 0, max_extent_px - 1, "--inject " + text),
                       parseInteger(comma == pixel.size() ? "" : pixel.substr(comma + 1), 0,
                                    max_extent_px - 1, "--inject " + text)};
    const char* number = text.c_str() + value_at + 1;
    char* end = nullptr;
    injection.value = std::strtof(number, &end); // reads inf and nan too
    if (end == number || *end != '\0')
        throw UsageError("--inject " + text + ": \"" + number + "\" is no number, inf, -inf or nan");
    return injection;
}

glm::ivec2 parseSize(const std::string& text) {
    const auto x = text.find('x');
    if (x == std::string::npos) throw UsageError("--size " + text + ": write WIDTHxHEIGHT, such as 640x480");
    const std::string_view view = text;
    const glm::ivec2 size(parseInteger(view.substr(0, x), 1, max_extent_px, "--size"),
                          parseInteger(view.substr(x + 1), 1, max_extent_px, "--size"));
    if (std::int64_t(size.x) * size.y > max_pixels)
        throw UsageError("--size " + text + ": more than 64 Mi pixels");
    return size;
}

std::optional<Options> parseOptions(int argc, char** argv, const RungInfo& info, Settings& settings) {
    CLI::App app(info.summary, info.name);
    app.set_version_flag("--version", info.name + " " GLLADDER_VERSION " (GL Ladder)");
    app.get_formatter()->column_width(28);
    app.footer("Without --context, the rung opens a window; --out, --frames, --target, --batch, --cost and "
               "--budget\n"
               "render headless instead. In the window: H hides the panel, Space pauses, P writes the frame, "
               "Esc quits.");

    Options options;
    bool headless = false;
    bool or_picture = false;
    std::string context;
    std::string size;
    std::string frame;
    std::string frames;
    std::string batch;
    std::string budget;
    std::string counter = "auto";
    std::vector<std::string> injections;
    app.add_flag("--headless", headless,
                 "render without a window: OSMesa, or EGL where that is not installed");
    app.add_option("--context", context, "who provides OpenGL: window, osmesa or egl")
        ->check(oneOf({"window", "osmesa", "egl"}))
        ->type_name("KIND");
    app.add_flag("--or-picture", or_picture,
                 "where no window can be opened, render " + info.name + ".png instead, and say so");
    app.add_option("--size", size,
                   "pixels of the frame, 640x480 unless given; a window without it has 1280x720")
        ->type_name("WxH");
    app.add_option("--window-state", options.window_state,
                   "begin the window as this file has it, and leave it there in the end")
        ->type_name("FILE");
    app.add_option("--frame", frame, "which frame, at N/60 s; the first is 1, the default 60")
        ->type_name("N");
    app.add_option("--frames", frames, "several frames, every STEP-th")->type_name("A..B[:STEP]");
    app.add_option("--preset", options.request.preset, "a named set of settings: original (the default), ...")
        ->type_name("NAME");
    app.add_option("--set", options.request.sets, "one setting; may be repeated")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--out", options.request.out,
                   "the file to write: .png as a display shows it, .exr or .hdr linear float")
        ->type_name("FILE");
    app.add_option("--target", options.request.target,
                   "write this target (as it is at the end) or this pass's (right after it) instead")
        ->type_name("NAME");
    app.add_option("--targets", options.request.targets,
                   "also write what each pass has drawn into this folder, in order: 001_PASS.exr, 002_...")
        ->type_name("FOLDER");
    app.add_option("--inject", injections,
                   "overwrite one pixel right after a pass, named by itself or its target, such as "
                   "scene:320,240:nan; may be repeated")
        ->type_name("PASS:X,Y:VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_flag("--settings", options.list_settings,
                 "list settings, presets, targets and passes; with --batch for each of its lines");
    app.add_option("--batch", batch, "many frames in one process: a JSON object a line, keys as the options")
        ->type_name("FILE");
    app.add_flag("--readings", options.request.readings,
                 "print the numbers that the rung reads in the frame, where it has some");
    app.add_flag("--cost", options.request.cost, "measure every pass: instructions, copies (cu), bytes, ms");
    app.add_option("--budget", budget,
                   "find the cheapest settings whose frames differ from those of the best ones by at most\n"
                   "flip=LIMIT, rmse=LIMIT (both of display values, 0 to 1) or ev=LIMIT (stops of exposure)")
        ->type_name("KIND=LIMIT");
    app.add_option(
           "--counter", counter,
           "what --cost and --budget count with: auto, perf (hardware instructions), callgrind (exact,\n"
           "slow, needs valgrind), cpu (time) or gpu (timer queries)")
        ->check(oneOf(counter_names))
        ->type_name("KIND");
    app.add_flag("--json", options.json, "with --settings, --readings, --cost or --budget: print JSON");
    for (const FileOption& option : fileOptions(info))
        app.add_option("--" + std::string(option.name), options.request.files.*option.file, option.help)
            ->type_name("FILE");

    // A script's unset variable must not pass for an option that was not given.
    for (CLI::Option* option :
         app.get_options([](const CLI::Option* o) { return o->get_items_expected() > 0; }))
        option->check([](const std::string& value) { return value.empty() ? "is empty" : ""; });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return std::nullopt;
        }
        throw UsageError(std::string(error.what()) + "; --help lists the options" +
                         optionMeant(app, settings));
    }

    for (const std::string& injection : injections)
        options.request.injections.push_back(parseInjection(injection));
    options.is_frame_given = !frame.empty();
    options.is_size_given = !size.empty();
    if (options.is_size_given) options.request.size = parseSize(size);
    if (!frame.empty() && !frames.empty()) throw UsageError("--frame and --frames exclude each other");
    if (!frame.empty())
        options.request.first_frame = options.request.last_frame =
            parseInteger(frame, 1, max_frame, "--frame");
    if (!frames.empty()) parseFrames(frames, options.request);
    const auto named = std::find(counter_names.begin(), counter_names.end(), counter);
    options.counter = static_cast<CounterKind>(named - counter_names.begin());
    if (!budget.empty()) options.budget = parseBudget(budget);
    if (options.budget &&
        (!batch.empty() || options.request.cost || options.request.readings || !injections.empty()))
        throw UsageError(
            "--budget excludes --batch, --cost, --readings and --inject: search first, then ask for them");

    const bool needs_headless = !options.request.out.empty() || !frames.empty() ||
                                !options.request.target.empty() || !options.request.targets.empty() ||
                                !batch.empty() || options.request.cost || options.request.readings ||
                                !injections.empty() || options.budget;
    if (!context.empty())
        options.context = contextKind(context);
    else if (headless || needs_headless)
        options.context = ContextKind::headless;
    if (headless && options.context == ContextKind::window)
        throw UsageError("--headless and --context window exclude each other");
    if (options.context == ContextKind::window && needs_headless)
        throw UsageError("--context window writes and measures nothing: leave it out, or use osmesa or egl");
    if (options.context != ContextKind::window && options.request.out.empty() && !options.request.cost &&
        !options.request.readings && !options.budget && batch.empty())
        options.request.out = info.name + (frames.empty() ? ".png" : "_%04d.png");
    if (options.context == ContextKind::window && context.empty() && or_picture) {
        options.or_picture = options.request;
        options.or_picture->out = info.name + ".png";
    }
    if (options.context == ContextKind::window && frame.empty())
        options.request.first_frame = options.request.last_frame = 1; // a window begins at the beginning
    checkRequest(options.request);
    checkSettings(options.request, settings);
    options.is_batch = !batch.empty();
    if (options.is_batch)
        options.batch = readBatch(batch, options.request, info, settings, options.list_settings);
    return options;
}

} // namespace gll
