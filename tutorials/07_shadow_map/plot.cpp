// The plot, as triangles.
#include "plot.hpp"

#include "06_gbuffer/solids.hpp"

#include <cmath>
#include <cstdint>

namespace gll::shadow_map {
namespace {

using namespace gbuffer;

// Half a cylinder lying on the ground along x, in facets of one and a half degrees: every slope there is.
void addVault(PlainObject& object, float from_x, float to_x, float middle_z, float radius) {
    constexpr int facets = 120;
    const auto rim = [&](int i, float x) {
        const float angle_rad = 3.14159265F * static_cast<float>(i) / facets;
        return glm::vec3(x, radius * std::sin(angle_rad), middle_z + radius * std::cos(angle_rad));
    };
    for (int i = 0; i < facets; ++i)
        addQuad(object, rim(i, from_x), rim(i, to_x), rim(i + 1, to_x), rim(i + 1, from_x));
}

} // namespace

std::vector<PlainObject> makePlot() {
    PlainObject ground = plain({0.30F, 0.29F, 0.27F});
    addQuad(ground, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, {-6, 0, -6});

    PlainObject vault = plain({0.42F, 0.22F, 0.12F});
    addVault(vault, -4.2F, -2.0F, -1.2F, 1.1F);

    PlainObject thin = plain({0.18F, 0.24F, 0.40F});
    addBox(thin, {-1.5F, 0, 0.6F}, {0.7F, 0.9F, 0.63F});   // a wall
    addBox(thin, {-2.6F, 0, 1.6F}, {-2.55F, 2.2F, 1.65F}); // a pole

    PlainObject plates = plain({0.45F, 0.34F, 0.08F});
    addBox(plates, {1.2F, 2.1F, -1.4F}, {3.0F, 2.16F, 0.2F});
    addBox(plates, {1.7F, 0.7F, -1.0F}, {2.7F, 0.76F, -0.1F});

    PlainObject boxes = plain({0.14F, 0.32F, 0.16F});
    addBox(boxes, {-0.9F, 0, -2.4F}, {-0.1F, 0.8F, -1.6F});
    addBox(boxes, {-0.1F, 0, -2.4F}, {0.7F, 1.2F, -1.6F}); // one side in common
    addBox(boxes, {0.7F, 0, -2.4F}, {1.5F, 0.4F, -1.6F});

    PlainObject high = plain({0.5F, 0.5F, 0.5F});
    addBox(high, {6.0F, 11.9F, 0.9F}, {7.0F, 12.0F, 1.9F});
    return {ground, vault, thin, plates, boxes, high};
}

} // namespace gll::shadow_map
