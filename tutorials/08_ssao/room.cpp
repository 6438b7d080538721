// The rooms, as triangles.
#include "room.hpp"

#include "06_gbuffer/solids.hpp"

#include <cmath>

namespace gll::ssao {

using namespace gbuffer;

std::vector<PlainObject> makeRoom() {
    PlainObject walls = plain({0.62F, 0.60F, 0.56F});
    addQuad(walls, {-2.6F, 0, 6}, {6, 0, 6}, {6, 0, -2.6F}, {-2.6F, 0, -2.6F});
    addQuad(walls, {-2.6F, 0, -2.6F}, {6, 0, -2.6F}, {6, 4, -2.6F}, {-2.6F, 4, -2.6F});
    addQuad(walls, {-2.6F, 0, 6}, {-2.6F, 0, -2.6F}, {-2.6F, 4, -2.6F}, {-2.6F, 4, 6});

    PlainObject chair = plain({0.55F, 0.22F, 0.10F});
    for (const glm::vec2 leg :
         {glm::vec2(0, 0), glm::vec2(0.9F, 0), glm::vec2(0, 0.9F), glm::vec2(0.9F, 0.9F)})
        addBox(chair, {0.3F + leg.x, 0, -0.3F + leg.y}, {0.38F + leg.x, 0.9F, -0.22F + leg.y});
    addBox(chair, {0.26F, 0.9F, -0.34F}, {1.32F, 0.98F, 0.72F});
    addBox(chair, {0.3F, 0.98F, -0.3F}, {0.38F, 1.9F, -0.22F});
    addBox(chair, {1.2F, 0.98F, -0.3F}, {1.28F, 1.9F, -0.22F});
    for (const float height : {1.25F, 1.5F, 1.75F})
        addBox(chair, {0.38F, height, -0.28F}, {1.2F, height + 0.1F, -0.24F});

    PlainObject shelf = plain({0.50F, 0.42F, 0.28F});
    for (const float x : {-2.1F, -0.45F})
        addBox(shelf, {x, 0, -2.6F}, {x + 0.06F, 2.4F, -1.8F});
    for (const float y : {0.1F, 0.65F, 1.2F, 1.75F, 2.34F})
        addBox(shelf, {-2.04F, y, -2.6F}, {-0.45F, y + 0.06F, -1.8F});

    PlainObject things = plain({0.16F, 0.34F, 0.50F});
    addBox(things, {-1.95F, 1.26F, -2.4F}, {-1.8F, 1.66F, -1.95F});
    addBox(things, {-1.78F, 1.26F, -2.4F}, {-1.7F, 1.7F, -1.95F});
    addBox(things, {-1.68F, 1.26F, -2.4F}, {-1.5F, 1.6F, -1.95F});
    addBox(things, {-1.2F, 0.71F, -2.3F}, {-0.8F, 1.0F, -1.9F});
    addBall(things, {-1.7F, 1.99F, -2.1F}, 0.18F);
    addBall(things, {-1.6F, 0.88F, -2.2F}, 0.17F);

    PlainObject balls = plain({0.66F, 0.60F, 0.46F});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const float radius = 0.1F + 0.04F * static_cast<float>((3 * row + 2 * column) % 5);
            addBall(
                balls,
                {-1.9F + 0.5F * static_cast<float>(column), radius, 0.4F + 0.5F * static_cast<float>(row)},
                radius);
        }

    PlainObject pole = plain({0.20F, 0.20F, 0.22F});
    addBox(pole, {2.1F, 0, -1.3F}, {2.18F, 3.4F, -1.22F});
    return {walls, chair, shelf, things, balls, pole};
}

std::vector<PlainObject> makeCorner() {
    PlainObject walls = plain({0.62F, 0.60F, 0.56F});
    addQuad(walls, {-20, 0, 20}, {20, 0, 20}, {20, 0, 0}, {-20, 0, 0});
    addQuad(walls, {-20, 0, 0}, {20, 0, 0}, {20, 20, 0}, {-20, 20, 0});
    return {walls};
}

Camera cameraOf(std::string_view scene, float time_s) {
    const float orbit_rad = time_s * 0.3F;
    const float sway_rad = 0.25F * std::sin(0.5F * time_s);
    Camera camera = {.position = {4.6F * std::cos(orbit_rad), 2.3F, 4.6F * std::sin(orbit_rad)},
                     .target = {0, 1, 0},
                     .vertical_field_of_view_deg = 50,
                     .near = 0.1F,
                     .far = 60};
    if (scene == "room") {
        camera.target = {-0.1F, 0.95F, -0.6F};
        camera.position = camera.target +
                          glm::vec3(4.6F * std::sin(0.5F + sway_rad), 1.5F, 4.6F * std::cos(0.5F + sway_rad));
    }
    if (scene == "corner") {
        camera.target = {0, 0.6F, 0.3F};
        camera.position = camera.target + glm::vec3(3 * std::sin(sway_rad), 1.2F, 3 * std::cos(sway_rad));
    }
    return camera;
}

} // namespace gll::ssao
