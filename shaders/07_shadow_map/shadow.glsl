// Whether the sun is seen from a place, by comparing with the depths the sun sees, softened in one of several ways.
#include "lib/noise.glsl"
#if SHADOW_FILTER == SHADOW_FILTER_VSM || SHADOW_FILTER == SHADOW_FILTER_EVSM || SHADOW_FILTER == SHADOW_FILTER_MSM
#define HAS_MOMENTS 1
#include "07_shadow_map/moments.glsl"
#else
#define HAS_MOMENTS 0
#endif

// Cascades stand side by side, each a square; outside of all of them everything is lit.
#if HAS_MOMENTS
uniform sampler2D shadow_moments;
#elif SHADOW_FILTER == SHADOW_FILTER_PCSS
uniform sampler2D shadow_map;
uniform float sun_tangent; // of half the angle that the sun takes up
#else
uniform sampler2DShadow shadow_map;
#endif
uniform vec4 shadow_rows[3 * CASCADES];      // of each view's map to [0, 1] cubed: texture coordinates and depth
uniform float shadow_texel[CASCADES];        // side of a texel, world units
uniform float shadow_depth_range[CASCADES];  // world units from depth 0 to 1

// What a filter needs of a receiver: its place in a cascade, and how the depth of its plane changes there.
struct ShadowPlace {
    int cascade;
    vec2 uv;       // [0, 1] in the cascade
    float depth;   // biased, [0, 1]
    vec2 gradient; // of depth, for a step in uv; 0 where the bias does not follow the plane
};

float mapSide() { // texels
#if HAS_MOMENTS
    return float(textureSize(shadow_moments, 0).y);
#else
    return float(textureSize(shadow_map, 0).y);
#endif
}

vec2 atlasUv(int cascade, vec2 uv) { return vec2((uv.x + float(cascade)) / float(CASCADES), uv.y); }

#if SHADOW_FILTER == SHADOW_FILTER_PCF
// excerpt: pcf
// Percentage-closer filtering (Reeves et al. 1987). PCF_TAPS squared bilinear comparisons, a texel apart, weigh the
// texels of a row (1-f) 1 1 ... 1 f. Each pair of them is one bilinear comparison at the right place between the two, so
// a quarter of the taps gives the same sum (Castano 2013, "Shadow Mapping Summary").
float filteredShadow(ShadowPlace place) {
    const int pairs = (PCF_TAPS + 1) / 2;
    float size = mapSide();
    vec2 texel = place.uv * size - 0.5;
    vec2 first = floor(texel);
    vec2 f = texel - first;
    first -= float(pairs - 1) - 0.5; // centre of the first texel
    float sum = 0.0;
    for (int y = 0; y < pairs; ++y) {
        float near_y = y == 0 ? 1.0 - f.y : 1.0;
        float far_y = y == pairs - 1 ? f.y : 1.0;
        float weight_y = near_y + far_y;
        float tap_y = (first.y + float(2 * y) + far_y / weight_y) / size;
        for (int x = 0; x < pairs; ++x) {
            float near_x = x == 0 ? 1.0 - f.x : 1.0;
            float far_x = x == pairs - 1 ? f.x : 1.0;
            float weight_x = near_x + far_x;
            vec2 tap = vec2((first.x + float(2 * x) + far_x / weight_x) / size, tap_y);
            float depth = place.depth;
#if SHADOW_BIAS == SHADOW_BIAS_PLANE
            depth += dot(place.gradient, tap - place.uv);
#endif
            sum += weight_x * weight_y * textureLod(shadow_map, vec3(atlasUv(place.cascade, tap), depth), 0.0);
        }
    }
    return sum / float(PCF_TAPS * PCF_TAPS);
}
// end excerpt
#endif

#if SHADOW_FILTER == SHADOW_FILTER_ROTATED_DISK || SHADOW_FILTER == SHADOW_FILTER_PCSS
// Place i of n on a disk of radius 1, spread evenly: each a golden angle further (Vogel 1979), all turned by turn.
vec2 diskPlace(int i, int n, float turn) {
    float angle_rad = 2.3999632 * float(i) + 6.2831853 * turn;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle_rad), sin(angle_rad));
}
#endif

