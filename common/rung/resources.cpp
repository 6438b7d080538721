// Finding the ladder's files.
#include "rung/resources.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gll {
namespace fs = std::filesystem;

Resources::Resources() {
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        // build/<preset>/bin/NN_name lies three folders under the root; an unpacked copy may be flatter.
        fs::path folder = executable.parent_path();
        for (int up = 0; up < 4 && folder.has_relative_path(); ++up, folder = folder.parent_path())
            if (fs::is_directory(folder / "shaders", error)) roots_.push_back(folder);
        if (roots_.empty()) roots_.push_back(executable.parent_path());
    }
    if (const char* root = std::getenv("GLLADDER_ROOT"); root != nullptr && *root != '\0')
        roots_.emplace_back(root);
}

fs::path Resources::find(const fs::path& relative) const {
    std::string tried;
    std::error_code error;
    for (const fs::path& root : roots_) {
        const fs::path path = root / relative;
        if (fs::exists(path, error)) return path;
        tried += (tried.empty() ? "" : ", ") + path.string();
    }
    throw std::runtime_error(relative.string() + " not found; tried " + tried +
                             "; set GLLADDER_ROOT to the folder that holds shaders and assets");
}

std::vector<fs::path> Resources::shaderRoots() const {
    std::vector<fs::path> roots;
    for (const fs::path& root : roots_)
        roots.push_back(root / "shaders");
    return roots;
}

} // namespace gll
