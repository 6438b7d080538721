#version 330 core
// How much of the ambient light reaches each pixel, judged from what the G-buffer holds round it. 1: all of it.
#include "06_gbuffer/read_view.glsl"
#include "10_deferred/noise.glsl"

uniform int pixel_step;         // 2: every second pixel in either direction
uniform vec2 half_uv_from_view; // offset from the screen's centre = view xy * this / -view z
uniform float radius;           // world units
uniform float bias;             // world units by which an occluder must stand out
#if SSAO == SSAO_GTAO
uniform int slices;             // directions in which horizons are sought
uniform int steps;              // samples along each half of a slice
#else
uniform float strength;         // factor on the occlusion
#endif

#if WITH_VIEW_Z
out vec2 visibility_and_view_z; // for the passes that must tell surfaces apart: [0, 1], world units
#else
out float visibility; // [0, 1]
#endif

#if SSAO == SSAO_GTAO
// excerpt: gtao
// Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion". In each of some planes through
// the view direction the highest horizon is sought to both sides; between the two the cosine-weighted visibility has
// a closed form (equations 7 and 10 there). The sum is divided by what it is where nothing is in the way, which few
// slices do not bring to exactly 1.
// The sine of the highest elevation above the surface's plane on the way to uv + uv_step. Elevation rather than the
// angle to the view direction: where a surface is seen at a grazing angle, the nearest pixel may lie far before or
// behind the place that was asked for, but never above its plane.
float highestSine(vec3 view_position, vec3 view_normal, vec2 uv, vec2 uv_step, float jitter) {
    float highest = 0.0;
    for (int i = 0; i < steps; ++i) {
        // samples lie closer together near the pixel, where the horizon changes most
        float along = (float(i) + jitter) / float(steps);
        vec2 place = uv + uv_step * (along * along);
        if (place != clamp(place, 0.0, 1.0)) break;
        vec3 to_sample = viewPositionAt(place) - view_position;
        float distance_squared = max(dot(to_sample, to_sample), 1e-12);
        // full weight within two fifths of the radius, none beyond it
        float fades = clamp((1.0 - sqrt(distance_squared) / radius) / 0.6, 0.0, 1.0);
        highest = max(highest, dot(to_sample, view_normal) * inversesqrt(distance_squared) * fades);
    }
    return highest;
}

// From the view direction to a horizon, both as angles in the slice, as the normal's is.
float visibleArc(float horizon_rad, float normal_rad) {
    return 0.25 * (cos(normal_rad) + 2.0 * horizon_rad * sin(normal_rad) - cos(2.0 * horizon_rad - normal_rad));
}

float visibilityAt(vec2 uv, vec3 view_position, vec3 view_normal, float turn) {
    const float pi = 3.14159265;
    // looked at from a little above, a flat surface hides nothing of itself, however coarse its stored positions
    view_position += bias * view_normal;
    vec3 to_eye = normalize(-view_position);
    vec2 uv_radius = min(radius * half_uv_from_view / -view_position.z, 0.3);
    float jitter = fract(turn * 7.0 + 0.5);
    float sum = 0.0;
    float unoccluded = 0.0;
    for (int slice = 0; slice < slices; ++slice) {
        float angle_rad = pi * (float(slice) + turn) / float(slices);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        vec3 axis = normalize(cross(vec3(direction, 0.0), to_eye));
        vec3 across = cross(to_eye, axis); // in the slice, perpendicular to to_eye, towards direction
        vec3 in_slice = view_normal - axis * dot(view_normal, axis);
        float in_slice_length = max(length(in_slice), 1e-4);
        float normal_rad = atan(dot(in_slice, across), dot(in_slice, to_eye));
        float sine_ahead = highestSine(view_position, view_normal, uv, direction * uv_radius, jitter);
        float sine_behind = highestSine(view_position, view_normal, uv, -direction * uv_radius, jitter);
        float ahead = normal_rad + acos(min(sine_ahead / in_slice_length, 1.0));
        float behind = normal_rad - acos(min(sine_behind / in_slice_length, 1.0));
        sum += in_slice_length * (visibleArc(ahead, normal_rad) + visibleArc(behind, normal_rad));
        unoccluded += in_slice_length * (cos(normal_rad) + normal_rad * sin(normal_rad));
    }
    return clamp(sum / unoccluded, 0.0, 1.0);
}
// end excerpt
#else
// excerpt: ssao
// Crytek's method (Mittring 2007) over the hemisphere about the normal: a sample of it is occluded where the surface
// seen at its place on the screen lies nearer to the camera.
float visibilityAt(vec2 uv, vec3 view_position, vec3 view_normal, float turn) {
    const float golden_angle_rad = 2.3998277;
    // a frame about the normal; the first sample's angle is another in each pixel, so that noise hides the pattern
    vec3 up = abs(dot(view_normal, view_from_world[1].xyz)) > 0.95 ? view_from_world[0].xyz : view_from_world[1].xyz;
    vec3 across = normalize(cross(up, view_normal));
    vec3 along = cross(view_normal, across);
    float angle_rad = turn * 6.2831853;
    vec2 direction = vec2(cos(angle_rad), sin(angle_rad));

    // The samples lie on a cone about the normal, spread evenly as seen from above: each is a golden angle further,
    // and the i-th of n covers i / n of the disk. Turning on is cheaper than looking directions up in an array.
    const mat2 golden_turn = mat2(cos(golden_angle_rad), sin(golden_angle_rad), //
                                  -sin(golden_angle_rad), cos(golden_angle_rad));
    float occlusion = 0.0;
    for (int i = 0; i < SSAO_SAMPLES; ++i) {
        float reach = radius * sqrt((float(i) + 0.5) / float(SSAO_SAMPLES));
        vec3 place = view_position + reach * (direction.x * across + direction.y * along + 0.5 * view_normal);
        direction = golden_turn * direction;
        vec2 place_uv = place.xy * half_uv_from_view / -place.z + 0.5;
        float seen_z = viewZAt(place_uv);
        // view space looks down -z: nearer is greater
        bool hidden = seen_z >= place.z + bias && place.z < 0.0 && place_uv == clamp(place_uv, 0.0, 1.0);
        float range = min(radius / max(abs(view_position.z - seen_z), 1e-4), 1.0);
        occlusion += hidden ? range * range * (3.0 - 2.0 * range) : 0.0;
    }
    return clamp(1.0 - strength / float(SSAO_SAMPLES) * occlusion, 0.0, 1.0);
}
// end excerpt
#endif

void main() {
    vec2 uv = (floor(gl_FragCoord.xy) * float(pixel_step) + 0.5) / gbufferSize();
    vec3 view_position = viewPositionAt(uv);
    float visible = 1.0;
    if (view_position.z > background_view_z)
        visible = visibilityAt(uv, view_position, viewNormalAt(uv), turnOf(ivec2(gl_FragCoord.xy)));
#if WITH_VIEW_Z
    visibility_and_view_z = vec2(visible, view_position.z);
#else
    visibility = visible;
#endif
}
