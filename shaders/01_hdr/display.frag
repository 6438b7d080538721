#version 330 core
// Scene light to display light: exposed, tone mapped, encoded. Or its luminance in false colours.
#include "lib/tone_map.glsl"
#include "lib/encode.glsl"

uniform sampler2D hdr;
uniform float exposure; // factor on scene light

in vec2 uv;
out vec4 display_color; // encoded, [0, 1]

#if VIEW == VIEW_STOPS
// excerpt: stops
// Luminance as a colour: a band a stop, from 8 stops below 1 (violet) to 8 above (red), grey about 1.
vec3 stopColor(float stops) {
    float t = clamp((floor(stops) + 8.5) / 16.0, 0.0, 1.0);
    if (abs(floor(stops) + 0.5) < 1.0) return stops < 0.0 ? vec3(0.22) : vec3(0.3);
    vec3 hue = clamp(abs(mod(6.0 * (0.8 - 0.8 * t) + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
    return hue * mix(0.25, 0.9, t);
}

// The light's colour band; striped where the display would show a channel at its end.
vec3 falseColor(vec3 exposed) {
    float stops = log2(clamp(luminance(max(exposed, 0.0)), 1e-6, 65504.0));
    vec3 display = toneMap(exposed);
    vec3 band = stopColor(stops);
    bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 3.0;
    float highest = max(display.r, max(display.g, display.b));
    if (stripe && highest >= 254.5 / 255.0) return vec3(1.0);
    if (stripe && highest <= 0.00015) return vec3(0.0); // below half a code of sRGB
    return band;
}
// end excerpt
#endif

// excerpt: display
void main() {
    vec3 exposed = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb * exposure;
#if VIEW == VIEW_STOPS
    vec3 color = uv.y < 0.035 ? stopColor(uv.x * 16.0 - 8.0) : falseColor(exposed);
#else
    vec3 color = toneMap(exposed);
#endif
    display_color = vec4(encode(color), 1.0);
}
// end excerpt
