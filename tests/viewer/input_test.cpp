#include "apps/viewer/input.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/common/parse.h"

namespace prt::viewer {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kAspectRatio = 1.5;

/// From a little above, a quarter around to +x: the camera's right is −z.
CameraPose samplePose() {
    return {.target = Vec3d(0.0, 1.0, 0.0),
            .distance = 4.0,
            .azimuthDegrees = 90.0,
            .elevationDegrees = 0.0};
}

void expectNear(const Vec3d& value, const Vec3d& truth) {
    EXPECT_NEAR((value - truth).length(), 0.0, kRounding)
        << "(" << value.x << ", " << value.y << ", " << value.z << ")";
}

TEST(Input, ButtonsAndModifiersChooseWhatADragDoes) {
    const Modifiers none, shift{.shift = true}, control{.control = true}, alt{.alt = true};
    EXPECT_EQ(chooseDrag(MouseButton::left, none, false), Drag::orbit);
    EXPECT_EQ(chooseDrag(MouseButton::left, none, true), Drag::moveSplit);
    EXPECT_EQ(chooseDrag(MouseButton::left, shift, false), Drag::pan);
    EXPECT_EQ(chooseDrag(MouseButton::middle, none, true), Drag::pan);
    EXPECT_EQ(chooseDrag(MouseButton::left, control, true), Drag::turnLight);
    EXPECT_EQ(chooseDrag(MouseButton::left, alt, false), Drag::turnLight);
    EXPECT_EQ(chooseDrag(MouseButton::left, {.shift = true, .control = true}, false),
              Drag::turnObject);
    EXPECT_EQ(chooseDrag(MouseButton::right, none, false), Drag::lookAround);
}

TEST(Input, OrbitingTurnsTheCameraAgainstTheMouse) {
    ViewState view;
    applyDrag(view, Drag::orbit, {.rightward = 0.25, .downward = 0.125}, samplePose(), kAspectRatio,
              0);
    ASSERT_TRUE(view.camera);
    EXPECT_NEAR(view.camera->azimuthDegrees, 45.0, kRounding);
    EXPECT_NEAR(view.camera->elevationDegrees, 22.5, kRounding);
    EXPECT_EQ(view.camera->target, samplePose().target);
}

TEST(Input, WhatIsPannedStaysUnderTheMouse) {
    ViewState view;
    const CameraPose pose = samplePose();
    applyDrag(view, Drag::pan, {.rightward = 0.1, .downward = -0.2}, pose, kAspectRatio, 0);
    ASSERT_TRUE(view.camera);
    // The old target is seen a tenth of the height to the right, and a fifth above the middle.
    const Camera camera = makeCamera(*view.camera);
    const Vec3d seen = pose.target - Vec3d(camera.eye);
    const double depth = seen.dot(Vec3d(camera.forward));
    const double height = 2.0 * depth * std::tan(0.5 * camera.verticalFovRadians);
    constexpr double kFloatRounding = 1e-5;
    EXPECT_NEAR(seen.dot(Vec3d(camera.forward.cross(camera.up))) / height, 0.1, kFloatRounding);
    EXPECT_NEAR(seen.dot(Vec3d(camera.up)) / height, 0.2, kFloatRounding);
}

TEST(Input, LightThatIsTurnedFollowsTheMouseOnTheNearSide) {
    ViewState view;
    const Vec3d towardsEye(1.0, 0.0, 0.0), right(0.0, 0.0, -1.0), down(0.0, -1.0, 0.0);
    applyDrag(view, Drag::turnLight, {.rightward = 0.5}, samplePose(), kAspectRatio, 0);
    expectNear(cli::rotationFromDegrees(view.lightRotationDegrees) * towardsEye, right);

    view.lightRotationDegrees = Vec3d(0.0);
    applyDrag(view, Drag::turnLight, {.downward = 0.5}, samplePose(), kAspectRatio, 0);
    expectNear(cli::rotationFromDegrees(view.lightRotationDegrees) * towardsEye, down);
    EXPECT_FALSE(view.camera);
}

TEST(Input, StepsOfADragAddUp) {
    ViewState once, often;
    applyDrag(once, Drag::turnLight, {.rightward = 0.7}, samplePose(), kAspectRatio, 0);
    for (int i = 0; i < 70; ++i)
        applyDrag(often, Drag::turnLight, {.rightward = 0.01}, samplePose(), kAspectRatio, 0);
    const Vec3d probe(0.3, -0.2, 0.9);
    expectNear(cli::rotationFromDegrees(often.lightRotationDegrees) * probe,
               cli::rotationFromDegrees(once.lightRotationDegrees) * probe);
}

TEST(Input, OneObjectTurnsAlone) {
    ViewState view;
    view.objects = {{.asset = "a"}, {.asset = "b"}};
    applyDrag(view, Drag::turnObject, {.rightward = 0.25}, samplePose(), kAspectRatio, 1);
    expectNear(view.objects[0].rotationDegrees, Vec3d(0.0));
    expectNear(view.objects[1].rotationDegrees, Vec3d(0.0, 45.0, 0.0));
    expectNear(view.lightRotationDegrees, Vec3d(0.0));
    applyDrag(view, Drag::turnObject, {.rightward = 0.25}, samplePose(), kAspectRatio, 2);
    expectNear(view.objects[1].rotationDegrees, Vec3d(0.0, 45.0, 0.0));
}

TEST(Input, TheSplitLineStaysUnderTheMouseAndInThePicture) {
    ViewState view;
    view.right = Pane{};
    applyDrag(view, Drag::moveSplit, {.rightward = 0.15}, samplePose(), kAspectRatio, 0);
    EXPECT_NEAR(view.splitPosition, 0.6, kRounding);
    applyDrag(view, Drag::moveSplit, {.rightward = 10.0}, samplePose(), kAspectRatio, 0);
    EXPECT_EQ(view.splitPosition, 1.0);
}

TEST(Input, TheSplitLineIsFoundWhereThereIsOne) {
    ViewState view;
    EXPECT_FALSE(isOnSplit(view, 0.5, 0.01));
    EXPECT_EQ(&paneAt(view, 0.9), &view.left);
    view.right = Pane{};
    EXPECT_TRUE(isOnSplit(view, 0.505, 0.01));
    EXPECT_FALSE(isOnSplit(view, 0.52, 0.01));
    EXPECT_EQ(&paneAt(view, 0.49), &view.left);
    EXPECT_EQ(&paneAt(view, 0.51), &*view.right);
}

TEST(Input, TheWheelComesNearerAndGoesBack) {
    ViewState view;
    applyWheel(view, 2.0, samplePose());
    ASSERT_TRUE(view.camera);
    EXPECT_LT(view.camera->distance, samplePose().distance);
    applyWheel(view, -2.0, *view.camera);
    EXPECT_NEAR(view.camera->distance, samplePose().distance, kRounding);
}

TEST(Input, FlyingGoesWhereTheCameraLooks) {
    ViewState view;
    applyFlight(view, {}, 1.0, false, samplePose());
    EXPECT_FALSE(view.camera);
    applyFlight(view, {.forward = 1}, 0.5, false, samplePose());
    ASSERT_TRUE(view.camera);
    const Vec3d step = view.camera->target - samplePose().target;
    EXPECT_LT(step.x, 0.0);
    EXPECT_NEAR(step.length(), -step.x, kRounding);
    ViewState fast;
    applyFlight(fast, {.forward = 1}, 0.5, true, samplePose());
    EXPECT_NEAR((fast.camera->target - samplePose().target).length(), 4.0 * step.length(),
                kRounding);
}

}  // namespace
}  // namespace prt::viewer
