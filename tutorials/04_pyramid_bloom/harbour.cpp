// Placing houses, bridge, lamps and signs, and their mirror images.
#include "04_pyramid_bloom/harbour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gll::pyramid_bloom {
namespace {

using glm::vec2;
using glm::vec3;

// A number in [0, 1) for each n: the finalizer of MurmurHash3 (Appleby), the same everywhere.
float hashed(std::uint32_t n) {
    n ^= n >> 16U;
    n *= 0x85ebca6bU;
    n ^= n >> 13U;
    n *= 0xc2b2ae35U;
    n ^= n >> 16U;
    return static_cast<float>(n >> 8U) / 16777216.0F;
}

// --- boxes ---

struct BoxVertex {
    vec3 corner;
    vec3 normal;
};

struct Box {
    vec3 centre;
    vec3 half_size;
    float windows = 0;
};

constexpr float floodlit = -1; // in place of windows

struct House {
    float x, width, height, z, depth;
};

std::vector<House> houses() {
    std::vector<House> all;
    std::uint32_t n = 1;
    for (int row = 0; row < 3; ++row) {
        const auto back = static_cast<float>(row);
        for (float x = -92 - 12 * back; x < 92 + 12 * back;) {
            const float width = 6 + 7 * hashed(n++);
            // Towers in the middle, low houses towards the ends.
            const float middle = std::exp(-(x * x) / (45 * 45));
            const float storeys = hashed(n++);
            const float height = 5 + 6 * storeys + (6 + 9 * back) * hashed(n++) * (0.3F + 1.4F * middle);
            all.push_back({x + width / 2, width, height, -92 - 22 * back, 12});
            x += width + (hashed(n++) < 0.25F ? 4.0F : 0.6F);
        }
    }
    return all;
}

// --- the bridge: its deck runs from the left, near, to the right, far ---

constexpr vec3 bridge_from(-54, 6.5F, -8);
constexpr vec3 bridge_to(34, 6.5F, -100);
constexpr std::array tower_places = {0.27F, 0.74F}; // along the deck
constexpr float tower_height = 24;

vec3 onDeck(float along) { return bridge_from + (bridge_to - bridge_from) * along; }

// Height of the main cable: a parabola from tower to tower, and half of one to either end.
float cableHeight(float along) {
    const float rise = along < tower_places[0]   ? along / tower_places[0]
                       : along > tower_places[1] ? (1 - along) / (1 - tower_places[1])
                                                 : (2 * along - tower_places[0] - tower_places[1]) /
                                                       (tower_places[1] - tower_places[0]);
    const float lowest = bridge_from.y + 1.5F;
    return lowest + (tower_height - lowest) * rise * rise;
}

// --- strokes ---

struct Stroke {
    vec3 a;
    vec3 b;
    vec3 color;
    float radius = 0.2F;
    float period_s = 0; // of its pulse; negative: of its travel, without a pulse
    float phase = 0;
    float is_streak = 0; // 0 or 1
    vec3 travel{0};
};

class Lights {
  public:
    std::vector<Stroke> all;

