// Building court and hall, and the way through them.
#include "scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace gll::auto_exposure {
namespace {

constexpr float pi = 3.14159265358979F;

// The same as in shaders/02_auto_exposure/scene.frag, which casts the sun through the arches.
constexpr float half_length = 14; // along x
constexpr float bay = 4;          // from arch to arch
constexpr float arch_radius = 1.25F;
constexpr float arch_spring = 2.3F; // height at which the arch begins to curve
constexpr float wall_depth = 0.8F;
constexpr float wall_height = 5.2F;
constexpr float court_end = 20; // z
constexpr float garden_wall_height = 2.4F;
constexpr float hall_end = -9.8F; // z
constexpr float ceiling_height = 4.6F;
constexpr glm::vec3 trees[] = {{-4.5F, 2.3F, 5}, {4.5F, 2.3F, 5}, {-4.5F, 2.3F, 12}, {4.5F, 2.3F, 12}};
constexpr float crown_radius = 0.95F;

enum class Surface { plain, stone, tiles, light, sky }; // SURFACE_ in the shader

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 albedo;
    float surface;
};

struct Material {
    glm::vec3 albedo; // linear; of lights what they emit
    Surface surface = Surface::plain;
};

constexpr Material wall_stone = {{0.62F, 0.52F, 0.40F}, Surface::stone};
constexpr Material arch_stone = {{0.66F, 0.58F, 0.47F}};
constexpr Material court_tiles = {{0.56F, 0.48F, 0.38F}, Surface::tiles};
constexpr Material hall_tiles = {{0.44F, 0.33F, 0.25F}, Surface::tiles};
constexpr Material plaster = {{0.60F, 0.55F, 0.47F}};
constexpr Material wood = {{0.26F, 0.16F, 0.09F}};
constexpr Material leaves = {{0.10F, 0.20F, 0.05F}};
constexpr Material lamp = {{9.0F, 5.4F, 2.2F}, Surface::light};
constexpr Material sky = {{1, 1, 1}, Surface::sky};

class Builder {
  public:
    // Corners in order round the quad; it faces where its normals point, whichever way round they go.
    void quad(const std::array<glm::vec3, 4>& corners, const std::array<glm::vec3, 4>& normals,
              const Material& material) {
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (std::size_t i = 0; i < 4; ++i)
            vertices_.push_back(
                {corners[i], normals[i], material.albedo, static_cast<float>(material.surface)});
        const glm::vec3 facing = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
        const bool counter_clockwise = glm::dot(facing, normals[0] + normals[2]) > 0;
        for (const std::uint32_t index :
             counter_clockwise ? std::array{0U, 1U, 2U, 2U, 3U, 0U} : std::array{0U, 2U, 1U, 2U, 0U, 3U})
            indices_.push_back(first + index);
    }

    void quad(const std::array<glm::vec3, 4>& corners, glm::vec3 normal, const Material& material) {
        quad(corners, {normal, normal, normal, normal}, material);
    }

    // A rectangle from one corner along two edges.
    void rectangle(glm::vec3 corner, glm::vec3 edge, glm::vec3 other_edge, glm::vec3 normal,
                   const Material& material) {
        quad({corner, corner + edge, corner + edge + other_edge, corner + other_edge}, normal, material);
    }

    // outward -1: seen from inside.
    void box(glm::vec3 low, glm::vec3 high, const Material& material, float outward = 1) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 edge(0);
            glm::vec3 other_edge(0);
            edge[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
            other_edge[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
            for (const float side : {-1.0F, 1.0F}) {
                glm::vec3 corner = low;
                glm::vec3 normal(0);
                normal[axis] = side * outward;
                if (side > 0) corner[axis] = high[axis];
                rectangle(corner, edge, other_edge, normal, material);
            }
        }
    }

    // A surface of revolution about the vertical through base: radius and height along the profile.
    void revolved(glm::vec3 base, const std::vector<glm::vec2>& profile, const Material& material) {
        constexpr int steps = 20;
        const auto direction = [](int i) {
            const float turn_rad = 2 * pi * static_cast<float>(i) / steps;
            return glm::vec3(std::cos(turn_rad), 0, std::sin(turn_rad));
        };
        const auto point = [&](int i, glm::vec2 at) {
            return base + at.x * direction(i) + glm::vec3(0, at.y, 0);
        };
        // Normals stand across the profile, averaged over the two segments that meet.
        const auto normal = [&](int i, std::size_t k) {
            const glm::vec2 along =
                profile[std::min(k + 1, profile.size() - 1)] - profile[k == 0 ? 0 : k - 1];
            return glm::normalize(along.y * direction(i) - glm::vec3(0, along.x, 0));
        };
        for (std::size_t k = 0; k + 1 < profile.size(); ++k)
            for (int i = 0; i < steps; ++i)
                quad({point(i, profile[k]), point(i + 1, profile[k]), point(i + 1, profile[k + 1]),
                      point(i, profile[k + 1])},
                     {normal(i, k), normal(i + 1, k), normal(i + 1, k + 1), normal(i, k + 1)}, material);
    }

