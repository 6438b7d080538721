// Reading and writing suites and cases as JSON.
#include "frame_check/suite.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* suite_file = "suite.json";
constexpr const char* list_file = "cases.txt";
constexpr std::size_t most_bytes = std::size_t(16) << 20;
constexpr int most_depth = 32;
const std::vector<std::string> picture_endings = {".png", ".exr", ".hdr", ".jpg"};

Json parsed(const fs::path& file) {
    std::error_code error;
    const auto bytes = fs::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) throw std::runtime_error("cannot be read");
    if (bytes > most_bytes) throw std::runtime_error("is larger than 16 MiB, and no description of a case");
    // Printing what is nested deeply enough takes all of the stack.
    Json json = Json::parse(stream, [](int depth, Json::parse_event_t, Json&) {
        if (depth > most_depth) throw std::runtime_error("is nested too deeply");
        return true;
    });
    if (!json.is_object()) throw std::runtime_error("is no JSON object");
    return json;
}

std::string textIn(const Json& json, const std::string& key) {
    if (!json.is_string()) throw std::runtime_error("\"" + key + "\" wants a text");
    return json.get<std::string>();
}

std::vector<std::string> wordsIn(const Json& json, const std::string& key) {
    if (!json.is_array() || json.empty())
        throw std::runtime_error("\"" + key + "\" wants a list of texts: a program and its arguments");
    std::vector<std::string> words;
    for (const Json& word : json)
        words.push_back(textIn(word, key));
    return words;
}

Blessing blessingIn(const Json& json) {
    Blessing one;
    one.hash = json.at("hash");
    one.renderer = json.at("renderer");
    one.date = json.at("date");
    one.because = json.value("because", "");
    one.cpu = json.value("cpu", "");
    one.picture = json.value("picture", "");
    if (json.contains("targets")) one.targets = json.at("targets");
    if (one.picture.find('/') != std::string::npos)
        throw std::runtime_error("the picture \"" + one.picture + "\" has to lie beside it");
    return one;
}

Case readCase(const fs::path& json_file, const Json& defaults) {
    Case one{.name = json_file.stem().string(), .settings = defaults};
    try {
        const Json json = parsed(json_file);
        for (const auto& [key, value] : json.items()) {
            if (key == "command") {
                one.command = wordsIn(value, key);
            } else if (key == "rule") {
                one.rule = ruleFromJson(value);
            } else if (key == "blessed") {
                for (const Json& blessing : value)
                    one.blessed.push_back(blessingIn(blessing));
            } else if (key == "out") {
                throw std::runtime_error("\"out\" is not its to say");
            } else {
                one.settings[key] = value; // what the program makes of it is the program's to check
            }
        }
    } catch (const std::exception& error) {
        throw std::runtime_error(json_file.string() + ": " + error.what());
    }
    return one;
}

void readKey(Suite& suite, const std::string& key, const Json& value) {
    if (key == "program") {
        suite.program = textIn(value, key);
    } else if (key == "command") {
        suite.command = wordsIn(value, key);
    } else if (key == "batch") {
        suite.batch = wordsIn(value, key);
    } else if (key == "targets" && value.is_string()) {
        suite.targets_key = value;
    } else if (key == "targets") {
        suite.targets_command = wordsIn(value, key);
    } else if (key == "renderer") {
        suite.renderer = wordsIn(value, key);
    } else if (key == "environment") {
        for (const auto& [name, text] : value.items())
            suite.environment[name] = text.is_null() ? std::optional<std::string>() : textIn(text, name);
    } else if (key == "shaders") {
        suite.variables[key] =
            (suite.settings.parent_path() / textIn(value, key)).lexically_normal().string();
    } else if (key == "variables") {
        for (const auto& [name, text] : value.items())
            suite.variables[name] = textIn(text, name);
    } else if (key == "defaults" && value.is_object()) {
        suite.defaults = value;
    } else if (key == "files") {
        suite.files = wordsIn(value, key);
    } else if (key == "format") {
        suite.format = textIn(value, key);
        if (suite.format != "png" && suite.format != "exr" && suite.format != "hdr")
            throw std::runtime_error("\"format\" is png, exr or hdr");
    } else if (key == "rule") {
        suite.rule = ruleFromJson(value);
    } else if (key == "bless") {
        suite.bless = textIn(value, key);
    } else if (key == "timeout_s") {
        if (!value.is_number() || !(value.get<double>() >= 1 && value.get<double>() <= 86400))
            throw std::runtime_error("\"timeout_s\" wants a number of seconds from 1 to 86400");
        suite.timeout = std::chrono::seconds(static_cast<int>(value.get<double>()));
    } else {
        throw std::runtime_error("\"" + key +
                                 "\" with this value is no key of a suite; there is program, command, batch, "
                                 "targets, renderer, environment, shaders, variables, defaults, files, "
                                 "format, rule, bless, timeout_s");
    }
}

