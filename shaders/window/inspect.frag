#version 330 core
// A target as the inspector shows it: any part at any size, in light, one channel or stops. What is no
// number is magenta, what is infinite a paler one, what lies outside the target dark grey.

uniform sampler2D source;
uniform vec2 view_corner_px;     // where it is drawn, lower left
uniform vec2 corner;             // what is shown there, texels
uniform float texels_per_pixel; // of what is shown
uniform float exposure;         // factor
uniform int channel;            // -1: red, green and blue; 0 to 3: one of them, or alpha, in grey
uniform int as_stops;           // luminance in false colours
uniform int encode_srgb;        // the values are linear light
uniform int depth;               // 0: none; 1: of any projection; 2: of a perspective, whose far plane is far away
uniform vec2 depth_range;        // of the distances that are black and white, in nears; for 2
uniform int channels;           // that the target has

out vec4 display_color;

const vec3 no_number = vec3(1.0, 0.0, 1.0);
const vec3 infinite = vec3(1.0, 0.6, 1.0);

// From 8 stops below middle grey, violet, to 8 above, red.
vec3 stopColor(float stops) {
    float hue = 0.8 - 0.8 * clamp((floor(stops) + 8.0) / 16.0, 0.0, 1.0);
    vec3 color = clamp(abs(mod(6.0 * hue + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
    return mix(color, vec3(1.0), 0.25 * fract(stops)); // within a stop it becomes paler
}

vec3 encoded(vec3 linear_color) { // IEC 61966-2-1
    return mix(1.055 * pow(linear_color, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear_color,
               vec3(lessThanEqual(linear_color, vec3(0.0031308))));
}

vec3 shown(vec4 value) {
    if (channels == 1) value = value.rrra;
    if (channels == 2 && channel < 0) value.b = 0.0;
    // The distance from the eye is near / (1 - depth); without knowing what is in view, its inverse, brightened.
    if (depth == 1) value.rgb = vec3(sqrt(sqrt(max(1.0 - value.r, 0.0))));
    if (depth == 2)
        value.rgb = vec3((1.0 / max(1.0 - value.r, 1e-7) - depth_range.x) / max(depth_range.y - depth_range.x, 1e-6));
    vec3 color = channel < 0 ? value.rgb : vec3(value[channel]);
    if (any(isnan(color))) return no_number;
    if (any(isinf(color))) return infinite;
    color *= exposure;
    if (as_stops != 0) {
        float luminance = dot(color, vec3(0.2126, 0.7152, 0.0722));
        return luminance > 0.0 ? stopColor(log2(luminance / 0.18)) : vec3(0.0);
    }
    color = clamp(color, 0.0, 1.0);
    return encode_srgb != 0 ? encoded(color) : color;
}

void main() {
    ivec2 size = textureSize(source, 0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < TAPS * TAPS; ++i) {
        vec2 place = (vec2(i % TAPS, i / TAPS) + 0.5) / float(TAPS) - 0.5;
        vec2 texel = corner + (gl_FragCoord.xy - view_corner_px + place) * texels_per_pixel;
        bool is_outside = any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(size)));
        vec3 color = is_outside ? vec3(0.07) : shown(texelFetch(source, ivec2(texel), 0));
        if (color == no_number || color == infinite) { // one is seen, however small it is shown
            sum = color * float(TAPS * TAPS);
            break;
        }
        sum += color;
    }
    display_color = vec4(sum / float(TAPS * TAPS), 1.0);
}
