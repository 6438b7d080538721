// Camera matrices against the textbook in double, and orbiting.
#include "rung/camera.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>

namespace gll::test {
namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

TEST(CameraTest, thePerspectiveMatrixIsTheTextbooks) {
    const Camera camera{.vertical_field_of_view_deg = 60, .near = 0.1F, .far = 60};
    const double near = camera.near;
    const double far = camera.far;
    const double aspect = 4.0 / 3.0;
    const double f = 1 / std::tan(radians(60) / 2);
    // glFrustum's matrix for a symmetric frustum; expected[column][row].
    double expected[4][4] = {};
    expected[0][0] = f / aspect;
    expected[1][1] = f;
    expected[2][2] = -(far + near) / (far - near);
    expected[2][3] = -1;
    expected[3][2] = -2 * far * near / (far - near);
    const glm::mat4 matrix = camera.clipFromView(4.0F / 3.0F);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(matrix[column][row], expected[column][row],
                        2e-7 * (1 + std::abs(expected[column][row])))
                << column << "," << row;
}

TEST(CameraTest, nearAndFarLandOnTheEndsOfDepthAndTheEdgeOfViewOnTheEdgeOfClip) {
    const Camera camera{.vertical_field_of_view_deg = 50, .near = 0.5F, .far = 20};
    const glm::mat4 clip_from_view = camera.clipFromView(2);
    const auto depth = [&](float distance) {
        const glm::vec4 clip = clip_from_view * glm::vec4(0, 0, -distance, 1);
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(0.5F), -1, 1e-6);
    EXPECT_NEAR(depth(20), 1, 1e-6);
    const auto half_height = static_cast<float>(std::tan(radians(25)));
    const glm::vec4 corner = clip_from_view * glm::vec4(2 * half_height * 3, half_height * 3, -3, 1);
    EXPECT_NEAR(corner.x / corner.w, 1, 1e-6);
    EXPECT_NEAR(corner.y / corner.w, 1, 1e-6);
}

TEST(CameraTest, theViewLooksDownMinusZWithYUp) {
    const Camera camera{.position = {3, 4, 12}, .target = {0, 0, 0}};
    const glm::mat4 view = camera.viewFromWorld();
    const glm::vec4 target = view * glm::vec4(0, 0, 0, 1);
    EXPECT_NEAR(target.x, 0, 1e-6);
    EXPECT_NEAR(target.y, 0, 1e-6);
    EXPECT_NEAR(target.z, -13, 1e-5);
    EXPECT_GT((view * glm::vec4(0, 1, 0, 1)).y, 0);
    EXPECT_NEAR(glm::determinant(glm::mat3(view)), 1, 1e-6);
}

class OrbitTest : public testing::Test {
  protected:
    Camera applied(double yaw, double pitch, double zoom) {
        settings.reset();
        settings.set("camera_yaw_deg", std::to_string(yaw));
        settings.set("camera_pitch_deg", std::to_string(pitch));
        settings.set("camera_zoom", std::to_string(zoom));
        return orbit.apply(scripted);
    }
    float distanceOf(const Camera& camera) { return glm::distance(camera.position, camera.target); }

    Settings settings;
    OrbitSettings orbit{settings};
    Camera scripted{.position = {13.37F, 1.1F, -4.2F}, .target = {0.3F, -0.7F, 0.1F}};
};

TEST_F(OrbitTest, atTheDefaultsTheScriptedCameraIsKeptBitForBit) {
    for (int i = 0; i < 1000; ++i) {
        const auto angle = static_cast<float>(i);
        scripted.position = {14 * std::cos(angle), 2 * std::sin(2 * angle), 14 * std::sin(angle)};
        const Camera camera = orbit.apply(scripted);
        ASSERT_EQ(std::memcmp(&camera, &scripted, sizeof camera), 0) << i;
    }
}

TEST_F(OrbitTest, aWholeTurnComesBackAndHalfATurnIsOpposite) {
    const Camera whole = applied(360, 0, 1);
    EXPECT_LT(glm::distance(whole.position, scripted.position), 1e-4F);
    const Camera half = applied(180, 0, 1);
    const glm::vec3 arm = scripted.position - scripted.target;
    EXPECT_LT(glm::distance(half.position, scripted.target + glm::vec3(-arm.x, arm.y, -arm.z)), 1e-4F);
}

TEST_F(OrbitTest, turningKeepsTheDistanceAndZoomDividesIt) {
    const float distance = distanceOf(scripted);
    EXPECT_NEAR(distanceOf(applied(77, 33, 1)), distance, 1e-4F);
    EXPECT_NEAR(distanceOf(applied(0, 0, 2)), distance / 2, 1e-4F);
    EXPECT_NEAR(distanceOf(applied(10, 5, 0.1)), distance * 10, 1e-3F);
}

TEST_F(OrbitTest, pitchStopsShortOfThePoleSoThatUpKeepsADirection) {
    for (const double pitch : {-180.0, -110.0, 110.0, 180.0}) {
        const Camera camera = applied(0, pitch, 1);
        const glm::vec3 arm = camera.position - camera.target;
        const double elevation = std::asin(arm.y / glm::length(arm));
        EXPECT_NEAR(std::abs(elevation), 1.55, 1e-3) << pitch;
        EXPECT_EQ(std::signbit(elevation), std::signbit(pitch));
        const glm::mat4 view = camera.viewFromWorld();
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                EXPECT_TRUE(std::isfinite(view[i][j]));
        EXPECT_NEAR(glm::determinant(glm::mat3(view)), 1, 1e-3);
    }
}

TEST_F(OrbitTest, aCameraOnItsTargetStaysFinite) {
    scripted.position = scripted.target;
    const Camera camera = applied(45, 45, 2);
    EXPECT_TRUE(std::isfinite(camera.position.x + camera.position.y + camera.position.z));
}

} // namespace
} // namespace gll::test
