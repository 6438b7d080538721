// Whether the sun is seen: the scene's depth as the sun sees it, and comparing with it.
#pragma once

#include "gl/framebuffer.hpp"
#include "rung/frame.hpp"
#include "rung/settings.hpp"

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace gll::shadow_map {

// A square parallel view along the sun's light.
struct SunView {
    glm::vec3 to_sun{0, 1, 0}; // world, unit length
    glm::mat4 view_from_world{1};
    float half_width = 1; // world units
    float near = 0;       // distance along the view, world units
    float far = 1;

    glm::mat4 clipFromWorld() const;
};

struct ShadowOptions {
    // Declares the settings. Every rung but 07 shares them.
    explicit ShadowOptions(Settings& settings);

    Integer size;
    Choice pcf;
    Choice bias;

    Defines defines() const;
};

class ShadowMap {
  public:
    explicit ShadowMap(ShaderLibrary& shaders) : shaders_(shaders) {}

    // Pass "shadow": the depth of everything that casts shadows. Draws name variants of 07_shadow_map/shadow.
    void draw(Frame& frame, const SunView& sun, const std::vector<Draw>& casters,
              const ShadowOptions& options);

    // For shaders that include 07_shadow_map/shadow.glsl. Valid until the next draw().
    ShaderPart part(const SunView& sun, const ShadowOptions& options) const;

  private:
    ShaderLibrary& shaders_;
    Framebuffer target_{{{.name = "shadow",
                          .format = Format::depth24,
                          .filter = Filter::linear,
                          .wrap = Wrap::border_one, // outside of what the sun's view holds, all is lit
                          .compare_depth = true}},
                        {1, 1}};
};

} // namespace gll::shadow_map
