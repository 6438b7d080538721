// Drawing the sun's view, and what readers of it need.
#include "shadow_map.hpp"

#include "06_gbuffer/gbuffer.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace gll::shadow_map {

glm::mat4 SunView::clipFromWorld() const {
    return glm::ortho(-half_width, half_width, -half_width, half_width, near, far) * view_from_world;
}

ShadowOptions::ShadowOptions(Settings& settings)
    : size(settings.integer("shadow_size", 1024, 16, 8192, "side of the shadow map, texels")),
      pcf(settings.choice("shadow_pcf", "5", {"1", "3", "5", "7", "9"},
                          "shadow comparisons averaged in either direction, a texel apart")),
      bias(settings.choice(
          "shadow_bias", "slope", {"constant", "slope", "texel"},
          "against self-shadowing: 0.0025; by slope and polygon offset; by slope and texel size")) {}

Defines ShadowOptions::defines() const { return bias.defines() + Defines{{"PCF_TAPS", pcf.name()}}; }

// excerpt: shadow
void ShadowMap::draw(Frame& frame, const SunView& sun, const std::vector<Draw>& casters,
                     const ShadowOptions& options) {
    target_.resize({options.size, options.size});
    const std::vector<Draw> draws = gbuffer::withPrograms(shaders_, casters, "07_shadow_map/shadow", {});
    frame.pass("shadow", target_,
               {.program = *draws.front().program,
                .uniforms = {{"light_clip_from_world", sun.clipFromWorld()}},
                .draws = draws,
                .depth_test = DepthTest::less,
                .polygon_offset = options.bias == "slope" ? std::optional(glm::vec2(2, 4)) : std::nullopt,
                .clear_depth = 1.0F});
}
// end excerpt

ShaderPart ShadowMap::part(const SunView& sun, const ShadowOptions& options) const {
    const glm::mat4 place_from_clip =
        glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.5F)), glm::vec3(0.5F));
    return {.defines = options.defines(),
            .inputs = {{"shadow_map", target_.depth()}},
            .uniforms = {{"to_sun", sun.to_sun},
                         {"shadow_from_world", place_from_clip * sun.clipFromWorld()},
                         {"shadow_texel", 2 * sun.half_width / static_cast<float>(options.size)},
                         {"shadow_depth_range", sun.far - sun.near}}};
}

} // namespace gll::shadow_map
