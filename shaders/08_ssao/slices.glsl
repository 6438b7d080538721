// Occluders sought along slices: planes that hold the view direction, each a line across the screen.

// Where along half of a slice the i-th tap is, 0 at the pixel, 1 at the radius. jitter: [0, 1).
float alongSlice(int i, float jitter) {
    float along = (float(i) + jitter) / float(SSAO_STEPS);
#if SSAO_SPACING == SSAO_SPACING_SQUARED
    return along * along;
#else
    return along;
#endif
}

// Of a cosine in [0, 1], good to 0.00007 rad (Abramowitz and Stegun 1964, 4.4.45), at a quarter of what acos() costs.
float fastAcos(float x) {
    return sqrt(max(1.0 - x, 0.0)) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
}

// A slice in view space, of the screen's direction (cos, sin).
struct Slice {
    vec3 tangent;          // in the slice, perpendicular to the normal's projection, towards direction
    float in_slice_length; // of the normal's projection into the slice
    float eye_sine;        // of the view direction's elevation above the surface's plane
    float normal_rad;      // from the view direction to that projection, positive towards direction
    float sine, cosine;    // of it
};

// A normal map's normal may face away from the eye, where no surface that is seen does: turned until it does not.
vec3 turnedTo(vec3 to_eye, vec3 view_normal) {
    return normalize(view_normal + to_eye * max(0.01 - dot(view_normal, to_eye), 0.0));
}

Slice sliceOf(vec2 direction, vec3 to_eye, vec3 view_normal) {
    Slice slice;
    vec3 axis = normalize(cross(vec3(direction, 0.0), to_eye));
    vec3 in_slice = view_normal - axis * dot(view_normal, axis);
    slice.in_slice_length = max(length(in_slice), 1e-4);
    slice.tangent = cross(in_slice, axis);
    slice.eye_sine = dot(in_slice, to_eye);
    slice.sine = clamp(dot(in_slice, cross(to_eye, axis)) / slice.in_slice_length, -1.0, 1.0);
    slice.cosine = sqrt(1.0 - slice.sine * slice.sine); // the normal does not face away: see turnedTo()
    slice.normal_rad = slice.sine < 0.0 ? -fastAcos(slice.cosine) : fastAcos(slice.cosine);
    return slice;
}

// excerpt: arc
// A direction in a slice by its angle from the normal's projection: cosine, [0, 1], and sine, positive along the slice.
// Directions come from how far they rise above the surface's plane, not from where in the slice they lie: the pixel
// that is read lies beside the slice, by up to half a pixel. Where a surface is seen at a grazing angle that is far in
// front of or behind the place that was asked for, but never above its plane. side: 1 along the slice, -1 against it.
// What leans over the normal (leansOver) is on the other side.
bool leansOver(vec3 to_point, float sine_of_elevation, vec3 tangent, Slice slice) {
    // no lower than the view direction, as it is beyond that on the screen
    return sine_of_elevation > slice.eye_sine && dot(to_point, tangent) < 0.0;
}

vec2 atElevation(float sine_of_elevation, float side, Slice slice) {
    float cosine = clamp(sine_of_elevation / slice.in_slice_length, 0.0, 1.0);
    return vec2(cosine, side * sqrt(1.0 - cosine * cosine));
}

// The share of a matt surface's light that arrives between the view direction and one in the slice: the integral of the
// cosine to the normal times the sine to the view direction (Jimenez et al. 2016, equation 7), by the angle's sine and
// cosine, which are at hand, in place of those of its double.
float arcLight(vec2 direction, Slice slice) {
    float from_normal = direction.y < 0.0 ? -fastAcos(direction.x) : fastAcos(direction.x);
    float sine_to_eye = slice.sine * direction.x + slice.cosine * direction.y;
    return 0.5 * ((slice.normal_rad + from_normal) * slice.sine + direction.y * sine_to_eye);
}

// The same from one end of the hemisphere to the other.
float wholeArcLight(Slice slice) { return slice.cosine + slice.normal_rad * slice.sine; }
// end excerpt
