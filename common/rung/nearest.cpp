// The edit distance with swaps of neighbours: optimal string alignment (Boytsov, Indexing Methods for
// Approximate Dictionary Searching, 2011).
#include "rung/nearest.hpp"

#include <algorithm>

namespace gll {
namespace {

constexpr std::size_t longest_name = 64; // no name is longer, and a text of megabytes is not compared

std::size_t edits(std::string_view one, std::string_view other) {
    // Three rows of the table of distances between the beginnings of both.
    std::vector<std::size_t> before(other.size() + 1);
    std::vector<std::size_t> last(other.size() + 1);
    std::vector<std::size_t> row(other.size() + 1);
    for (std::size_t j = 0; j <= other.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= one.size(); ++i) {
        before.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= other.size(); ++j) {
            const std::size_t changed = one[i - 1] == other[j - 1] ? 0 : 1;
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + changed});
            if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[other.size()];
}

std::string plain(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = c == '-' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

} // namespace

std::string nearestName(std::string_view text, const std::vector<std::string>& names) {
    if (text.size() < 2 || text.size() > longest_name) return "";
    const std::string meant = plain(text);
    const std::string* nearest = nullptr;
    std::size_t fewest = (text.size() + 2) / 3; // a third of the letters; with more, any name is near
    for (const std::string& name : names) {
        const std::size_t here = edits(meant, plain(name));
        if (here < fewest || (here == fewest && nearest == nullptr)) {
            nearest = &name;
            fewest = here;
        }
    }
    // Else the one that goes on as the text begins: "aces" for aces_hill, "thresh" for threshold.
    for (const std::string& name : names)
        if (nearest == nullptr && meant.size() > 2 && plain(name).starts_with(meant)) nearest = &name;
    return nearest == nullptr ? "" : *nearest;
}

std::string didYouMean(std::string_view text, const std::vector<std::string>& names) {
    const std::string nearest = nearestName(text, names);
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

} // namespace gll
