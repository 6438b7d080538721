#version 330 core
// How much of the light from all round reaches each pixel, judged from what the G-buffer holds round it. 1: all of it.
#include "06_gbuffer/read_view.glsl"
#include "08_ssao/noise.glsl"

uniform int pixel_step;         // 2: every second pixel in either direction
uniform vec2 half_uv_from_view; // offset from the screen's centre = view xy * this / -view z
uniform float radius;           // world units
uniform float bias;             // world units by which an occluder must stand out
uniform float strength;         // factor on the occlusion, of some methods
#if WITH_POWER
uniform float power;            // exponent on the visibility
#endif

// How much light this pixel's slices bring where nothing is in the way, by which a blur weighs it; 1 without slices.
float weight = 1.0;

#include "08_ssao/around_normal.glsl"
#include "08_ssao/around_pixel.glsl"
#include "08_ssao/slices.glsl"
#if SSAO == SSAO_CONE
#include "08_ssao/cone.glsl"
#elif SSAO == SSAO_HEMISPHERE
#include "08_ssao/hemisphere.glsl"
#elif SSAO == SSAO_SAO
#include "08_ssao/sao.glsl"
#elif SSAO == SSAO_HBAO
#include "08_ssao/hbao.glsl"
#elif SSAO == SSAO_GTAO
#include "08_ssao/gtao.glsl"
#elif SSAO == SSAO_BITMASK
#include "08_ssao/bitmask.glsl"
#else
#error
#endif

#if WITH_WEIGHT
out vec3 visibility_view_z_weight; // for a blur: [0, 1], world units, [0, infinity)
#elif WITH_VIEW_Z
out vec2 visibility_and_view_z; // for a look-up that must tell surfaces apart
#else
out float visibility; // [0, 1]
#endif

vec3 normalFor(vec2 uv, vec3 view_position) {
#if SSAO_NORMALS == SSAO_NORMALS_MAPPED
    return viewNormalAt(uv);
#elif SSAO_NORMALS == SSAO_NORMALS_GEOMETRIC
    return viewGeometricNormalAt(uv, view_position);
#elif SSAO_NORMALS == SSAO_NORMALS_DEPTH
    return viewNormalFromDepth(uv, view_position);
#else
#error
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 uv = (vec2(pixel * pixel_step) + 0.5) / gbufferSize();
    vec3 view_position = viewPositionAt(uv);
    float visible = 1.0;
    if (view_position.z > background_view_z)
        visible = visibilityFrom(uv, view_position, normalFor(uv, view_position), noiseOf(pixel));
#if WITH_POWER
    visible = pow(visible, power);
#endif
#if WITH_WEIGHT
    visibility_view_z_weight = vec3(visible, view_position.z, weight);
#elif WITH_VIEW_Z
    visibility_and_view_z = vec2(visible, view_position.z);
#else
    visibility = visible;
#endif
}
