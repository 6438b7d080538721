#version 330 core
// A picture over the whole target, scaled about the middle.

in vec2 uv;

uniform sampler2D picture;
#if !SAME_SIZE
uniform vec2 uv_scale; // the part of the picture that is shown, (0, 1]
#endif

out vec4 hdr_color; // linear

void main() {
#if SAME_SIZE
    hdr_color = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, 1.0);
#else
    hdr_color = vec4(texture(picture, (uv - 0.5) * uv_scale + 0.5).rgb, 1.0);
#endif
}
