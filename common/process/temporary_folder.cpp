// Making temporary folders and removing them again.
#include "process/temporary_folder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace gll {
namespace fs = std::filesystem;

namespace {

// The folders that are there. Never destroyed, as folders may outlast what is.
struct Folders {
    std::mutex mutex;
    std::set<fs::path> paths;
};

Folders& folders() {
    static auto* const there = new Folders;
    return *there;
}

constexpr std::array end_signals = {SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, end_signals.size()> actions_before;
int signal_pipe[2] = {-1, -1};

void tellWatcher(int number) {
    const auto byte = static_cast<unsigned char>(number);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(signal_pipe[1], &byte, 1);
    errno = error;
}

// Programs that still run may be writing into a folder that is just being removed.
void removeInsistently(const fs::path& folder) {
    std::error_code ignored;
    for (int attempt = 0; attempt < 100 && fs::exists(folder, ignored); ++attempt) {
        if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        fs::remove_all(folder, ignored);
    }
}

void watch() {
    unsigned char number = 0;
    ssize_t count = 0;
    do
        count = read(signal_pipe[0], &number, 1);
    while (count < 0 && errno == EINTR);
    if (count != 1 || number == 0) return;
    Folders& all = folders();
    all.mutex.lock(); // for good: no folder is made any more
    for (const fs::path& folder : all.paths)
        removeInsistently(folder);
    std::signal(number, SIG_DFL);
    std::raise(number);
}

} // namespace

TemporaryFolder::TemporaryFolder() {
    const std::lock_guard lock(folders().mutex);
    std::string name = (fs::temp_directory_path() / "gl-ladder-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": no folder can be made there");
    path_ = fs::canonical(name);
    folders().paths.insert(path_);
}

TemporaryFolder::~TemporaryFolder() {
    const std::lock_guard lock(folders().mutex);
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    folders().paths.erase(path_);
}

FolderRemoval::FolderRemoval() {
    if (pipe2(signal_pipe, O_CLOEXEC) != 0)
        throw std::runtime_error(std::string("a pipe for signals: ") + std::strerror(errno));
    watcher_ = std::thread(watch);
    struct sigaction action {};
    action.sa_handler = tellWatcher; // programs that are begun have the usual one
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < end_signals.size(); ++i) {
        sigaction(end_signals[i], &action, &actions_before[i]);
        if (actions_before[i].sa_handler == SIG_IGN) sigaction(end_signals[i], &actions_before[i], nullptr);
    }
}

FolderRemoval::~FolderRemoval() {
    for (std::size_t i = 0; i < end_signals.size(); ++i)
        sigaction(end_signals[i], &actions_before[i], nullptr);
    tellWatcher(0);
    watcher_.join();
    for (const int end : signal_pipe)
        close(end);
}

fs::path TemporaryFolder::write(const fs::path& name, std::string_view text) const {
    const std::lock_guard lock(folders().mutex); // it must not come back while a signal removes it
    const fs::path path = path_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(path.string() + ": cannot be written");
    return path;
}

void TemporaryFolder::copy(const fs::path& from, const fs::path& name) const {
    const std::lock_guard lock(folders().mutex);
    const fs::path path = path_ / name;
    fs::create_directories(path.parent_path());
    fs::copy_file(from, path);
}

std::vector<std::string> TemporaryFolder::listing() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path_))
        names.push_back(entry.path().lexically_relative(path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace gll
