#version 330 core
// One tap, copied: the unit every cost is given in.

in vec2 uv;
uniform sampler2D source;
out vec4 color;

void main() { color = texture(source, uv); }
