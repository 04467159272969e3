#include "prt/math/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/random.h"

namespace prt {
namespace {

constexpr double kRounding = 1e-14;

void expectNear(const Vec3d& value, const Vec3d& truth, double tolerance = kRounding) {
    EXPECT_NEAR((value - truth).length(), 0.0, tolerance)
        << "(" << value.x << ", " << value.y << ", " << value.z << ")";
}

Vec3d randomVector(RandomStream& random) {
    const double x = random.nextUnitDouble(), y = random.nextUnitDouble(),
                 z = random.nextUnitDouble();
    return Vec3d(x, y, z) * 2.0 - Vec3d(1.0);
}

const Vec3d kX(1.0, 0.0, 0.0), kY(0.0, 1.0, 0.0), kZ(0.0, 0.0, 1.0);

TEST(Conventions, C9_MatricesActOnColumnVectorsAndChainDestinationFromSource) {
    expectNear(Mat3d(1, 2, 3, 4, 5, 6, 7, 8, 9) * kY, Vec3d(2, 5, 8));
    const Affine3d worldFromObject{rotationZ(std::numbers::pi / 2), Vec3d(10, 0, 0)};
    const Affine3d objectFromBone{rotationX(std::numbers::pi / 2), Vec3d(0, 5, 0)};
    const Affine3d worldFromBone = worldFromObject * objectFromBone;
    const Vec3d point(1, 2, 3);
    expectNear(transformPoint(worldFromBone, point),
               transformPoint(worldFromObject, transformPoint(objectFromBone, point)));
    // The bone's y turns to the object's z, which the world keeps.
    expectNear(worldFromBone.linear * kY, kZ);
    expectNear(transformPoint(worldFromBone, Vec3d(0.0)), Vec3d(5, 0, 0));
}

TEST(Transform, QuarterTurnsFollowTheRightHand) {
    const double quarter = std::numbers::pi / 2;
    expectNear(rotationX(quarter) * kY, kZ);
    expectNear(rotationY(quarter) * kZ, kX);
    expectNear(rotationZ(quarter) * kX, kY);
}

TEST(Transform, RotationAboutAnAxisIsThePublishedMatrix) {
    constexpr double kPrintedPrecision = 1e-9;
    const Mat3d rotation = rotationAbout(Vec3d(1, 2, 3) / std::sqrt(14.0), 0.7);
    const Mat3d published(.781639174, -.482929284, .394739798, .550117231, .832030134, -.071392499,
                          -.293957878, .272956339, .916015067);
    EXPECT_TRUE(rotation.equalWithAbsError(published, kPrintedPrecision));
}

Imath::Quatd randomQuaternion(RandomStream& random) {
    return Imath::Quatd(random.nextUnitDouble() - 0.5, randomVector(random)).normalized();
}

TEST(Transform, AQuaternionIsTheRotationAboutItsAxis) {
    RandomStream random(1, 1);
    for (int i = 0; i < 100; ++i) {
        const Vec3d axis = randomVector(random).normalized();
        const double angle = 2.0 * std::numbers::pi * random.nextUnitDouble();
        const Imath::Quatd quaternion(std::cos(0.5 * angle), axis * std::sin(0.5 * angle));
        EXPECT_TRUE(rotationFromQuaternion(quaternion)
                        .equalWithAbsError(rotationAbout(axis, angle), kRounding));
    }
    EXPECT_EQ(rotationFromQuaternion(Imath::Quatd()), Mat3d());
}

TEST(Transform, AQuaternionAndItsNegativeAreTheSameRotation) {
    RandomStream random(1, 2);
    for (int i = 0; i < 100; ++i) {
        const Imath::Quatd quaternion = randomQuaternion(random);
        EXPECT_EQ(rotationFromQuaternion(-quaternion), rotationFromQuaternion(quaternion));
    }
}

TEST(Transform, ProductsOfQuaternionsAreProductsOfMatrices) {
    RandomStream random(1, 3);
    for (int i = 0; i < 100; ++i) {
        const Imath::Quatd a = randomQuaternion(random), b = randomQuaternion(random);
        EXPECT_TRUE(rotationFromQuaternion(a * b).equalWithAbsError(
            rotationFromQuaternion(a) * rotationFromQuaternion(b), kRounding));
    }
}

// Files with z up become ours, with y up, by a quarter turn about x that keeps x.
TEST(Transform, SwappingTheUpAxisIsARotation) {
    const Mat3d yUpFromZUp = rotationX(-std::numbers::pi / 2);
    expectNear(yUpFromZUp * kZ, kY);
    expectNear(yUpFromZUp * kX, kX);
    expectNear(yUpFromZUp * kY, -kZ);
    EXPECT_NEAR(yUpFromZUp.determinant(), 1.0, kRounding);
    const Imath::Quatd quaternion(std::sqrt(0.5), Vec3d(-std::sqrt(0.5), 0.0, 0.0));
    EXPECT_TRUE(rotationFromQuaternion(quaternion).equalWithAbsError(yUpFromZUp, kRounding));
}

TEST(Transform, NormalsStayPerpendicularUnderAnyLinearMap) {
    RandomStream random(1, 0);
    for (int i = 0; i < 100; ++i) {
        const Vec3d a = randomVector(random), b = randomVector(random), c = randomVector(random);
        const Mat3d linear(a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
        const Vec3d tangent = randomVector(random), bitangent = randomVector(random);
        expectNear(normalMatrix(linear) * tangent.cross(bitangent),
                   (linear * tangent).cross(linear * bitangent));
    }
}

TEST(Transform, AMirroredInstanceKeepsItsOutsideOutside) {
    const Mat3d mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    // det < 0: the cofactors point against the mirrored geometric normal
    // of the plain inverse transpose.
    expectNear(normalMatrix(mirror) * kY, -kY);
    expectNear(normalMatrix(mirror) * kX, kX);
}

TEST(Transform, FloatVectorsAreTransformedInDouble) {
    const Vec3f rotated = rotationZ(std::numbers::pi / 2) * Vec3f(1.0f, 2.0f, 3.0f);
    EXPECT_EQ(rotated, Vec3f(-2.0f, 1.0f, 3.0f));
}

}  // namespace
}  // namespace prt
