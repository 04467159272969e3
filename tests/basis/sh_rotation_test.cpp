#include "prt/basis/sh_rotation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

// A15: the required accuracy in double, up to 10 bands.
constexpr double kTolerance = 1e-12;

Vec3d randomDirection(RandomStream& random) {
    const double z = 2.0 * random.nextUnitDouble() - 1.0;
    const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
    const double radius = std::sqrt(1.0 - z * z);
    return Vec3d(radius * std::cos(phi), radius * std::sin(phi), z);
}

Mat3d randomRotation(RandomStream& random) {
    const Vec3d axis = randomDirection(random);
    return rotationAbout(axis, 2.0 * std::numbers::pi * random.nextUnitDouble());
}

std::vector<double> evaluate(const Vec3d& direction, int bandCount) {
    std::vector<double> values(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    evaluateSh(direction, bandCount, values);
    return values;
}

std::vector<double> turn(const ShRotation& rotation, const std::vector<double>& source) {
    std::vector<double> rotated(source.size());
    rotation.apply(source, rotated);
    return rotated;
}

double maxDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference = std::max(difference, std::abs(a[i] - b[i]));
    return difference;
}

/// The oracle: M_ij = ∫ y_i(ω) y_j(R⁻¹ω) dω by a quadrature that is exact for n bands.
std::vector<double> integrateMatrix(const Mat3d& rotation, int bandCount) {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const Mat3d inverse = rotation.transposed();
    std::vector<double> matrix(count * count, 0.0);
    for (const auto& [direction, weight] : sphereQuadrature(2 * (bandCount - 1))) {
        const auto values = evaluate(direction, bandCount);
        const auto turned = evaluate(inverse * direction, bandCount);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j)
                matrix[i * count + j] += weight * values[i] * turned[j];
        }
    }
    return matrix;
}

void expectIntegratedMatrix(const Mat3d& rotation, int bandCount) {
    const ShRotation fast(rotation, bandCount);
    const std::vector<double> matrix = integrateMatrix(rotation, bandCount);
    const int count = shCoefficientCount(bandCount);
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            const int l = shDegree(i);
            const double entry =
                l == shDegree(j) ? fast.entry(l, i - shIndex(l, 0), j - shIndex(l, 0)) : 0.0;
            ASSERT_NEAR(entry, matrix[static_cast<std::size_t>(i * count + j)], kTolerance)
                << "functions " << i << " and " << j;
        }
    }
}

TEST(ShRotation, EntriesAreThePublishedOnes) {
    constexpr double kPrintedPrecision = 1e-9;
    const ShRotation rotation(rotationAbout(Vec3d(1, 2, 3) / std::sqrt(14.0), 0.7), 3);
    const double degree1[3][3] = {{.832030134, .071392499, .550117231},
                                  {-.272956339, .916015067, .293957878},
                                  {-.482929284, -.394739798, .781639174}};
    const double degree2[5][5] = {{.384679626, -.362912936, -.048811722, -.16134999, .831804895},
                                  {.094423828, .742665103, .113270243, .52490206, .388819193},
                                  {-.138975715, -.433068334, .758625404, .466389054, .01031096},
                                  {-.355314235, -.33462377, -.626288099, .599956387, .097950384},
                                  {-.83519056, .131230697, .130529617, -.347818334, .38369214}};
    for (int m = -1; m <= 1; ++m) {
        for (int k = -1; k <= 1; ++k) {
            EXPECT_NEAR(rotation.entry(1, m, k), degree1[m + 1][k + 1], kPrintedPrecision);
        }
    }
    for (int m = -2; m <= 2; ++m) {
        for (int k = -2; k <= 2; ++k) {
            EXPECT_NEAR(rotation.entry(2, m, k), degree2[m + 2][k + 2], kPrintedPrecision);
        }
    }
}

TEST(ShRotation, IsTheIntegralOfTurnedFunctions) {
    RandomStream random(15, 0);
    expectIntegratedMatrix(randomRotation(random), kMaxBandCount);
    for (int i = 0; i < 20; ++i)
        expectIntegratedMatrix(randomRotation(random), 5);
}