    // A lamp and the streak that rippled water draws of it, longer than the lamp is high.
    void lamp(Stroke stroke, bool over_water = true) {
        all.push_back(stroke);
        if (!over_water) return;
        const float height = std::max(stroke.a.y, stroke.b.y);
        Stroke streak = stroke;
        streak.a.y = -0.3F * std::min(stroke.a.y, stroke.b.y);
        streak.b.y = -2.1F * height;
        streak.radius = std::max(1.2F * stroke.radius, 0.12F);
        streak.color *= stroke.radius / streak.radius * stroke.radius / (0.15F * height + stroke.radius);
        streak.is_streak = 1;
        all.push_back(streak);
    }
    void lamp(vec3 place, vec3 color, float radius, bool over_water = true) {
        lamp(Stroke{.a = place, .b = place, .color = color, .radius = radius}, over_water);
    }
};

constexpr vec3 sodium(1.0F, 0.48F, 0.12F);
constexpr vec3 tungsten(1.0F, 0.72F, 0.38F);
constexpr vec3 mercury(0.62F, 0.92F, 1.0F);
constexpr vec3 red(1.0F, 0.07F, 0.04F);

void addBridgeLights(Lights& lights) {
    constexpr int bulbs = 88;
    for (int i = 0; i <= bulbs; ++i) {
        const float along = static_cast<float>(i) / bulbs;
        const vec3 deck = onDeck(along);
        lights.lamp({deck.x, cableHeight(along), deck.z}, 20.0F * tungsten, 0.13F, i % 4 == 0);
    }
    for (int i = 1; i < 24; ++i)
        lights.lamp(onDeck(static_cast<float>(i) / 24) + vec3(0, 1.7F, 0), 16.0F * sodium, 0.22F);
    // A line of light along the deck's edge, thinner than a pixel.
    lights.lamp({.a = bridge_from, .b = bridge_to, .color = vec3(0.3F, 0.75F, 1.0F) * 2.6F, .radius = 0.07F},
                false);
    for (const float along : tower_places) {
        const vec3 foot = onDeck(along);
        lights.lamp({.a = {foot.x, tower_height + 1, foot.z},
                     .b = {foot.x, tower_height + 1, foot.z},
                     .color = 60.0F * red,
                     .radius = 0.3F,
                     .period_s = 4,
                     .phase = 0.6F},
                    false);
    }
    constexpr int cars = 9;
    for (int i = 0; i < cars; ++i) {
        const float phase =
            (static_cast<float>(i) + 0.6F * hashed(500U + static_cast<std::uint32_t>(i))) / cars;
        const bool coming = i % 2 == 0;
        const vec3 start = (coming ? bridge_to : bridge_from) + vec3(0, 0.6F, coming ? 0.8F : -0.8F);
        lights.lamp({.a = start,
                     .b = start,
                     .color = coming ? 34.0F * vec3(1, 0.93F, 0.8F) : 14.0F * red,
                     .radius = 0.16F,
                     .period_s = -24,
                     .phase = phase,
                     .travel = coming ? bridge_from - bridge_to : bridge_to - bridge_from},
                    false);
    }
}

// Strokes of the letters on a grid of 2 by 4.
void addSign(Lights& lights, vec3 place, float unit) {
    struct Line {
        float x0, y0, x1, y1;
    };
    constexpr Line pier[] = {
        {0, 0, 0, 4},       {0, 4, 2, 4},       {2, 4, 2, 2},       {2, 2, 0, 2},       // P
        {3.4F, 0, 3.4F, 4},                                                             // I
        {4.8F, 0, 4.8F, 4}, {4.8F, 4, 6.6F, 4}, {4.8F, 2, 6.2F, 2}, {4.8F, 0, 6.6F, 0}, // E
        {8, 0, 8, 4},       {8, 4, 10, 4},      {10, 4, 10, 2},     {10, 2, 8, 2},
        {8.8F, 2, 10, 0}}; // R
    constexpr Line four[] = {{14.4F, 0, 14.4F, 4}, {14.4F, 4, 12.6F, 1.2F}, {12.6F, 1.2F, 15.2F, 1.2F}};
    const auto add = [&](const Line& line, vec3 color) {
        lights.lamp({.a = place + unit * vec3(line.x0, line.y0, 0),
                     .b = place + unit * vec3(line.x1, line.y1, 0),
                     .color = color,
                     .radius = 0.11F},
                    false);
    };
    for (const Line& line : pier)
        add(line, {9.0F, 0.55F, 3.2F});
    for (const Line& line : four)
        add(line, {0.7F, 6.0F, 7.5F});
}

void addStars(Lights& lights) {
    for (std::uint32_t i = 0; i < 90; ++i) {
        const float around = (hashed(3 * i + 9000) - 0.5F) * 1.9F;
        const float up = 0.10F + 0.55F * hashed(3 * i + 9001);
        const float faint = hashed(3 * i + 9002);
        lights.lamp(400.0F * glm::normalize(vec3(std::sin(around), up, -std::cos(around))),
                    (0.4F + 5.0F * faint * faint * faint * faint) * vec3(0.75F, 0.85F, 1.0F), 0.35F, false);
    }
}

} // namespace

