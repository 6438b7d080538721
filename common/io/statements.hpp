// What the OBJ and the MTL reader share: statements with their lines, numbers, the files that they name, and
// warnings. Private to common/io.
#pragma once

#include "io/files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace gll {

// What no material says a color for.
inline constexpr float plain_grey = 0.8F;

// Warnings, with those that say the same of many lines as one.
class Notes {
  public:
    void add(const std::string& where, const std::string& what, std::size_t times = 1) {
        const auto [known, is_new] = numbers_.emplace(what, notes_.size());
        if (is_new) notes_.push_back({where, what, 0});
        notes_[known->second].more += is_new ? times - 1 : times;
    }
    // Does what may throw "where: what"; false, and a note, where it did.
    template <typename Try>
    bool attempt(const std::string& where, const Try& what) {
        try {
            what();
            return true;
        } catch (const std::runtime_error& error) {
            const std::string_view text = error.what();
            add(where, std::string(text.starts_with(where + ": ") ? text.substr(where.size() + 2) : text));
            return false;
        }
    }
    std::vector<std::string> lines() const {
        std::vector<std::string> result;
        for (const Note& note : notes_)
            result.push_back(note.where + ": " + note.what +
                             (note.more > 0 ? " (and " + std::to_string(note.more) + " more like it)" : ""));
        return result;
    }

  private:
    struct Note {
        std::string where, what;
        std::size_t more;
    };
    std::vector<Note> notes_;
    std::map<std::string, std::size_t> numbers_;
};

// One statement of the file: keyword, the rest of the line without blanks at its ends, and where it stands.
struct Statement {
    std::string_view keyword;
    std::string_view rest;
    const std::string& path;
    std::size_t line_number;

    std::string where() const { return path + ":" + std::to_string(line_number); }
};

// The next word of text, which is shortened by it; empty at the end.
inline std::string_view nextWord(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    return word;
}

// Names may hold '#', as in "Material #3": only where a name leads nowhere, what follows is a comment.
inline std::string_view withoutComment(std::string_view name) {
    return trimmed(name.substr(0, name.find(" #")));
}

inline std::string lowerCase(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

// Calls use(statement) for every line that is neither empty nor a comment. Lines end in LF, CRLF or CR; those
// that end in a backslash go on in the next. That, and a byte order mark, become blanks in the text.
template <typename Use>
void forEachStatement(std::string& text, const std::string& path, const Use& use) {
    if (text.find('\0') != std::string::npos)
        throw fileError(path, "is binary or UTF-16, an OBJ or MTL is text in ASCII or UTF-8");
    if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, 3, ' ');
    std::size_t lines = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t first_line = lines + 1;
        std::size_t end = begin;
        std::size_t next = begin;
        while (true) {
            ++lines;
            end = std::min(text.find_first_of("\r\n", next), text.size());
            next = end + (std::string_view(text).substr(end).starts_with("\r\n") ? 2 : 1);
            const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
            if (!line.ends_with('\\') || line.starts_with('#') || next >= text.size()) break;
            const auto backslash = text.begin() + (&line.back() - text.data());
            std::fill(backslash, text.begin() + static_cast<std::ptrdiff_t>(next), ' ');
        }
        std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = next;
        if (line.empty() || line.front() == '#') continue;
        const std::string_view keyword = nextWord(line);
        use(Statement{keyword, trimmed(line), path, first_line});
    }
}

// A finite number that a float can hold with room to spare, because tinyobjloader's own parser rounds
// otherwise than this one. It also raises ten to whatever exponent it finds, so words are limited in length.
inline bool isNumber(std::string_view word, double& value) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    if (parsed.ec == std::errc::result_out_of_range) value = std::numeric_limits<double>::infinity();
    return !word.empty() && parsed.ec != std::errc::invalid_argument &&
           parsed.ptr == word.data() + word.size();
}
inline float parseNumber(std::string_view word, const Statement& s) {
    double value = 0.0;
    if (word.empty()) throw fileError(s.where(), "a number is missing");
    if (!isNumber(word, value)) throw fileError(s.where(), inQuotes(word) + " is not a number");
    if (!(std::abs(value) <= 1e38) || word.size() > 64)
        throw fileError(s.where(), inQuotes(word) + " is not a finite number of sensible size");
    return static_cast<float>(value);
}

// The file that a statement names: in the folder or below it, or else, as names from other machines lead
// nowhere, beside the statement's own file. Empty, with a note, where there is none.
inline std::filesystem::path namedFile(std::string name, const char* what,
                                       const std::filesystem::path& folder, const Statement& s,
                                       Notes& notes) {
    std::filesystem::path file;
    const std::string last = name.substr(name.find_last_of("/\\") + 1);
    Notes unsaid;
    if (last != name && unsaid.attempt("", [&] { file = confinedFile(folder, last, what); }) &&
        !unsaid.attempt("", [&] { file = confinedFile(folder, name, what); })) {
        notes.add(s.where(), what + (": " + inQuotes(name)) + " is taken from the file's own folder");
        return file;
    }
    notes.attempt(s.where(), [&] { file = confinedFile(folder, std::move(name), what); });
    return file;
}

} // namespace gll