TEST(ShRotation, HoldsAtPolesHalfTurnsAndReflections) {
    const double pi = std::numbers::pi;
    const Mat3d special[] = {Mat3d(),
                             rotationX(pi),
                             rotationY(pi),
                             rotationZ(pi),
                             rotationX(pi / 2),
                             rotationY(-pi / 2),
                             rotationZ(1e-9),
                             rotationY(1e-9),
                             rotationAbout(Vec3d(1, 1, 0) / std::sqrt(2.0), pi),
                             Mat3d(1, 0, 0, 0, 1, 0, 0, 0, -1),
                             Mat3d(-1, 0, 0, 0, -1, 0, 0, 0, -1),
                             Mat3d(0, 1, 0, 1, 0, 0, 0, 0, 1) * rotationX(0.3)};
    for (const Mat3d& rotation : special)
        expectIntegratedMatrix(rotation, 6);
}

// A15
TEST(ShRotation, RotatedValuesAreTheValuesAtTheRotatedDirection) {
    RandomStream random(15, 1);
    for (int i = 0; i < 1000; ++i) {
        const Mat3d rotation = randomRotation(random);
        const Vec3d direction = randomDirection(random);
        const int bandCount = 1 + i % kMaxBandCount;
        const auto rotated = turn(ShRotation(rotation, bandCount), evaluate(direction, bandCount));
        ASSERT_LT(maxDifference(rotated, evaluate(rotation * direction, bandCount)), kTolerance);
    }
}

// A15
TEST(ShRotation, RotatingTwiceIsRotatingByTheProduct) {
    RandomStream random(15, 2);
    for (int i = 0; i < 1000; ++i) {
        const Mat3d a = randomRotation(random), b = randomRotation(random);
        std::vector<double> source(static_cast<std::size_t>(shCoefficientCount(kMaxBandCount)));
        for (double& value : source)
            value = 2.0 * random.nextUnitDouble() - 1.0;
        const auto twice =
            turn(ShRotation(a, kMaxBandCount), turn(ShRotation(b, kMaxBandCount), source));
        ASSERT_LT(maxDifference(twice, turn(ShRotation(a * b, kMaxBandCount), source)), kTolerance);
    }
}

// A15
TEST(ShRotation, KeepsTheEnergyOfEachBand) {
    RandomStream random(15, 3);
    std::vector<double> source(static_cast<std::size_t>(shCoefficientCount(kMaxBandCount)));
    for (double& value : source)
        value = 2.0 * random.nextUnitDouble() - 1.0;
    const auto rotated = turn(ShRotation(randomRotation(random), kMaxBandCount), source);
    for (int l = 0; l < kMaxBandCount; ++l) {
        double before = 0.0, after = 0.0;
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
            before += source[static_cast<std::size_t>(i)] * source[static_cast<std::size_t>(i)];
            after += rotated[static_cast<std::size_t>(i)] * rotated[static_cast<std::size_t>(i)];
        }
        EXPECT_NEAR(after, before, kTolerance);
    }
}

// A15
TEST(ShRotation, ATurnAboutZMixesOrdersOfOneSizeOnly) {
    const double angle = 0.4;
    const ShRotation rotation(rotationZ(angle), kMaxBandCount);
    for (int l = 0; l < kMaxBandCount; ++l) {
        for (int m = -l; m <= l; ++m) {
            for (int k = -l; k <= l; ++k) {
                double expected = 0.0;
                if (m == k) expected = std::cos(m * angle);
                if (m == -k && m != 0) expected = std::sin(k * angle);
                EXPECT_NEAR(rotation.entry(l, m, k), expected, kTolerance)
                    << l << " " << m << " " << k;
            }
        }
    }
}

TEST(ShRotation, StaysAccurateAtSixtyFourBands) {
    constexpr int kBandCount = 64;
    // Rounding grows with the depth of the recurrence: some four digits over 64 degrees.
    constexpr double kDeepTolerance = 1e-10;
    RandomStream random(15, 4);
    const Mat3d rotation = randomRotation(random);
    const Vec3d direction = randomDirection(random);
    const auto rotated = turn(ShRotation(rotation, kBandCount), evaluate(direction, kBandCount));
    EXPECT_LT(maxDifference(rotated, evaluate(rotation * direction, kBandCount)), kDeepTolerance);
}

}  // namespace
}  // namespace prt
