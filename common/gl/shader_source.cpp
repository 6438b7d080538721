// Reading shader files and what they include; understanding a compiler's complaints.
#include "gl/shader_source.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

namespace gll {
namespace {

constexpr int max_include_depth = 16;
constexpr std::uintmax_t max_shader_bytes = 1 << 20;
// Lines of file k are numbered from k times this: Mesa forgets the file number of a line marker in all but
// syntax errors, and with the file in the line number it is known all the same.
constexpr int line_stride = 100'000;

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    const auto last = text.find_last_not_of(" \t\r\n");
    return std::string(text.substr(first, last - first + 1));
}

std::string errorText(const std::string& file, int line, const std::string& complaint) {
    std::string text = file;
    if (line > 0) text += ":" + std::to_string(line);
    return text.empty() ? complaint : text + ": " + complaint;
}

// A line of a file, for errors: where it is and what stands there.
struct Place {
    std::string file;
    int line = 0;
    std::string text;

    ShaderError error(std::string complaint) const { return {file, line, std::move(complaint), text}; }
};

// Puts one file and what it includes behind the other into the source.
class Preprocessor {
  public:
    Preprocessor(const std::vector<std::filesystem::path>& roots, const Defines& defines,
                 std::set<std::filesystem::path>* looked_for)
        : roots_(roots), defines_(defines), looked_for_(looked_for) {}

    ShaderSource run(const std::string& file) {
        append(file, Place{}, 0);
        return std::move(source_);
    }

  private:
    // A file, however its name was spelt.
    ShaderFile read(const std::string& file, const Place& asked_from) {
        std::vector<std::filesystem::path> tried;
        std::string tried_text;
        for (const std::filesystem::path& root : roots_) {
            const auto canonical_root = std::filesystem::weakly_canonical(root);
            const auto path = std::filesystem::weakly_canonical(root / file);
            const auto relative = path.lexically_relative(canonical_root);
            if (relative.empty() || *relative.begin() == "..")
                throw asked_from.error("\"" + file +
                                       "\" lies outside the shader folder; name files inside it");
            if (looked_for_ != nullptr) looked_for_->insert(path);
            std::error_code error;
            if (std::filesystem::is_regular_file(path, error)) {
                if (std::filesystem::file_size(path, error) > max_shader_bytes && !error)
                    throw ShaderError(path, 0, "larger than 1 MiB, which no shader is");
                std::ifstream stream(path, std::ios::binary);
                std::ostringstream text;
                text << stream.rdbuf();
                if (!stream.is_open() || stream.bad()) throw ShaderError(path, 0, "cannot be read");
                return {file, path, text.str()};
            }
            tried.push_back(path);
            tried_text += (tried_text.empty() ? "" : ", ") + path.string();
        }
        ShaderError error = asked_from.error("shader file " + file + " not found; tried " + tried_text);
        error.tried = std::move(tried);
        throw error;
    }

    void append(const std::string& name, const Place& asked_from, int depth) {
        ShaderFile file = read(name, asked_from);
        if (!included_.insert(file.path).second) return;
        if (depth > max_include_depth)
            throw asked_from.error("includes go more than " + std::to_string(max_include_depth) + " deep");
        const auto number = static_cast<int>(source_.files.size());
        std::istringstream lines(file.text);
        source_.files.push_back(std::move(file));
        if (depth > 0) markLine(number, 1);

        Place here{name, 0, {}};
        while (std::getline(lines, here.text)) {
            if (!here.text.empty() && here.text.back() == '\r') here.text.pop_back();
            if (++here.line >= line_stride) throw here.error("more lines than a shader has");
            const std::string statement = trimmed(here.text);
            if (statement.starts_with("#version")) {
                if (depth > 0) throw here.error("#version belongs into the stage alone");
                source_.text += here.text + "\n";
                for (const Define& define : defines_)
                    source_.text += "#define " + define.name + " " + define.value + "\n";
                markLine(number, here.line + 1);
            } else if (statement.starts_with("#include")) {
                append(includedFile(statement, here), here, depth + 1);
                markLine(number, here.line + 1);
            } else {
                source_.text += here.text + "\n";
            }
        }
    }

    void markLine(int file, int line) {
        source_.text +=
            "#line " + std::to_string(file * line_stride + line) + " " + std::to_string(file) + "\n";
    }

    static std::string includedFile(const std::string& statement, const Place& place) {
        const auto open = statement.find('"');
        const auto close = statement.rfind('"');
        if (open == std::string::npos || close <= open + 1)
            throw place.error("write #include \"lib/name.glsl\"");
        return statement.substr(open + 1, close - open - 1);
    }

    const std::vector<std::filesystem::path>& roots_;
    const Defines& defines_;
    std::set<std::filesystem::path>* looked_for_;
    ShaderSource source_;
    std::set<std::filesystem::path> included_;
};

// The first line of a log that speaks of an error, or else its first: warnings may stand before it.
std::string firstErrorLine(const std::string& log) {
    std::istringstream lines(log);
    std::string first;
    for (std::string line; std::getline(lines, line);) {
        line = trimmed(line);
        if (first.empty()) first = line;
        std::string small = line;
        std::transform(small.begin(), small.end(), small.begin(),
                       [](unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : char(c); });
        if (small.find("error") != std::string::npos) return line;
    }
    return first;
}

std::string lineOf(const std::string& text, int number) {
    std::istringstream lines(text);
    std::string line;
    for (int i = 0; i < number; ++i)
        if (!std::getline(lines, line)) return {};
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

} // namespace

ShaderError::ShaderError(std::string in_file, int at_line, std::string says, std::string line_text)
    : std::runtime_error(errorText(in_file, at_line, says)), file(std::move(in_file)), line(at_line),
      complaint(std::move(says)), source_line(std::move(line_text)) {}

ShaderSource readShader(const std::vector<std::filesystem::path>& roots, const std::string& file,
                        const Defines& defines, std::set<std::filesystem::path>* looked_for) {
    return Preprocessor(roots, defines, looked_for).run(file);
}

// The "file number:line" or "file number(line)" of a complaint is turned into the file's name and its own
// line; see line_stride.
ShaderError ShaderSource::firstComplaint(const std::string& log) const {
    std::string line = firstErrorLine(log);
    if (line.starts_with("ERROR: ")) line = line.substr(7);
    std::size_t file = 0;
    const char* end = line.data() + line.size();
    const auto [after_file, file_error] = std::from_chars(line.data(), end, file);
    if (file_error == std::errc() && after_file < end && (*after_file == ':' || *after_file == '(') &&
        file < files.size()) {
        int number = 0;
        const auto [after_line, line_error] = std::from_chars(after_file + 1, end, number);
        if (line_error == std::errc()) {
            if (const auto told = static_cast<std::size_t>(number / line_stride);
                number > 0 && told < files.size() && told > 0)
                file = told;
            number = std::max(number % line_stride, 0);
            std::string_view rest(after_line, static_cast<std::size_t>(end - after_line));
            while (!rest.empty() && std::string_view(" :()0123456789").find(rest.front()) != rest.npos)
                rest.remove_prefix(1); // a column, if any
            return {files[file].name, number, std::string(rest), lineOf(files[file].text, number)};
        }
    }
    return {files.empty() ? std::string("shader") : files.front().name, 0, line};
}

} // namespace gll
