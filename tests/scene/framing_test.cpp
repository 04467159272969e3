#include "prt/scene/framing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr float kFrameTolerance = 1e-6f;  // float rounding of unit vectors

void expectOrthonormal(const Camera& camera) {
    EXPECT_NEAR(camera.forward.length(), 1.0f, kFrameTolerance);
    EXPECT_NEAR(camera.up.length(), 1.0f, kFrameTolerance);
    EXPECT_NEAR(camera.forward.dot(camera.up), 0.0f, kFrameTolerance);
}

// Where a point lies in the picture: -1 to 1 from the left to the right edge
// and from the bottom to the top.
Vec2f project(const Camera& camera, float aspectRatio, const Vec3f& point) {
    const Vec3f toPoint = point - camera.eye;
    const float depth = toPoint.dot(camera.forward);
    EXPECT_GT(depth, 0.0f);
    const float tanVertical = std::tan(0.5f * camera.verticalFovRadians);
    return Vec2f(toPoint.dot(camera.forward.cross(camera.up)) / (depth * tanVertical * aspectRatio),
                 toPoint.dot(camera.up) / (depth * tanVertical));
}

TEST(LookAt, TheTargetIsInTheMiddleAndUpIsUp) {
    const Vec3f eye(3.0f, 2.0f, -1.0f), target(-1.0f, 0.5f, 4.0f);
    const Camera camera = lookAt(eye, target, 0.7f);
    expectOrthonormal(camera);
    EXPECT_EQ(camera.eye, eye);
    EXPECT_FLOAT_EQ(camera.verticalFovRadians, 0.7f);
    EXPECT_LT(project(camera, 1.0f, target).length(), kFrameTolerance);
    EXPECT_GT(project(camera, 1.0f, target + Vec3f(0.0f, 0.1f, 0.0f)).y, 0.0f);
    EXPECT_NEAR(project(camera, 1.0f, target + Vec3f(0.0f, 0.1f, 0.0f)).x, 0.0f, kFrameTolerance);
}

TEST(LookAt, StraightDownAndUpHaveZUp) {
    for (const float y : {-1.0f, 1.0f}) {
        const Camera camera = lookAt(Vec3f(0.0f), Vec3f(0.0f, y, 0.0f), 0.7f);
        expectOrthonormal(camera);
        EXPECT_EQ(camera.up, Vec3f(0.0f, 0.0f, 1.0f));
    }
}

TEST(LookAt, AnEyeInItsTargetStillLooksSomewhere) {
    expectOrthonormal(lookAt(Vec3f(1.0f), Vec3f(1.0f), 0.7f));
}

TEST(FrameScene, ShowsAllEightCornersOfTheBoundsAndFillsThePicture) {
    constexpr float kFilled =
        0.75f;  // of the way from the middle to the nearest edge of the picture
    const std::vector<Scene> scenes{
        sceneOf({makeBox(Vec3f(-1.0f), Vec3f(1.0f), false, 1)}),
        sceneOf({makeBox(Vec3f(100.0f, 0.0f, 0.0f), Vec3f(140.0f, 1.0f, 2.0f), false, 1)}),
        sceneOf({makeBox(Vec3f(0.0f, -3.0f, 0.0f), Vec3f(0.001f, 7.0f, 0.002f), false, 1)}),
        sceneOf({makeFloor(1e4f, 5.0f, 1)})};
    for (const Scene& scene : scenes) {
        const Bounds bounds = computeBounds(scene);
        for (const float aspectRatio : {0.1f, 0.5f, 1.0f, 1.7777778f, 10.0f}) {
            const Camera camera = frameScene(scene, aspectRatio);
            expectOrthonormal(camera);
            float widest = 0.0f;
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3f point((corner & 1) ? bounds.low.x : bounds.high.x,
                                  (corner & 2) ? bounds.low.y : bounds.high.y,
                                  (corner & 4) ? bounds.low.z : bounds.high.z);
                const Vec2f inPicture = project(camera, aspectRatio, point);
                EXPECT_LE(std::abs(inPicture.x), 1.0f);
                EXPECT_LE(std::abs(inPicture.y), 1.0f);
                widest = std::max({widest, std::abs(inPicture.x), std::abs(inPicture.y)});
            }
            EXPECT_GT(widest, kFilled);
        }
    }
}

TEST(FrameScene, LooksFromTheFrontFromTheRightAndFromAbove) {
    const Camera camera = frameScene(sceneOf({makeBox(Vec3f(-1.0f), Vec3f(1.0f), false, 1)}), 1.5f);
    EXPECT_LT(camera.forward.z, -0.7f);
    EXPECT_LT(camera.forward.x, 0.0f);
    EXPECT_LT(camera.forward.y, 0.0f);
}

TEST(FrameScene, EmptyAndPointLikeScenesHaveAView) {
    expectOrthonormal(frameScene(Scene{}, 1.0f));
    Mesh point;
    point.positions = {Vec3f(4.0f, 5.0f, 6.0f)};
    const Camera camera = frameScene(sceneOf({point}), 1.0f);
    EXPECT_LT(project(camera, 1.0f, point.positions[0]).length(), kFrameTolerance);
}

}  // namespace
}  // namespace prt
