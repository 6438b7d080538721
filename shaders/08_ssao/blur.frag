#version 330 core
// One direction of a blur that stops at edges in depth. Its weights 1/2 1 1 1 1/2 meet every column of the 4 x 4
// noise pattern equally, so that on a smooth surface no noise is left.
#include "08_ssao/same_surface.glsl"
#include "08_ssao/blurred.glsl"

// excerpt: blur
void main() {
    vec3 center = occlusionAt(uv);
    float sum = center.r * center.b;
    float weights = center.b;
    for (int i = -2; i <= 2; ++i) {
        if (i == 0) continue;
        vec3 other = occlusionAt(inside(uv + float(i) * uv_step));
        float weight = other.b * (abs(i) == 2 ? 0.5 : 1.0) * sameSurface(center.g, other.g);
        sum += weight * other.r;
        weights += weight;
    }
    write(sum, weights, center.g);
}
// end excerpt
