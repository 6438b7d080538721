#version 330 core
// Nothing to shade: the shadow map has depth and no colour. But where a material has holes the sun shines through.

#ifdef ALPHA_MASK
in vec2 base_uv;
in float vertex_opacity;

uniform sampler2D base_map; // a: opacity
uniform float opacity;      // of the whole material
uniform float alpha_cutoff; // what has less is a hole

void main() {
    if (texture(base_map, base_uv).a * opacity * vertex_opacity < alpha_cutoff) discard;
}
#else
void main() {}
#endif
