// What was read otherwise than its file says, or not at all: gathered where files are read, said once by
// whoever drives the rung.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gll {

class Warnings {
  public:
    // How many lines are said at a time; the rest is a count.
    static constexpr std::size_t most_lines = 10;

    // Lines of "where: what", as MeshData::warnings and Image::warnings hold them. The same line is said once
    // in a run, however often its file is read.
    void add(const std::vector<std::string>& lines);

    // What was added since the last call: at most most_lines, then "... and n more".
    std::vector<std::string> take();

  private:
    std::set<std::string> known_;
    std::vector<std::string> waiting_;
};

} // namespace gll