#if SHADOW_FILTER == SHADOW_FILTER_ROTATED_DISK
// excerpt: rotated_disk
// Sixteen comparisons on a disk as large as PCF's square, turned in every pixel: noise in place of steps.
float filteredShadow(ShadowPlace place) {
    const int taps = 16;
    float radius = 0.5642 * float(PCF_TAPS) / mapSide(); // pi r^2 = PCF_TAPS^2
    float turn = hashedUnit(ivec2(gl_FragCoord.xy));
    float sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 offset = radius * diskPlace(i, taps, turn);
        float depth = place.depth + dot(place.gradient, offset);
        sum += textureLod(shadow_map, vec3(atlasUv(place.cascade, place.uv + offset), depth), 0.0);
    }
    return sum / float(taps);
}
// end excerpt
#endif

#if SHADOW_FILTER == SHADOW_FILTER_PCSS
// excerpt: pcss
// Percentage-closer soft shadows (Fernando 2005): what stands in the way is averaged first; how far off it is says how
// wide the sun's disk blurs the edge.
float filteredShadow(ShadowPlace place) {
    const int seekers = 16;
    const int taps = 32;
    const float farthest = 4.0; // world units from which blockers are sought
    float uv_per_unit = 1.0 / (shadow_texel[place.cascade] * mapSide());
    float least = 0.7071 / mapSide(); // half of a texel's diagonal
    float turn = hashedUnit(ivec2(gl_FragCoord.xy));
    float search = max(farthest * sun_tangent * uv_per_unit, least);
    float blockers = 0.0;
    float blocker_depth = 0.0;
    for (int i = 0; i < seekers; ++i) {
        vec2 offset = search * diskPlace(i, seekers, turn);
        float seen = textureLod(shadow_map, atlasUv(place.cascade, place.uv + offset), 0.0).r;
        float blocks = seen < place.depth + dot(place.gradient, offset) ? 1.0 : 0.0;
        blockers += blocks;
        blocker_depth += blocks * seen;
    }
    if (blockers == 0.0) return 1.0;
    float in_front = max(place.depth - blocker_depth / blockers, 0.0) * shadow_depth_range[place.cascade];
    float radius = max(in_front * sun_tangent * uv_per_unit, least);
    float sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 offset = radius * diskPlace(i, taps, turn);
        float seen = textureLod(shadow_map, atlasUv(place.cascade, place.uv + offset), 0.0).r;
        sum += seen < place.depth + dot(place.gradient, offset) ? 0.0 : 1.0;
    }
    return sum / float(taps);
}
// end excerpt
#endif

#if HAS_MOMENTS
// excerpt: moments
// Chebyshev's inequality: the most of a distribution that can lie at or beyond a depth in front of which its mean is
// (Donnelly and Lauritzen 2006, "Variance Shadow Maps").
float chebyshev(float mean, float square, float depth, float least_variance) {
    if (depth <= mean) return 1.0;
    float variance = max(square - mean * mean, least_variance);
    return variance / (variance + (depth - mean) * (depth - mean));
}