// In the folder, or in the nearest above that has one.
fs::path findSettings(const fs::path& folder) {
    for (fs::path above = folder;; above = above.parent_path()) {
        if (fs::exists(above / suite_file)) return above / suite_file;
        if (above == above.parent_path()) return {};
    }
}

std::vector<fs::path> caseFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".json" && entry.path().filename() != suite_file &&
            entry.is_regular_file())
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Suite readSuite(const fs::path& folder, const SuiteChanges& changes) {
    Suite suite;
    suite.folder = folder;
    suite.name = folder.filename().string();
    suite.settings = findSettings(folder);
    if (!suite.settings.empty()) {
        try {
            const Json json = parsed(suite.settings);
            for (const auto& [key, value] : json.items())
                readKey(suite, key, value);
            if (!suite.command.empty() && !suite.batch.empty())
                throw std::runtime_error("has both \"command\" and \"batch\", keep one");
        } catch (const std::exception& error) {
            throw std::runtime_error(suite.settings.string() + ": " + error.what());
        }
        // A program without a slash is looked for where programs are.
        if (suite.program.has_parent_path()) suite.program = suite.settings.parent_path() / suite.program;
    }
    if (!changes.program.empty())
        suite.program = changes.program.find('/') == std::string::npos && !fs::exists(changes.program)
                            ? fs::path(changes.program)
                            : fs::absolute(changes.program);
    for (const auto& [name, value] : changes.variables)
        suite.variables[name] = value;
    for (const auto& [name, value] : changes.environment)
        suite.environment[name] = value;
    for (const fs::path& file : caseFiles(folder))
        suite.cases.push_back(readCase(file, suite.defaults));
    if (changes.rule) {
        suite.rule = *changes.rule;
        for (Case& one : suite.cases)
            one.rule.reset();
    }
    return suite;
}

std::set<std::string> readList(const fs::path& file) {
    std::set<std::string> names;
    std::ifstream stream(file);
    for (std::string name; std::getline(stream, name);)
        if (!name.empty()) names.insert(name);
    return names;
}

void writeWhole(const fs::path& file, const std::string& text) {
    const fs::path part = file.string() + ".part";
    std::ofstream stream(part, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
    fs::rename(part, file);
}

// Rows of many short values are easier to review, and to merge, as one line.
std::string blessedText(const std::vector<Blessing>& blessed) {
    std::string text;
    for (const Blessing& one : blessed) {
        Json json{{"hash", one.hash}, {"renderer", one.renderer}, {"date", one.date}};
        if (!one.because.empty()) json["because"] = one.because;
        if (!one.cpu.empty()) json["cpu"] = one.cpu;
        if (!one.picture.empty()) json["picture"] = one.picture;
        if (one.targets.is_object()) json["targets"] = one.targets;
        text += text.empty() ? "" : ",\n";
        std::string members;
        for (const auto& [key, value] : json.items())
            members += (members.empty() ? "" : ",\n") + ("      " + Json(key).dump()) + ": " + value.dump();
        text += "    {\n" + members + "\n    }";
    }
    return text.empty() ? "[]" : "[\n" + text + "\n  ]";
}

} // namespace

