#version 330 core
// Light on the street, and what of it is bright enough to bloom: two targets from one pass.
#include "lib/luminance.glsl"

in vec3 world_position;
flat in vec3 world_normal;
flat in vec3 surface_albedo;
in vec3 emitted_color; // linear

uniform vec3 camera_position;          // world, above the ground
uniform vec3 light_positions[LIGHTS];  // world
uniform vec3 light_colors[LIGHTS];     // linear, radiant intensity
uniform float threshold;               // luminance

layout(location = 0) out vec4 hdr_color;    // linear, [0, 65504]
layout(location = 1) out vec4 bright_color; // the same where it is bright, else black

const vec3 ambient = vec3(0.010, 0.012, 0.022);
const vec3 haze_color = vec3(0.010, 0.012, 0.024); // the sky's at the horizon
const float haze_per_metre = 0.012;
const vec3 asphalt = vec3(0.06, 0.06, 0.065);
const vec3 mirrored_light = vec3(0.25, 0.19, 0.13); // on every wall of the mirror image

vec3 lightOn(vec3 position, vec3 normal) {
    vec3 light = ambient;
    for (int i = 0; i < LIGHTS; ++i) {
        vec3 to_light = light_positions[i] - position;
        float squared = dot(to_light, to_light) + 0.01; // a lamp is no point: nothing is infinitely near
        float near = inversesqrt(squared);
        light += light_colors[i] * (max(dot(normal, to_light), 0.0) * near * near * near);
    }
    return light;
}

// How much water lies on the asphalt, 0 to 1: waves of sine, bent by each other, so that no grid is seen.
float water(vec2 place) {
    float height = sin(place.x * 0.9 + 1.7 * sin(place.y * 0.35)) + sin(place.y * 0.6 + 1.3 * sin(place.x * 0.7 + 2.0));
    return smoothstep(-0.6, 0.9, height);
}

// How much of the mirror image one sees in the road. Schlick 1994: water reflects 2 % seen from above, and everything
// seen along its surface.
float reflectance(vec3 ground, float cos_view) {
    float grazing = 1.0 - cos_view;
    float squared = grazing * grazing;
    return (0.02 + 0.98 * squared * squared * grazing) * mix(0.15, 1.0, water(ground.xz));
}

// Below the ground lies the street's mirror image, seen through the surface of the road. Its emitters are what
// matters there; its walls have the same light everywhere, so that a pixel looks at the lamps only once.
vec3 seenColor() {
    vec3 to_point = world_position - camera_position;
    bool mirrored = world_position.y < 0.0;
    vec3 ground = camera_position + to_point * (camera_position.y / max(-to_point.y, 1e-4));
    vec3 light = lightOn(mirrored ? ground : world_position, mirrored ? vec3(0.0, 1.0, 0.0) : world_normal);
    if (!mirrored) return emitted_color + light * surface_albedo;
    float cos_view = -to_point.y * inversesqrt(dot(to_point, to_point));
    return light * asphalt + (emitted_color + mirrored_light * surface_albedo) * reflectance(ground, cos_view);
}

// excerpt: bright_pass
bool isBright(float luma) {
#if BRIGHT_PASS == BRIGHT_PASS_FIXED
    return luma > threshold;
#elif BRIGHT_PASS == BRIGHT_PASS_WHITE_POINT
    return luma >= threshold;
#endif
}

void main() {
    vec3 color = seenColor();
    color = mix(haze_color, color, exp(-haze_per_metre * distance(world_position, camera_position)));

    hdr_color = vec4(min(color, 65504.0), 1.0);
    bright_color = vec4(isBright(luminance(color)) ? hdr_color.BRIGHT_CHANNELS : vec3(0.0), 1.0);
}
// end excerpt
