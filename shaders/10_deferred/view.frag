#version 330 core
// One buffer, full screen.
#include "10_deferred/show.glsl"
#include "lib/encode.glsl"

in vec2 uv;

#if VIEW == VIEW_SHADOW
#include "07_shadow_map/shadow.glsl"
#include "07_shadow_map/show_map.glsl"
uniform float aspect; // width / height of the screen
#elif VIEW == VIEW_SUN || VIEW == VIEW_AMBIENT || VIEW == VIEW_REFLECTED
uniform sampler2D lit_map; // that term alone
#elif VIEW == VIEW_DEPTH
#if STORES_POSITION
uniform sampler2D depth_map;
uniform vec2 view_z_from_depth; // view z = x / (depth + y)
#endif
#endif

out vec4 display_color; // encoded, [0, 1]

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
    vec3 color = showShadowMap(vec2((uv.x - 0.5) * aspect + 0.5, uv.y));
#elif VIEW == VIEW_SUN
    vec3 color = textureLod(lit_map, uv, 0.0).rgb;
#elif VIEW == VIEW_AMBIENT || VIEW == VIEW_REFLECTED
    vec3 color = encode(min(textureLod(lit_map, uv, 0.0).rgb, 1.0));
#endif
    display_color = vec4(color, 1.0);
}
