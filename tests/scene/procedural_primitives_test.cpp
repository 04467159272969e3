#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kRounding = 3e-7f;  // of coordinates and normals near 1

TEST(MakeSphere, IsClosedFacesOutwardsAndLiesOnTheSphere) {
    const Vec3f center(1.0f, -2.0f, 3.0f);
    const Mesh mesh = makeSphere(center, 2.0f, 24);
    const Scene scene = sceneOf({mesh});
    EXPECT_TRUE(findOpenEdges(scene).empty());
    EXPECT_EQ(countFlippedTriangles(scene), 0u);
    EXPECT_EQ(weldVertices(scene).vertexOfGroup.size(), mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        EXPECT_LE((mesh.positions[i] - (center + mesh.normals[i] * 2.0f)).length(),
                  4.0f * kRounding);
    }
}

TEST(MakeSphere, AreaAndVolumeConvergeWithTheSquareOfTheCellSize) {
    double previousAreaError = 1.0, previousVolumeError = 1.0;
    for (const int segmentCount : {16, 32, 64, 128}) {
        const Scene scene = sceneOf({makeSphere(Vec3f(0.0f), 1.0f, segmentCount)});
        const double areaError = 1.0 - surfaceArea(scene) / (4.0 * kPi);
        const double volumeError = 1.0 - enclosedVolume(scene) / (4.0 / 3.0 * kPi);
        EXPECT_GT(areaError, 0.0);
        EXPECT_LT(areaError, 0.3 * previousAreaError);
        EXPECT_LT(volumeError, 0.3 * previousVolumeError);
        previousAreaError = areaError;
        previousVolumeError = volumeError;
    }
    EXPECT_LT(previousVolumeError, 1.1e-3);
}

// The bowl of the closed form A13: its area fraction of the sphere decides the interreflection.
TEST(MakeBowl, IsThePartOfTheUnitSphereBelowTheOpeningSeenFromInside) {
    for (const float opening : {-0.5f, 0.0f, 0.7f}) {
        const Mesh mesh = makeBowl(opening, 320);
        const Scene scene = sceneOf({mesh});
        EXPECT_EQ(countFlippedTriangles(scene), 0u);
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            EXPECT_NEAR(mesh.positions[i].length(), 1.0f, kRounding);
            EXPECT_EQ(mesh.normals[i], -mesh.positions[i]);
            EXPECT_LE(mesh.positions[i].z, opening);
        }
        constexpr double kAreaTolerance = 2e-4;
        EXPECT_NEAR(surfaceArea(scene) / (2.0 * kPi * (1.0 + static_cast<double>(opening))), 1.0,
                    kAreaTolerance);
        const auto rim = findOpenEdges(scene);
        EXPECT_EQ(rim.size(), 320u);
        for (const auto& [a, b] : rim)
            EXPECT_TRUE(a.z == opening && b.z == opening);
    }
}

TEST(MakeFloor, IsASquareThatFacesUp) {
    const Mesh mesh = makeFloor(3.0f, 0.3f, 7);
    const Scene scene = sceneOf({mesh});
    EXPECT_EQ(mesh.vertexCount(), 64u);
    EXPECT_EQ(mesh.triangleCount(), 98u);
    EXPECT_EQ(countFlippedTriangles(scene), 0u);
    EXPECT_NEAR(surfaceArea(scene), 36.0, 1e-5);
    for (const Vec3f& position : mesh.positions)
        EXPECT_EQ(position.y, 0.3f);
    for (const Vec3f& normal : mesh.normals)
        EXPECT_EQ(normal, Vec3f(0.0f, 1.0f, 0.0f));
}

TEST(MakeBox, IsClosedAndItsSidesMeetInTheSamePoints) {
    const Vec3f low(-0.1f, 0.3f, 1.7f), high(0.9f, 2.6f, 3.1f);
    for (const bool facingInwards : {false, true}) {
        const Scene scene = sceneOf({makeBox(low, high, facingInwards, 7)});
        EXPECT_TRUE(findOpenEdges(scene).empty());
        EXPECT_EQ(countFlippedTriangles(scene), 0u);
        EXPECT_NEAR(enclosedVolume(scene), (facingInwards ? -1.0 : 1.0) * 1.0 * 2.3 * 1.4, 1e-5);
        EXPECT_EQ(computeBounds(scene).low, low);
        EXPECT_EQ(computeBounds(scene).high, high);
        // Six sides of 8 × 8 points meet along edges and corners: 6·36 + 12·6 + 8 places.
        EXPECT_EQ(weldPositions(scene).vertexOfGroup.size(), 296u);
        EXPECT_EQ(scene.vertexCount(), 384u);
    }
}

}  // namespace
}  // namespace prt
