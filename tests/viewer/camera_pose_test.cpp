#include "apps/viewer/camera_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"

namespace prt::viewer {
namespace {

constexpr double kFloatRounding = 2e-5;  ///< cameras hold floats; all lengths here are below 10

std::vector<CameraPose> samplePoses() {
    RandomStream random(3, 0);
    std::vector<CameraPose> poses;
    for (int i = 0; i < 200; ++i) {
        CameraPose pose;
        pose.target =
            Vec3d(random.nextUnitDouble(), random.nextUnitDouble(), random.nextUnitDouble());
        pose.distance = 0.5 + 3.0 * random.nextUnitDouble();
        pose.azimuthDegrees = 358.0 * random.nextUnitDouble() - 179.0;
        pose.elevationDegrees = 176.0 * random.nextUnitDouble() - 88.0;
        pose.fovDegrees = 20.0 + 60.0 * random.nextUnitDouble();
        poses.push_back(pose);
    }
    return poses;
}

double distanceBetween(const Vec3f& a, const Vec3f& b) {
    return Vec3d(a - b).length();
}

TEST(CameraPose, LooksFromItsAzimuthAndElevationAtItsTarget) {
    const Camera camera = makeCamera({.target = Vec3d(1.0, 2.0, 3.0),
                                      .distance = 2.0,
                                      .azimuthDegrees = 90.0,
                                      .elevationDegrees = 0.0,
                                      .fovDegrees = 45.0});
    EXPECT_NEAR(distanceBetween(camera.eye, Vec3f(3.0f, 2.0f, 3.0f)), 0.0, kFloatRounding);
    EXPECT_NEAR(distanceBetween(camera.forward, Vec3f(-1.0f, 0.0f, 0.0f)), 0.0, kFloatRounding);
    EXPECT_NEAR(camera.verticalFovRadians, std::numbers::pi / 4.0, kFloatRounding);

    const Camera above = makeCamera({.elevationDegrees = 30.0});
    EXPECT_NEAR(above.eye.y, 0.5, kFloatRounding);
    EXPECT_GT(above.eye.z, 0.0f);
}

TEST(CameraPose, IsFoundAgainFromItsCamera) {
    constexpr double kDegreesRounding = 1e-3;  // of floats near the poles
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose found = poseFromCamera(makeCamera(pose), pose.distance);
        EXPECT_NEAR((found.target - pose.target).length(), 0.0, kFloatRounding);
        EXPECT_EQ(found.distance, pose.distance);
        EXPECT_NEAR(found.azimuthDegrees, pose.azimuthDegrees, kDegreesRounding);
        EXPECT_NEAR(found.elevationDegrees, pose.elevationDegrees, kDegreesRounding);
        EXPECT_NEAR(found.fovDegrees, pose.fovDegrees, kDegreesRounding);
    }
}

TEST(CameraPose, OfATiltedCameraIsUpright) {
    Camera camera = makeCamera({.distance = 2.0, .azimuthDegrees = 40.0, .elevationDegrees = 10.0});
    const Vec3f right = camera.forward.cross(camera.up);
    camera.up = (camera.up + right).normalized();
    const Camera upright = makeCamera(poseFromCamera(camera, 2.0));
    EXPECT_NEAR(distanceBetween(upright.forward, camera.forward), 0.0, kFloatRounding);
    EXPECT_NEAR(upright.forward.cross(upright.up).y, 0.0, kFloatRounding);
}

TEST(CameraPose, OrbitKeepsTargetAndDistance) {
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose turned = orbit(pose, 77.0, -31.0);
        EXPECT_EQ(turned.target, pose.target);
        EXPECT_EQ(turned.distance, pose.distance);
        EXPECT_NEAR((Vec3d(makeCamera(turned).eye) - pose.target).length(), pose.distance,
                    kFloatRounding);
        EXPECT_LE(std::abs(turned.azimuthDegrees), 180.0);
    }
}

TEST(CameraPose, OrbitStopsShortOfThePolesWithTheEyeAboveTheTarget) {
    const CameraPose top = orbit({.azimuthDegrees = 30.0}, 0.0, 500.0);
    EXPECT_LT(top.elevationDegrees, 90.0);
    EXPECT_GT(top.elevationDegrees, 89.0);
    EXPECT_LT(makeCamera(top).forward.y, -0.999f);
    // What is right stays right, so that pictures do not spin there.
    EXPECT_GT(makeCamera(top).up.dot(-makeCamera({.azimuthDegrees = 30.0}).eye), 0.99f);
    EXPECT_EQ(orbit(top, 0.0, -1000.0).elevationDegrees, -top.elevationDegrees);
}

TEST(CameraPose, PanKeepsTheDirectionAndMovesByPictures) {
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose moved = pan(pose, 0.3, -0.2);
        const Camera before = makeCamera(pose), after = makeCamera(moved);
        EXPECT_NEAR(distanceBetween(after.forward, before.forward), 0.0, kFloatRounding);
        const Vec3d step = moved.target - pose.target;
        EXPECT_NEAR((Vec3d(after.eye - before.eye) - step).length(), 0.0, kFloatRounding);
        const double height =
            2.0 * pose.distance * std::tan(pose.fovDegrees * std::numbers::pi / 360.0);
        EXPECT_NEAR(step.dot(Vec3d(before.forward.cross(before.up))), 0.3 * height, kFloatRounding);
        EXPECT_NEAR(step.dot(Vec3d(before.up)), -0.2 * height, kFloatRounding);
    }
}

TEST(CameraPose, ZoomMovesTheEyeAlone) {
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose nearer = zoom(pose, 0.5);
        EXPECT_EQ(nearer.target, pose.target);
        EXPECT_EQ(nearer.distance, 0.5 * pose.distance);
        EXPECT_EQ(nearer.azimuthDegrees, pose.azimuthDegrees);
    }
}

TEST(CameraPose, FlyingMovesEyeAndTargetTogether) {
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose moved = fly(pose, 0.5, 0.25, -0.125);
        const Camera before = makeCamera(pose), after = makeCamera(moved);
        const Vec3d step = Vec3d(before.forward) * 0.5 +
                           Vec3d(before.forward.cross(before.up)) * 0.25 - Vec3d(before.up) * 0.125;
        EXPECT_NEAR((Vec3d(after.eye - before.eye) - step * pose.distance).length(), 0.0,
                    kFloatRounding);
        EXPECT_NEAR(distanceBetween(after.forward, before.forward), 0.0, kFloatRounding);
    }
}

TEST(CameraPose, LookingAroundKeepsTheEye) {
    for (const CameraPose& pose : samplePoses()) {
        const CameraPose turned = lookAround(pose, 25.0, 200.0);
        EXPECT_NEAR(distanceBetween(makeCamera(turned).eye, makeCamera(pose).eye), 0.0,
                    kFloatRounding);
        EXPECT_EQ(turned.distance, pose.distance);
    }
    // The target goes right when the eye's azimuth shrinks: the picture is seen from the other end.
    const CameraPose right = lookAround({}, -90.0, 0.0);
    EXPECT_NEAR((right.target - Vec3d(1.0, 0.0, 1.0)).length(), 0.0, kFloatRounding);
}

}  // namespace
}  // namespace prt::viewer
