#version 330 core
// Light in court and hall: the sun through the arches, the sky, what both of them throw back, and two lamps. The sun's
// shadows are computed from the building's shape, so that they need no map and have no jagged edge.

in vec3 world_position; // metres
in vec3 world_normal;
flat in vec3 base_color;
flat in int surface_kind; // SURFACE_*

uniform vec3 camera_position; // world
uniform float light;          // factor on all light

out vec4 hdr_color; // linear, [0, infinity)

const int SURFACE_PLAIN = 0;
const int SURFACE_STONE = 1;
const int SURFACE_TILES = 2;
const int SURFACE_LIGHT = 3;
const int SURFACE_SKY = 4;

// The building, as in scene.cpp.
const float half_length = 14.0;
const float bay = 4.0;
const float arch_radius = 1.25;
const float arch_spring = 2.3;
const float wall_depth = 0.8;
const float wall_height = 5.2;
const float court_end = 20.0;
const float garden_wall_height = 2.4;
const float cornice = 4.95; // its lower edge
const float cornice_depth = 0.35;
const float hall_end = -9.8;
const float ceiling_height = 4.6;
const vec3 trees[4] = vec3[](vec3(-4.5, 2.3, 5.0), vec3(4.5, 2.3, 5.0), vec3(-4.5, 2.3, 12.0), vec3(4.5, 2.3, 12.0));
const float crown_radius = 0.95;
const vec3 lamps[2] = vec3[](vec3(-9.0, 2.55, -5.4), vec3(9.0, 2.55, -5.4));

const vec3 to_sun = vec3(0.330, 0.472, 0.817); // normalised: 28 degrees high
const vec3 sun_irradiance = vec3(1.50, 1.22, 0.86);
const vec3 sky_irradiance = vec3(0.16, 0.22, 0.34);
const vec3 bounce_irradiance = vec3(0.24, 0.18, 0.11); // from sunlit stone
const vec3 lamp_intensity = vec3(0.150, 0.085, 0.032);

// How far a point of the arcade's plane lies outside of an opening; negative inside.
float outsideArch(vec2 p) {
    p.x -= bay * clamp(round(p.x / bay), -3.0, 3.0);
    return p.y < arch_spring ? abs(p.x) - arch_radius : length(p - vec2(0.0, arch_spring)) - arch_radius;
}

// 1 where the distance is well above 0, 0 well below; soft in proportion to how far the edge is that casts the shadow.
float lit(float distance, float away) {
    float blur = 0.006 + 0.012 * away;
    return smoothstep(-blur, blur, distance);
}

float throughArch(vec3 p, float plane_z) {
    float away = (plane_z - p.z) / to_sun.z;
    return lit(-outsideArch(p.xy + to_sun.xy * away), away);
}

float sunVisibility(vec3 p) {
    if (p.z < -0.001) {
        float visible = throughArch(p, 0.0);
        return p.z < -wall_depth - 0.001 ? visible * throughArch(p, -wall_depth) : visible;
    }
    float to_side = (half_length - p.x) / to_sun.x;
    float visible = lit(p.y + to_sun.y * to_side - wall_height, to_side);
    float to_garden = (court_end - p.z) / to_sun.z;
    visible *= p.z > court_end ? 1.0 : lit(p.y + to_sun.y * to_garden - garden_wall_height, to_garden);
    if (p.y < cornice && p.z < cornice_depth) {
        float to_edge = (cornice_depth - p.z) / to_sun.z;
        visible *= lit(cornice - p.y - to_sun.y * to_edge, to_edge);
    }
    for (int i = 0; i < 4; ++i) {
        vec3 to_tree = trees[i] - p;
        float along = dot(to_tree, to_sun);
        if (along > 0.0) visible *= lit(length(to_tree - along * to_sun) - crown_radius, along);
    }
    return visible;
}

