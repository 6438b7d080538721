// What somebody may have meant who misspelt a name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gll {

// The name that is the fewest edits away (a letter more, less, other, or two neighbours swapped; capitals
// and the kind of dash count for nothing). Empty where even that one is too far off to have been meant.
std::string nearestName(std::string_view text, const std::vector<std::string>& names);

// "; did you mean NAME?", to add to an error; empty likewise.
std::string didYouMean(std::string_view text, const std::vector<std::string>& names);

} // namespace gll
