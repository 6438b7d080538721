// The rungs whose frames show faults, a copy of the shaders to put faults into, and rendering with it.
#pragma once

#include "golden/case.hpp"
#include "io/image.hpp"
#include "process/process.hpp"
#include "support/temporary_folder.hpp"

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gll::test {

inline const std::map<std::string, std::optional<std::string>> rasteriser = {
    {"GALLIUM_DRIVER", "llvmpipe"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"LP_NUM_THREADS", "0"}};

// Throws std::runtime_error where it cannot be read.
std::string readText(const std::filesystem::path& file);

struct Rung {
    std::string name;
    std::filesystem::path program;
    std::vector<GoldenCase> cases;
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
    std::filesystem::path program(const Rung& rung) const { return folder_ / "bin" / rung.name; }
    void write(const std::string& shader, const std::string& text) const {
        folder_.write(std::filesystem::path("shaders") / shader, text);
    }

  private:
    TemporaryFolder folder_;
};

// Renders cases of a rung one after the other, and lets each be looked at as soon as it is there.
class Rendering {
  public:
    Rendering(const Copy& copy, const Rung& rung, const std::filesystem::path& goldens,
              const std::vector<std::size_t>& cases);

    // The next frame; nothing where it could not be drawn, or after the last.
    std::optional<Image> next();
    bool atEnd() const { return next_ >= count_ || hangs_; }
    bool hangs() const { return hangs_; }
    // What it said on stderr, after the last frame.
    std::string messages();

  private:
    std::filesystem::path file(std::size_t i) const { return folder_ / (std::to_string(i) + ".png"); }

    TemporaryFolder folder_;
    std::size_t count_;
    std::size_t next_ = 0;
    bool hangs_ = false;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::optional<Process> process_;
    std::optional<ProcessResult> end_;
};

} // namespace gll::test
