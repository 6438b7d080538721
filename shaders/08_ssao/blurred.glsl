// What a blur reads and writes.

in vec2 uv;

uniform sampler2D occlusion; // r: visibility, g: view z, b: weight, see ssao.frag
uniform vec2 uv_step;        // one pixel, in the directions of the blur

#if WITH_WEIGHT
out vec3 visibility_view_z_weight; // for the second direction
#elif WITH_VIEW_Z
out vec2 visibility_and_view_z; // [0, 1], world units
#else
out float visibility; // [0, 1]
#endif

vec3 occlusionAt(vec2 place) { return textureLod(occlusion, place, 0.0).rgb; }

// Four pixels further inwards where a place lies outside: there the noise pattern is the same.
vec2 inside(vec2 place) {
    vec2 pattern = 4.0 / vec2(textureSize(occlusion, 0));
    return place + pattern * (vec2(lessThan(place, vec2(0.0))) - vec2(greaterThan(place, vec2(1.0))));
}

void write(float sum, float weights, float view_z) {
#if WITH_WEIGHT
    visibility_view_z_weight = vec3(sum / weights, view_z, weights);
#elif WITH_VIEW_Z
    visibility_and_view_z = vec2(sum / weights, view_z);
#else
    visibility = sum / weights;
#endif
}
