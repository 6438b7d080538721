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

// The bytes of a regular file of at most max_bytes. Anything else is never opened (opening a FIFO would
// hang). Throws std::runtime_error "path: what, what to do".
std::string readFile(const std::filesystem::path& path, std::size_t max_bytes);

// Throws as readFile does, without reading: for files that are only named here and read later.
void requireRegularFile(const std::filesystem::path& path);

} // namespace gll
