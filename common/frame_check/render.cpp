// Making commands from a suite's words, running them, and finding what they drew or why they did not.
#include "frame_check/render.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Values = std::map<std::string, Json>;

std::string textOf(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

bool isNameCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

const Json& valueOf(const Values& values, const std::string& name) {
    const auto found = values.find(name);
    if (found != values.end()) return found->second;
    std::string names;
    for (const auto& [other, value] : values)
        names += (names.empty() ? "" : ", ") + other;
    throw std::runtime_error("{" + name + "} stands for nothing here; there is " + names);
}

// The text with every {name} replaced.
std::string filled(const std::string& text, const Values& values) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::size_t end = i + 1;
        while (text[i] == '{' && end < text.size() && isNameCharacter(text[end]))
            ++end;
        if (text[i] != '{' || end == i + 1 || end >= text.size() || text[end] != '}') {
            result += text[i];
            continue;
        }
        result += textOf(valueOf(values, text.substr(i + 1, end - i - 1)));
        i = end;
    }
    return result;
}

// A word that is only {name} of a list becomes as many words.
std::vector<std::string> filled(const std::vector<std::string>& words, const Values& values) {
    std::vector<std::string> result;
    for (const std::string& word : words) {
        if (word.size() > 2 && word.front() == '{' && word.back() == '}' &&
            std::all_of(word.begin() + 1, word.end() - 1, isNameCharacter)) {
            if (const Json& value = valueOf(values, word.substr(1, word.size() - 2)); value.is_array()) {
                for (const Json& one : value)
                    result.push_back(textOf(one));
                continue;
            }
        }
        result.push_back(filled(word, values));
    }
    return result;
}

fs::path workFolder(const Suite& suite) {
    return suite.settings.empty() ? suite.folder : suite.settings.parent_path();
}

// A name without a slash is looked for where the shell would; another is a path from where programs run.
fs::path programNamed(const std::string& name, const Suite& suite) {
    if (name.find('/') != std::string::npos) {
        fs::path program = (workFolder(suite) / name).lexically_normal();
        if (access(program.c_str(), X_OK) != 0 || fs::is_directory(program))
            throw std::runtime_error(program.string() +
                                     ": is no program to run; build it, or say --program FILE");
        return program;
    }
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const fs::path program = fs::path(folder) / name;
            !name.empty() && access(program.c_str(), X_OK) == 0 && !fs::is_directory(program))
            return program;
    if (access((workFolder(suite) / name).c_str(), X_OK) == 0)
        throw std::runtime_error("\"" + name + "\" is no program in PATH; for the one in " +
                                 workFolder(suite).string() + ", write \"./" + name + "\"");
    throw std::runtime_error("\"" + name +
                             "\" is no program that is found here; install it, or say --program FILE");
}

Values valuesOf(const Suite& suite) {
    Values values;
    for (const auto& [name, text] : suite.variables)
        values[name] = text;
    values["folder"] = suite.name;
    if (!suite.program.empty()) values["program"] = filled(suite.program.string(), {{"folder", suite.name}});
    return values;
}

// The settings of a case, files named from its folder made whole paths.
Json settingsOf(const Suite& suite, const Case& one) {
    Json settings = one.settings.is_object() ? one.settings : Json::object();
    for (const std::string& key : suite.files)
        if (settings.contains(key) && settings.at(key).is_string())
            settings[key] = (suite.folder / settings.at(key).get<std::string>()).lexically_normal().string();
    return settings;
}

Values valuesOf(const Suite& suite, const Case& one, const std::string& out) {
    Values values = valuesOf(suite);
    const Json settings = settingsOf(suite, one);
    for (const auto& [name, value] : settings.items())
        values[name] = value;
    values["name"] = one.name;
    values["out"] = out;
    return values;
}

std::map<std::string, std::optional<std::string>> environmentOf(const Suite& suite) {
    auto environment = suite.environment;
    for (auto& [name, value] : environment)
        if (value) *value = filled(*value, valuesOf(suite));
    return environment;
}

