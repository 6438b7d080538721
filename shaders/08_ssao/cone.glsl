// The original's occlusion: samples on a cone about the normal.

// excerpt: cone
// Crytek's method (Mittring 2007, "Finding Next Gen") over the hemisphere about the normal: a sample of it is occluded
// where the surface seen at its place on the screen lies nearer to the camera.
float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    const float golden_angle_rad = 2.3998277;
    vec3 across, along;
    frameAbout(view_normal, across, along);
    float angle_rad = noise.x * 6.2831853; // noise hides the pattern
    vec2 direction = vec2(cos(angle_rad), sin(angle_rad));

    // The samples lie on a cone about the normal, spread evenly as seen from above: each is a golden angle further,
    // and the i-th of n covers i / n of the disk. Turning on is cheaper than looking directions up in an array.
    const mat2 golden_turn = mat2(cos(golden_angle_rad), sin(golden_angle_rad), //
                                  -sin(golden_angle_rad), cos(golden_angle_rad));
    float hidden = 0.0;
    for (int i = 0; i < SSAO_SAMPLES; ++i) {
        float reach = radius * sqrt((float(i) + 0.5) / float(SSAO_SAMPLES));
        vec3 place = view_position + reach * (direction.x * across + direction.y * along + 0.5 * view_normal);
        direction = golden_turn * direction;
        hidden += hiddenShare(place, view_position.z);
    }
    return visibilityOf(hidden);
}
// end excerpt
