// Whether two pixels show the same surface, as far as their depths tell.

// excerpt: same_surface
// Full weight within 2 % of the distance, none beyond 4 %.
float sameSurface(float view_z, float other_view_z) {
    return clamp(2.0 - abs(view_z - other_view_z) / (0.02 * abs(view_z)), 0.0, 1.0);
}
// end excerpt

// The same for a pixel whose plane is expected at that depth; half as much will do, since slopes are allowed for.
float nearEnough(float expected_view_z, float other_view_z, float view_z) {
    return clamp(2.0 - abs(expected_view_z - other_view_z) / (0.01 * abs(view_z)), 0.0, 1.0);
}
