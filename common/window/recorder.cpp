// The second process, and how far it is.
#include "window/recorder.hpp"

#include <algorithm>
#include <csignal>
#include <iterator>
#include <system_error>

namespace gll {
namespace fs = std::filesystem;

void Recorder::start(FrameRequest request, const std::string& rung, const std::string& context) {
    const std::string stem =
        rung + "_frames_" + std::to_string(request.first_frame) + "_to_" + std::to_string(request.last_frame);
    folder_ = stem;
    for (int i = 2; fs::exists(folder_); ++i)
        folder_ = stem + "_" + std::to_string(i);
    std::error_code error;
    if (!fs::create_directory(folder_, error))
        throw std::runtime_error(folder_.string() + ": cannot be made (" + error.message() + ")");
    request.out = fs::absolute(folder_) / "frame_%06d.png";
    of_ = (request.last_frame - request.first_frame) / request.step + 1;
    process_.emplace(headlessCommand(request, context));
}

void Recorder::cancel() {
    if (!process_) return;
    process_->signal(SIGINT); // finishes the picture that it is at
}

int Recorder::done() const {
    std::error_code error;
    return static_cast<int>(std::distance(fs::directory_iterator(folder_, error), fs::directory_iterator()));
}

std::optional<std::string> Recorder::poll() {
    if (!process_) return {};
    const std::optional<ProcessResult> result = process_->poll();
    if (!result) return {};
    process_.reset();
    if (result->exit_code == 0) return "wrote " + std::to_string(of_) + " frames into " + folder_.string();
    if (result->exit_code == 130)
        return "recording ended: " + std::to_string(done()) + " of " + std::to_string(of_) +
               " frames are in " + folder_.string();
    return "recording failed: " + result->err;
}

} // namespace gll