    void sphere(glm::vec3 center, float radius, const Material& material) {
        constexpr int rings = 12;
        std::vector<glm::vec2> profile;
        for (int i = 0; i <= rings; ++i) {
            const float angle_rad = pi * static_cast<float>(i) / rings;
            profile.emplace_back(radius * std::sin(angle_rad), -radius * std::cos(angle_rad));
        }
        revolved(center, profile, material);
    }

    Mesh mesh() const {
        return Mesh({.vertices = std::as_bytes(std::span(vertices_)),
                     .vertex_stride_bytes = sizeof(Vertex),
                     .attributes = {{0, 3, offsetof(Vertex, position)},
                                    {1, 3, offsetof(Vertex, normal)},
                                    {2, 3, offsetof(Vertex, albedo)},
                                    {3, 1, offsetof(Vertex, surface)}},
                     .indices = indices_});
    }

  private:
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

// One bay of the arcade about x = center: both faces, and the arch's inside between them.
void addArch(Builder& builder, float center) {
    constexpr int segments = 20;
    const auto arc = [&](int i) { // from the right foot over the top to the left one
        const float angle_rad = pi * static_cast<float>(i) / segments;
        return glm::vec2(std::cos(angle_rad), std::sin(angle_rad));
    };
    for (const float z : {0.0F, -wall_depth}) {
        const glm::vec3 normal(0, 0, z == 0 ? 1 : -1);
        const Material& material = z == 0 ? wall_stone : plaster;
        const float width = bay / 2 - arch_radius;
        for (const float left : {center - bay / 2, center + arch_radius}) {
            builder.rectangle({left, 0, z}, {width, 0, 0}, {0, arch_spring, 0}, normal, material);
            builder.rectangle({left, arch_spring, z}, {width, 0, 0}, {0, wall_height - arch_spring, 0},
                              normal, material);
        }
        for (int i = 0; i < segments; ++i) {
            const glm::vec2 a = glm::vec2(center, arch_spring) + arch_radius * arc(i);
            const glm::vec2 b = glm::vec2(center, arch_spring) + arch_radius * arc(i + 1);
            builder.quad({{{a, z}, {a.x, wall_height, z}, {b.x, wall_height, z}, {b, z}}}, normal, material);
        }
    }
    for (int i = 0; i < segments; ++i) {
        const glm::vec3 a(arc(i), 0);
        const glm::vec3 b(arc(i + 1), 0);
        const glm::vec3 middle(center, arch_spring, 0);
        const glm::vec3 back(0, 0, -wall_depth);
        builder.quad({middle + arch_radius * a, middle + arch_radius * b, middle + arch_radius * b + back,
                      middle + arch_radius * a + back},
                     {-a, -b, -b, -a}, arch_stone);
    }
    for (const float side : {-1.0F, 1.0F})
        builder.rectangle({center + side * arch_radius, 0, -wall_depth}, {0, 0, wall_depth},
                          {0, arch_spring, 0}, {-side, 0, 0}, arch_stone);
}

void addCourt(Builder& builder) {
    const float length = 2 * half_length;
    builder.rectangle({-half_length, 0, 0}, {length, 0, 0}, {0, 0, court_end}, {0, 1, 0}, court_tiles);
    for (const float side : {-1.0F, 1.0F})
        builder.rectangle({side * half_length, 0, 0}, {0, 0, court_end}, {0, wall_height, 0}, {-side, 0, 0},
                          wall_stone);
    builder.rectangle({-half_length, 0, court_end}, {length, 0, 0}, {0, garden_wall_height, 0}, {0, 0, -1},
                      wall_stone);
    builder.box({-half_length, wall_height - 0.25F, 0}, {half_length, wall_height + 0.1F, 0.35F}, arch_stone);
    for (const glm::vec3& tree : trees) {
        builder.box({tree.x - 0.5F, 0, tree.z - 0.5F}, {tree.x + 0.5F, 0.7F, tree.z + 0.5F}, arch_stone);
        builder.box({tree.x - 0.07F, 0.7F, tree.z - 0.07F}, {tree.x + 0.07F, 1.6F, tree.z + 0.07F}, wood);
        builder.sphere(tree, crown_radius, leaves);
    }
    for (const float x : {-11.0F, -8.5F, -6.2F, 5.0F, 7.8F, 10.5F}) // cypresses beyond the garden wall
        builder.revolved({x, 1.5F, court_end + 2},
                         {{0.1F, 0}, {0.75F, 1.2F}, {0.6F, 3.0F}, {0.3F, 4.6F}, {0, 5.4F}}, leaves);
    builder.box({-40, -30, -40}, {40, 45, 50}, sky, -1);
}

void addHall(Builder& builder) {
    const float length = 2 * half_length;
    builder.rectangle({-half_length, 0, hall_end}, {length, 0, 0}, {0, 0, -hall_end}, {0, 1, 0}, hall_tiles);
    builder.rectangle({-half_length, ceiling_height, hall_end}, {length, 0, 0}, {0, 0, -hall_end}, {0, -1, 0},
                      plaster);
    builder.rectangle({-half_length, 0, hall_end}, {length, 0, 0}, {0, ceiling_height, 0}, {0, 0, 1},
                      plaster);
    for (const float side : {-1.0F, 1.0F})
        builder.rectangle({side * half_length, 0, hall_end}, {0, 0, -hall_end}, {0, ceiling_height, 0},
                          {-side, 0, 0}, plaster);
    constexpr glm::vec3 cloths[] = {{0.55F, 0.06F, 0.05F}, {0.07F, 0.14F, 0.45F}, {0.60F, 0.40F, 0.06F}};
    for (int i = -3; i <= 3; ++i) {
        const float x = bay * static_cast<float>(i);
        builder.box({x - 1.85F, 0, hall_end}, {x - 2.15F, ceiling_height, hall_end + 0.25F}, arch_stone);
        builder.box({x - 0.8F, 1.5F, hall_end}, {x + 0.8F, 3.9F, hall_end + 0.06F},
                    {cloths[static_cast<std::size_t>(i + 3) % 3]});
        builder.box({x - 0.9F, 3.9F, hall_end}, {x + 0.9F, 4.0F, hall_end + 0.12F}, wood);
        for (const float beam : {x - 1, x + 1})
            builder.box({beam - 0.14F, ceiling_height - 0.35F, hall_end},
                        {beam + 0.14F, ceiling_height, -wall_depth}, wood);
    }
    for (const float side : {-1.0F, 1.0F}) { // a bench along the wall, with a chest beside it
        builder.box({side * 4 - 1.6F, 0.4F, hall_end + 0.3F}, {side * 4 + 1.6F, 0.5F, hall_end + 0.85F},
                    wood);
        for (const float leg : {-1.4F, 1.2F})
            builder.box({side * 4 + leg, 0, hall_end + 0.35F}, {side * 4 + leg + 0.2F, 0.4F, hall_end + 0.8F},
                        wood);
        const glm::vec3 hanging(side * 9, 2.55F, -5.4F);
        builder.sphere(hanging, 0.17F, lamp);
        builder.box(hanging + glm::vec3(-0.02F, 0.17F, -0.02F),
                    {hanging.x + 0.02F, ceiling_height, hanging.z + 0.02F}, wood);
    }
}

} // namespace

