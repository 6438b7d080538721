// From linear display light, [0, 1], to the values a display is sent. ENCODE chooses how.

vec3 encode(vec3 linear_color) {
#if ENCODE == ENCODE_GAMMA22
    return pow(linear_color, vec3(1.0 / 2.2));
#elif ENCODE == ENCODE_SRGB
    // IEC 61966-2-1
    return mix(1.055 * pow(linear_color, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear_color,
               vec3(lessThanEqual(linear_color, vec3(0.0031308))));
#endif
}
