// Shooting rays all round.
#include "truth/occlusion_rays.hpp"

#include "06_gbuffer/statue.hpp"
#include "08_ssao/room.hpp"
#include "io/mesh.hpp"
#include "rung/resources.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

namespace gll::truth {
namespace {

constexpr double pi = std::numbers::pi;

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void add(const std::vector<gbuffer::PlainObject>& objects) {
        for (const gbuffer::PlainObject& object : objects) {
            const auto first = static_cast<std::uint32_t>(positions.size());
            for (const gbuffer::Vertex& vertex : object.vertices)
                positions.push_back(vertex.position);
            for (const std::uint32_t index : object.indices)
                indices.push_back(first + index);
        }
    }
};

Triangles catOnFloor() {
    const std::filesystem::path path = Resources().find("assets/cat/cat.obj");
    const MeshData cat = loadMesh(path);
    const gbuffer::StatuePlace place(cat, path);
    Triangles triangles;
    for (const glm::vec3& position : cat.positions)
        triangles.positions.push_back(place.position(position));
    triangles.indices = cat.indices;
    const auto first = static_cast<std::uint32_t>(triangles.positions.size());
    for (const glm::vec3 corner : {glm::vec3(-6, 0, 6), {6, 0, 6}, {6, 0, -6}, {-6, 0, -6}})
        triangles.positions.push_back(corner);
    for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U})
        triangles.indices.push_back(first + index);
    return triangles;
}

double bitsReversed(std::uint32_t i) {
    double value = 0;
    for (double share = 0.5; i != 0; i >>= 1U, share /= 2)
        value += (i & 1U) != 0 ? share : 0;
    return value;
}

double fraction(double value) { return value - std::floor(value); }

} // namespace

std::unique_ptr<RayScene> occlusionScene(std::string_view name) {
    Triangles triangles;
    if (name == "cat")
        triangles = catOnFloor();
    else if (name == "room")
        triangles.add(ssao::makeRoom());
    else if (name == "corner")
        triangles.add(ssao::makeCorner());
    else
        throw std::invalid_argument("no scene " + std::string(name));
    return std::make_unique<RayScene>(triangles.positions, triangles.indices);
}

std::vector<SeenPoint> seenPoints(const Camera& camera, const measure::ColorImage& depth,
                                  const Image& normals) {
    const auto& stored = std::get<std::vector<float>>(normals.pixels);
    std::vector<SeenPoint> points(depth.pixels.size());
    if (stored.size() != 2 * points.size())
        throw std::invalid_argument("normals want two floats for each depth");
    const double aspect = double(depth.width) / depth.height;
    const glm::dmat4 clip_from_world =
        glm::dmat4(camera.clipFromView(static_cast<float>(aspect))) * glm::dmat4(camera.viewFromWorld());
    const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
    for (int y = 0; y < depth.height; ++y)
        for (int x = 0; x < depth.width; ++x) {
            const double stored_depth = depth.at(x, y).r;
            if (stored_depth >= 1) continue;
            const auto i = static_cast<std::size_t>(y * depth.width + x);
            // images have their first row at the top
            const glm::dvec4 clip(2 * (x + 0.5) / depth.width - 1, 1 - 2 * (y + 0.5) / depth.height,
                                  2 * stored_depth - 1, 1);
            const glm::dvec4 world = world_from_clip * clip;
            points[i] = {true, glm::vec3(glm::dvec3(world) / world.w),
                         directionFromOctahedral({stored[2 * i], stored[2 * i + 1]})};
        }
    return points;
}

std::unique_ptr<RayScene> heightField(const std::vector<SeenPoint>& points, int width, float longest) {
    Triangles triangles;
    for (const SeenPoint& point : points)
        triangles.positions.push_back(point.position);
    const std::size_t columns = static_cast<std::size_t>(width);
    for (std::size_t i = 0; i + columns + 1 < points.size(); ++i) {
        if (i % columns == columns - 1) continue;
        const std::size_t corners[] = {i, i + columns, i + columns + 1, i + 1};
        if (!std::all_of(std::begin(corners), std::end(corners), [&](std::size_t corner) {
                return points[corner].is_surface &&
                       glm::distance(points[corner].position, points[i].position) <= longest;
            }))
            continue;
        for (const int corner : {0, 1, 2, 0, 2, 3})
            triangles.indices.push_back(static_cast<std::uint32_t>(corners[corner]));
    }
    return std::make_unique<RayScene>(triangles.positions, triangles.indices);
}

std::vector<float> trueVisibility(const RayScene& scene, const std::vector<SeenPoint>& points, float radius,
                                  int rays) {
    std::vector<float> visibility(points.size(), 1.0F);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SeenPoint& point = points[i];
        if (!point.is_surface) continue;
        const glm::vec3 aside = std::abs(point.normal.y) > 0.9F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 across = glm::normalize(glm::cross(aside, point.normal));
        const glm::vec3 along = glm::cross(point.normal, across);
        // Rounding must not put the origin behind its own triangle.
        const glm::vec3 origin = point.position + 1e-3F * point.normal;
        const double turn_x = fraction(double(i) * 0.75487766624669276);
        const double turn_y = fraction(double(i) * 0.56984029099805327);
        int open = 0;
        for (int ray = 0; ray < rays; ++ray) {
            const double square =
                fraction((ray + 0.5) / rays + turn_x); // of the sine to the normal: cosine-weighted
            const double angle_rad =
                2 * pi * fraction(bitsReversed(static_cast<std::uint32_t>(ray)) + turn_y);
            const auto sine = static_cast<float>(std::sqrt(square));
            const glm::vec3 direction = sine * static_cast<float>(std::cos(angle_rad)) * across +
                                        sine * static_cast<float>(std::sin(angle_rad)) * along +
                                        static_cast<float>(std::sqrt(1 - square)) * point.normal;
            open += scene.isBlocked(origin, direction, radius) ? 0 : 1;
        }
        visibility[i] = static_cast<float>(open) / static_cast<float>(rays);
    }
    return visibility;
}

double cornerVisibility(double distance, double radius) {
    // A direction at height z over the plane and angle a to the other plane's normal meets that plane at
    // distance / (s cos a), s^2 + z^2 = 1, which is within the radius where s cos a > distance / radius. Of
    // the cosine-weighted disk, whose points (s cos a, s sin a) are evenly spread, that is a segment.
    const double offset = distance / radius;
    if (offset >= 1) return 1;
    return 1 - (std::acos(offset) - offset * std::sqrt(1 - offset * offset)) / pi;
}

} // namespace gll::truth
