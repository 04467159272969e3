#include "prt/scene/scene.h"

#include <gtest/gtest.h>

#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

TEST(Scene, VerticesAreNumberedMeshAfterMesh) {
    const Scene scene = sceneOf({makeFloor(1.0f, 0.0f, 2), Mesh{}, makeFloor(1.0f, 0.0f, 1)});
    EXPECT_EQ(scene.vertexCount(), 9u + 4u);
    EXPECT_EQ(scene.triangleCount(), 8u + 2u);
    EXPECT_EQ(vertexOffsets(scene), (std::vector<std::size_t>{0, 9, 9, 13}));
    EXPECT_EQ(vertexOffsets(Scene{}), (std::vector<std::size_t>{0}));
}

TEST(Scene, BoundsAreTheSmallestBoxAroundAllMeshes) {
    const Scene scene =
        sceneOf({makeFloor(2.0f, -1.0f, 1),
                 makeBox(Vec3f(-1.0f, 0.0f, 1.0f), Vec3f(0.5f, 3.0f, 5.0f), false, 1)});
    const Bounds bounds = computeBounds(scene);
    EXPECT_EQ(bounds.low, Vec3f(-2.0f, -1.0f, -2.0f));
    EXPECT_EQ(bounds.high, Vec3f(2.0f, 3.0f, 5.0f));
    EXPECT_EQ(bounds.center(), Vec3f(0.0f, 1.0f, 1.5f));
    EXPECT_FLOAT_EQ(bounds.radius(), 0.5f * Vec3f(4.0f, 4.0f, 7.0f).length());
}

}  // namespace
}  // namespace prt
