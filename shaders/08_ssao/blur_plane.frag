#version 330 core
// Averages the 5 x 5 pixels round one that lie in its plane, as far as depth tells.
#include "08_ssao/same_surface.glsl"

in vec2 uv;

uniform sampler2D occlusion; // r: visibility, g: view z
uniform vec2 uv_step;        // one pixel

#if WITH_VIEW_Z
out vec2 visibility_and_view_z; // [0, 1], world units
#else
out float visibility; // [0, 1]
#endif

// excerpt: blur_plane
vec2 at(ivec2 offset) { return textureLod(occlusion, uv + vec2(offset) * uv_step, 0.0).rg; }

// What depth is in line with the center's at each of the neighbours: by the smaller of the steps to either side, as the
// larger may lead across an edge.
float smallerStep(float before, float center, float after) {
    float one = center - before;
    float other = after - center;
    return abs(one) < abs(other) ? one : other;
}

void main() {
    vec2 center = at(ivec2(0));
    float across = smallerStep(at(ivec2(-1, 0)).g, center.g, at(ivec2(1, 0)).g);
    float up = smallerStep(at(ivec2(0, -1)).g, center.g, at(ivec2(0, 1)).g);
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            vec2 other = at(ivec2(x, y));
            // 1/2 1 1 1 1/2: every column and row of a 4 x 4 pattern counts alike
            float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
            weight *= nearEnough(center.g + float(x) * across + float(y) * up, other.g, center.g);
            sum += weight * other.r;
            weights += weight;
        }
#if WITH_VIEW_Z
    visibility_and_view_z = vec2(sum / weights, center.g);
#else
    visibility = sum / weights;
#endif
}
// end excerpt
