#version 330 core
// Doubles an image, smoothing it; blending adds the result to the level above. Offsets are in texels of the source.

in vec2 uv;

uniform sampler2D source;

out vec4 color;

// excerpt: up
vec3 tap(float x, float y) { return texture(source, uv + vec2(x, y) / vec2(textureSize(source, 0))).rgb; }

vec3 up() {
#if UP_FILTER == UP_FILTER_TENT
    // [1 2 1] / 4 in either direction, over bilinear fetches
    vec3 corners = tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0);
    vec3 edges = tap(-1.0, 0.0) + tap(1.0, 0.0) + tap(0.0, -1.0) + tap(0.0, 1.0);
    return 0.0625 * corners + 0.125 * edges + 0.25 * tap(0.0, 0.0);
#elif UP_FILTER == UP_FILTER_4TAP
    return 0.25 * (tap(-0.5, -0.5) + tap(0.5, -0.5) + tap(-0.5, 0.5) + tap(0.5, 0.5));
#elif UP_FILTER == UP_FILTER_BILINEAR
    return tap(0.0, 0.0);
#endif
}
// end excerpt

void main() { color = vec4(up(), 1.0); }
