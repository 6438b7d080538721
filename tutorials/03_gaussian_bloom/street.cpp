// Building the street from boxes.
#include "street.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string_view>

namespace gll::gaussian_bloom {
namespace {

constexpr float pi = 3.14159265358979F;
constexpr float wall_x = 6.5F; // the houses' fronts
constexpr float street_end = -46;

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 albedo;
    glm::vec3 emission;
    float pulses;
};

struct Material {
    glm::vec3 albedo{0};
    glm::vec3 emission{0};
    float pulses = 0;
};

float luminance(glm::vec3 color) { return glm::dot(color, glm::vec3(0.2126F, 0.7152F, 0.0722F)); }

Material paint(glm::vec3 albedo) { return {.albedo = albedo}; }
// Light of a colour's hue and of this luminance.
Material light(glm::vec3 color, float to_luminance) {
    return {.emission = color * (to_luminance / luminance(color))};
}

const Material iron = paint({0.05F, 0.05F, 0.055F});
const glm::vec3 lamp_color(1, 0.66F, 0.34F);
const glm::vec3 pink(1, 0.12F, 0.32F);
const glm::vec3 cyan(0.08F, 0.85F, 1);
const glm::vec3 blue(0.01F, 0.08F, 1);
const glm::vec3 amber(1, 0.45F, 0.08F);

// One number from 0 to 1 for each whole number, without a pattern (PCG, O'Neill 2014).
float random(std::uint32_t n) {
    n = n * 747796405U + 2891336453U;
    n = ((n >> ((n >> 28) + 4)) ^ n) * 277803737U;
    return static_cast<float>((n >> 22) ^ n) / 4294967296.0F;
}

class Builder {
  public:
    // A parallelogram round a centre and its mirror image; right x up points to where it is seen from.
    void quad(glm::vec3 center, glm::vec3 right, glm::vec3 up, const Material& material) {
        gradient(center, right, up, material, material.emission, material.emission);
    }

    // As above, with one emission at its lower edge and another at its upper.
    void gradient(glm::vec3 center, glm::vec3 right, glm::vec3 up, const Material& material, glm::vec3 lower,
                  glm::vec3 upper) {
        const glm::vec3 normal = glm::normalize(glm::cross(right, up));
        const std::array corners = {center - right - up, center + right - up, center + right + up,
                                    center - right + up};
        for (const float side : {1.0F, -1.0F}) {
            const auto first = static_cast<std::uint32_t>(vertices.size());
            for (std::size_t i = 0; i < corners.size(); ++i)
                vertices.push_back({corners[i] * glm::vec3(1, side, 1), normal, material.albedo,
                                    i < 2 ? lower : upper, material.pulses});
            for (const std::uint32_t i : {0U, 1U, 2U, 2U, 3U, 0U}) // mirroring turns faces round
                indices.push_back(first + (side > 0 ? i : 3 - i));
        }
    }

    // Half its edges as vectors, right-handed.
    void box(glm::vec3 center, glm::vec3 x, glm::vec3 y, glm::vec3 z, const Material& material) {
        quad(center + z, x, y, material);
        quad(center - z, -x, y, material);
        quad(center + x, -z, y, material);
        quad(center - x, z, y, material);
        quad(center + y, x, -z, material);
        quad(center - y, x, z, material);
    }
    void box(glm::vec3 center, glm::vec3 half, const Material& material) {
        box(center, {half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}, material);
    }

