// The same frames through OSMesa and through EGL: no pixel may differ, in what a display shows and in the
// targets. Usage: contexts RUNG
#include "measure/comparison.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace {
using namespace gll;
using namespace gll::test;

struct Request {
    std::string name;
    nlohmann::json line; // of --batch, without "out"
};

// Sizes that no row of SIMD lanes or tile divides evenly, so that edges would show; then every target.
std::vector<Request> requestsFor(const std::filesystem::path& rung) {
    std::vector<Request> requests = {{"default.png", {{"frame", 60}, {"size", "640x480"}}},
                                     {"odd.png", {{"frame", 1}, {"size", "641x479"}}},
                                     {"tiny.png", {{"frame", 180}, {"size", "2x3"}}}};
    const auto listed = nlohmann::json::parse(runToSuccess({rung, {"--settings", "--json"}}).out);
    for (const std::string target : listed.at("targets"))
        requests.push_back({target + ".exr", {{"frame", 60}, {"size", "333x222"}, {"target", target}}});
    return requests;
}

void renderAll(const std::filesystem::path& rung, const std::vector<Request>& requests,
               const std::string& context, const TemporaryFolder& folder) {
    std::string lines;
    for (const Request& request : requests) {
        nlohmann::json line = request.line;
        line["out"] = (folder / (context + "_" + request.name)).string();
        lines += line.dump() + "\n";
    }
    const auto batch = folder.write(context + ".jsonl", lines);
    runToSuccess({rung, {"--context", context, "--batch", batch.string()}});
}

int check(const std::filesystem::path& rung) {
    const TemporaryFolder folder;
    const std::vector<Request> requests = requestsFor(rung);
    renderAll(rung, requests, "osmesa", folder);
    renderAll(rung, requests, "egl", folder);
    int failures = 0;
    for (const Request& request : requests) {
        const Image osmesa = loadImage(folder / ("osmesa_" + request.name));
        const Image egl = loadImage(folder / ("egl_" + request.name));
        const measure::Comparison comparison = measure::compare(osmesa, egl);
        const bool same = comparison.identical();
        std::printf("%s: OSMesa and EGL %s\n%s", request.name.c_str(), same ? "agree" : "DIFFER",
                    same ? "" : (comparison.summary() + "\n" + comparison.map()).c_str());
        failures += same ? 0 : 1;
    }
    return failures == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: contexts RUNG\n");
        return 2;
    }
    try {
        return check(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contexts: error: %s\n", error.what());
        return 1;
    }
}
