#version 330 core
// One pixel: the eye adapts by one frame, and what it has adapted to says how the frame is exposed.
#include "02_auto_exposure/key.glsl"
#include "02_auto_exposure/is_finite.glsl"

uniform sampler2D metered;      // 1x1: log2 luminance of this frame
uniform float lowest_stop;      // log2 luminance: the darkest scene that is adapted to
uniform float highest_stop;     // the brightest
uniform float previous_stop;    // log2 luminance adapted to one frame ago
uniform float share_up;         // of the way to a brighter scene that is gone in a frame, [0, 1]
uniform float share_down;       // of the way to a darker one
uniform float key_override;     // 0: from the luminance adapted to
uniform float compensation;     // factor

out vec4 exposure; // r: factor on scene light, g: luminance adapted to, b: key, a: log2 luminance metered

// excerpt: exposure
void main() {
    float metered_stop = texelFetch(metered, ivec2(0), 0).r;
    if (!isFinite(metered_stop)) metered_stop = previous_stop; // the eye stays as it was
    float goal = clamp(metered_stop, lowest_stop, highest_stop);
    float stop = mix(previous_stop, goal, goal > previous_stop ? share_up : share_down);
    float average_luminance = exp2(stop);
    float key = key_override > 0.0 ? key_override : keyOf(average_luminance);
    exposure = vec4(compensation * key / average_luminance, average_luminance, key, metered_stop);
}
// end excerpt