    // From one point to another, as thick as it is deep.
    void bar(glm::vec3 from, glm::vec3 to, float half_thickness, const Material& material) {
        const glm::vec3 along = 0.5F * (to - from);
        const glm::vec3 z(0, 0, half_thickness);
        box(0.5F * (from + to), along, half_thickness * glm::normalize(glm::cross(z, along)), z, material);
    }

    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
};

// Letters of three columns and five rows, the top row first, the left column the highest bit.
std::array<int, 5> glyph(char letter) {
    switch (letter) {
    case 'A':
        return {2, 5, 7, 5, 5};
    case 'B':
        return {6, 5, 6, 5, 6};
    case 'C':
        return {3, 4, 4, 4, 3};
    case 'D':
        return {6, 5, 5, 5, 6};
    case 'E':
        return {7, 4, 6, 4, 7};
    case 'F':
        return {7, 4, 6, 4, 4};
    case 'H':
        return {5, 5, 7, 5, 5};
    case 'L':
        return {4, 4, 4, 4, 7};
    case 'M':
        return {5, 7, 7, 5, 5};
    case 'O':
        return {2, 5, 5, 5, 2};
    case 'R':
        return {6, 5, 6, 5, 5};
    default:
        return {};
    }
}

// Letters one below the other on a dark board that faces the camera; top is the middle of its upper edge.
void appendSign(Builder& street, std::string_view word, glm::vec3 top, float block,
                const Material& material) {
    const float height = block * (6 * static_cast<float>(word.size()) + 1);
    street.box(top - glm::vec3(0, 0.5F * height, 0.12F), {2.5F * block, 0.5F * height, 0.1F},
               paint({0.03F, 0.03F, 0.035F}));
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::array<int, 5> rows = glyph(word[i]);
        for (int row = 0; row < 5; ++row)
            for (int column = 0; column < 3; ++column) {
                if ((rows[static_cast<std::size_t>(row)] >> (2 - column) & 1) == 0) continue;
                const glm::vec3 place(static_cast<float>(column - 1) * block,
                                      -block * (6 * static_cast<float>(i) + static_cast<float>(row) + 1.5F),
                                      0);
                street.box(top + place, glm::vec3(0.5F * block, 0.5F * block, 0.05F), material);
            }
    }
}

// side is -1 on the left and 1 on the right of the street; shop is the colour of the light in its shop
// window.
const glm::vec3 dark(0);
void appendHouse(Builder& street, float side, float front_z, float length, float height, glm::vec3 albedo,
                 glm::vec3 shop, std::uint32_t seed) {
    const float middle_z = front_z - 0.5F * length;
    street.box({side * (wall_x + 4), 0.5F * height, middle_z}, {4, 0.5F * height, 0.5F * length},
               paint(albedo));
    street.box({side * (wall_x - 0.1F), height - 0.2F, middle_z}, {0.25F, 0.2F, 0.5F * length},
               paint(albedo * 0.8F)); // the cornice
    const float x = side * (wall_x - 0.02F);
    const glm::vec3 up(0, 0.75F, 0);
    const int columns = static_cast<int>(length / 2.2F);
    for (int floor = 0; 3.2F + static_cast<float>(floor) * 2.9F < height - 2; ++floor)
        for (int column = 0; column < columns; ++column) {
            const auto n = seed * 100 + static_cast<std::uint32_t>(floor * 10 + column);
            const float y = 4.4F + static_cast<float>(floor) * 2.9F;
            const float z =
                front_z - length * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
            // Lit windows stay below the threshold of 1: they are bright, and do not bloom.
            const Material glass = random(n) < 0.4F ? light({1, 0.7F, 0.38F}, 0.12F + 0.6F * random(n + 5000))
                                                    : paint({0.012F, 0.014F, 0.02F});
            street.quad({x, y, z}, {0, 0, side * 0.55F}, up, glass);
        }
    // A shop window along the ground floor, as bright as paper.
    street.quad({x, 1.5F, middle_z}, {0, 0, side * (0.5F * length - 0.8F)}, {0, 0.95F, 0},
                shop == dark ? paint({0.015F, 0.017F, 0.022F}) : light(shop, 0.75F));
    street.box({side * (wall_x - 0.45F), 2.75F, middle_z}, {0.45F, 0.08F, 0.5F * length - 0.6F},
               paint(albedo * glm::vec3(1, 0.5F, 0.5F)));
}

constexpr float lamp_height = 5.2F;
constexpr std::array lamp_z = {0.5F, -9.0F, -18.5F, -28.0F};
glm::vec3 lampAt(std::size_t i) { return {i % 2 == 0 ? 3.2F : -3.2F, lamp_height, lamp_z[i]}; }

