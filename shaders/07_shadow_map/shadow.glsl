// Whether the sun is seen from a place, by comparing with the depths the sun sees; softened over PCF_TAPS x PCF_TAPS
// comparisons (percentage-closer filtering, Reeves et al. 1987).

uniform sampler2DShadow shadow_map;  // outside of it everything is lit
uniform mat4 shadow_from_world;      // to [0, 1] cubed: texture coordinates and depth
uniform float shadow_texel;          // side of a texel, world units
uniform float shadow_depth_range;    // world units from depth 0 to 1

// excerpt: pcf
// PCF_TAPS squared bilinear comparisons, a texel apart, weigh the texels of a row (1-f) 1 1 ... 1 f. Each pair of
// them is one bilinear comparison at the right place between the two, so a quarter of the taps gives the same sum
// (Castano 2013, "Shadow Mapping Summary").
float filteredShadow(vec2 shadow_uv, float depth) {
    const int pairs = (PCF_TAPS + 1) / 2;
    vec2 size = vec2(textureSize(shadow_map, 0));
    vec2 texel = shadow_uv * size - 0.5;
    vec2 first = floor(texel);
    vec2 f = texel - first;
    first -= float(pairs - 1) - 0.5; // centre of the first texel
    float sum = 0.0;
    for (int y = 0; y < pairs; ++y) {
        float near_y = y == 0 ? 1.0 - f.y : 1.0;
        float far_y = y == pairs - 1 ? f.y : 1.0;
        float weight_y = near_y + far_y;
        float tap_y = (first.y + float(2 * y) + far_y / weight_y) / size.y;
        for (int x = 0; x < pairs; ++x) {
            float near_x = x == 0 ? 1.0 - f.x : 1.0;
            float far_x = x == pairs - 1 ? f.x : 1.0;
            float weight_x = near_x + far_x;
            float tap_x = (first.x + float(2 * x) + far_x / weight_x) / size.x;
            sum += weight_x * weight_y * textureLod(shadow_map, vec3(tap_x, tap_y, depth), 0.0);
        }
    }
    return sum / float(PCF_TAPS * PCF_TAPS);
}
// end excerpt

// excerpt: shadow_bias
// By how much of the depth range a surface is moved towards the sun, so that it does not shade itself.
float shadowBias(float n_dot_l) {
#if SHADOW_BIAS == SHADOW_BIAS_CONSTANT
    return 0.0025;
#elif SHADOW_BIAS == SHADOW_BIAS_SLOPE
    return max(0.0025 * (1.0 - n_dot_l), 0.0009);
#elif SHADOW_BIAS == SHADOW_BIAS_TEXEL
    // what the surface's depth changes by over half of the filter's width
    float slope = sqrt(max(1.0 - n_dot_l * n_dot_l, 0.0)) / max(n_dot_l, 0.1);
    return shadow_texel * (0.5 * float(PCF_TAPS) + 0.5) * (0.2 + slope) / shadow_depth_range;
#endif
}
// end excerpt

// 1: seen, 0: in shadow, and where the surface faces away or all but.
float sunVisible(vec3 world_position, vec3 world_normal, vec3 to_sun) {
    float n_dot_l = dot(world_normal, to_sun);
    vec3 place = (shadow_from_world * vec4(world_position, 1.0)).xyz;
    float depth = place.z - shadowBias(max(n_dot_l, 0.0));
    float visible = place.z > 1.0 ? 1.0 : filteredShadow(place.xy, clamp(depth, 0.0, 1.0));
    return n_dot_l < 0.05 ? 0.0 : visible;
}
