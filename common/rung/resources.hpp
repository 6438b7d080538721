// Where a program's own files are: shaders and assets, found from the executable's place, then GLLADDER_ROOT.
#pragma once

#include <filesystem>
#include <vector>

namespace gll {

class Resources {
  public:
    // The folders that may hold shaders/ and assets/, best first. Never the current directory.
    Resources();

    // The first "root/relative" that exists. Throws std::runtime_error naming every path tried.
    std::filesystem::path find(const std::filesystem::path& relative) const;

    std::vector<std::filesystem::path> shaderRoots() const;

  private:
    std::vector<std::filesystem::path> roots_;
};

} // namespace gll
