// A picture over the whole target, scaled about the middle.

in vec2 uv;

uniform sampler2D picture;
#if !SAME_SIZE
uniform vec2 uv_scale; // the part of the picture that is shown, (0, 1]
#endif

// Linear light.
vec3 pictureColor() {
#if SAME_SIZE
    return texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
#else
    return texture(picture, (uv - 0.5) * uv_scale + 0.5).rgb;
#endif
}
