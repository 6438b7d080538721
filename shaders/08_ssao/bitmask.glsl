// Occlusion by sectors: what is seen is taken to be so thick, and light passes behind it.

uniform float thickness; // world units

// Therrien et al. 2023, "Screen Space Indirect Lighting with Visibility Bitmask": the half circle of a slice is cut
// into 32 sectors, one bit each, and each point that is seen takes those between its front and its back. So there is
// light under a table and beside a pole, where one horizon to either side would shut out all below it.
int countOfBits(uint bits) {
    bits -= (bits >> 1) & 0x55555555u;
    bits = (bits & 0x33333333u) + ((bits >> 2) & 0x33333333u);
    return int((((bits + (bits >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24);
}

// Where a direction lies between the two ends of the hemisphere, [0, 1]; at the end on its side, 1 or -1, where it is
// below the plane.
float shareOf(vec3 to_point, vec3 view_normal, Slice slice, float side) {
    float sine = dot(to_point, view_normal) * inversesqrt(max(dot(to_point, to_point), 1e-12));
    if (leansOver(to_point, sine, side * slice.tangent, slice)) side = -side;
    vec2 direction = atElevation(sine, side, slice);
#if SSAO_SECTORS == SSAO_SECTORS_UNIFORM
    return 0.5 + side * fastAcos(direction.x) / 3.14159265;
#else
    // sectors of one share of a matt surface's light
    float arc = arcLight(direction, slice);
    bool is_before_eye = slice.sine * direction.x + slice.cosine * direction.y < 0.0;
    float before_eye = arcLight(vec2(0.0, -1.0), slice);
    return (before_eye + (is_before_eye ? -arc : arc)) / wholeArcLight(slice);
#endif
}

// excerpt: sectors
uint sectorsBetween(float from, float to) {
#if SSAO_ROUNDING == SSAO_ROUNDING_FLOOR
    int first = int(ceil(from * 32.0));
    int end = int(floor(to * 32.0));
#elif SSAO_ROUNDING == SSAO_ROUNDING_ROUND
    int first = int(floor(from * 32.0 + 0.5));
    int end = int(floor(to * 32.0 + 0.5));
#else
    int first = max(int(floor(from * 32.0)), 0);
    int end = int(ceil(to * 32.0));
#endif
    int count = min(end, 32) - first;
    return count <= 0 ? 0u : (0xFFFFFFFFu >> (32 - count)) << first;
}

uint occludedSectors(vec3 view_position, vec3 view_normal, vec3 to_eye, Slice slice, float side, vec2 uv, vec2 uv_step,
                     float jitter) {
    uint sectors = 0u;
    for (int i = 0; i < SSAO_STEPS; ++i) {
        vec2 place = pixelCenter(uv + uv_step * alongSlice(i, jitter));
        if (!isOnScreen(place)) break;
        vec3 front = viewPositionAt(place) - view_position;
        float squared = dot(front, front);
        if (squared > radius * radius) continue;
        float front_share = shareOf(front, view_normal, slice, side);
        float back_share = shareOf(front - thickness * to_eye, view_normal, slice, side);
        sectors |= sectorsBetween(min(front_share, back_share), max(front_share, back_share));
    }
    return sectors;
}
// end excerpt

float visibilityFrom(vec2 uv, vec3 view_position, vec3 view_normal, vec2 noise) {
    vec3 to_eye = normalize(-view_position);
    view_normal = turnedTo(to_eye, view_normal);
    view_position += bias * view_normal;
    vec2 uv_radius = uvRadiusAt(view_position.z);
    float sum = 0.0;
    float unoccluded = 0.0;
    for (int i = 0; i < SSAO_SLICES; ++i) {
        float angle_rad = 3.14159265 * (float(i) + noise.x) / float(SSAO_SLICES);
        vec2 direction = vec2(cos(angle_rad), sin(angle_rad));
        Slice slice = sliceOf(direction, to_eye, view_normal);
        uint sectors =
            occludedSectors(view_position, view_normal, to_eye, slice, 1.0, uv, direction * uv_radius, noise.y) |
            occludedSectors(view_position, view_normal, to_eye, slice, -1.0, uv, -direction * uv_radius, noise.y);
#if SSAO_SECTORS == SSAO_SECTORS_UNIFORM
        float light = 1.0;
#else
        float light = slice.in_slice_length * wholeArcLight(slice);
#endif
        sum += light * (1.0 - float(countOfBits(sectors)) / 32.0);
        unoccluded += light;
    }
    weight = unoccluded;
    return sum / unoccluded;
}
