// Relative luminance of linear light with BT.709 primaries (ITU-R BT.709-6, section 3).

float luminance(vec3 linear_color) { return dot(linear_color, vec3(0.2126, 0.7152, 0.0722)); }
