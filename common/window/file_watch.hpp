// Hears which files below some folders are saved: from the kernel, or where that has no watches left by
// looking.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <sys/types.h>
#include <tuple>
#include <vector>

namespace gll {

class FileWatch {
  public:
    enum class By { inotify, looking };

    // The folders, with all below them, may appear, go and come back. by: how to begin; inotify changes to
    // looking where the kernel refuses a watch.
    explicit FileWatch(const std::vector<std::filesystem::path>& folders, By by = By::inotify);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    // The files (canonical paths) that were written to their end, put in place of others, touched or added
    // since the last call; more where what happened is not known. Never waits. By looking, a file is told
    // when it has been the same for a tenth of a second.
    std::set<std::filesystem::path> changes();

    By by() const { return inotify_ < 0 ? By::looking : By::inotify; }

  private:
    void listen(std::set<std::filesystem::path>* found);
    void deafen();
    void watchBelow(const std::filesystem::path& folder, std::set<std::filesystem::path>* found);
    void hear(std::set<std::filesystem::path>& found);
    void look(std::set<std::filesystem::path>& found);

    struct State {
        std::tuple<time_t, long, off_t, ino_t> stamp; // modification time (s, ns), size, file
        bool is_told = false;
    };

    std::vector<std::filesystem::path> roots_;
    int inotify_ = -1;
    std::map<int, std::filesystem::path> folders_; // by their inotify watch
    std::map<std::filesystem::path, State> files_; // as they were when last looked at
    std::chrono::steady_clock::time_point last_look_;
};

} // namespace gll
