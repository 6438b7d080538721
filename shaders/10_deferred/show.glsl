// What a buffer looks like as a picture: values for the display, not light.
#include "06_gbuffer/read_gbuffer.glsl"

#if SSAO != SSAO_OFF
uniform sampler2D ssao_map;
#endif

vec3 showAlbedo(vec2 uv) { return albedoAt(uv); }

vec3 showNormal(vec2 uv) {
    if (positionAt(uv).w == 0.0) return vec3(0.5);
    return normalAt(uv) * 0.5 + 0.5;
}

vec3 showPosition(vec2 uv) {
    vec4 position = positionAt(uv);
    return position.w == 0.0 ? vec3(0.5) : position.xyz * 0.12 + 0.5;
}

vec3 showVisibility(vec2 uv) {
#if SSAO == SSAO_OFF
    return vec3(1.0);
#else
    return vec3(textureLod(ssao_map, uv, 0.0).r);
#endif
}
