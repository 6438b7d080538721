// Whole files in memory; the checks that come before a file is opened.
// Only regular files are opened: a FIFO would block for ever, a directory reads as an empty file.
#include "io/files.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace gll {
namespace {

void requireRegularFile(const std::filesystem::path& path) {
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw fileError(path.string(), "no such file, check the name and the folder");
    if (std::filesystem::is_directory(status))
        throw fileError(path.string(), "is a folder, name a file in it");
    if (!std::filesystem::is_regular_file(status))
        throw fileError(path.string(), "is not a regular file, copy its contents to one");
}

} // namespace

std::string readFile(const std::filesystem::path& path, std::size_t max_bytes) {
    requireRegularFile(path);
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(path, failure);
    std::ifstream file(path, std::ios::binary);
    if (failure || !file) throw fileError(path.string(), "cannot be opened, check its permissions");
    if (size > max_bytes)
        throw fileError(path.string(), "has " + std::to_string(size) + " bytes, at most " +
                                           std::to_string(max_bytes) + " are read");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::size_t>(file.gcount()) != bytes.size())
        throw fileError(path.string(), "cannot be read to its end, check the disk");
    return bytes;
}

std::filesystem::path confinedFile(const std::filesystem::path& folder, std::string relative,
                                   std::string_view where) {
    const std::string quoted = inQuotes(relative).append(" ");
    std::replace(relative.begin(), relative.end(), '\\', '/');
    if (relative.empty() || relative.find('\0') != std::string::npos) throw fileError(where, "names no file");
    // "C:", "https:" and "file:" alike; a colon in a plain name is too rare to be worth the doubt.
    if (relative.front() == '/' || relative.find(':') != std::string::npos)
        throw fileError(where, quoted + "is not a path relative to the file's folder, make it one");
    const std::filesystem::path inside(relative);
    if (std::find(inside.begin(), inside.end(), "..") != inside.end())
        throw fileError(where, quoted + "leaves the file's folder, move what it names inside");

    std::error_code failure;
    const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, failure);
    const std::filesystem::path file = std::filesystem::canonical(root / inside, failure);
    if (failure) throw fileError(where, quoted + "is missing, no such file as " + (folder / inside).string());
    if (std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first != root.end())
        throw fileError(where, quoted + "is a link out of the file's folder, copy what it points to");
    if (!std::filesystem::is_regular_file(file, failure))
        throw fileError(where, quoted + "is not a regular file");
    return file;
}

} // namespace gll
