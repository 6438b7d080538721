// Occlusion by what rises above the surface's plane on a disk round the pixel.

// excerpt: sao
// McGuire et al. 2012, "Scalable Ambient Obscurance", after the Alchemy method of 2011: each point that is seen near
// the pixel occludes by the sine of its elevation over its distance, fading to nothing at the radius.
float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    const float golden_angle_rad = 2.3999632;
    const mat2 golden_turn = mat2(cos(golden_angle_rad), sin(golden_angle_rad), //
                                  -sin(golden_angle_rad), cos(golden_angle_rad));
    vec2 uv_radius = uvRadiusAt(view_position.z);
    float angle_rad = noise.x * 6.2831853;
    vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
    float sum = 0.0;
    for (int i = 0; i < SSAO_SAMPLES; ++i) {
        vec2 place = pixelCenter(uv + uv_radius * ((float(i) + noise.y) / float(SSAO_SAMPLES)) * direction);
        direction = golden_turn * direction;
        if (!isOnScreen(place)) continue;
        vec3 to_sample = viewPositionAt(place) - view_position;
        float squared = dot(to_sample, to_sample);
        float fades = max(1.0 - squared / (radius * radius), 0.0);
        const float least_squared = 0.01; // world units: the estimate of what is nearer would be too uneven
        sum += fades * fades * fades * max(dot(to_sample, view_normal) - bias, 0.0) / (squared + least_squared);
    }
    return max(1.0 - strength * 5.0 / float(SSAO_SAMPLES) * sum, 0.0);
}
// end excerpt
