// Finding the shaders of rungs, and copying what they are drawn with.
#include "mutation/rendering.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gll::test {
namespace fs = std::filesystem;
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

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

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
        const std::string text = readText(sources[i]);
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
                included.merge(shadersNamedIn(readText(root / "shaders" / name)));
        shaders.merge(included);
        grows = shaders.size() > before;
    }
    return shaders;
}

Copy::Copy(const fs::path& root, const std::vector<Rung>& rungs) {
    fs::create_directories(folder_ / "bin");
    for (const Rung& rung : rungs)
        fs::copy_file(rung.suite.program, folder_ / "bin" / rung.name);
    fs::copy(root / "shaders", folder_ / "shaders", fs::copy_options::recursive);
    fs::create_directory_symlink(fs::canonical(root / "assets"), folder_ / "assets");
}

frame_check::Suite Copy::suite(const Rung& rung) const {
    frame_check::Suite suite = rung.suite;
    suite.program = folder_ / "bin" / rung.name;
    return suite;
}

} // namespace gll::test
