#version 330 core
// The light of a stroke, smooth over a pixel at its edge; on water broken by ripples and fading.

flat in vec2 from_a;  // a, in pixels from the bottom left
flat in vec2 a_to_b;  // pixels
flat in float radius; // pixels
flat in vec3 color;   // linear
flat in vec2 streak;  // x: 1 on the water; y: phase of its ripples

uniform float time_s;

out vec4 hdr_color; // linear, added to what is there

void main() {
    vec2 to_pixel = gl_FragCoord.xy - from_a;
    float along = clamp(dot(to_pixel, a_to_b) / max(dot(a_to_b, a_to_b), 1e-6), 0.0, 1.0);
    float from_axis = length(to_pixel - along * a_to_b);
    float part = clamp(radius - from_axis + 0.5, 0.0, 1.0);
    if (part <= 0.0) discard;
    if (streak.x > 0.0) {
        float ripple = sin(34.0 * along + streak.y + 1.6 * time_s) * sin(21.0 * along - streak.y + 1.1 * time_s);
        part *= (0.55 + 0.45 * ripple) * along * along * (1.0 - along) * 6.75 * (1.0 - from_axis / (radius + 0.5));
    }
    hdr_color = vec4(color * part, 1.0);
}