void appendLamp(Builder& street, std::size_t i) {
    const glm::vec3 head = lampAt(i);
    const float pole_x = head.x > 0 ? 4.6F : -4.6F;
    street.box({pole_x, 0.5F * lamp_height, head.z}, {0.07F, 0.5F * lamp_height, 0.07F}, iron);
    street.bar({std::min(pole_x, head.x), head.y + 0.1F, head.z},
               {std::max(pole_x, head.x), head.y + 0.1F, head.z}, 0.05F, iron);
    street.box(head + glm::vec3(0, 0.08F, 0), {0.42F, 0.07F, 0.2F}, iron);
    street.box(head - glm::vec3(0, 0.06F, 0), {0.36F, 0.07F, 0.16F}, light(lamp_color, 40));
}

// Nine lanterns of rising luminance, the first three below the threshold of 1.
void appendLanterns(Builder& street) {
    constexpr std::array luminances = {0.25F, 0.5F, 0.85F, 1.4F, 2.5F, 5.0F, 10.0F, 20.0F, 40.0F};
    const auto wireAt = [](float along) { // -1 to 1
        return glm::vec3(along * wall_x, 4.2F + 1.1F * along * along, -3.5F);
    };
    for (std::size_t i = 0; i < luminances.size(); ++i) {
        const float along = (static_cast<float>(i) - 4) / 5;
        const glm::vec3 top = wireAt(along);
        constexpr int sides = 8;
        for (int side = 0; side < sides; ++side) {
            const float angle_rad = 2 * pi * (static_cast<float>(side) + 0.5F) / sides;
            const glm::vec3 out(std::sin(angle_rad), 0, std::cos(angle_rad));
            const glm::vec3 right = 0.23F * std::tan(pi / sides) * glm::vec3(out.z, 0, -out.x);
            street.quad(top + 0.23F * out - glm::vec3(0, 0.42F, 0), right, {0, 0.24F, 0},
                        light({1, 0.58F, 0.25F}, luminances[i]));
        }
        for (const float y : {-0.15F, -0.69F})
            street.box(top + glm::vec3(0, y, 0), {0.17F, 0.035F, 0.17F}, iron);
        street.box(top - glm::vec3(0, 0.05F, 0), {0.025F, 0.08F, 0.025F}, iron);
    }
    constexpr int pieces = 10;
    for (int i = 0; i < pieces; ++i)
        street.bar(wireAt(2.0F * static_cast<float>(i) / pieces - 1),
                   wireAt(2.0F * static_cast<float>(i + 1) / pieces - 1), 0.025F, iron);
}

// Its tail lights face the camera.
void appendCar(Builder& street, float x, float z, glm::vec3 albedo) {
    street.box({x, 0.62F, z}, {0.85F, 0.34F, 2.0F}, paint(albedo));
    street.box({x, 1.16F, z - 0.1F}, {0.7F, 0.26F, 1.05F}, paint({0.02F, 0.02F, 0.025F}));
    for (const float side : {-1.0F, 1.0F}) {
        street.box({x + side * 0.6F, 0.72F, z + 2.0F}, {0.17F, 0.07F, 0.03F}, light({1, 0.04F, 0.03F}, 3));
        for (const float along : {-1.2F, 1.2F})
            street.box({x + side * 0.78F, 0.3F, z + along}, {0.1F, 0.3F, 0.3F}, paint({0.01F, 0.01F, 0.01F}));
    }
}

// A ring of straight pieces on the house that closes the street.
const glm::vec3 ring_center(0, 6.4F, street_end + 0.3F);
void appendRing(Builder& street) {
    constexpr int pieces = 24;
    constexpr float radius = 3;
    Material material = light(amber, 4);
    material.pulses = 1;
    for (int i = 0; i < pieces; ++i) {
        const float angle_rad = 2 * pi * static_cast<float>(i) / pieces;
        const glm::vec3 out(std::cos(angle_rad), std::sin(angle_rad), 0);
        const glm::vec3 along(-out.y, out.x, 0);
        street.box(ring_center + radius * out, 0.18F * out, radius * std::tan(pi / pieces) * along,
                   {0, 0, 0.1F}, material);
    }
}

