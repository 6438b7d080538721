// What the fuzz targets share: a folder in memory-backed storage where each input becomes a file.
// The readers take paths, so an input has to be one; /dev/shm costs no disk. libFuzzer leaves without running
// destructors, so the folders (gll_fuzz_*) stay behind until someone removes them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

namespace gll::fuzz {

inline const std::filesystem::path& folder() {
    static const std::filesystem::path made = [] {
        std::string name =
            std::filesystem::is_directory("/dev/shm") ? "/dev/shm/gll_fuzz_XXXXXX" : "gll_fuzz_XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        return std::filesystem::path(name);
    }();
    return made;
}

inline std::filesystem::path write(const char* name, std::string_view bytes) {
    const std::filesystem::path path = folder() / name;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr || std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) std::abort();
    std::fclose(file);
    return path;
}

// std::runtime_error that begins with the path is the one way out a reader may take besides returning.
template <typename Work>
void mayOnlyRefuse(const Work& work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        const std::string_view message = error.what();
        if (!message.starts_with(folder().string())) std::abort();
        if (message.find('\n') != std::string_view::npos) std::abort();
    }
}

} // namespace gll::fuzz
