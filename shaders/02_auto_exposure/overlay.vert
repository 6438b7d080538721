#version 330 core
// A rectangle of the frame, in two triangles.

uniform vec2 origin;     // pixels, of the lower left corner
uniform vec2 extent;     // pixels
uniform vec2 frame_size; // pixels

void main() {
    int corner = gl_VertexID + gl_InstanceID; // 0, 1, 2 and 1, 2, 3
    vec2 place = vec2(corner & 1, corner >> 1);
    gl_Position = vec4((origin + extent * place) / frame_size * 2.0 - 1.0, 0.0, 1.0);
}