// Light from everywhere but the sun and lamps: outside the sky and the sunlit ground; inside what comes through the
// arches, less the deeper one stands, and what the sunlit strip of the floor throws up. Shapes chosen by eye.
vec3 ambient(vec3 p, vec3 n) {
    vec3 outside = sky_irradiance * (0.6 + 0.4 * n.y) + bounce_irradiance * (0.55 - 0.45 * n.y);
    outside *= 1.0 - 0.35 * exp(-max(p.z, 0.0) * 1.3) * max(n.y, 0.0);
    outside *= 1.0 - 0.30 * exp(-max(p.y, 0.0) * 1.6) * (1.0 - abs(n.y));
    float depth = max(-p.z - wall_depth, 0.0);
    float from_arches = (0.12 + 0.88 * max(n.z, 0.0) + 0.25 * max(n.y, 0.0)) / (1.0 + 0.45 * depth * depth);
    float strip = exp(-0.12 * (depth - 2.0) * (depth - 2.0));
    float from_strip = strip * (0.15 + 0.85 * max(-n.y, 0.0)) + 0.10 * (0.5 - 0.5 * n.y);
    vec3 inside = 0.55 * (sky_irradiance + bounce_irradiance) * from_arches + 0.60 * bounce_irradiance * from_strip;
    float corner = min(min(p.y, ceiling_height - p.y) + abs(n.y), min(p.z - hall_end, half_length - abs(p.x)) + 0.4);
    inside *= 0.45 + 0.55 * smoothstep(0.0, 1.6, corner);
    return mix(inside, outside, smoothstep(-wall_depth, 0.0, p.z));
}

vec3 lampLight(vec3 p, vec3 n) {
    if (p.z > -wall_depth + 0.01) return vec3(0.0); // the wall is in the way
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        vec3 to_lamp = lamps[i] - p;
        float squared = dot(to_lamp, to_lamp) + 0.02;
        sum += lamp_intensity * max(dot(n, to_lamp), 0.0) * inversesqrt(squared) / squared;
    }
    return sum;
}

// A whole number for a place in a grid, scattered over [0, 1].
float scattered(ivec2 cell) {
    uint h = uint(cell.x) * 0x9E3779B1u ^ uint(cell.y) * 0x85EBCA77u;
    h = (h ^ (h >> 15)) * 0xC2B2AE3Du;
    return float((h >> 8) & 0xFFFFu) / 65535.0;
}

// Blocks or tiles: each with a tone of its own, and joints that fade before they are too thin to draw.
vec3 laid(vec3 albedo, vec2 place, vec2 size, float shift, float tones) {
    vec2 cell = place / size;
    cell.x += shift * mod(floor(cell.y), 2.0);
    vec2 width = fwidth(place);
    vec2 edge = (0.5 - abs(fract(cell) - 0.5)) * size; // metres to the nearest joint
    vec2 joint = (1.0 - smoothstep(vec2(0.012), 0.012 + 1.5 * width, edge)) * clamp(0.02 / width, 0.0, 1.0);
    float detail = clamp(0.35 * min(size.x, size.y) / max(width.x, width.y), 0.0, 1.0);
    float tone = 1.0 + detail * tones * (scattered(ivec2(floor(cell))) - 0.5);
    return albedo * tone * (1.0 - 0.35 * max(joint.x, joint.y));
}

vec3 albedo() {
    if (surface_kind == SURFACE_TILES) return laid(base_color, world_position.xz, vec2(1.0), 0.0, 0.22);
    if (surface_kind == SURFACE_STONE) {
        float along = abs(world_normal.x) > 0.5 ? world_position.z : world_position.x;
        return laid(base_color, vec2(along, world_position.y), vec2(0.9, 0.45), 0.5, 0.18);
    }
    return base_color;
}

vec3 skyRadiance(vec3 direction) {
    float height = clamp(direction.y, 0.0, 1.0);
    return mix(vec3(0.52, 0.60, 0.70), vec3(0.12, 0.25, 0.55), sqrt(height));
}

void main() {
    vec3 radiance;
    if (surface_kind == SURFACE_SKY) {
        radiance = skyRadiance(normalize(world_position - camera_position));
    } else if (surface_kind == SURFACE_LIGHT) {
        radiance = base_color;
    } else {
        vec3 n = normalize(world_normal);
        float sun = max(dot(n, to_sun), 0.0);
        if (sun > 0.0) sun *= sunVisibility(world_position);
        vec3 irradiance = sun_irradiance * sun + ambient(world_position, n) + lampLight(world_position, n);
        radiance = albedo() * irradiance;
    }
    hdr_color = vec4(light * radiance, 1.0);
}
