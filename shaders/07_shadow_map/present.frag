#version 330 core
// The picture by sun and sky, or one thing that it was made from.
#include "06_gbuffer/read_gbuffer.glsl"
#include "07_shadow_map/shadow.glsl"
#include "07_shadow_map/show_map.glsl"
#include "lib/encode.glsl"
#include "lib/tone_map.glsl"

in vec2 uv;

uniform vec3 to_sun; // world, unit length
uniform sampler2D sun_map;
uniform float aspect;   // width / height of the screen
uniform float exposure; // factor on scene light

out vec4 display_color; // encoded, [0, 1]

const vec3 sun_color = vec3(2.2, 2.0, 1.65);

vec3 skyColor(float height) { return mix(vec3(0.62, 0.68, 0.75), vec3(0.24, 0.38, 0.62), height); }

vec3 litColor(vec4 position) {
    Surface surface = surfaceAt(uv, position);
    vec3 ambient = mix(vec3(0.16, 0.14, 0.13), vec3(0.34, 0.40, 0.52), surface.world_normal.y * 0.5 + 0.5);
    float facing = max(dot(surface.world_normal, to_sun), 0.0);
    return surface.albedo * (ambient + sun_color * (facing * textureLod(sun_map, uv, 0.0).r));
}

vec3 cascadeColor(int cascade) {
    return cascade == 0   ? vec3(0.0, 0.45, 0.70) // from Okabe and Ito's palette
           : cascade == 1 ? vec3(0.90, 0.62, 0.0)
           : cascade == 2 ? vec3(0.0, 0.62, 0.45)
                          : vec3(0.80, 0.47, 0.65);
}

void main() {
    vec4 position = positionAt(uv);
#if VIEW == VIEW_SHADOW
    vec3 color = showShadowMap(vec2((uv.x - 0.5) * aspect + 0.5, uv.y));
#elif VIEW == VIEW_SUN
    vec3 color = vec3(textureLod(sun_map, uv, 0.0).r);
#elif VIEW == VIEW_CASCADES
    vec3 color = position.w == 0.0 ? vec3(0.0)
                                   : cascadeColor(cascadeAt(position.xyz)) * (0.4 + 0.6 * textureLod(sun_map, uv, 0.0).r);
#else
    vec3 light = position.w == 0.0 ? skyColor(uv.y) : litColor(position);
    vec3 color = encode(toneMap(light * exposure));
#endif
    display_color = vec4(color, 1.0);
}
