// A suite: a folder of cases, each a NAME.json beside the picture that its frame has to be, and what all of
// them share, in a suite.json in that folder or in one above.
#pragma once

#include "frame_check/rule.hpp"

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gll::frame_check {

// A frame that somebody looked at and accepted.
struct Blessing {
    std::string hash = {};     // pixelHash() of it
    std::string renderer = {}; // what drew it, as the suite's "renderer" says; "" where it says nothing
    std::string date = {};     // ISO 8601, UTC
    std::string because = {};  // why it was accepted
    std::string cpu = {};      // cpuFeatures() of the machine
    std::string picture =
        {}; // the file of it in the folder; "": it lies within the rule of the case's first picture
    nlohmann::ordered_json targets =
        {}; // the hash of each intermediate target, by name in order of drawing; or null
};

struct Case {
    std::string name = {};
    nlohmann::ordered_json settings =
        {}; // the suite's defaults, and over them what its .json says but the keys below
    std::vector<std::string> command = {}; // "command": in place of the suite's
    std::optional<Rule> rule = {};         // "rule": in place of the suite's
    std::vector<Blessing> blessed = {};    // "blessed"

    bool isBlessed(const std::string& hash) const;
    const Blessing* blessingFor(const std::string& renderer) const;
};

// What suite.json may say. Words in braces stand for a value in every text of a command: {program}, {folder}
// (the name of the cases' folder), {name} (the case's), {out} (the file to write), {batch} (the file of JSON
// lines), {targets} (the folder for intermediate targets), a variable of the suite, or a setting of the case,
// of which a list becomes several words.
struct Suite {
    std::filesystem::path folder = {};     // the cases' folder
    std::filesystem::path settings = {};   // suite.json; empty where there is none
    std::string name = {};                 // the folder's
    std::filesystem::path program = {};    // "program": a path from suite.json's folder
    std::vector<std::string> command = {}; // "command": renders one case; or
    std::vector<std::string> batch =
        {}; // "batch": renders many, from a file with a case's settings as a line
    std::vector<std::string> targets_command = {}; // "targets": added to "command" where targets are wanted
    std::string targets_key = {};                  // "targets": the key of a line of "batch" for their folder
    std::vector<std::string> renderer = {}; // "renderer": prints what draws: a line, or JSON with "renderer"
    std::map<std::string, std::optional<std::string>> environment = {}; // "environment": null unsets
    std::map<std::string, std::string> variables =
        {}; // "variables"; and "shaders": a path from suite.json's folder
    nlohmann::ordered_json defaults = nlohmann::ordered_json::object(); // "defaults": settings of every case
    std::vector<std::string> files = {}; // "files": settings that name files, from the case's folder
    std::string format = "png";          // "format": of new references, png, exr or hdr
    Rule rule = {};                      // "rule"
    std::string bless = {}; // "bless": the command that blesses, for messages; {folder} and {name} as above
    std::chrono::seconds timeout{600}; // "timeout_s": of one process
    std::vector<Case> cases = {};      // by name

    const Case* find(const std::string& name) const;
    std::filesystem::path fileOf(const std::string& case_name) const {
        return folder / (case_name + ".json");
    }
    // The case's own picture: NAME.png, .exr, .hdr or .jpg beside its .json; empty where there is none.
    std::filesystem::path pictureOf(const std::string& case_name) const;
    const Rule& ruleOf(const Case& one) const { return one.rule ? *one.rule : rule; }
};

// What the command line has in place of what suite.json says.
struct SuiteChanges {
    std::string program = {}; // a path from the current folder; may hold {folder}
    std::map<std::string, std::string> variables = {};
    std::map<std::string, std::optional<std::string>> environment = {};
    std::optional<Rule> rule = {}; // of every case, too
};

// The suite of a folder; or, where it holds no case itself, those of the folders in it that do. Throws
// std::runtime_error naming the file that is wrong, and where there is no case at all unless `may_be_empty`.
std::vector<Suite> readSuites(const std::filesystem::path& folder, const SuiteChanges& changes = {},
                              bool may_be_empty = false);

// Writes what was blessed into a case's file, whole, and leaves the rest of it alone; a new file gets the
// case's settings. Throws std::runtime_error where it cannot be written.
void writeCase(const std::filesystem::path& json_file, const Case& one);

// The names in the folder's cases.txt, one a line, are those of the cases that must be there. A sentence for
// each that is not there, for each that is and is not listed, and for each picture that no case compares
// with. Nothing is asked where there is no cases.txt.
std::vector<std::string> problemsOf(const Suite& suite);
void addToList(const Suite& suite, const std::string& case_name);

} // namespace gll::frame_check
