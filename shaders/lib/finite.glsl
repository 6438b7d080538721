// Light that may be added to other light: what is infinite or not a number becomes 0. Where each pass of a blur does so, one
// bad pixel stays a small hole instead of growing over the frame. UNGUARDED leaves it as it is, to show what happens then.

vec3 finite(vec3 linear_color) {
#ifdef UNGUARDED
    return linear_color;
#else
    // One comparison for three channels: what is wrong with any of them is wrong with their sum, and not-a-number is not
    // less than anything.
    return abs(linear_color.r + linear_color.g + linear_color.b) < 3.402823e38 ? linear_color : vec3(0.0);
#endif
}
