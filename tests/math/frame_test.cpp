#include "prt/math/frame.h"

#include <gtest/gtest.h>

#include "prt/math/quadrature.h"

namespace prt {
namespace {

TEST(Frame, IsOrthonormalAndRightHandedForEveryNormal) {
    constexpr double kRounding = 1e-15 * 4;
    std::vector<Vec3d> normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 0, -0.0}};
    for (const SphereNode& node : sphereQuadrature(21))
        normals.push_back(node.direction);
    for (const Vec3d& normal : normals) {
        const Frame<double> frame = frameFromNormal(normal);
        EXPECT_EQ(frame.normal, normal);
        EXPECT_NEAR(frame.tangent.length(), 1.0, kRounding);
        EXPECT_NEAR(frame.tangent.dot(normal), 0.0, kRounding);
        EXPECT_NEAR((frame.tangent.cross(frame.bitangent) - normal).length(), 0.0, kRounding);
    }
}

TEST(Frame, LocalZIsTheNormal) {
    const Frame<float> frame = frameFromNormal(Vec3f(0.6f, 0.0f, -0.8f));
    EXPECT_EQ(frame.worldFromLocal(Vec3f(0.0f, 0.0f, 1.0f)), frame.normal);
    EXPECT_EQ(frame.worldFromLocal(Vec3f(2.0f, 3.0f, 0.0f)),
              frame.tangent * 2.0f + frame.bitangent * 3.0f);
}

}  // namespace
}  // namespace prt