Mesh makeCourtAndHall() {
    Builder builder;
    for (int i = -3; i <= 3; ++i)
        addArch(builder, bay * static_cast<float>(i));
    addCourt(builder);
    addHall(builder);
    return builder.mesh();
}

// excerpt: walk
Camera walk(int frame_number) {
    constexpr float start_rad = 3.5F;                           // frame 1 stands deep in the hall
    const int frame_in_walk = (frame_number - 1) % walk_frames; // whole numbers: every round is the same
    const float way_rad = start_rad + 2 * pi * static_cast<float>(frame_in_walk) / walk_frames;
    // x is 0 where z is -0.4, in the thickness of the wall: both ways lead through the middle arch.
    const float z = 1.5F + 9.5F * std::cos(way_rad);
    const float x = 0.3F * (z + 0.4F) * std::sin(way_rad);
    // One turn a round: into the hall, along it, back out, along the court.
    const float yaw_rad = way_rad - pi / 2 - 0.15F * std::sin(4 * way_rad);
    const glm::vec3 position(x, 1.65F, z);
    const glm::vec3 forward(std::sin(yaw_rad), 0.02F, -std::cos(yaw_rad));
    return {.position = position,
            .target = position + 4.0F * forward,
            .vertical_field_of_view_deg = 62,
            .near = 0.1F,
            .far = 120};
}
// end excerpt

} // namespace gll::auto_exposure