#if SHADOW_FILTER == SHADOW_FILTER_MSM
// Peters and Klein 2015, algorithm 3 (Hamburger's moment problem): of all distributions with these four moments, the
// least that lies in front of the depth.
float hamburger(vec4 b, float depth) {
    b = mix(b, vec4(0.5), 6e-5); // what 16 bits have rounded away may leave no distribution at all
    float l32d22 = b.z - b.x * b.y;
    float d22 = b.y - b.x * b.x;
    float variance = b.w - b.y * b.y;
    float d33d22 = variance * d22 - l32d22 * l32d22;
    float l32 = l32d22 / d22;
    vec3 c = vec3(1.0, depth, depth * depth);
    c.y -= b.x;
    c.z -= b.y + l32 * c.y;
    c.y /= d22;
    c.z *= d22 / d33d22;
    c.y -= l32 * c.z;
    c.x -= dot(c.yz, b.xy);
    float p = c.y / c.z;
    float q = c.x / c.z;
    float root = sqrt(max(0.25 * p * p - q, 0.0));
    float low = -0.5 * p - root;
    float high = -0.5 * p + root;
    vec4 chosen = high < depth ? vec4(low, depth, 1.0, 1.0) : low < depth ? vec4(depth, low, 0.0, 1.0) : vec4(0.0);
    float share = (chosen.x * high - b.x * (chosen.x + high) + b.y) / ((high - chosen.y) * (depth - low));
    // what bias and rounding take from a full shadow: Peters 2017, "Non-linearly Quantized Moment Shadow Maps"
    return clamp(1.0 - (chosen.z + chosen.w * share) / 0.98, 0.0, 1.0);
}
#endif

float filteredShadow(ShadowPlace place) {
    float half_texel = 0.5 / mapSide(); // no cascade sees into its neighbour
    vec2 uv = atlasUv(place.cascade, clamp(place.uv, half_texel, 1.0 - half_texel));
    vec4 stored = textureLod(shadow_moments, uv, 0.0);
#if SHADOW_FILTER == SHADOW_FILTER_VSM
    // the bound is far from tight where things lie one behind the other; without its last fifth less light bleeds
    return clamp((chebyshev(stored.x, stored.y, place.depth, 1e-6) - 0.2) / 0.8, 0.0, 1.0);
#elif SHADOW_FILTER == SHADOW_FILTER_EVSM
    vec2 depth = warped(place.depth);
    vec2 scale = 1e-4 * vec2(positive_exponent, negative_exponent) * depth;
    return min(chebyshev(stored.x, stored.z, depth.x, scale.x * scale.x),
               chebyshev(stored.y, stored.w, depth.y, scale.y * scale.y));
#else
    const mat4 moments_from_stored = mat4( //
        0.2227744146, 0.0771972861, 0.7926986636, 0.0319417555, //
        0.1549679261, 0.1394629426, 0.7963415838, -0.1722823173, //
        0.1451988946, 0.2120202157, 0.7258694464, -0.2758014811, //
        0.163127443, 0.2591432266, 0.6539092497, -0.3376131734);
    return hamburger((stored - stored_offset) * moments_from_stored, place.depth);
#endif
}
// end excerpt
#endif

#if SHADOW_BIAS == SHADOW_BIAS_PLANE
// excerpt: plane
// How the depth of the receiver's plane changes in the map, from its geometric normal: every tap is compared with the
// plane's own depth there (Isidoro 2006, "Shadow Mapping: GPU-based Tips and Techniques"). A comparison mixes texels up
// to one beside the tap, by which the plane may lie deeper; that much is the whole bias, and it is one texel of shadow
// at every slope. Rows of the map are a rotation, scaled, so its inverse needs no more than their lengths.
vec2 planeGradient(vec3 normal, int cascade) {
    vec3 x = shadow_rows[3 * cascade].xyz;
    vec3 y = shadow_rows[3 * cascade + 1].xyz;
    vec3 z = shadow_rows[3 * cascade + 2].xyz;
    vec3 n = vec3(dot(x, normal) / dot(x, x), dot(y, normal) / dot(y, y), dot(z, normal) / dot(z, z));
    // steeper than 87 degrees, what is left of the sun's light is not worth a longer gap
    const float least_cosine = 0.052;
    float n_z = min(n.z, -least_cosine * inversesqrt(dot(z, z)));
    return -n.xy / n_z;
}
// end excerpt
#else
// excerpt: shadow_bias
// By how much of the depth range a surface is moved towards the sun, so that it does not shade itself.
float shadowBias(float n_dot_l, int cascade) {
#if SHADOW_BIAS == SHADOW_BIAS_CONSTANT
    return 0.0025;
#elif SHADOW_BIAS == SHADOW_BIAS_SLOPE
    return max(0.0025 * (1.0 - n_dot_l), 0.0009);
#elif SHADOW_BIAS == SHADOW_BIAS_TEXEL
    // what the surface's depth changes by over half of the filter's width
    float slope = sqrt(max(1.0 - n_dot_l * n_dot_l, 0.0)) / max(n_dot_l, 0.1);
    return shadow_texel[cascade] * (0.5 * float(PCF_TAPS) + 0.5) * (0.2 + slope) / shadow_depth_range[cascade];
#elif SHADOW_BIAS == SHADOW_BIAS_NORMAL_OFFSET
    return 0.2 * shadow_texel[cascade] / shadow_depth_range[cascade];
#else // front faces cast no shadow: what is lit is well in front of what casts
    return 0.5 * shadow_texel[cascade] / shadow_depth_range[cascade];
#endif
}
// end excerpt
#endif

