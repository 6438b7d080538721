// Where a direction lies in an equirectangular picture: u goes round the y axis, v from straight up (0) to down (1).

vec2 equirectangularUv(vec3 direction) {
    const float pi = 3.14159265;
    return vec2(atan(direction.z, direction.x) / (2.0 * pi) + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / pi);
}
