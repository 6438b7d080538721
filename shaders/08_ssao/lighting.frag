#version 330 core
// Lights every pixel by a sky alone, as much of it as occlusion leaves.
#include "06_gbuffer/read_gbuffer.glsl"
#include "08_ssao/read_ssao.glsl"

in vec2 uv;

out vec4 lit_color; // linear light, or with view=visibility the share that arrives, [0, 1]

// excerpt: lighting
void main() {
    vec4 position = positionAt(uv);
    float visibility = position.w == 0.0 ? 1.0 : visibilityAt(uv, position.xyz);
#if VIEW == VIEW_VISIBILITY
    lit_color = vec4(vec3(visibility), 1.0);
#else
    const vec3 ground_light = vec3(0.55, 0.45, 0.35);
    const vec3 sky_light = vec3(1.45, 1.55, 1.70);
    const vec3 background = vec3(0.50, 0.55, 0.62);
    if (position.w == 0.0) {
        lit_color = vec4(background, 1.0);
        return;
    }
    Surface surface = surfaceAt(uv, position);
    vec3 light = mix(ground_light, sky_light, surface.world_normal.y * 0.5 + 0.5);
    lit_color = vec4(surface.albedo * light * visibilityOfColor(visibility, surface.albedo), 1.0);
#endif
}
// end excerpt
