// Gathering warnings and cutting them short.
#include "rung/warnings.hpp"

#include <algorithm>
#include <utility>

namespace gll {

void Warnings::add(const std::vector<std::string>& lines) {
    for (std::string line : lines) {
        // Names from files are shown on a terminal, and a warning is one line of it.
        std::replace_if(
            line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
        if (known_.insert(line).second) waiting_.push_back(std::move(line));
    }
}

std::vector<std::string> Warnings::take() {
    std::vector<std::string> lines = std::move(waiting_);
    waiting_.clear();
    if (lines.size() > most_lines) {
        const std::size_t more = lines.size() - most_lines;
        lines.resize(most_lines);
        lines.push_back("... and " + std::to_string(more) + " more");
    }
    return lines;
}

} // namespace gll
