// The error of a caller: an unknown name, a value out of range. Programs end with exit code 2 on it, 1 on any
// other.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gll {

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What there is, as a message lists it: "one, two, three".
inline std::string joined(const std::vector<std::string>& words, const char* between = ", ") {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

} // namespace gll
