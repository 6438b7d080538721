// Whole files in memory; the checks that come before a file is opened.
// Only regular files are opened: a FIFO would block for ever, a directory reads as an empty file.
#include "io/files.hpp"

#include <cstdint>
#include <fstream>
#include <system_error>

namespace gll {

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

} // namespace gll
