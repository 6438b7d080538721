// Moments of depth: what can be filtered like a color, and still says how much of a texel lies before a surface.

#if SHADOW_FILTER == SHADOW_FILTER_EVSM
// As large as 32-bit floats hold the square of.
const float positive_exponent = 42.0;
const float negative_exponent = 20.0;

vec2 warped(float depth) {
    float centered = depth * 2.0 - 1.0;
    return vec2(exp(positive_exponent * centered), -exp(-negative_exponent * centered));
}
#endif

#if SHADOW_FILTER == SHADOW_FILTER_MSM
// Peters and Klein 2015, "Moment Shadow Mapping": a change of basis after which 16 bits are enough.
const mat4 stored_from_moments = mat4( //
    -2.07224649, 32.23703778, -68.571074599, 39.3703274134, //
    13.7948857237, -59.4683975703, 82.0359750338, -35.364903257, //
    0.105877704, -1.9077466311, 9.3496555107, -6.6543490743, //
    9.7924062118, -33.7652110555, 47.9456096605, -23.9728048165);
const vec4 stored_offset = vec4(0.035955884801, 0.0, 0.0, 0.0);
#endif

vec4 momentsOf(float depth) {
#if SHADOW_FILTER == SHADOW_FILTER_VSM
    return vec4(depth, depth * depth, 0.0, 0.0);
#elif SHADOW_FILTER == SHADOW_FILTER_EVSM
    vec2 w = warped(depth);
    return vec4(w, w * w);
#else
    float square = depth * depth;
    return vec4(depth, square, square * depth, square * square) * stored_from_moments + stored_offset;
#endif
}
