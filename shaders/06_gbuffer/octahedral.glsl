// Unit vectors in two numbers: the sphere is projected on an octahedron whose lower half is folded outwards (Meyer et
// al. 2010, "On Floating-Point Normal Vectors"; Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors"). In 2 x 16 bits no direction is off by more than 0.004 degrees.

// excerpt: octahedral
vec2 signNotZero(vec2 v) { return vec2(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0); }

// To [0, 1] squared, for an unsigned normalised format.
vec2 octahedralFromDirection(vec3 direction) {
    vec2 p = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    if (direction.z < 0.0) p = (1.0 - abs(p.yx)) * signNotZero(p);
    return p * 0.5 + 0.5;
}

vec3 directionFromOctahedral(vec2 stored) {
    vec2 p = stored * 2.0 - 1.0;
    vec3 direction = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float folded = max(-direction.z, 0.0);
    direction.xy -= signNotZero(direction.xy) * folded;
    return normalize(direction);
}
// end excerpt

// excerpt: precise
// The code, of `steps` + 1 either way, that decodes nearest to the direction: rounding each number by itself may miss it
// (Cigolle et al. 2014, "oct precise"). As what the target will store: [0, 1] squared.
vec2 nearestOctahedral(vec3 direction, float steps) {
    vec2 low = floor(octahedralFromDirection(direction) * steps);
    vec2 best = low;
    float least = 4.0; // squared distance: cosines near 1 would not tell 16-bit codes apart
    for (int i = 0; i < 4; ++i) {
        vec2 code = min(low + vec2(i & 1, i >> 1), steps);
        vec3 off = directionFromOctahedral(code / steps) - direction;
        if (dot(off, off) < least) {
            least = dot(off, off);
            best = code;
        }
    }
    return best / steps;
}
// end excerpt
