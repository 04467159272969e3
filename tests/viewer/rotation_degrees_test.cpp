#include <gtest/gtest.h>

#include <cmath>

#include "apps/common/parse.h"
#include "prt/base/random.h"

namespace prt::cli {
namespace {

constexpr double kRounding = 1e-12;
/// Angles of which one is a multiple of 90° to rounding leave the others a few digits fewer.
constexpr double kPoleRounding = 1e-6;

void expectSameRotation(const Vec3d& degrees, double tolerance) {
    const Mat3d rotation = rotationFromDegrees(degrees);
    const Mat3d again = rotationFromDegrees(degreesFromRotation(rotation));
    EXPECT_TRUE(rotation.equalWithAbsError(again, tolerance))
        << degrees.x << ", " << degrees.y << ", " << degrees.z;
}

TEST(RotationDegrees, AreFoundAgainWithinAQuarterTurnAboutY) {
    RandomStream random(7, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d degrees(random.nextUnitDouble() * 359.0 - 179.5,
                            random.nextUnitDouble() * 178.0 - 89.0,
                            random.nextUnitDouble() * 359.0 - 179.5);
        const Vec3d found = degreesFromRotation(rotationFromDegrees(degrees));
        EXPECT_NEAR((found - degrees).length(), 0.0, 1e-9);
        expectSameRotation(degrees, kRounding);
    }
}

TEST(RotationDegrees, BeyondAQuarterTurnAreAnotherWayToTheSameRotation) {
    for (const double y : {95.0, 179.0, -120.0, 300.0})
        expectSameRotation({30.0, y, -70.0}, kRounding);
}

TEST(RotationDegrees, HaveNoZWhereYIsAQuarterTurn) {
    for (const double y : {90.0, -90.0, 90.0 - 1e-9, -90.0 + 1e-7})
        for (const double x : {0.0, 25.0, 170.0, -100.0})
            expectSameRotation({x, y, 40.0}, kPoleRounding);
    EXPECT_EQ(degreesFromRotation(rotationFromDegrees({20.0, 90.0, 50.0})).z, 0.0);
}

TEST(RotationDegrees, OfNoRotationAreZero) {
    EXPECT_EQ(degreesFromRotation(Mat3d()), Vec3d(0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace prt::cli
