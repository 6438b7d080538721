// One frame as a rung renders it: its number, time and size, and the passes it is made of.
#pragma once

#include "gl/pass.hpp"

#include <string>
#include <vector>

namespace gll {

inline constexpr double frames_per_second = 60;
inline constexpr int max_frame = 10'000'000; // 46 hours; beyond, float32 time is too coarse to animate by

// What is known of a pass that has been drawn. The target lives as long as the rung keeps it.
struct DrawnPass {
    std::string name;
    const Framebuffer* target = nullptr;
    double bytes_per_pixel = 0; // see bytesPerPixel() in gl/pass.hpp
    GLuint program = 0;
};

// Told of every pass as it is drawn: how passes are measured, captured and inspected.
class PassObserver {
  public:
    virtual ~PassObserver() = default;
    virtual void before(const std::string& /*name*/) {}
    virtual void after(const DrawnPass& /*pass*/) {}
};

class Frame {
  public:
    // number: 1 and up. presented is the frame's last target, which a display shows. observer may be null.
    Frame(int number, const Framebuffer& presented, const Mesh& full_screen_triangle, PassObserver* observer)
        : number_(number), presented_(presented), full_screen_triangle_(full_screen_triangle),
          observer_(observer) {}

    int number() const { return number_; }
    float time_s() const { return static_cast<float>(number_ / frames_per_second); }
    glm::ivec2 size() const { return presented_.size(); } // pixels
    float aspect() const { return static_cast<float>(size().x) / static_cast<float>(size().y); }

    // RGBA8 holding what a display is sent: sRGB-encoded, target "frame".
    const Framebuffer& presented() const { return presented_; }

    // Draws one pass into the target; see gl/pass.hpp. Names are unique within a frame.
    void pass(const std::string& name, const Framebuffer& target, const Pass& pass);

    const std::vector<DrawnPass>& passes() const { return passes_; }

  private:
    int number_;
    const Framebuffer& presented_;
    const Mesh& full_screen_triangle_;
    PassObserver* observer_;
    std::vector<DrawnPass> passes_;
};

} // namespace gll
