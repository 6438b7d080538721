#version 330 core
// A level of the pyramid as it is, each texel a square, toned and encoded like the picture.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

in vec2 uv;

uniform sampler2D level;
uniform float exposure; // factor on its light

out vec4 display_color; // encoded, [0, 1]

void main() {
    ivec2 size = textureSize(level, 0);
    vec2 right = dFdx(uv);
    vec2 up = dFdy(uv);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) { // over the pixel: a large level has several texels in it, a small one has edges
        vec2 place = uv + (float(i % 4) - 1.5) / 4.0 * right + (float(i / 4) - 1.5) / 4.0 * up;
        sum += texelFetch(level, clamp(ivec2(place * vec2(size)), ivec2(0), size - 1), 0).rgb;
    }
    display_color = vec4(encode(toneMap(sum / 16.0 * exposure)), 1.0);
}
