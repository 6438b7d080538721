// bake: writes everything under assets/ (cat, brick, sky), the same bytes on every run.
// Usage: bake [--help] [OUT_DIR]; see assets/README.md for what comes out.
#include "assets.hpp"

#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;

constexpr const char* usage =
    "usage: bake [--help] [OUT_DIR]\n"
    "Writes cat/, brick/ and sky/ into OUT_DIR, which must exist.\n"
    "Without OUT_DIR: into assets/ of the source tree that holds this executable.\n";

/// The nearest folder above the executable that has the source tree's assets/bake in it.
fs::path sourceAssets() {
    std::error_code failed;
    const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) {
        for (fs::path at = executable.parent_path(); at != at.root_path(); at = at.parent_path()) {
            if (fs::is_regular_file(at / "assets" / "bake" / "CMakeLists.txt")) return at / "assets";
        }
    }
    throw std::runtime_error("no assets/bake above this executable; name a folder: bake OUT_DIR");
}

} // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--help") == 0) {
        std::fputs(usage, stdout);
        return 0;
    }
    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
        std::fputs(usage, stderr);
        return 2;
    }
    try {
        const fs::path out = argc == 2 ? fs::path{argv[1]} : sourceAssets();
        if (!fs::is_directory(out))
            throw std::runtime_error(out.string() + ": no such folder; make it first");
        for (const char* name : {"cat", "brick", "sky"})
            fs::create_directory(out / name);
        bake::bakeSky(out / "sky");
        bake::bakeBrick(out / "brick");
        bake::bakeCat(out / "cat");
        std::printf("done: %s\n", out.string().c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bake: error: %s\n", error.what());
        return 1;
    }
    return 0;
}
