#version 330 core
// How much of the ambient light reaches each pixel, judged from what the G-buffer holds round it. 1: all of it.
#include "10_deferred/read_view.glsl"
#include "10_deferred/noise.glsl"

uniform int pixel_step;         // 2: every second pixel in either direction
uniform vec2 half_uv_from_view; // offset from the screen's centre = view xy * this / -view z
uniform float radius;           // world units
uniform float bias;             // world units by which an occluder must stand out
#if SSAO == SSAO_GTAO
uniform int slices;             // directions in which horizons are sought
uniform int steps;              // samples along each half of a slice
#else
uniform vec3 kernel[SSAO_SAMPLES]; // samples in the hemisphere about z, world units
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
// a closed form (equations 7 and 10 there).
float horizonCosine(vec3 view_position, vec3 to_eye, vec2 uv, vec2 uv_step, float jitter, float lowest) {
    float highest = lowest;
    for (int i = 0; i < steps; ++i) {
        // samples lie closer together near the pixel, where the horizon changes most
        float along = (float(i) + jitter) / float(steps);
        vec2 place = uv + uv_step * (along * along);
        if (place != clamp(place, 0.0, 1.0)) break;
        vec3 to_sample = viewPositionAt(place) - view_position;
        float distance_squared = dot(to_sample, to_sample);
        float cosine = dot(to_sample, to_eye) * inversesqrt(max(distance_squared, 1e-12));
        float fades = clamp(1.0 - distance_squared / (radius * radius), 0.0, 1.0);
        highest = max(highest, mix(lowest, cosine, fades));
    }
    return highest;
}

float visibilityAt(vec2 uv, vec3 view_position, vec3 view_normal, float turn) {
    const float pi = 3.14159265;
    const float half_pi = 0.5 * pi;
    // looked at from a little above, a flat surface hides nothing of itself, however coarse its stored positions
    view_position += bias * view_normal;
    vec3 to_eye = normalize(-view_position);
    vec2 uv_radius = min(radius * half_uv_from_view / -view_position.z, 0.3);
    float jitter = fract(turn * 7.0 + 0.5);
    float sum = 0.0;
    for (int slice = 0; slice < slices; ++slice) {
        float angle_rad = pi * (float(slice) + turn) / float(slices);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        vec3 axis = normalize(cross(vec3(direction, 0.0), to_eye));
        vec3 across = cross(to_eye, axis); // in the slice, perpendicular to to_eye, towards direction
        vec3 in_slice = view_normal - axis * dot(view_normal, axis);
        float in_slice_length = max(length(in_slice), 1e-4);
        float normal_rad = atan(dot(in_slice, across), dot(in_slice, to_eye));
        float ahead = acos(horizonCosine(view_position, to_eye, uv, direction * uv_radius, jitter,
                                         max(cos(normal_rad + half_pi), -1.0)));
        float behind = -acos(horizonCosine(view_position, to_eye, uv, -direction * uv_radius, jitter,
                                           max(cos(normal_rad - half_pi), -1.0)));
        // no lower than the surface's own plane
        ahead = min(ahead, normal_rad + half_pi);
        behind = max(behind, normal_rad - half_pi);
        float constant = cos(normal_rad);
        sum += in_slice_length * 0.25 *
               (2.0 * constant + 2.0 * (ahead + behind) * sin(normal_rad) - cos(2.0 * ahead - normal_rad) -
                cos(2.0 * behind - normal_rad));
    }
    return clamp(sum / float(slices), 0.0, 1.0);
}
// end excerpt
#else
// excerpt: ssao
// Crytek's method (Mittring 2007) over the hemisphere about the normal: a sample of it is occluded where the surface
// seen at its place on the screen lies nearer to the camera.
float visibilityAt(vec2 uv, vec3 view_position, vec3 view_normal, float turn) {
    // a frame about the normal, turned by another angle in each pixel: the kernel is small, noise hides its pattern
    vec3 up = abs(dot(view_normal, view_from_world[1].xyz)) > 0.95 ? view_from_world[0].xyz : view_from_world[1].xyz;
    vec3 across = normalize(cross(up, view_normal));
    vec3 along = cross(view_normal, across);
    float angle_rad = turn * 6.2831853;
    vec3 x_axis = cos(angle_rad) * across + sin(angle_rad) * along;
    vec3 y_axis = cos(angle_rad) * along - sin(angle_rad) * across;

    float occlusion = 0.0;
    for (int i = 0; i < SSAO_SAMPLES; ++i) {
        vec3 place = view_position + kernel[i].x * x_axis + kernel[i].y * y_axis + kernel[i].z * view_normal;
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
    vec2 uv = (floor(gl_FragCoord.xy) * float(pixel_step) + 0.5) / vec2(textureSize(normal_map, 0));
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
