#version 330 core
// One direction of a box filter over the shadow map, as wide as the comparisons of PCF reach; the first direction turns
// depths into the moments that are filtered.
#include "07_shadow_map/moments.glsl"

uniform sampler2D source;
uniform ivec2 texel_step; // to the next texel of the filter
uniform int map_size;     // texels of a cascade's side: no cascade may see into its neighbour

out vec4 filtered;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 first = ivec2(texel.x / map_size * map_size, 0);
    ivec2 last = first + map_size - 1;
    vec4 sum = vec4(0.0);
    const int reach = PCF_TAPS / 2;
    for (int i = -reach; i <= reach; ++i) {
        ivec2 place = clamp(texel + i * texel_step, first, last);
#if FIRST
        sum += momentsOf(texelFetch(source, place, 0).r);
#else
        sum += texelFetch(source, place, 0);
#endif
    }
    filtered = sum / float(PCF_TAPS);
}