vec3 placeIn(int cascade, vec3 world_position) {
    vec4 p = vec4(world_position, 1.0);
    return vec3(dot(shadow_rows[3 * cascade], p), dot(shadow_rows[3 * cascade + 1], p),
                dot(shadow_rows[3 * cascade + 2], p));
}

// The nearest view that holds the place and its filter's reach; the last one where none does.
int cascadeAt(vec3 world_position) {
#if CASCADES > 1
    float margin = (0.5 * float(PCF_TAPS) + 1.0) / mapSide();
    for (int i = 0; i < CASCADES - 1; ++i) {
        vec3 place = placeIn(i, world_position);
        if (place == clamp(place, vec3(margin, margin, 0.0), vec3(1.0 - margin, 1.0 - margin, 1.0))) return i;
    }
#endif
    return CASCADES - 1;
}

// Whether sunVisible() wants the surface's geometric normal. The first two biases are the original's, which took the
// normal map's.
#define BIAS_BY_GEOMETRY (SHADOW_BIAS != SHADOW_BIAS_CONSTANT && SHADOW_BIAS != SHADOW_BIAS_SLOPE)

// 1: seen, 0: in shadow, and where the surface faces away or all but. normal: see
// BIAS_BY_GEOMETRY; unit length.
float sunVisible(vec3 world_position, vec3 normal, vec3 to_sun) {
    float n_dot_l = dot(normal, to_sun);
    int cascade = cascadeAt(world_position);
#if SHADOW_BIAS == SHADOW_BIAS_NORMAL_OFFSET
    // Holbert 2011, "Saying Goodbye to Shadow Acne": along the normal. By the sine, as a plane that much higher is as much
    // nearer the sun as the filter's farthest texels of it are deeper.
    float sine = sqrt(max(1.0 - n_dot_l * n_dot_l, 0.0));
    world_position += normal * (shadow_texel[cascade] * (0.5 * float(PCF_TAPS) + 0.5) * sine);
#endif
    vec3 at = placeIn(cascade, world_position);
    ShadowPlace place = ShadowPlace(cascade, at.xy, at.z, vec2(0.0));
#if SHADOW_BIAS == SHADOW_BIAS_PLANE
    const float rounding = 4e-7; // of a depth in 24 bits, and of arithmetic in 32
    place.gradient = planeGradient(normal, cascade);
    place.depth -= (abs(place.gradient.x) + abs(place.gradient.y)) / mapSide() + rounding;
#else
    place.depth -= shadowBias(max(n_dot_l, 0.0), cascade);
#endif
    place.depth = clamp(place.depth, 0.0, 1.0);
    bool outside = at.z > 1.0;
#if CASCADES > 1
    outside = outside || at.xy != clamp(at.xy, 0.0, 1.0);
#endif
    float visible = outside ? 1.0 : filteredShadow(place);
#if SHADOW_BIAS == SHADOW_BIAS_CONSTANT || SHADOW_BIAS == SHADOW_BIAS_SLOPE || SHADOW_BIAS == SHADOW_BIAS_TEXEL
    const float faces_away = 0.05; // nearly along the light no such bias is enough
#else
    const float faces_away = 0.0;
#endif
    return n_dot_l < faces_away ? 0.0 : visible;
}
