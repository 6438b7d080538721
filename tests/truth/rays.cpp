// Rays by Embree 3 or 4.
#include "truth/rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gll::truth {
namespace {

constexpr float nearest = 5e-4F; // world units

} // namespace

struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Embree() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

RayScene::RayScene(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
    : embree_(std::make_unique<Embree>()) {
    embree_->device = rtcNewDevice("threads=1");
    if (embree_->device == nullptr) throw std::runtime_error("Embree makes no device");
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    std::copy(positions.begin(), positions.end(), vertices);
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), indices.size() / 3));
    std::copy(indices.begin(), indices.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_->scene);
    if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree refuses the scene");
}

RayScene::~RayScene() = default;

float RayScene::distance(glm::vec3 origin, glm::vec3 direction) const {
    RTCRayHit hit{};
    hit.ray.org_x = origin.x;
    hit.ray.org_y = origin.y;
    hit.ray.org_z = origin.z;
    hit.ray.dir_x = direction.x;
    hit.ray.dir_y = direction.y;
    hit.ray.dir_z = direction.z;
    hit.ray.tnear = nearest;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0U;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(embree_->scene, &hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &hit);
#endif
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : hit.ray.tfar;
}

bool RayScene::isBlocked(glm::vec3 origin, glm::vec3 direction, float far) const {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = nearest;
    ray.tfar = far;
    ray.mask = ~0U;
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(embree_->scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_->scene, &context, &ray);
#endif
    return ray.tfar < 0;
}

glm::vec3 directionFromOctahedral(glm::dvec2 stored) { // see octahedral.glsl
    glm::dvec3 n(stored.x * 2 - 1, stored.y * 2 - 1, 0);
    n.z = 1 - std::abs(n.x) - std::abs(n.y);
    const double folded = std::max(-n.z, 0.0);
    n.x -= n.x < 0 ? -folded : folded;
    n.y -= n.y < 0 ? -folded : folded;
    return glm::normalize(n);
}

} // namespace gll::truth
