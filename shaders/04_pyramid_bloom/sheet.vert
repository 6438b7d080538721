#version 330 core
// One picture of the contact sheet.

layout(location = 0) in vec2 corner; // [0, 1]

uniform vec4 place; // left, bottom, right, top in [0, 1] of the target

out vec2 uv;

void main() {
    uv = corner;
    gl_Position = vec4(2.0 * mix(place.xy, place.zw, corner) - 1.0, 0.0, 1.0);
}
