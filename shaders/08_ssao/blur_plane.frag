#version 330 core
// Averages the 5 x 5 pixels round one that lie in its plane, as far as depth tells.
#include "08_ssao/same_surface.glsl"
#include "08_ssao/blurred.glsl"

// excerpt: blur_plane
// By how much depth changes from pixel to pixel where the center's plane goes on: the smaller of the steps to either
// side, as the larger may lead across an edge.
float smallerStep(vec2 direction, float center) {
    float before = center - occlusionAt(uv - direction * uv_step).g;
    float after = occlusionAt(uv + direction * uv_step).g - center;
    vec2 place = uv * direction; // outside there is only one of them
    float coordinate = place.x + place.y;
    float pixel = dot(direction, uv_step);
    if (coordinate < pixel) return after;
    if (coordinate > 1.0 - pixel) return before;
    return abs(before) < abs(after) ? before : after;
}

void main() {
    vec3 center = occlusionAt(uv);
    float across = smallerStep(vec2(1.0, 0.0), center.g);
    float up = smallerStep(vec2(0.0, 1.0), center.g);
    vec2 size = vec2(textureSize(occlusion, 0));
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            vec2 place = inside(uv + vec2(x, y) * uv_step);
            vec3 other = occlusionAt(place);
            vec2 pixels = (place - uv) * size;
            // 1/2 1 1 1 1/2: every column and row of a 4 x 4 pattern counts alike
            float weight = other.b * (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
            weight *= nearEnough(center.g + pixels.x * across + pixels.y * up, other.g, center.g);
            sum += weight * other.r;
            weights += weight;
        }
    write(sum, weights, center.g);
}
// end excerpt
