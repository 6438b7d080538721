// Occlusion by horizons, with the light between them in closed form.

uniform float falloff; // outer part of the radius over which occluders fade, [0, 1]

// excerpt: gtao
// Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion". In each slice the horizon is
// sought to both sides; what is lit between the two has a closed form. Occluders fade out towards the radius.

// What rises highest above the surface's plane on one side: the sine of its elevation, or 2 less that sine where it leans
// over the normal, as a shelf does. side: 1 along the slice, -1 against it.
float highestOn(vec3 view_position, vec3 view_normal, float side, Slice slice, vec2 uv, vec2 uv_step, float jitter) {
    float highest = 0.0;
    for (int i = 0; i < SSAO_STEPS; ++i) {
        vec2 place = pixelCenter(uv + uv_step * alongSlice(i, jitter));
        if (!isOnScreen(place)) break;
        vec3 to_sample = viewPositionAt(place) - view_position;
        float reach = max(length(to_sample), 1e-6);
        float sine = dot(to_sample, view_normal) / reach;
        if (leansOver(to_sample, sine, side * slice.tangent, slice)) sine = 2.0 - sine;
        highest = max(highest, sine * clamp((1.0 - reach / radius) / max(falloff, 1e-4), 0.0, 1.0));
    }
    return highest;
}

// The light from the view direction to that.
float arcLightTo(float highest, float side, Slice slice) {
    bool leans_over = highest > 1.0;
    return arcLight(atElevation(leans_over ? 2.0 - highest : highest, leans_over ? -side : side, slice), slice);
}

float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    vec3 to_eye = normalize(-view_position);
    view_normal = turnedTo(to_eye, view_normal);
    // looked at from a little above, a flat surface hides nothing of itself, however coarse its stored positions
    view_position += bias * view_normal;
    vec2 uv_radius = uvRadiusAt(view_position.z);
    float sum = 0.0;
    float unoccluded = 0.0; // which few slices do not bring to exactly 1: what they bring is what counts as open
    for (int i = 0; i < SSAO_SLICES; ++i) {
        float angle_rad = 3.14159265 * (float(i) + noise.x) / float(SSAO_SLICES);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        Slice slice = sliceOf(direction, to_eye, view_normal);
        float ahead = highestOn(view_position, view_normal, 1.0, slice, uv, direction * uv_radius, noise.y);
        float behind = highestOn(view_position, view_normal, -1.0, slice, uv, -direction * uv_radius, noise.y);
        sum += slice.in_slice_length * (arcLightTo(ahead, 1.0, slice) + arcLightTo(behind, -1.0, slice));
        unoccluded += slice.in_slice_length * wholeArcLight(slice);
    }
    weight = unoccluded;
    return clamp(sum / unoccluded, 0.0, 1.0);
}
// end excerpt
