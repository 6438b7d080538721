// The sun's views, drawing them, and what readers of them need.
#include "shadow_map.hpp"

#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gll::shadow_map {

// excerpt: settings
ShadowOptions::ShadowOptions(Settings& settings)
    : size(settings.integer("shadow_size", 1024, 16, 8192, "side of the shadow map, texels")),
      filter(settings.choice(
          "shadow_filter", "pcf", {"pcf", "rotated_disk", "pcss", "vsm", "evsm", "msm"},
          "how edges are softened: comparisons averaged in a square; on a disk turned in each "
          "pixel; the wider the farther what casts them; or from 2 or 4 moments of depth")),
      pcf(settings.choice("shadow_pcf", "5", {"1", "3", "5", "7", "9"},
                          "how wide the filter is, texels; pcss finds its own width")),
      bias(settings.choice(
          "shadow_bias", "slope", {"constant", "slope", "texel", "normal_offset", "front_faces", "plane"},
          "against self-shadowing: 0.0025; by slope and polygon offset; by slope and texel size; "
          "along the normal; only back faces cast; each texel compared with the surface's plane")),
      fit(settings.choice(
          "shadow_fit", "fixed", {"fixed", "as_printed", "fitted", "stable"},
          "what the sun's view holds: a fixed square; that, looking 3 degrees past the sun; what the "
          "camera sees; a sphere round that, moved by whole texels")),
      cascades(settings.integer(
          "cascades", 1, 1, max_cascades,
          "sun's views, each for a farther part of what the camera sees; fitted and stable")),
      sun_radius_deg(
          settings.number("sun_radius_deg", 1, 0.05, 10,
                          "half of the angle that the sun takes up, for pcss; the real one has 0.27")) {
    settings.shared("07_shadow_map", {"shadow_size", "shadow_filter", "shadow_pcf", "shadow_bias",
                                      "shadow_fit", "cascades", "sun_radius_deg"});
    settings.needs({"cascades"}, {{"shadow_fit", {"fitted", "stable"}}});
    settings.needs({"sun_radius_deg"}, {{"shadow_filter", {"pcss"}}});
}
// end excerpt

Defines ShadowOptions::defines() const {
    const bool one_view = fit == "fixed" || fit == "as_printed";
    return filter.defines() + bias.defines() +
           Defines{{"PCF_TAPS", pcf.name()}, {"CASCADES", one_view ? "1" : std::to_string(int(cascades))}};
}

glm::mat4 SunView::clipFromWorld() const {
    return glm::ortho(middle.x - half_width, middle.x + half_width, middle.y - half_width,
                      middle.y + half_width, near, far) *
           view_from_world;
}

namespace {

// From the middle of everything, as fitted views move.
glm::mat4 lightFromWorld(const Sun& sun) {
    const glm::vec3 up = std::abs(sun.to_sun.y) > 0.99F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return glm::lookAt(sun.to_sun, glm::vec3(0), up);
}

SunView fixedView(const Sun& sun, bool as_printed) {
    // As printed, the view's middle is lifted but not the place it is looked at from.
    const glm::vec3 from = sun.to_sun * sun.distance + (as_printed ? glm::vec3(0) : sun.target);
    return {.view_from_world = glm::lookAt(from, sun.target, {0, 1, 0}),
            .half_width = sun.half_width,
            .near = sun.near,
            .far = sun.far};
}

// The corners of what the camera sees between two distances, world.
std::array<glm::vec3, 8> sliceCorners(const gbuffer::View& camera, float from, float to) {
    const glm::mat4 world_from_view = glm::inverse(camera.view_from_world);
    std::array<glm::vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const float distance = (i & 4U) != 0 ? to : from;
        const glm::vec2 ndc((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1);
        const glm::vec2 view_xy =
            distance * ndc / glm::vec2(camera.clip_from_view[0][0], camera.clip_from_view[1][1]);
        corners[i] = glm::vec3(world_from_view * glm::vec4(view_xy, -distance, 1));
    }
    return corners;
}

// excerpt: fitted
SunView fittedView(const Sun& sun, const std::array<glm::vec3, 8>& corners) {
    SunView view{.view_from_world = lightFromWorld(sun)};
    glm::vec3 lowest(1e30F);
    glm::vec3 highest(-1e30F);
    for (const glm::vec3& corner : corners) {
        const glm::vec3 place(view.view_from_world * glm::vec4(corner, 1));
        lowest = glm::min(lowest, place);
        highest = glm::max(highest, place);
    }
    view.middle = 0.5F * glm::vec2(lowest + highest);
    view.half_width = 0.5F * std::max(highest.x - lowest.x, highest.y - lowest.y);
    view.near = -highest.z - sun.casters_reach;
    view.far = -lowest.z;
    return view;
}

// A sphere has the same size however the camera turns, and when it moves by whole texels, every texel stays
// where it was in the world: edges do not crawl (Valient 2007, "Stable Rendering of Cascaded Shadow Maps").
SunView stableView(const Sun& sun, const std::array<glm::vec3, 8>& corners, int size) {
    SunView view{.view_from_world = lightFromWorld(sun)};
    glm::vec3 middle(0);
    for (const glm::vec3& corner : corners)
        middle += corner / 8.0F;
    float radius = 0;
    for (const glm::vec3& corner : corners)
        radius = std::max(radius, glm::distance(corner, middle));
    view.half_width = std::ceil(radius * 16) / 16; // or rounding would make it differ from frame to frame
    const glm::vec3 place(view.view_from_world * glm::vec4(middle, 1));
    const float texel = view.texel(size);
    view.middle = texel * glm::round(glm::vec2(place) / texel);
    const float step = view.half_width / 16;
    const float depth = step * std::round(-place.z / step);
    view.near = depth - view.half_width - sun.casters_reach;
    view.far = depth + view.half_width + step;
    return view;
}
// end excerpt

} // namespace

