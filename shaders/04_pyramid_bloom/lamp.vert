#version 330 core
// A glowing stroke with round ends, turned to the camera. Where it is thinner than a pixel it is drawn wider and
// dimmer, so that its light stays the same, and does not flicker as it moves.

layout(location = 0) in vec2 corner;        // [-1, 1]
layout(location = 1) in vec3 stroke_a;      // world, metres
layout(location = 2) in vec3 stroke_b;
layout(location = 3) in vec3 stroke_color;  // linear
layout(location = 4) in vec4 stroke_values; // radius in metres; period of the pulse, s (0: none, < 0: of the travel);
                                            // phase, [0, 1); 1 for a streak on the water
layout(location = 5) in vec3 stroke_travel; // in one period, metres

uniform mat4 clip_from_world;
uniform vec2 size;          // of the target, pixels
uniform float pixels_per_m; // at one metre's distance
uniform float time_s;

flat out vec2 from_a;     // a, in pixels from the bottom left
flat out vec2 a_to_b;     // pixels
flat out float radius;    // pixels
flat out vec3 color;      // linear
flat out vec2 streak;     // x: 1 on the water; y: phase of its ripples

const float two_pi = 6.2831853;
const float thinnest_px = 0.75;

void main() {
    float turn = stroke_values.y == 0.0 ? 0.0 : fract(stroke_values.z + time_s / abs(stroke_values.y));
    vec3 travelled = stroke_values.y < 0.0 ? stroke_travel * turn : vec3(0.0);
    vec4 a = clip_from_world * vec4(stroke_a + travelled, 1.0);
    vec4 b = clip_from_world * vec4(stroke_b + travelled, 1.0);
    color = stroke_color;
    if (stroke_values.y > 0.0) // a light that turns: short and bright once a period, never quite dark
        color *= 0.12 + 0.88 * pow(0.5 + 0.5 * cos(two_pi * turn), 3.0);
    streak = vec2(stroke_values.w, 10.0 * fract(0.37 * stroke_a.x));

    if (min(a.w, b.w) < 0.5) { // behind the camera
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    from_a = (0.5 + 0.5 * a.xy / a.w) * size;
    a_to_b = (0.5 + 0.5 * b.xy / b.w) * size - from_a;
    float true_radius = stroke_values.x * pixels_per_m / max(0.5 * (a.w + b.w), 0.5);
    radius = max(true_radius, thinnest_px);
    float thinned = true_radius / radius;
    color *= dot(a_to_b, a_to_b) > 4.0 * radius * radius ? thinned : thinned * thinned; // a line, a point

    float length_px = length(a_to_b);
    vec2 along = length_px > 1e-3 ? a_to_b / length_px : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec2 end = from_a + (corner.x > 0.0 ? a_to_b : vec2(0.0));
    vec2 pixel = end + (radius + 1.0) * (corner.x * along + corner.y * across);
    float depth = corner.x > 0.0 && streak.x == 0.0 ? b.z / b.w : a.z / a.w; // a streak lies as far as its lamp
    gl_Position = vec4(2.0 * pixel / size - 1.0, depth, 1.0);
}
