// Rings of a drop that fell onto the picture, which they bend and light. GLSL ES 1.00, which GStreamer's own shaders are.
precision highp float;
varying vec2 v_texcoord;
uniform sampler2D tex;
uniform float bend; // of the picture, in parts of its width

void main() {
    vec2 from_drop = v_texcoord - vec2(0.6, 0.45);
    float distance = length(from_drop);
    float slope = cos(distance * 60.0) * exp(-5.0 * distance);
    vec2 direction = from_drop / max(distance, 1e-4);
    vec3 color = texture2D(tex, v_texcoord + bend * slope * direction).rgb;
    gl_FragColor = vec4(color * (0.8 + 0.4 * slope) + 0.2 * pow(max(slope, 0.0), 8.0), 1.0);
}
