// Finding the shaders of rungs, and telling rungs of a copy.
#include "mutation/ladder.hpp"

#include <algorithm>
#include <stdexcept>

namespace gll::test {
namespace fs = std::filesystem;
using frame_check::MutationOptions;
using frame_check::Suite;
namespace {

// What stands between double quotes in a text, where it names a shader.
std::set<std::string> shadersNamedIn(const std::string& text) {
    std::set<std::string> names;
    for (auto open = text.find('"'); open != std::string::npos; open = text.find('"', open + 1)) {
        const auto close = text.find('"', open + 1);
        if (close == std::string::npos) break;
        const std::string name = text.substr(open + 1, close - open - 1);
        if (name.ends_with(".frag") || name.ends_with(".vert") || name.ends_with(".glsl")) names.insert(name);
    }
    return names;
}

} // namespace

std::set<std::string> shadersOf(const fs::path& root, const std::string& rung) {
    std::vector<fs::path> sources;
    std::set<fs::path> seen;
    const auto visit = [&](const fs::path& file) {
        if (fs::exists(file) && seen.insert(file).second) sources.push_back(file);
    };
    for (const fs::path& folder : {root / "tutorials" / rung, root / "common"})
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") visit(entry.path());
    std::set<std::string> shaders;
    if (const fs::path own = root / "shaders" / rung; fs::is_directory(own))
        for (const auto& entry : fs::directory_iterator(own))
            shaders.insert(rung + "/" + entry.path().filename().string());
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const std::string text = contents(sources[i]);
        shaders.merge(shadersNamedIn(text));
        for (auto at = text.find("#include \""); at != std::string::npos;
             at = text.find("#include \"", at + 1)) {
            const fs::path header =
                root / "tutorials" / text.substr(at + 10, text.find('"', at + 10) - at - 10);
            visit(header);
            visit(fs::path(header).replace_extension(".cpp"));
        }
    }
    for (bool grows = true; grows;) {
        const std::size_t before = shaders.size();
        std::set<std::string> included;
        for (const std::string& name : shaders)
            if (fs::exists(root / "shaders" / name))
                included.merge(shadersNamedIn(contents(root / "shaders" / name)));
        shaders.merge(included);
        grows = shaders.size() > before;
    }
    return shaders;
}

Ladder::Ladder(const fs::path& root, const fs::path& programs) : root_(root) {
    for (const auto& entry : fs::directory_iterator(root / "tests/golden")) {
        const std::string name = entry.path().filename();
        if (!entry.is_directory() || !fs::exists(programs / name)) continue;
        // One thread for a frame's pixels: the jobs are what goes on at once.
        suites_.push_back(frame_check::readSuites(entry.path(), {.program = (programs / name).string(),
                                                                 .environment = {{"LP_NUM_THREADS", "0"}}})
                              .at(0));
        shaders_[name] = shadersOf(root, name);
    }
    if (suites_.empty()) throw std::runtime_error(programs.string() + ": holds no rung with goldens");
    std::sort(suites_.begin(), suites_.end(), [](const Suite& a, const Suite& b) { return a.name < b.name; });
}

void Ladder::complete(MutationOptions& options) const {
    options.shaders = root_ / "shaders";
    options.excuses = frame_check::readExcuses(root_ / "tests/mutation/excused.json");
    options.noticed = "no uniform named";
    options.within = [this](const Suite& suite, const fs::path& folder) { return within(suite, folder); };
    options.draws_with = [this](const Suite& suite, const std::string& shader) {
        return shaders_.at(suite.name).contains(shader);
    };
}

Suite Ladder::within(const Suite& suite, const fs::path& folder) const {
    Suite there = suite;
    there.program = folder / "bin" / suite.name;
    if (!fs::exists(there.program)) {
        fs::create_directories(folder / "bin");
        fs::copy_file(suite.program, there.program);
    }
    const fs::path libraries = suite.program.parent_path().parent_path() / "lib";
    if (fs::exists(libraries) && !fs::exists(folder / "lib"))
        fs::create_directory_symlink(fs::canonical(libraries), folder / "lib");
    if (!fs::exists(folder / "assets"))
        fs::create_directory_symlink(fs::canonical(root_ / "assets"), folder / "assets");
    return there;
}

} // namespace gll::test
