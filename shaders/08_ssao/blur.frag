#version 330 core
// One direction of a blur that stops at edges in depth. Its weights 1/2 1 1 1 1/2 meet every column of the 4 x 4
// noise pattern equally, so that on a smooth surface no noise is left.
#include "08_ssao/same_surface.glsl"

in vec2 uv;

uniform sampler2D occlusion; // r: visibility, g: view z
uniform vec2 uv_step;        // one pixel across or up

#if WITH_VIEW_Z
out vec2 visibility_and_view_z; // [0, 1], world units
#else
out float visibility; // [0, 1]
#endif

// excerpt: ssao_blur
void main() {
    vec2 center = textureLod(occlusion, uv, 0.0).rg;
    float sum = center.r;
    float weights = 1.0;
    for (int i = -2; i <= 2; ++i) {
        if (i == 0) continue;
        vec2 other = textureLod(occlusion, uv + float(i) * uv_step, 0.0).rg;
        float weight = (abs(i) == 2 ? 0.5 : 1.0) * sameSurface(center.g, other.g);
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
