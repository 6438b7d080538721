// Watching folders by inotify, and by modification times.
#include "window/file_watch.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gll {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds look_interval(100);

// Closing after writing, not writing: a file half written is nobody's business. Attributes: touched.
constexpr std::uint32_t saved = IN_CLOSE_WRITE | IN_MOVED_TO | IN_ATTRIB;
constexpr std::uint32_t listened_to = saved | IN_CREATE | IN_MOVE_SELF | IN_ONLYDIR;

} // namespace

FileWatch::FileWatch(const std::vector<fs::path>& folders, By by) {
    for (const fs::path& folder : folders)
        roots_.push_back(fs::weakly_canonical(folder));
    if (by == By::inotify) listen(nullptr);
    if (inotify_ < 0) {
        std::set<fs::path> as_it_is;
        look(as_it_is);
        for (auto& [path, state] : files_)
            state.is_told = true;
    }
}

FileWatch::~FileWatch() { deafen(); }

std::set<fs::path> FileWatch::changes() {
    std::set<fs::path> found;
    if (inotify_ >= 0) hear(found);
    for (const fs::path& root : roots_) // one that is not there, or not there again
        if (inotify_ >= 0 && std::none_of(folders_.begin(), folders_.end(),
                                          [&](const auto& folder) { return folder.second == root; }))
            watchBelow(root, &found);
    if (inotify_ < 0) look(found);
    return found;
}

// Anew, whatever was listened to before.
void FileWatch::listen(std::set<fs::path>* found) {
    deafen();
    inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    for (const fs::path& root : roots_)
        if (inotify_ >= 0) watchBelow(root, found);
}

void FileWatch::deafen() {
    folders_.clear();
    if (inotify_ >= 0) close(std::exchange(inotify_, -1));
}

// found: is given the files that are there already, unless null.
void FileWatch::watchBelow(const fs::path& folder, std::set<fs::path>* found) {
    const int watch = inotify_add_watch(inotify_, folder.c_str(), listened_to);
    if (watch < 0) {
        if (errno == ENOSPC || errno == ENOMEM) deafen(); // else it is not there, or not for us to read
        return;
    }
    folders_[watch] = folder;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->is_directory(error) && !entry->is_symlink(error)) {
            watchBelow(entry->path(), found);
            if (inotify_ < 0) return;
        } else if (found != nullptr)
            found->insert(entry->path());
    }
}

void FileWatch::hear(std::set<fs::path>& found) {
    alignas(inotify_event) std::array<char, 16384> buffer;
    for (;;) {
        const ssize_t length = read(inotify_, buffer.data(), buffer.size());
        if (length <= 0) return;
        for (ssize_t at = 0; at < length;) {
            const auto& event = *reinterpret_cast<const inotify_event*>(buffer.data() + at);
            at += static_cast<ssize_t>(sizeof event + event.len);
            if ((event.mask & (IN_Q_OVERFLOW | IN_MOVE_SELF)) != 0) { // paths are not what they were
                listen(&found);
                return;
            }
            const auto folder = folders_.find(event.wd);
            if (folder == folders_.end()) continue;
            if ((event.mask & IN_IGNORED) != 0) {
                folders_.erase(folder); // the folder is gone
            } else if (event.len > 0) {
                const fs::path path = folder->second / event.name;
                if ((event.mask & IN_ISDIR) != 0)
                    watchBelow(path, &found);
                else if ((event.mask & saved) != 0)
                    found.insert(path);
                if (inotify_ < 0) return;
            }
        }
    }
}

void FileWatch::look(std::set<fs::path>& found) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_look_ < look_interval) return;
    last_look_ = now;
    std::map<fs::path, State> files;
    for (const fs::path& root : roots_) {
        std::error_code error;
        fs::recursive_directory_iterator entry(root, fs::directory_options::skip_permission_denied, error);
        for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
            struct stat status = {};
            if (stat(entry->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
            State state{{status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size, status.st_ino}};
            const auto before = files_.find(entry->path());
            if (before != files_.end() && before->second.stamp == state.stamp) {
                if (!before->second.is_told) found.insert(entry->path());
                state.is_told = true;
            }
            files.emplace(entry->path(), state);
        }
    }
    files_ = std::move(files);
}

} // namespace gll
