// Light that may be added to other light: what is no number, negative or infinite becomes 0. Where each pass of a pyramid
// does so, one bad pixel stays a small hole instead of growing over the frame.

vec3 finite(vec3 linear_color) {
    // Not-a-number is not greater than 0; max() need not know that. No half float is above 65504.
    vec3 light = mix(vec3(0.0), linear_color, greaterThan(linear_color, vec3(0.0)));
    return mix(light, vec3(0.0), greaterThan(light, vec3(65504.0)));
}