bool Case::isBlessed(const std::string& hash) const {
    return std::any_of(blessed.begin(), blessed.end(), [&](const Blessing& one) { return one.hash == hash; });
}

const Blessing* Case::blessingFor(const std::string& wanted) const {
    const auto found = std::find_if(blessed.begin(), blessed.end(),
                                    [&](const Blessing& one) { return one.renderer == wanted; });
    return found == blessed.end() ? nullptr : &*found;
}

const Case* Suite::find(const std::string& wanted) const {
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const Case& one) { return one.name == wanted; });
    return found == cases.end() ? nullptr : &*found;
}

fs::path Suite::pictureOf(const std::string& case_name) const {
    for (const std::string& ending : picture_endings)
        if (const fs::path file = folder / (case_name + ending); fs::exists(file)) return file;
    return {};
}

std::vector<Suite> readSuites(const fs::path& named, const SuiteChanges& changes, bool may_be_empty) {
    if (!fs::is_directory(named)) throw std::runtime_error(named.string() + ": there is no such folder");
    const fs::path folder = fs::canonical(named);
    std::vector<Suite> suites;
    if (may_be_empty || !caseFiles(folder).empty()) {
        suites.push_back(readSuite(folder, changes));
        return suites;
    }
    std::vector<fs::path> inner;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory() && !caseFiles(entry.path()).empty()) inner.push_back(entry.path());
    std::sort(inner.begin(), inner.end());
    for (const fs::path& one : inner)
        suites.push_back(readSuite(one, changes));
    if (suites.empty())
        throw std::runtime_error(named.string() + ": holds no case, which is a NAME.json beside its picture");
    return suites;
}

void writeCase(const fs::path& json_file, const Case& one) {
    // A file that is there is kept as it is but for what was blessed.
    Json json = fs::exists(json_file) ? parsed(json_file) : one.settings;
    json.erase("blessed");
    std::string text = json.dump(2);
    text.resize(text.size() - (json.empty() ? 1 : 2)); // without the brace that ends it, and its line
    writeWhole(json_file,
               text + (json.empty() ? "\n" : ",\n") + "  \"blessed\": " + blessedText(one.blessed) + "\n}\n");
}

std::vector<std::string> problemsOf(const Suite& suite) {
    std::vector<std::string> sentences;
    std::set<std::string> compared;
    for (const Case& one : suite.cases) {
        if (const fs::path picture = suite.pictureOf(one.name); !picture.empty())
            compared.insert(picture.filename());
        for (const Blessing& blessing : one.blessed)
            compared.insert(blessing.picture);
    }
    for (const auto& entry : fs::directory_iterator(suite.folder))
        if (const std::string name = entry.path().filename();
            std::find(picture_endings.begin(), picture_endings.end(), entry.path().extension()) !=
                picture_endings.end() &&
            !compared.contains(name))
            sentences.push_back(name + ": no case compares with it; there is no .json beside it");
    const fs::path file = suite.folder / list_file;
    if (fs::exists(file)) {
        const std::set<std::string> listed = readList(file);
        for (const std::string& name : listed)
            if (suite.find(name) == nullptr)
                sentences.push_back(name + ": the case is gone; if that is meant, take it out of " +
                                    file.string());
        for (const Case& one : suite.cases)
            if (!listed.contains(one.name))
                sentences.push_back(one.name + ": is not in " + file.string() +
                                    "; blessing adds what it accepts");
    }
    std::sort(sentences.begin(), sentences.end());
    return sentences;
}

void addToList(const Suite& suite, const std::string& case_name) {
    const fs::path file = suite.folder / list_file;
    std::set<std::string> names = readList(file);
    names.insert(case_name);
    std::string text;
    for (const std::string& name : names)
        text += name + "\n";
    writeWhole(file, text);
}

} // namespace gll::frame_check
