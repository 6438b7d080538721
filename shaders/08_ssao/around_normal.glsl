// Samples placed in space about the normal, each compared with what the screen shows at its place.

// Two directions that are perpendicular to the normal and to each other; up and across are the world's, so that the
// samples do not turn with the camera.
void frameAbout(vec3 view_normal, out vec3 across, out vec3 along) {
    vec3 up = abs(dot(view_normal, view_from_world[1].xyz)) > 0.95 ? view_from_world[0].xyz : view_from_world[1].xyz;
    across = normalize(cross(up, view_normal));
    along = cross(view_normal, across);
}

// How much a sample at `place` is hidden, [0, 1]: by what lies in front of it, less the farther that is from the pixel.
float hiddenShare(vec3 place, float view_z) {
    vec2 place_uv = place.xy * half_uv_from_view / -place.z + 0.5;
    float seen_z = viewZAt(place_uv);
    // view space looks down -z: nearer is greater
    bool hidden = seen_z >= place.z + bias && place.z < 0.0 && place_uv == clamp(place_uv, 0.0, 1.0);
    float range = min(radius / max(abs(view_z - seen_z), 1e-4), 1.0);
    return hidden ? range * range * (3.0 - 2.0 * range) : 0.0;
}

float visibilityOf(float hidden) { return clamp(1.0 - strength / float(SSAO_SAMPLES) * hidden, 0.0, 1.0); }
