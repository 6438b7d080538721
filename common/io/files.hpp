// Whole files in memory, and errors that name them: what every reader of gll_io begins with.
// Private to common/io; nothing here is part of the library's interface.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gll {

// The one form of this library's errors: "where: what, what to do".
inline std::runtime_error fileError(std::string_view where, std::string_view what) {
    return std::runtime_error(std::string(where) + ": " + std::string(what));
}

// What a message shows of a word from a file, which may be of any length and hold any bytes.
inline std::string inQuotes(std::string_view word) {
    std::string result = "'";
    for (const char c : word.substr(0, 80))
        result += (c >= 0 && c < ' ') || c == '\x7f' ? '?' : c;
    return result + "'";
}

// Without blanks at either end, the return before a line feed among them.
inline std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

// The bytes of a regular file of at most max_bytes. Anything else is never opened (opening a FIFO would
// hang). Throws std::runtime_error "path: what, what to do".
std::string readFile(const std::filesystem::path& path, std::size_t max_bytes);

// The file that `relative` names inside `folder`, symbolic links resolved. It must exist, be regular and lie
// in the folder or below: a mesh must not make us read /etc. Backslashes count as separators. `where` names
// the reference in the error, std::runtime_error "where: what, what to do".
std::filesystem::path confinedFile(const std::filesystem::path& folder, std::string relative,
                                   std::string_view where);

} // namespace gll
