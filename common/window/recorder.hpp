// Recording frames as pictures by this program run a second time, so that they are the headless ones and the
// window goes on.
#pragma once

#include "process/process.hpp"
#include "rung/request.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace gll {

class Recorder {
  public:
    // Begins to write the request's frames into a new folder in the present one, named after the rung and the
    // frames. Throws std::runtime_error where that cannot be made.
    void start(FrameRequest request, const std::string& rung, const std::string& context);
    void cancel();

    // Once a loop. What is to be said when it has ended.
    std::optional<std::string> poll();

    bool isRecording() const { return process_.has_value(); }
    int done() const; // pictures that are there
    int of() const { return of_; }

  private:
    std::optional<Process> process_;
    std::filesystem::path folder_;
    int of_ = 0;
};

} // namespace gll
