// A folder that is there as long as its object lives, and what lies in files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace gll {

class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

    // Writes a file, and the folders that it lies in; returns its path.
    std::filesystem::path write(const std::filesystem::path& name, std::string_view text) const;
    // Copies a file, and makes the folders that it lies in. Throws std::filesystem::filesystem_error.
    void copy(const std::filesystem::path& from, const std::filesystem::path& name) const;
    // What lies in it, at any depth, by name.
    std::vector<std::string> listing() const;

  private:
    std::filesystem::path path_;
};

// While one lives, SIGINT, SIGTERM and SIGHUP end this process as they would, once its temporary folders are
// removed. A signal that is ignored stays so. Throws std::runtime_error where the system has no pipe for it.
class FolderRemoval {
  public:
    FolderRemoval();
    ~FolderRemoval();
    FolderRemoval(const FolderRemoval&) = delete;
    FolderRemoval& operator=(const FolderRemoval&) = delete;

  private:
    std::thread watcher_;
};

// All bytes of a file; nothing where it cannot be read.
std::string contents(const std::filesystem::path& file);

} // namespace gll
