#version 330 core
// A dark hall with one great window, whose panes double in brightness from row to row: 1 at the sill, 256 in the arch.
// The sun through the panes, their mirror image in the floor and a few lamps are all the light there is. Everything is
// computed from where a point lies; there are no textures.

in vec3 world_position;
flat in vec3 world_normal;
flat in vec3 color; // linear
flat in float glow;

uniform vec3 camera_position; // world
uniform vec3 to_sun;          // world, length 1, z < 0: the sun stands outside the window
uniform float pixel_angle;    // rad, of one pixel in the middle of the picture
uniform float brightness;     // factor on all light
uniform vec3 lamp_position[LAMPS]; // world
uniform vec3 lamp_color[LAMPS];    // radiant intensity, linear

out vec4 hdr_color; // linear, [0, infinity)

// The window, in the plane z = 0: a pointed arch over a rectangle.
const float half_width = 1.4;
const float sill = 0.9;
const float springing = 2.0; // where the arch begins
const vec2 pane = vec2(0.35, 0.391);
const float lead = 0.022; // half the width of the bars between panes

// excerpt: window
// What comes through the window at a place in it, in units of the lowest row of panes; 0 beside it. Edges are soft over
// that many units: a pixel's width, or the blur that the sun's disc gives a shadow.
vec3 windowLight(vec2 place, float softness) {
    float out_of_arch = place.y > springing ? length(vec2(abs(place.x) + half_width, place.y - springing)) - 2.0 * half_width
                                            : max(abs(place.x) - half_width, sill - place.y);
    if (out_of_arch > softness) return vec3(0.0);
    vec2 cell = vec2(place.x, place.y - sill) / pane;
    vec2 to_edge = (0.5 - abs(fract(cell) - 0.5)) * pane;
    float open = clamp(0.5 + (min(to_edge.x, to_edge.y) - lead) / softness, 0.0, 1.0) *
                 clamp(0.5 - out_of_arch / softness, 0.0, 1.0);
    float row = clamp(floor(cell.y), 0.0, 8.0);
    float column = abs(floor(cell.x) + 0.5);
    float hue = 0.13 * column + 0.29 * row;
    vec3 glass = 0.52 + 0.48 * cos(6.2832 * (hue + vec3(0.0, 0.36, 0.64)));
    return glass * glass * sqrt(glass) * (open * exp2(row));
}
// end excerpt

// Stone with joints: courses of blocks on walls, square tiles on the floor. A little lighter or darker from block to block.
float stone(vec3 p, vec3 normal, float softness) {
    vec2 place = abs(normal.y) > 0.5 ? p.xz : vec2(abs(normal.x) > 0.5 ? p.z : p.x, p.y);
    vec2 block = abs(normal.y) > 0.5 ? vec2(0.75, 0.75) : vec2(0.9, 0.45);
    vec2 cell = place / block;
    if (abs(normal.y) < 0.5) cell.x += 0.5 * mod(floor(cell.y), 2.0);
    vec2 to_joint = (0.5 - abs(fract(cell) - 0.5)) * block;
    float joint = clamp(0.5 + (min(to_joint.x, to_joint.y) - 0.012) / softness, 0.0, 1.0);
    float shade = fract(dot(floor(cell), vec2(0.37, 0.61)));
    return (0.75 + 0.25 * shade) * mix(0.35, 1.0, mix(joint, 0.95, clamp(softness * 12.0, 0.0, 1.0)));
}

vec3 lit(vec3 p, vec3 normal, vec3 albedo) {
    // Light that has bounced about the hall: more near the window, less in corners.
    float corner = (normal.y > 0.5 ? 1.0 : smoothstep(-0.1, 0.7, p.y)) *
                   (abs(normal.x) > 0.5 ? 1.0 : smoothstep(-0.1, 0.8, 3.0 - abs(p.x)));
    vec3 light = vec3(0.008, 0.010, 0.015) * (0.3 + 0.7 * corner) * (1.0 + 14.0 * exp(-0.5 * p.z));
    // The window as a whole, from its middle.
    vec3 to_window = vec3(0.0, 3.0, 0.0) - p;
    float square = dot(to_window, to_window) + 1.5;
    vec3 direction = to_window * inversesqrt(square);
    light += vec3(1.0, 0.86, 0.72) * (9.0 * max(dot(normal, direction), 0.0) * max(-direction.z, 0.0) / square);
    for (int i = 0; i < LAMPS; ++i) {
        vec3 to_lamp = lamp_position[i] - p;
        float distance2 = dot(to_lamp, to_lamp) + 0.02;
        light += lamp_color[i] * (max(dot(normal, to_lamp) * inversesqrt(distance2) + 0.1, 0.0) / distance2);
    }
    return light * albedo;
}

void main() {
    vec3 from_camera = world_position - camera_position;
    float way = length(from_camera);
    float pixel = pixel_angle * way; // the width of a pixel here, for surfaces that face the camera
    if (glow > 0.0) {
        hdr_color = vec4(color * (glow * brightness), 1.0);
        return;
    }
    float slant = max(abs(dot(world_normal, from_camera)) / way, 0.05);
    vec3 albedo = color * stone(world_position, world_normal, pixel / slant);
    vec3 light = lit(world_position, world_normal, albedo);
    // The window itself, on the end wall; elsewhere the sun through it.
    bool end_wall = world_normal.z > 0.5 && world_position.z < 0.01;
    float to_window = world_position.z / -to_sun.z;
    light += windowLight(world_position.xy + to_sun.xy * to_window, 0.012 * to_window + pixel / (end_wall ? 1.0 : slant)) *
             (end_wall ? vec3(1.0) : albedo * (0.35 * max(dot(world_normal, to_sun), 0.0)));
    bool floor_stone = world_normal.y > 0.5 && world_position.y < 0.01;
    if (floor_stone) { // polished: it mirrors the window, the more so the flatter one looks (Schlick 1994)
        vec3 mirrored = from_camera * (vec3(1.0, -1.0, 1.0) / way);
        float fresnel = 0.04 + 0.96 * pow(1.0 - mirrored.y, 5.0);
        float onward = world_position.z / max(-mirrored.z, 1e-3);
        if (mirrored.z < 0.0)
            light += windowLight(world_position.xy + mirrored.xy * onward, pixel_angle * (way + onward) + 0.012 * onward) *
                     fresnel * 0.5;
    }
    hdr_color = vec4(light * brightness, 1.0);
}
