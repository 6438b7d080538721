// What the engine that puts faults into shaders has to know of the ladder: its golden suites, which rung
// draws with which shaders, and how a rung is told of a copy of them.
#pragma once

#include "frame_check/mutate.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gll::test {

// The shaders of a rung's folder, whatever its C++ calls them; those that its C++ names, its own and what it
// includes of other rungs; and what all these include.
std::set<std::string> shadersOf(const std::filesystem::path& root, const std::string& rung);

class Ladder {
  public:
    // The rungs with goldens whose programs are there. Throws std::runtime_error where there is none.
    Ladder(const std::filesystem::path& root, const std::filesystem::path& programs);

    const std::vector<frame_check::Suite>& suites() const { return suites_; }
    // Fills in what is the ladder's. `options` must not outlive this.
    void complete(frame_check::MutationOptions& options) const;

  private:
    // Rungs find shaders and assets from the executable's place: the program and a link to the assets beside
    // the copy of the shaders.
    frame_check::Suite within(const frame_check::Suite& suite, const std::filesystem::path& folder) const;

    std::filesystem::path root_;
    std::vector<frame_check::Suite> suites_;
    std::map<std::string, std::set<std::string>> shaders_; // by rung
};

} // namespace gll::test
