// Reading and writing golden cases as JSON.
#include "golden/case.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace gll::test {
namespace fs = std::filesystem;

bool GoldenCase::isBlessed(const std::string& hash) const {
    return std::any_of(blessed.begin(), blessed.end(), [&](const Blessing& one) { return one.hash == hash; });
}

bool GoldenCase::isBlessedFor(const std::string& renderer) const {
    return std::any_of(blessed.begin(), blessed.end(),
                       [&](const Blessing& one) { return one.renderer == renderer; });
}

std::vector<GoldenCase> readCases(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<GoldenCase> cases;
    for (const fs::path& file : files)
        cases.push_back(readCase(file));
    return cases;
}

GoldenCase readCase(const fs::path& json_file) {
    GoldenCase golden{.name = json_file.stem().string(), .request = {}, .blessed = {}};
    try {
        std::ifstream stream(json_file);
        const auto json = nlohmann::ordered_json::parse(stream);
        for (const auto& [key, value] : json.items()) {
            if (key != "blessed") {
                golden.request[key] = value; // the rung refuses what is no key of a batch line
                continue;
            }
            for (const auto& one : value)
                golden.blessed.push_back({one.at("hash"), one.at("renderer"), one.at("date")});
        }
        // What a golden says must not change with a default of the command line.
        for (const char* key : {"frame", "size"})
            if (!golden.request.contains(key))
                throw std::runtime_error(std::string("has no \"") + key + "\"");
        if (golden.request.contains("out")) throw std::runtime_error("\"out\" is not its to say");
    } catch (const std::exception& error) {
        throw std::runtime_error(json_file.string() + ": " + error.what());
    }
    return golden;
}

nlohmann::ordered_json batchLine(const GoldenCase& golden, const fs::path& folder) {
    nlohmann::ordered_json line = golden.request;
    for (const char* key : {"image", "mesh", "floor", "environment"})
        if (line.contains(key)) line[key] = (folder / line.at(key).get<std::string>()).string();
    return line;
}

void writeCase(const fs::path& json_file, const GoldenCase& golden) {
    nlohmann::ordered_json json = golden.request;
    json["blessed"] = nlohmann::ordered_json::array();
    for (const Blessing& one : golden.blessed)
        json["blessed"].push_back({{"hash", one.hash}, {"renderer", one.renderer}, {"date", one.date}});
    std::ofstream stream(json_file);
    stream << json.dump(2) << "\n";
    stream.close();
    if (!stream) throw std::runtime_error(json_file.string() + ": cannot be written");
}

} // namespace gll::test