Command commandOf(const Suite& suite, const std::vector<std::string>& words) {
    if (words.empty())
        throw std::runtime_error(
            (suite.settings.empty() ? suite.folder : suite.settings).string() +
            ": nothing says how a frame is drawn; give suite.json a \"command\" or a \"batch\"");
    return {.program = programNamed(words.front(), suite),
            .arguments = {words.begin() + 1, words.end()},
            .environment = environmentOf(suite),
            .folder = workFolder(suite)};
}

bool isOfBatch(const Suite& suite, const Case& one) { return one.command.empty() && !suite.batch.empty(); }

const std::vector<std::string>& wordsOf(const Suite& suite, const Case& one) {
    return one.command.empty() ? suite.command : one.command;
}

std::string lastLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

std::string howItEnded(const fs::path& program, const ProcessResult& end, std::chrono::seconds limit) {
    std::string text = program.filename().string();
    if (end.timed_out)
        text += " was ended after " + std::to_string(limit.count()) + " s";
    else if (end.signalled)
        text += " was ended by signal " + std::to_string(end.exit_code - 128);
    else
        text += " ended with " + std::to_string(end.exit_code);
    const std::string said = lastLine(end.err);
    return text + (said.empty() ? ", and said nothing" : ": " + said);
}

// How a suite's environment stands before a command in a shell.
std::string environmentLine(const Suite& suite) {
    std::string line;
    for (const auto& [name, value] : environmentOf(suite))
        line += value ? name + "=" + shellWord(*value) + " " : "";
    return line;
}

std::string shellWords(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + shellWord(word);
    return line;
}

} // namespace

Rendering::Rendering(const Suite& suite, std::vector<const Case*> cases, bool wants_targets)
    : suite_(suite), cases_(std::move(cases)), wants_targets_(wants_targets && hasTargets(suite)) {
    startBatch();
}

fs::path Rendering::fileOf(std::size_t i) const {
    fs::path ending = suite_.pictureOf(cases_[i]->name).extension();
    if (ending.empty()) ending = "." + suite_.format;
    return folder_ / (std::to_string(i + 1) + ending.string());
}

fs::path Rendering::targetsOf(std::size_t i) const {
    return wants_targets_ ? folder_ / (std::to_string(i + 1) + ".targets") : fs::path();
}

void Rendering::startBatch() {
    std::string lines;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
        if (wants_targets_) fs::create_directory(targetsOf(i));
        if (!isOfBatch(suite_, *cases_[i])) continue;
        Json line = settingsOf(suite_, *cases_[i]);
        line["out"] = fileOf(i).string();
        if (wants_targets_) line[suite_.targets_key] = targetsOf(i).string();
        lines += line.dump() + "\n";
    }
    if (lines.empty()) return;
    Values values = valuesOf(suite_);
    values["batch"] = folder_.write("batch.jsonl", lines).string();
    process_.emplace(commandOf(suite_, filled(suite_.batch, values)));
}

Frame Rendering::next() {
    if (atEnd()) return {};
    const std::size_t i = next_++;
    Frame frame = isOfBatch(suite_, *cases_[i]) ? nextOfBatch(i) : nextOfCommand(i);
    if (frame.error.empty()) frame.targets = targetsOf(i);
    return frame;
}

