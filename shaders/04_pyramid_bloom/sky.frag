#version 330 core
// The sky, and below the horizon the water that mirrors it.
#include "04_pyramid_bloom/sky.glsl"

in vec2 uv;

uniform mat4 world_from_clip;
uniform vec3 camera_position; // world, metres

out vec4 hdr_color; // linear

// Noise of a display code or so, for so dark a gradient would show its 8-bit steps (Jimenez 2014, "interleaved gradient
// noise").
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
    vec4 far = world_from_clip * vec4(2.0 * uv - 1.0, 1.0, 1.0);
    vec3 ray = far.xyz / far.w - camera_position;
    float height = ray.y * inversesqrt(dot(ray, ray));
    vec3 color = skyColor(height) * (height < 0.0 ? 0.55 : 1.0);
    hdr_color = vec4(color * (1.0 + 0.16 * (noise(gl_FragCoord.xy) - 0.5)), 1.0);
}
