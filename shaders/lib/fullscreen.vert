#version 330 core
// The vertex stage of every full-screen pass: one triangle that covers the screen, made from the vertex number.

out vec2 uv; // [0, 1] over the target, (0, 0) at the bottom left

void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
