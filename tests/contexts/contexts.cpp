// The same frames through OSMesa and through EGL: no pixel may differ, in what a display shows and in the
// targets. Usage: contexts RUNG
#include "support/comparison.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace {
using namespace gll;
using namespace gll::test;

struct Request {
    const char* name;
    const char* line; // of --batch, without "out"
};

// Sizes that no row of SIMD lanes or tile divides evenly, so that edges would show.
const std::vector<Request> requests = {{"default.png", R"({"frame": 60, "size": "640x480"})"},
                                       {"odd.png", R"({"frame": 1, "size": "641x479"})"},
                                       {"tiny.png", R"({"frame": 180, "size": "2x3"})"},
                                       {"hdr.exr", R"({"frame": 60, "size": "333x222", "target": "hdr"})"}};

void renderAll(const std::filesystem::path& rung, const std::string& context, const TemporaryFolder& folder) {
    std::string lines;
    for (const Request& request : requests) {
        auto line = nlohmann::json::parse(request.line);
        line["out"] = (folder / (context + "_" + request.name)).string();
        lines += line.dump() + "\n";
    }
    const auto batch = folder.write(context + ".jsonl", lines);
    runToSuccess({rung, {"--context", context, "--batch", batch.string()}});
}

// Of floats only whether all are equal matters here.
bool identical(const Image& a, const Image& b) {
    if (std::holds_alternative<std::vector<float>>(a.pixels))
        return a.width == b.width && a.height == b.height && a.channels == b.channels && a.pixels == b.pixels;
    return compare(a, b).identical();
}

int check(const std::filesystem::path& rung) {
    const TemporaryFolder folder;
    renderAll(rung, "osmesa", folder);
    renderAll(rung, "egl", folder);
    int failures = 0;
    for (const Request& request : requests) {
        const Image osmesa = loadImage(folder / (std::string("osmesa_") + request.name));
        const Image egl = loadImage(folder / (std::string("egl_") + request.name));
        const bool same = identical(osmesa, egl);
        const Comparison comparison = compare(osmesa, egl);
        std::printf("%s: OSMesa and EGL %s\n%s", request.name, same ? "agree" : "DIFFER",
                    comparison.comparable ? (comparison.summary() + "\n" + comparison.map()).c_str() : "");
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
