// The shadow map as a picture: needs 07_shadow_map/shadow.glsl before it. Near the sun is bright.

// place: [0, 1] over the first cascade; black beyond.
vec3 showShadowMap(vec2 place) {
    if (place != clamp(place, 0.0, 1.0)) return vec3(0.0);
    vec2 at = atlasUv(0, place);
#if HAS_MOMENTS
    return vec3(1.0 - filteredShadow(ShadowPlace(0, place, 0.5, vec2(0.0))));
#elif SHADOW_FILTER == SHADOW_FILTER_PCSS
    return vec3(1.0 - textureLod(shadow_map, at, 0.0).r);
#else
    // The map's sampler only compares, so its depth is what part of a row of references lies in front of it.
    const float nearest = 0.15; // of the light's range: where the scene lies
    const float farthest = 0.65;
    const int references = 128;
    float sum = 0.0;
    for (int i = 0; i < references; ++i) {
        float depth = mix(nearest, farthest, (float(i) + 0.5) / float(references));
        sum += textureLod(shadow_map, vec3(at, depth), 0.0);
    }
    return vec3(1.0 - sum / float(references));
#endif
}
