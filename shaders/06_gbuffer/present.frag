#version 330 core
// The picture, what the G-buffer holds, or how far that is from 32-bit floats.
#include "06_gbuffer/read_gbuffer.glsl"
#include "lib/encode.glsl"
#include "lib/tone_map.glsl"

in vec2 uv;

#define SHOWS_ERROR (VIEW == VIEW_LIT_ERROR || VIEW == VIEW_NORMAL_ERROR || VIEW == VIEW_POSITION_ERROR)

#if VIEW == VIEW_LIT || VIEW == VIEW_LIT_ERROR
uniform sampler2D lit_map;
uniform float exposure; // factor on scene light
#endif
#if VIEW == VIEW_LIT_ERROR
uniform sampler2D reference_lit_map;
#elif SHOWS_ERROR
uniform sampler2D reference_normal_map;
uniform sampler2D reference_position_map;
#endif
#if SHOWS_ERROR
uniform float amplify;
#endif
#if STORES_POSITION && (VIEW == VIEW_DEPTH || VIEW == VIEW_POSITION_ERROR)
uniform vec3 camera_position; // world
#endif

out vec4 display_color; // encoded, [0, 1]

#if VIEW == VIEW_LIT || VIEW == VIEW_LIT_ERROR
vec3 displayed(vec3 lit_color) { return encode(toneMap(lit_color * exposure)); }
#endif

vec3 shown() {
#if VIEW == VIEW_LIT
    return displayed(textureLod(lit_map, uv, 0.0).rgb);
#elif VIEW == VIEW_LIT_ERROR
    return abs(displayed(textureLod(lit_map, uv, 0.0).rgb) - displayed(textureLod(reference_lit_map, uv, 0.0).rgb)) *
           amplify;
#else
    vec4 position = positionAt(uv);
    if (position.w == 0.0) return vec3(0.0);
    Surface surface = surfaceAt(uv, position);
#if VIEW == VIEW_ALBEDO
    return encode(surface.albedo);
#elif VIEW == VIEW_SPECULAR
    return vec3(surface.specular / max_specular);
#elif VIEW == VIEW_NORMAL
    return surface.world_normal * 0.5 + 0.5;
#elif VIEW == VIEW_GEOMETRIC
    return geometricNormalAt(uv, surface.world_position) * 0.5 + 0.5;
#elif VIEW == VIEW_GLOSS
    return vec3(log2(surface.shininess) / log2_max_shininess);
#elif VIEW == VIEW_POSITION
    return fract(surface.world_position);
#elif VIEW == VIEW_DEPTH
    // distance, every doubling a step: white at half a unit, black at the far plane
    return vec3(0.9 - 0.09 * log2(distance(surface.world_position, camera_position)));
#elif VIEW == VIEW_NORMAL_ERROR
    // degrees, amplified
    vec3 right = normalize(textureLod(reference_normal_map, uv, 0.0).rgb);
    return vec3(degrees(2.0 * asin(min(0.5 * distance(surface.world_normal, right), 1.0))) / 255.0 * amplify);
#elif VIEW == VIEW_POSITION_ERROR
    // of the distance, amplified
    vec3 right = textureLod(reference_position_map, uv, 0.0).xyz;
    return vec3(distance(surface.world_position, right) / distance(right, camera_position) * amplify);
#endif
#endif
}

void main() { display_color = vec4(shown(), 1.0); }
