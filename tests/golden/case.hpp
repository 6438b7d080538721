// A golden case: the settings of a frame, and the hashes of the pictures that somebody looked at and
// accepted. Kept as tests/golden/NN_name/CASE.json, the picture beside it as CASE.png.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gll::test {

struct Blessing {
    std::string hash;     // pixelHash() of the frame
    std::string renderer; // what drew it
    std::string date;     // ISO 8601, UTC
};

struct GoldenCase {
    std::string name;
    nlohmann::ordered_json request; // as a line of --batch: size, frame, preset, set, target, inject, files
    std::vector<Blessing> blessed;  // one a renderer; the picture is the first one's

    bool isBlessed(const std::string& hash) const;
    bool isBlessedFor(const std::string& renderer) const;
};

// The cases of a folder, by name. Throws std::runtime_error naming the file that is wrong.
std::vector<GoldenCase> readCases(const std::filesystem::path& folder);

GoldenCase readCase(const std::filesystem::path& json_file);

// The line of --batch, but for "out": the files that it names are found from the case's folder.
nlohmann::ordered_json batchLine(const GoldenCase& golden, const std::filesystem::path& folder);

void writeCase(const std::filesystem::path& json_file, const GoldenCase& golden);

} // namespace gll::test