Instances makeWalls() {
    std::vector<BoxVertex> vertices;
    std::vector<std::uint32_t> indices;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F}) {
            vec3 normal(0);
            vec3 right(0);
            vec3 up(0);
            normal[axis] = side;
            right[(axis + 1) % 3] = side;
            up[(axis + 2) % 3] = 1;
            const auto first = static_cast<std::uint32_t>(vertices.size());
            for (const vec2 c : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)})
                vertices.push_back({normal + c.x * right + c.y * up, normal});
            for (const std::uint32_t index : {0U, 1U, 2U, 2U, 3U, 0U})
                indices.push_back(first + index);
        }

    std::vector<Box> boxes;
    const auto add = [&](vec3 centre, vec3 size, float windows = 0) {
        boxes.push_back({centre, size * 0.5F, windows});
        boxes.push_back({{centre.x, -centre.y, centre.z}, size * 0.5F, windows});
    };
    float seed = 1;
    for (const House& house : houses())
        add({house.x, 1.4F + house.height / 2, house.z}, {house.width, house.height, house.depth}, seed++);
    add({29, 7.6F, -91.5F}, {20, 12.4F, 12}, seed); // below the sign
    add({0, 0.7F, -90}, {400, 1.4F, 24});           // the quay
    const float length = glm::length(bridge_to - bridge_from);
    constexpr int segments = 120; // of the deck, for boxes here lie along the axes
    for (int i = 0; i < segments; ++i) {
        const vec3 middle = onDeck((static_cast<float>(i) + 0.5F) / segments);
        add(middle - vec3(0, 0.5F, 0), {length / segments, 0.8F, 3.2F});
    }
    for (const float along : tower_places) {
        const vec3 foot = onDeck(along);
        for (const float side : {-1.3F, 1.3F})
            add({foot.x, tower_height / 2, foot.z + side}, {1.3F, tower_height, 0.9F}, floodlit);
        add({foot.x, tower_height - 2, foot.z}, {1.1F, 0.9F, 3}, floodlit);
    }
    // The rock, and the lighthouse on it.
    add({25, 0.6F, -22}, {9, 1.2F, 6});
    add({25, 1.5F, -22}, {5.5F, 1.4F, 4});
    add({25, 6.5F, -22}, {1.2F, 9, 1.2F}, floodlit);
    add({25, 10.9F, -22}, {2, 0.25F, 2});
    add({25, 13.1F, -22}, {1.3F, 0.5F, 1.3F});

    return {Mesh({.vertices = std::as_bytes(std::span(vertices)),
                  .vertex_stride_bytes = sizeof(BoxVertex),
                  .attributes = {{0, 3, offsetof(BoxVertex, corner)}, {1, 3, offsetof(BoxVertex, normal)}},
                  .indices = indices,
                  .instances = std::as_bytes(std::span(boxes)),
                  .instance_stride_bytes = sizeof(Box),
                  .instance_attributes = {{2, 3, offsetof(Box, centre)},
                                          {3, 3, offsetof(Box, half_size)},
                                          {4, 1, offsetof(Box, windows)}}}),
            static_cast<int>(boxes.size())};
}

Instances makeLamps() {
    Lights lights;
    addStars(lights);
    addBridgeLights(lights);
    for (int i = 0; i < 44; ++i) // along the quay
        lights.lamp({-105 + 4.9F * static_cast<float>(i), 3.4F, -77.5F},
                    (i % 5 == 3 ? 11.0F : 8.0F) * (i % 5 == 3 ? mercury : sodium), 0.24F);
    addSign(lights, {20.5F, 14.2F, -85.4F}, 1.1F);
    // The lighthouse: a small lamp, far brighter than anything else.
    lights.lamp({.a = {25, 11.7F, -20.8F},
                 .b = {25, 12.2F, -20.8F},
                 .color = vec3(1.0F, 0.9F, 0.7F) * 60.0F,
                 .radius = 0.34F,
                 .period_s = 8,
                 .phase = 0.875F});

    // Strokes write depth: the farthest first, along the way that the camera looks, then none hides another's
    // light.
    const auto distance = [](const Stroke& stroke) { return 0.02F * stroke.a.y - stroke.a.z; };
    std::stable_sort(lights.all.begin(), lights.all.end(),
                     [&](const Stroke& one, const Stroke& other) { return distance(one) > distance(other); });
    const std::array<vec2, 4> corners = {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)};
    const std::array<std::uint32_t, 6> indices = {0, 1, 2, 2, 3, 0};
    return {Mesh({.vertices = std::as_bytes(std::span(corners)),
                  .vertex_stride_bytes = sizeof(vec2),
                  .attributes = {{0, 2, 0}},
                  .indices = indices,
                  .instances = std::as_bytes(std::span(lights.all)),
                  .instance_stride_bytes = sizeof(Stroke),
                  .instance_attributes = {{1, 3, offsetof(Stroke, a)},
                                          {2, 3, offsetof(Stroke, b)},
                                          {3, 3, offsetof(Stroke, color)},
                                          {4, 4, offsetof(Stroke, radius)},
                                          {5, 3, offsetof(Stroke, travel)}}}),
            static_cast<int>(lights.all.size())};
}

Mesh makeSquare() {
    const std::array<vec2, 4> corners = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)};
    const std::array<std::uint32_t, 6> indices = {0, 1, 2, 2, 3, 0};
    return Mesh({.vertices = std::as_bytes(std::span(corners)),
                 .vertex_stride_bytes = sizeof(vec2),
                 .attributes = {{0, 2, 0}},
                 .indices = indices});
}

} // namespace gll::pyramid_bloom
