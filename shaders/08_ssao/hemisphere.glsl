// The occlusion that most tutorials know: samples all through the hemisphere about the normal.

// excerpt: hemisphere
// After Chapman 2013, "SSAO Tutorial", as learnopengl.com has it: directions of the whole hemisphere, and lengths that
// crowd near the pixel. Directions are spread by the sequence R2 and not drawn at random, which leaves less noise.
float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    vec3 across, along;
    frameAbout(view_normal, across, along);
    const float turn_rad = 0.56984029 * 6.2831853;
    const mat2 turn = mat2(cos(turn_rad), sin(turn_rad), -sin(turn_rad), cos(turn_rad));
    float angle_rad = noise.x * 6.2831853;
    vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
    float hidden = 0.0;
    for (int i = 0; i < SSAO_SAMPLES; ++i) {
        float share = (float(i) + 0.5) / float(SSAO_SAMPLES);
        float reach = radius * mix(0.1, 1.0, share * share);
        float height = fract(0.5 + float(i) * 0.75487767); // even heights are even over the hemisphere
        vec2 aside = sqrt(1.0 - height * height) * direction;
        direction = turn * direction;
        hidden += hiddenShare(view_position + reach * (aside.x * across + aside.y * along + height * view_normal),
                              view_position.z);
    }
    return visibilityOf(hidden);
}
// end excerpt
