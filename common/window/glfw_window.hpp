// GLFW's window with its OpenGL context.
#pragma once

#include "rung/context.hpp"

#include <glm/vec2.hpp>
#include <string>

struct GLFWcursor;
struct GLFWwindow;

namespace gll {

// GLFW, as long as a window is open. Throws NoWindow (window/window.hpp) where there is no display.
struct GlfwLibrary {
    GlfwLibrary();
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

class WindowContext final : public Context {
  public:
    // size: of its inside, in the display's units. Throws NoWindow where OpenGL 3.3 is not to be had.
    WindowContext(const std::string& title, glm::ivec2 size);
    ~WindowContext() override;
    const char* kind() const override { return "window"; }

    GLFWwindow* window() const { return window_; }
    glm::ivec2 sizePx() const;
    glm::ivec2 size() const; // in the display's units, which the cursor's place is in, too
    // To a size at a content scale of 1, which is as much larger as the scale, and no larger than the
    // display.
    void resize(glm::ivec2 size_at_scale_1);
    float pixelsPerUnit() const;          // 2 on many HiDPI displays, always 1 on X11
    float contentScale() const;           // how large the display wants things drawn, 1 to 4, in pixels
    void showResizeCursor(bool is_shown); // that of an edge which can be dragged sideways
    bool isFullScreen() const;
    void setFullScreen(bool full_screen); // on the display that the window is on, and back to where it was

  private:
    GLFWwindow* window_ = nullptr;
    GLFWcursor* resize_cursor_ = nullptr; // GLFW's to destroy
    glm::ivec2 place_before_{0};          // before it filled the screen
    glm::ivec2 size_before_{0};
};

} // namespace gll
