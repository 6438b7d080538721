#version 330 core
// The read-out: average luminance, key and exposure in figures, over the histogram of log2 luminance with its marks.
#include "02_auto_exposure/histogram.glsl"

uniform sampler2D histogram;  // r: samples of each bin
uniform sampler2D exposure;   // 1x1, see exposure.frag
uniform vec2 origin;          // pixels, of the lower left corner
uniform float scale;          // pixels of the frame for one of the read-out
uniform float samples;        // in all bins together, but for those left out
uniform float burn_out;       // exposed luminance that becomes white; 0: none does

out vec4 display_color; // encoded

const ivec2 plot = ivec2(4, 4); // its lower left corner
const int plot_height = 32;
const int text_row = 39;
const float full_share = 0.1; // of all samples in one bin: a bar as high as the plot

// A character is 3 wide and 5 high, a bit a pixel, the top left one highest: "0" to "9", then these.
const int POINT = 10;
const int MINUS = 11;
const int PLUS = 12;
const int LETTER_Y = 13;
const int LETTER_A = 14;
const int LETTER_K = 15;
const int LETTER_E = 16;
const int LETTER_V = 17;
const int SPACE = 18;
const int glyphs[19] = int[](0x7B6F, 0x2C97, 0x73E7, 0x73CF, 0x5BC9, 0x79CF, 0x79EF, 0x7249, 0x7BEF, 0x7BCF, 0x0002,
                             0x01C0, 0x05D0, 0x5A92, 0x2BED, 0x5BAD, 0x79E7, 0x5B6A, 0x0000);

// The character at a place (0: the last) of a number that is not negative, with so many decimals.
int figure(float value, int decimals, int place) {
    if (place == decimals) return POINT;
    float digit = place > decimals ? float(place - 1) : float(place);
    float scaled = floor(value * pow(10.0, float(decimals)) + 0.5);
    return int(mod(floor(scaled / pow(10.0, digit) + 1e-3), 10.0));
}

// "YA 0.0123  KEY 0.045  EV +1.23": thirty characters.
int character(int column, vec4 state) {
    float ev = log2(state.r);
    if (column == 0) return LETTER_Y;
    if (column == 1) return LETTER_A;
    if (column >= 3 && column < 9) return figure(state.g, state.g < 9.9999 ? 4 : state.g < 99.999 ? 3 : 2, 8 - column);
    if (column == 11) return LETTER_K;
    if (column == 12 || column == 23) return LETTER_E;
    if (column == 13) return LETTER_Y;
    if (column >= 15 && column < 20) return figure(state.b, 3, 19 - column);
    if (column == 24) return LETTER_V;
    if (column == 26) return ev < 0.0 ? MINUS : PLUS;
    if (column >= 27 && column < 31) return figure(abs(ev), abs(ev) < 9.995 ? 2 : 1, 30 - column);
    return SPACE;
}

bool inText(ivec2 pixel, vec4 state) {
    ivec2 place = pixel - ivec2(plot.x, text_row);
    if (place.x < 0 || place.y < 0 || place.y > 4 || place.x % 4 == 3) return false;
    int bit = 3 * place.y + 2 - place.x % 4;
    return ((glyphs[character(place.x / 4, state)] >> bit) & 1) == 1;
}

vec3 plotColor(ivec2 place, vec4 state) {
    float bin = float(place.x);
    float stop = lowest_stop + (bin + 0.5) / float(bins) * (highest_stop - lowest_stop);
    float share = texelFetch(histogram, ivec2(place.x, 0), 0).r / samples;
    bool in_bar = float(place.y) < float(plot_height) * sqrt(min(share / full_share, 1.0));
    bool burnt = burn_out > 0.0 && exp2(stop) * state.r >= burn_out;
    if (bin == floor(binOf(state.a))) return vec3(0.35, 0.80, 1.00);
    if (bin == floor(binOf(log2(state.g)))) return vec3(1.00, 0.62, 0.15);
    if (in_bar) return burnt ? vec3(1.0) : vec3(0.55);
    if (place.x % 16 == 0) return vec3(place.x == bins / 2 ? 0.30 : 0.17); // every four stops; 1 stands out
    return burnt ? vec3(0.16, 0.14, 0.14) : vec3(0.07);
}

void main() {
    vec4 state = texelFetch(exposure, ivec2(0), 0);
    ivec2 pixel = ivec2(floor((gl_FragCoord.xy - origin) / scale));
    ivec2 place = pixel - plot;
    vec3 color = vec3(0.07);
    if (place.x >= 0 && place.x < bins && place.y >= 0 && place.y < plot_height) color = plotColor(place, state);
    if (inText(pixel, state)) color = vec3(0.92);
    display_color = vec4(color, 1.0);
}
