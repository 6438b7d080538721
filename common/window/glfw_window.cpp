// Opening a window by GLFW.
#include "window/glfw_window.hpp"

#include "window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>

namespace gll {
namespace {

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

// The monitor with the most of the window on it.
GLFWmonitor* monitorOf(GLFWwindow* window) {
    glm::ivec2 low(0);
    glm::ivec2 size(0);
    glfwGetWindowPos(window, &low.x, &low.y);
    glfwGetWindowSize(window, &size.x, &size.y);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    int most = 0;
    for (int i = 0; i < count; ++i) {
        glm::ivec2 corner(0);
        glm::ivec2 extent(0);
        glfwGetMonitorWorkarea(monitors[i], &corner.x, &corner.y, &extent.x, &extent.y);
        const int width = std::min(low.x + size.x, corner.x + extent.x) - std::max(low.x, corner.x);
        const int height = std::min(low.y + size.y, corner.y + extent.y) - std::max(low.y, corner.y);
        if (std::max(width, 0) * std::max(height, 0) <= most) continue;
        most = width * height;
        best = monitors[i];
    }
    return best;
}

} // namespace

GlfwLibrary::GlfwLibrary() {
    // Asked for a display that nothing names, Wayland's library complains on stderr where there is no
    // XDG_RUNTIME_DIR.
    const bool wayland = isSet("WAYLAND_DISPLAY") || isSet("WAYLAND_SOCKET");
    if (!wayland && !isSet("DISPLAY")) throw NoWindow("neither DISPLAY nor WAYLAND_DISPLAY is set");
#ifdef GLFW_PLATFORM // GLFW 3.4, which otherwise tries Wayland first
    if (!wayland) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (glfwInit() != GLFW_TRUE) throw NoWindow(glfwReason());
}

GlfwLibrary::~GlfwLibrary() { glfwTerminate(); }

WindowContext::WindowContext(const std::string& title, glm::ivec2 size) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) throw NoWindow(glfwReason());
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    try {
        load(glfwGetProcAddress);
    } catch (...) {
        glfwDestroyWindow(window_);
        throw;
    }
}

WindowContext::~WindowContext() { glfwDestroyWindow(window_); }

glm::ivec2 WindowContext::sizePx() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 WindowContext::size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

void WindowContext::resize(glm::ivec2 size_at_scale_1) {
    glm::ivec2 size(glm::vec2(size_at_scale_1) * contentScale() / pixelsPerUnit());
    if (GLFWmonitor* monitor = monitorOf(window_); monitor != nullptr) {
        glm::ivec2 corner(0);
        glm::ivec2 extent(0);
        glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &extent.x, &extent.y);
        if (extent.x > 0 && extent.y > 0) size = glm::min(size, extent);
    }
    if (size != this->size()) glfwSetWindowSize(window_, size.x, size.y);
}

float WindowContext::pixelsPerUnit() const {
    const int width = size().x;
    return width < 1 ? 1.0F : static_cast<float>(sizePx().x) / static_cast<float>(width);
}

float WindowContext::contentScale() const {
    float x = 1;
    float y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(x, 1.0F, 4.0F);
}

void WindowContext::showResizeCursor(bool is_shown) {
    if (is_shown && resize_cursor_ == nullptr) resize_cursor_ = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    glfwSetCursor(window_, is_shown ? resize_cursor_ : nullptr);
}

bool WindowContext::isFullScreen() const { return glfwGetWindowMonitor(window_) != nullptr; }

void WindowContext::setFullScreen(bool full_screen) {
    if (full_screen == isFullScreen()) return;
    if (!full_screen) {
        glfwSetWindowMonitor(window_, nullptr, place_before_.x, place_before_.y, size_before_.x,
                             size_before_.y, 0);
        return;
    }
    GLFWmonitor* monitor = monitorOf(window_);
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &place_before_.x, &place_before_.y);
    size_before_ = size();
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

} // namespace gll
