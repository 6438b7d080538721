// The rungs whose frames show faults, and a copy of the shaders to put faults into.
#pragma once

#include "frame_check/render.hpp"
#include "io/image.hpp"
#include "process/temporary_folder.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace gll::test {

// Throws std::runtime_error where it cannot be read.
std::string readText(const std::filesystem::path& file);

struct Rung {
    std::string name;
    frame_check::Suite suite;
    std::vector<Image> references; // one a case
    std::set<std::string> shaders; // those that it may draw with
};

// The shaders of a rung's folder, whatever its C++ calls them; those that its C++ names, its own and what it
// includes of other rungs; and what all these include.
std::set<std::string> shadersOf(const std::filesystem::path& root, const std::string& rung);

// A folder that rungs take for theirs, because they find shaders and assets from the executable's place.
class Copy {
  public:
    Copy(const std::filesystem::path& root, const std::vector<Rung>& rungs);
    // The rung's suite, drawn with this folder's shaders.
    frame_check::Suite suite(const Rung& rung) const;
    void write(const std::string& shader, const std::string& text) const {
        folder_.write(std::filesystem::path("shaders") / shader, text);
    }

  private:
    TemporaryFolder folder_;
};

} // namespace gll::test
