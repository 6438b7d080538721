#version 330 core
// One buffer, full screen.
#include "10_deferred/show.glsl"
#include "lib/encode.glsl"

in vec2 uv;

#if VIEW == VIEW_SHADOW
uniform sampler2DShadow shadow_map;
uniform float aspect; // width / height of the screen
#elif VIEW == VIEW_DEPTH
#if STORES_POSITION
uniform sampler2D depth_map;
uniform vec2 view_z_from_depth; // view z = x / (depth + y)
#endif
#endif

out vec4 display_color; // encoded, [0, 1]

#if VIEW == VIEW_SHADOW
// The map's sampler only compares, so its depth is what part of a row of references lies in front of it. The square
// fills the screen's height; near is bright.
vec3 showShadow() {
    vec2 square = vec2((uv.x - 0.5) * aspect + 0.5, uv.y);
    if (square != clamp(square, 0.0, 1.0)) return vec3(0.0);
    const float nearest = 0.15; // of the light's range: where the scene lies
    const float farthest = 0.65;
    const int references = 128;
    float sum = 0.0;
    for (int i = 0; i < references; ++i) {
        float depth = mix(nearest, farthest, (float(i) + 0.5) / float(references));
        sum += textureLod(shadow_map, vec3(square, depth), 0.0);
    }
    return vec3(1.0 - sum / float(references));
}
#endif

#if VIEW == VIEW_DEPTH
// Distance along the view direction: black at the camera, white at ten units and beyond.
vec3 showDepth() {
    float depth = textureLod(depth_map, uv, 0.0).r;
    return vec3(-view_z_from_depth.x / (depth + view_z_from_depth.y) / 10.0);
}
#endif

void main() {
#if VIEW == VIEW_ALBEDO
    vec3 color = encode(showAlbedo(uv));
#elif VIEW == VIEW_NORMAL
    vec3 color = showNormal(uv);
#elif VIEW == VIEW_POSITION
    vec3 color = showPosition(uv);
#elif VIEW == VIEW_DEPTH
    vec3 color = showDepth();
#elif VIEW == VIEW_SSAO
    vec3 color = showVisibility(uv);
#elif VIEW == VIEW_SHADOW
    vec3 color = showShadow();
#endif
    display_color = vec4(color, 1.0);
}
