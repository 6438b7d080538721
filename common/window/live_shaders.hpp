// Shaders that follow their files while a rung is shown: what is saved is drawn with, and what is wrong with
// it is told until it is mended.
#pragma once

#include "gl/program.hpp"
#include "window/file_watch.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gll {

class LiveShaders {
  public:
    // Watches the shader folders as long as it lives, which the library must outlive. The program's name
    // begins what is said on the terminal.
    LiveShaders(std::string program, ShaderLibrary& shaders, FileWatch::By by = FileWatch::By::inotify)
        : program_(std::move(program)), shaders_(shaders), watch_(shaders.roots(), by) {}

    // Once before a frame, at once. Whether files were saved that programs are made from: the frame is then
    // another.
    bool update() { return shaders_.changed(watch_.changes()); }

    // Renders by calling render. What that throws, such as a uniform that is new and that nothing sets, is
    // then among errors(), and the show goes on. What is newly wrong, and that all is well again, is said on
    // the terminal.
    void attempt(const std::function<void()>& render);
    bool isDrawn() const { return !frame_error_; } // the frame tried last

    // What is wrong at present: of the frame tried last, then of programs that go on as they last were.
    std::vector<ShaderError> errors() const;

  private:
    void tell();

    std::string program_;
    ShaderLibrary& shaders_;
    FileWatch watch_;
    std::optional<ShaderError> frame_error_;
    std::vector<std::string> told_;
};

} // namespace gll
