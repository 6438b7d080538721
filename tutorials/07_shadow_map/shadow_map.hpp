// Whether the sun is seen: the scene's depth as the sun sees it, and comparing with it.
#pragma once

#include "06_gbuffer/gbuffer.hpp"

#include <array>

namespace gll::shadow_map {

inline constexpr int max_cascades = 4;

// The sun, and what of the scene its light is followed to.
struct Sun {
    glm::vec3 to_sun{0, 1, 0};    // world, unit length
    glm::vec3 target{0, 0.8F, 0}; // the fixed view's middle, world
    float distance = 8;           // of the fixed view from its middle, world units
    float half_width = 4;         // of the fixed view
    float near = 0.1F;            // of the fixed view, world units from where it looks
    float far = 20;
    bool casters_beyond = true; // whether what stands before the fixed view's near plane casts a shadow too
    float receivers_far = 20;   // the fitted views follow shadows to this distance from the camera
    float casters_reach = 10;   // and see what casts them this much nearer the sun
};

// A square parallel view along the sun's light.
struct SunView {
    glm::mat4 view_from_world{1};
    glm::vec2 middle{0};  // of the view, in view space, world units
    float half_width = 1; // world units
    float near = 0;       // distances along the view, world units
    float far = 1;

    glm::mat4 clipFromWorld() const;
    float texel(int size) const { return 2 * half_width / static_cast<float>(size); } // world units
};

struct ShadowOptions {
    // Declares the settings. Every rung but 07 shares them.
    explicit ShadowOptions(Settings& settings);

    Integer size;
    Choice filter;
    Choice pcf;
    Choice bias;
    Choice fit;
    Integer cascades;
    Number sun_radius_deg;

    bool hasMoments() const { return filter == "vsm" || filter == "evsm" || filter == "msm"; }
    bool compares() const { return filter == "pcf" || filter == "rotated_disk"; }
    // Whether the bias wants the surface's geometric normal, see gbuffer::GBufferOptions::geometric.
    bool usesGeometry() const { return !(bias == "constant") && !(bias == "slope"); }
    Defines defines() const;
};

// The views for a frame, from the nearest cascade on. fixed and as_printed have one whatever the cascades.
std::vector<SunView> sunViews(const Sun& sun, const gbuffer::View& camera, const ShadowOptions& options);

class ShadowMap {
  public:
    explicit ShadowMap(ShaderLibrary& shaders) : shaders_(shaders) {}

    // Passes "shadow" ("shadow0" and on for cascades), the depth of everything that casts shadows, and, for
    // filters of moments, "shadow_moments_x" and "_y". Draws' parts name variants of 07_shadow_map/shadow.
    void draw(Frame& frame, const Sun& sun, const gbuffer::View& camera, const std::vector<Draw>& casters,
              const ShadowOptions& options);

    // For shaders that include 07_shadow_map/shadow.glsl. Valid until the next draw().
    ShaderPart part(const Sun& sun, const ShadowOptions& options) const;

    const std::vector<SunView>& views() const { return views_; } // of the last draw()

  private:
    void drawMoments(Frame& frame, const ShadowOptions& options);

    ShaderLibrary& shaders_;
    Framebuffer target_;
    std::array<Framebuffer, 2> moments_; // filtered along x, and then y
    std::vector<SunView> views_;
};

} // namespace gll::shadow_map