// excerpt: cascades
std::vector<SunView> sunViews(const Sun& sun, const gbuffer::View& camera, const ShadowOptions& options) {
    if (options.fit == "fixed" || options.fit == "as_printed")
        return {fixedView(sun, options.fit == "as_printed")};
    // Zhang et al. 2006, "Parallel-Split Shadow Maps": half way between even splits and ones of equal ratio.
    const glm::mat4& p = camera.clip_from_view;
    const float near = p[3][2] / (p[2][2] - 1);
    const int count = options.cascades;
    std::vector<SunView> views;
    float from = near;
    for (int i = 1; i <= count; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(count);
        const float even = near + (sun.receivers_far - near) * share;
        const float by_ratio = near * std::pow(sun.receivers_far / near, share);
        const float to = i == count ? sun.receivers_far : 0.5F * (even + by_ratio);
        const std::array<glm::vec3, 8> corners = sliceCorners(camera, from, to);
        views.push_back(options.fit == "fitted" ? fittedView(sun, corners)
                                                : stableView(sun, corners, options.size));
        from = to;
    }
    return views;
}
// end excerpt

// excerpt: shadow
void ShadowMap::draw(Frame& frame, const Sun& sun, const gbuffer::View& camera,
                     const std::vector<Draw>& casters, const ShadowOptions& options) {
    views_ = sunViews(sun, camera, options);
    const int size = options.size;
    const int count = static_cast<int>(views_.size());
    target_.remake({{.name = "shadow",
                     .format = Format::depth24,
                     .filter = options.compares() ? Filter::linear : Filter::nearest,
                     .wrap = Wrap::border_one, // outside of what the sun's view holds, all is lit
                     .compare_depth = options.compares()}},
                   {size * count, size}); // cascades side by side
    const std::vector<Draw> draws = gbuffer::withPrograms(shaders_, casters, "07_shadow_map/shadow", {});
    // What stands between a fitted view and the sun is drawn on the near plane, and still casts its shadow.
    const bool clamped = sun.casters_beyond || options.fit == "fitted" || options.fit == "stable";
    for (int i = 0; i < count; ++i)
        frame.pass(
            count == 1 ? "shadow" : "shadow" + std::to_string(i), target_,
            {.program = *draws.front().program,
             .uniforms = {{"light_clip_from_world", views_[static_cast<std::size_t>(i)].clipFromWorld()}},
             .draws = draws,
             .depth_test = DepthTest::less,
             .cull = options.bias == "front_faces" ? Cull::front : Cull::none,
             .polygon_offset = options.bias == "slope" ? std::optional(glm::vec2(2, 4)) : std::nullopt,
             .clear_depth = i == 0 ? std::optional(1.0F) : std::nullopt,
             .viewport = Viewport{{size * i, 0}, {size, size}},
             .depth_clamp = clamped});
    if (options.hasMoments()) drawMoments(frame, options);
}
// end excerpt

void ShadowMap::drawMoments(Frame& frame, const ShadowOptions& options) {
    const Format format = options.filter == "vsm"    ? Format::rg32f
                          : options.filter == "evsm" ? Format::rgba32f
                                                     : Format::rgba16;
    for (const int axis : {0, 1}) {
        Framebuffer& target = moments_[static_cast<std::size_t>(axis)];
        target.remake({{.name = axis == 0 ? "shadow_moments_x" : "shadow_moments",
                        .format = format,
                        .filter = axis == 0 ? Filter::nearest : Filter::linear}},
                      target_.size());
        glm::ivec2 step(0);
        step[axis] = 1;
        frame.pass(
            axis == 0 ? "shadow_moments_x" : "shadow_moments_y", target,
            {.program = shaders_.fullScreen("07_shadow_map/moments.frag",
                                            options.defines() + Defines{{"FIRST", axis == 0 ? "1" : "0"}}),
             .inputs = {{"source", axis == 0 ? target_.depth() : moments_[0].color()}},
             .part = {.uniforms = {{"texel_step", step}, {"map_size", int(options.size)}}}});
    }
}

ShaderPart ShadowMap::part(const Sun& sun, const ShadowOptions& options) const {
    const glm::mat4 place_from_clip =
        glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.5F)), glm::vec3(0.5F));
    std::vector<glm::vec4> rows; // of the affine maps to [0, 1] cubed
    std::vector<float> texels;
    std::vector<float> depth_ranges;
    for (const SunView& view : views_) {
        const glm::mat4 place_from_world = place_from_clip * view.clipFromWorld();
        for (const int row : {0, 1, 2})
            rows.push_back(glm::row(place_from_world, row));
        texels.push_back(view.texel(options.size));
        depth_ranges.push_back(view.far - view.near);
    }
    ShaderPart part = {.defines = options.defines(),
                       .inputs = {{"shadow_map", target_.depth()}},
                       .uniforms = {{"to_sun", sun.to_sun},
                                    {"shadow_rows", rows},
                                    {"shadow_texel", texels},
                                    {"shadow_depth_range", depth_ranges},
                                    {"sun_tangent", std::tan(glm::radians(float(options.sun_radius_deg)))}}};
    if (options.hasMoments()) part.inputs.push_back({"shadow_moments", moments_[1].color()});
    return part;
}

} // namespace gll::shadow_map