void appendPavementAndSky(Builder& street) {
    for (const float side : {-1.0F, 1.0F})
        street.box({side * 5.6F, 0.08F, -20}, {0.9F, 0.08F, 32},
                   paint({0.11F, 0.11F, 0.12F})); // the pavement
    constexpr float far = 70;
    constexpr float height = 60;
    const glm::vec3 low(0.010F, 0.012F, 0.024F);
    const glm::vec3 high(0.002F, 0.003F, 0.009F);
    for (const glm::vec3 out :
         {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0)})
        street.gradient(far * out + glm::vec3(0, 0.5F * height, 0), far * glm::vec3(-out.z, 0, out.x),
                        {0, 0.5F * height, 0}, {}, low, high);
    street.quad({0, height, 0}, {far, 0, 0}, {0, 0, far}, {.emission = high});
}

} // namespace

Mesh makeStreet() {
    const glm::vec3 brick(0.20F, 0.11F, 0.09F);
    const glm::vec3 plaster(0.24F, 0.21F, 0.17F);
    const glm::vec3 slate(0.12F, 0.14F, 0.18F);
    Builder street; // roughly from near to far, so that little is shaded that is hidden later
    appendLanterns(street);
    for (std::size_t i = 0; i < lamp_z.size(); ++i)
        appendLamp(street, i);
    appendSign(street, "BLOOM", {-5.5F, 10.7F, -8}, 0.17F, light(pink, 6));
    appendSign(street, "HDR", {5.3F, 11.9F, -13}, 0.28F, light(cyan, 9));
    // As bright as the others in watts, but blue counts little in luminance: 0.5 stays below the threshold.
    appendSign(street, "CAFE", {5.3F, 4.0F, -4.5F}, 0.13F, light(blue, 0.5F));
    appendCar(street, -3.6F, -6, {0.12F, 0.03F, 0.03F});
    appendCar(street, 3.5F, -15, {0.05F, 0.07F, 0.1F});
    const glm::vec3 warm(1, 0.85F, 0.6F);
    const glm::vec3 cold(0.65F, 0.9F, 1);
    appendHouse(street, -1, 8, 9, 13, brick, warm, 1);
    appendHouse(street, 1, 8, 11, 10, slate, dark, 5);
    appendHouse(street, -1, -1, 10, 9.5F, plaster, dark, 2);
    appendHouse(street, 1, -3, 9, 14, plaster, cold, 6);
    appendHouse(street, -1, -11, 11, 15, slate, warm, 3);
    appendHouse(street, 1, -12, 12, 10, brick, dark, 7);
    appendHouse(street, -1, -22, 24, 11, brick, dark, 4);
    appendHouse(street, 1, -24, 22, 16, slate, cold, 8);
    appendRing(street);
    street.box({0, 7, street_end - 3}, {20, 7, 3}, paint(plaster));
    appendPavementAndSky(street);
    return Mesh({.vertices = std::as_bytes(std::span(street.vertices)),
                 .vertex_stride_bytes = sizeof(Vertex),
                 .attributes = {{0, 3, offsetof(Vertex, position)},
                                {1, 3, offsetof(Vertex, normal)},
                                {2, 3, offsetof(Vertex, albedo)},
                                {3, 3, offsetof(Vertex, emission)},
                                {4, 1, offsetof(Vertex, pulses)}},
                 .indices = street.indices});
}

float pulseAt(float time_s) { return 0.8F + 0.65F * std::cos(2 * pi * (time_s - 1) / 5); }

StreetLights streetLightsAt(float time_s) {
    StreetLights lights;
    const auto add = [&](glm::vec3 position, glm::vec3 color, float intensity) {
        lights.positions.push_back(position);
        lights.colors.push_back(color * intensity);
    };
    for (std::size_t i = 0; i < 3; ++i) // the fourth is far away
        add(lampAt(i) - glm::vec3(0, 0.2F, 0), lamp_color, 16);
    add({-5.0F, 8.0F, -7}, pink, 9);
    add({4.8F, 9.2F, -12}, cyan, 10);
    add({4.9F, 2.4F, -3.7F}, blue, 2.5F);
    add({3.5F, 4.6F, -3.4F}, lamp_color, 5); // the brightest lanterns
    add(ring_center + glm::vec3(0, 0, 2), amber, 14 * pulseAt(time_s));
    return lights;
}

} // namespace gll::gaussian_bloom