Frame Rendering::nextOfBatch(std::size_t i) {
    while (!end_) {
        end_ = process_->poll();
        // A frame is whole once a later one is begun or the program has ended.
        for (std::size_t later = i + 1; later < cases_.size() && !end_; ++later)
            if (isOfBatch(suite_, *cases_[later]) && fs::exists(fileOf(later)) && fs::exists(fileOf(i)))
                return {.file = fileOf(i)};
        if (!end_ && std::chrono::steady_clock::now() - begin_ > suite_.timeout) {
            hangs_ = true;
            end_ = process_->wait(std::chrono::milliseconds(0));
        }
        if (!end_) std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
    if (fs::exists(fileOf(i))) return {.file = fileOf(i)};
    return {.error = errorOf(i)};
}

// Programs name the line of the batch that they cannot draw; else it is what ended them.
std::string Rendering::errorOf(std::size_t i) const {
    std::size_t line = 0; // of the batch, from 1
    for (std::size_t before = 0; before <= i; ++before)
        line += isOfBatch(suite_, *cases_[before]) ? 1 : 0;
    const std::string place = "batch.jsonl:" + std::to_string(line) + ": ";
    std::istringstream messages(end_->err);
    for (std::string message; std::getline(messages, message);)
        if (const auto at = message.find(place); at != std::string::npos)
            return message.substr(at + place.size());
    const Values values = valuesOf(suite_);
    return howItEnded(suite_.batch.front() == "{program}" ? textOf(values.at("program"))
                                                          : suite_.batch.front(),
                      *end_, suite_.timeout);
}

Frame Rendering::nextOfCommand(std::size_t i) {
    Values values = valuesOf(suite_, *cases_[i], fileOf(i).string());
    std::vector<std::string> words = wordsOf(suite_, *cases_[i]);
    if (wants_targets_) {
        values["targets"] = targetsOf(i).string();
        words.insert(words.end(), suite_.targets_command.begin(), suite_.targets_command.end());
    }
    const Command command = commandOf(suite_, filled(words, values));
    const ProcessResult end = Process(command).wait(suite_.timeout);
    hangs_ = hangs_ || end.timed_out;
    if (end.exit_code != 0) return {.error = howItEnded(command.program, end, suite_.timeout)};
    if (!fs::exists(fileOf(i)))
        return {.error = command.program.filename().string() + " wrote no picture to {out}" +
                         (end.err.empty() ? "" : ": " + lastLine(end.err))};
    return {.file = fileOf(i)};
}

std::string Rendering::messages() {
    if (process_ && !end_) end_ = process_->wait(suite_.timeout);
    return end_ ? end_->err : "";
}

bool hasTargets(const Suite& suite) {
    return suite.batch.empty() ? !suite.targets_command.empty() : !suite.targets_key.empty();
}

std::string rendererOf(const Suite& suite) {
    if (suite.renderer.empty()) return "";
    const Command command = commandOf(suite, filled(suite.renderer, valuesOf(suite)));
    const ProcessResult end = Process(command).wait(suite.timeout);
    if (end.exit_code != 0)
        throw std::runtime_error("\"renderer\": " + howItEnded(command.program, end, suite.timeout));
    const Json json = Json::parse(end.out, nullptr, false);
    if (json.is_object() && json.contains("renderer") && json.at("renderer").is_string())
        return json.at("renderer");
    const std::string line = lastLine(end.out);
    if (json.is_object() || line.empty())
        throw std::runtime_error("\"renderer\": " + command.program.filename().string() + " names none" +
                                 (end.err.empty() ? "" : ": " + lastLine(end.err)));
    return line;
}

std::string commandLine(const Suite& suite, const Case& one) {
    const std::string ending = suite.pictureOf(one.name).empty()
                                   ? "." + suite.format
                                   : suite.pictureOf(one.name).extension().string();
    const std::string out = one.name + ending;
    std::string line = environmentLine(suite);
    if (!isOfBatch(suite, one))
        return line + shellWords(filled(wordsOf(suite, one), valuesOf(suite, one, out)));
    Json json = settingsOf(suite, one);
    json["out"] = out;
    Values values = valuesOf(suite);
    values["batch"] = one.name + ".jsonl";
    return "printf '%s\\n' " + shellWord(json.dump()) + " > " + shellWord(one.name + ".jsonl") + " && " +
           line + shellWords(filled(suite.batch, values));
}

std::string blessLine(const Suite& suite, const Case& one) {
    if (!suite.bless.empty()) return filled(suite.bless, {{"folder", suite.name}, {"name", one.name}});
    return "frame_check --suite " + shellWord(suite.folder.string()) + " --bless " + shellWord(one.name) +
           " --because 'why the new frame is right'";
}

} // namespace gll::frame_check
