#version 330 core
// One direction of a blur that stops at edges in depth. Its weights 1/2 1 1 1 1/2 meet every column of the 4 x 4
// noise pattern equally, so that on a smooth surface no noise is left.

in vec2 uv;

uniform sampler2D occlusion; // r: visibility, g: view z
uniform vec2 uv_step;        // one pixel across or up

#if LAST
out float visibility; // [0, 1]
#else
out vec2 visibility_and_view_z;
#endif

// excerpt: ssao_blur
// Full weight within 2 % of the distance, none beyond 4 %.
float sameSurface(float view_z, float other_view_z) {
    return clamp(2.0 - abs(view_z - other_view_z) / (0.02 * abs(view_z)), 0.0, 1.0);
}

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
#if LAST
    visibility = sum / weights;
#else
    visibility_and_view_z = vec2(sum / weights, center.g);
#endif
}
// end excerpt
