// Where a surface reads an image: each image of a material may have its own set of texture coordinates and its own
// transform of them.

// uv_set: 0 or 1. transform: of (u, v, 1), third row unused.
vec2 placedUv(vec2 first_uv, vec2 second_uv, int uv_set, mat3 transform) {
    return (transform * vec3(uv_set == 0 ? first_uv : second_uv, 1.0)).xy;
}
