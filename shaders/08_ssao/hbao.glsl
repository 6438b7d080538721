// Occlusion by horizons above the surface's plane.

// excerpt: hbao
// Bavoil et al. 2008, "Image-Space Horizon-Based Ambient Occlusion": whatever rises above the highest point so far
// takes that much of the sky, less the farther away it is. The elevation is that above the surface's own plane.
float occludedAlong(vec3 view_position, vec3 view_normal, vec2 uv, vec2 uv_step, float jitter) {
    float highest = 0.0; // sine of the elevation
    float occluded = 0.0;
    for (int i = 0; i < SSAO_STEPS; ++i) {
        vec2 place = pixelCenter(uv + uv_step * alongSlice(i, jitter));
        if (!isOnScreen(place)) break;
        vec3 to_sample = viewPositionAt(place) - view_position;
        float squared = dot(to_sample, to_sample);
        float sine = dot(to_sample, view_normal) * inversesqrt(max(squared, 1e-12));
        float fades = max(1.0 - squared / (radius * radius), 0.0);
        occluded += max(sine - highest, 0.0) * fades;
        if (fades > 0.0) highest = max(highest, sine);
    }
    return occluded;
}

float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    view_position += bias * view_normal;
    vec2 uv_radius = uvRadiusAt(view_position.z);
    float sum = 0.0;
    for (int i = 0; i < SSAO_SLICES; ++i) {
        float angle_rad = 3.14159265 * (float(i) + noise.x) / float(SSAO_SLICES);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        sum += occludedAlong(view_position, view_normal, uv, direction * uv_radius, noise.y);
        sum += occludedAlong(view_position, view_normal, uv, -direction * uv_radius, noise.y);
    }
    return clamp(1.0 - strength * sum / float(2 * SSAO_SLICES), 0.0, 1.0);
}
// end excerpt
