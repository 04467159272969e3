#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh_rotation.h"
#include "tests/support/instruction_sets.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
// A15: the required accuracies, up to 10 bands.
constexpr double kDoubleTolerance = 1e-12;
constexpr double kFloatTolerance = 1e-5;

Vec3d randomDirection(RandomStream& random) {
    const double z = 2.0 * random.nextUnitDouble() - 1.0;
    const double phi = 2.0 * kPi * random.nextUnitDouble();
    const double radius = std::sqrt(1.0 - z * z);
    return Vec3d(radius * std::cos(phi), radius * std::sin(phi), z);
}

Mat3d randomRotation(RandomStream& random) {
    const Vec3d axis = randomDirection(random);
    return rotationAbout(axis, 2.0 * kPi * random.nextUnitDouble());
}

template <class Real>
std::vector<Real> evaluate(const Vec3d& direction, int bandCount) {
    std::vector<double> values(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    evaluateSh(direction, bandCount, values);
    return std::vector<Real>(values.begin(), values.end());
}

/// Coefficients of unit length, whose rotation keeps it.
std::vector<double> randomCoefficients(RandomStream& random, int bandCount) {
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    double square = 0.0;
    for (double& value : coefficients) {
        value = 2.0 * random.nextUnitDouble() - 1.0;
        square += value * value;
    }
    for (double& value : coefficients)
        value /= std::sqrt(square);
    return coefficients;
}

template <class Real>
std::vector<Real> turn(const Mat3d& rotation, int bandCount, const std::vector<Real>& source) {
    std::vector<Real> rotated(source.size());
    rotateSh(rotation, bandCount, std::span<const Real>(source), std::span<Real>(rotated));
    return rotated;
}

/// The independent derivation.
std::vector<double> turnByMatrix(const Mat3d& rotation, int bandCount,
                                 const std::vector<double>& source) {
    std::vector<double> rotated(source.size());
    ShRotation(rotation, bandCount).apply(source, rotated);
    return rotated;
}

/// NaN where either holds one.
template <class A, class B>
double maxDifference(const std::vector<A>& a, const std::vector<B>& b) {
    double difference = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double next = std::abs(double(a[i]) - double(b[i]));
        if (!(next <= difference)) difference = next;
    }
    return difference;
}

/// A thousand rotations and what is hard about them: poles, the way there, half turns and quarter
/// turns about many axes, reflections.
std::vector<Mat3d> makeRotations() {
    RandomStream random(15, 10);
    std::vector<Mat3d> rotations = {Mat3d(), Mat3d() * -1.0};
    for (const auto& rotate : {rotationX, rotationY, rotationZ}) {
        for (int quarter = 1; quarter < 4; ++quarter)
            rotations.push_back(rotate(quarter * kPi / 2));
    }
    for (int exponent = 4; exponent <= 20; ++exponent) {
        const double angle = std::pow(10.0, -exponent);
        for (const double around : {0.0, 0.3, kPi / 2, 2.0}) {
            const Mat3d nearPole = rotationZ(around) * rotationX(angle) * rotationZ(1.1);
            rotations.push_back(nearPole);
            rotations.push_back(rotationX(kPi) * nearPole);
            // With the rounding of a matrix that has seen some use.
            const Mat3d used = randomRotation(random);
            rotations.push_back(used * used.transposed() * nearPole);
        }
    }
    for (int i = 0; i < 100; ++i) {
        rotations.push_back(rotationAbout(randomDirection(random), kPi));
        const Vec3d flat = Vec3d(std::cos(0.1 * i), std::sin(0.1 * i), 0.0);
        rotations.push_back(rotationAbout(flat, kPi));
    }
    const std::size_t specialCount = rotations.size();
    for (std::size_t i = 0; i < specialCount; ++i)
        rotations.push_back(rotations[i] * Mat3d(1, 0, 0, 0, -1, 0, 0, 0, 1));
    for (int i = 0; i < 1000; ++i)
        rotations.push_back(randomRotation(random) * (i % 4 == 0 ? -1.0 : 1.0));
    return rotations;
}

void expectAgreesWithTheMatrix() {
    RandomStream random(15, 11);
    for (const Mat3d& rotation : makeRotations()) {
        for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
            const auto source = randomCoefficients(random, bandCount);
            const std::vector<float> floats(source.begin(), source.end());
            const auto truth = turnByMatrix(rotation, bandCount, source);
            ASSERT_LT(maxDifference(turn(rotation, bandCount, source), truth), kDoubleTolerance);
            ASSERT_LT(maxDifference(turn(rotation, bandCount, floats), truth), kFloatTolerance);
        }
    }
}

// A15
TEST(RotateSh, AgreesWithTheMatrixForEveryBandCountAndOrthogonalMatrix) {
    onEveryInstructionSet(expectAgreesWithTheMatrix);
}

// A15, without any other rotation code of ours.
TEST(RotateSh, RotatedValuesAreTheValuesAtTheRotatedDirection) {
    RandomStream random(15, 12);
    for (const Mat3d& rotation : makeRotations()) {
        const Vec3d direction = randomDirection(random);
        const auto truth = evaluate<double>(rotation * direction, kMaxBandCount);
        const auto doubles = evaluate<double>(direction, kMaxBandCount);
        const auto floats = evaluate<float>(direction, kMaxBandCount);
        ASSERT_LT(maxDifference(turn(rotation, kMaxBandCount, doubles), truth), kDoubleTolerance);
        ASSERT_LT(maxDifference(turn(rotation, kMaxBandCount, floats), truth), kFloatTolerance);
    }
}

// A15
TEST(RotateSh, RotatingTwiceIsRotatingByTheProductAndBackIsTheIdentity) {
    RandomStream random(15, 13);
    for (int i = 0; i < 1000; ++i) {
        const Mat3d a = randomRotation(random), b = randomRotation(random);
        const auto source = randomCoefficients(random, kMaxBandCount);
        const auto once = turn(b, kMaxBandCount, source);
        const auto twice = turn(a, kMaxBandCount, once);
        ASSERT_LT(maxDifference(twice, turn(a * b, kMaxBandCount, source)), kDoubleTolerance);
        ASSERT_LT(maxDifference(turn(b.transposed(), kMaxBandCount, once), source),
                  kDoubleTolerance);
    }
}

// A15
TEST(RotateSh, KeepsTheEnergyOfEachBandAndTheIdentityKeepsAll) {
    RandomStream random(15, 14);
    const auto source = randomCoefficients(random, kMaxBandCount);
    EXPECT_LT(maxDifference(turn(Mat3d(), kMaxBandCount, source), source), kDoubleTolerance);
    const auto rotated = turn(randomRotation(random), kMaxBandCount, source);
    for (std::size_t l = 0; l < kMaxBandCount; ++l) {
        double before = 0.0, after = 0.0;
        for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) {
            before += source[i] * source[i];
            after += rotated[i] * rotated[i];
        }
        EXPECT_NEAR(after, before, kDoubleTolerance);
    }
}

TEST(RotateSh, HasThePublishedEntries) {
    constexpr double kPrintedPrecision = 1e-9;
    const Mat3d rotation = rotationAbout(Vec3d(1, 2, 3) / std::sqrt(14.0), 0.7);
    const double degree2[5][5] = {{.384679626, -.362912936, -.048811722, -.16134999, .831804895},
                                  {.094423828, .742665103, .113270243, .52490206, .388819193},
                                  {-.138975715, -.433068334, .758625404, .466389054, .01031096},
                                  {-.355314235, -.33462377, -.626288099, .599956387, .097950384},
                                  {-.83519056, .131230697, .130529617, -.347818334, .38369214}};
    for (std::size_t k = 0; k < 5; ++k) {
        std::vector<double> unit(9, 0.0);
        unit[4 + k] = 1.0;
        const auto column = turn(rotation, 3, unit);
        for (std::size_t m = 0; m < 5; ++m)
            EXPECT_NEAR(column[4 + m], degree2[m][k], kPrintedPrecision) << m << " " << k;
    }
}

// A15
TEST(RotateSh, ATurnAboutZMixesOrdersOfOneSizeOnly) {
    const double angle = 0.4;
    RandomStream random(15, 15);
    const auto source = randomCoefficients(random, kMaxBandCount);
    const auto rotated = turn(rotationZ(angle), kMaxBandCount, source);
    for (int l = 0; l < kMaxBandCount; ++l) {
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(shIndex(l, m));
            const auto mirrored = static_cast<std::size_t>(shIndex(l, -m));
            const double truth =
                std::cos(m * angle) * source[i] - std::sin(m * angle) * source[mirrored];
            EXPECT_NEAR(rotated[i], truth, kDoubleTolerance) << l << " " << m;
        }
    }
}

// The test of DirectXMath, with our tolerance in place of its 1e-4.
TEST(RotateSh, TakesThePoleToEveryDirection) {
    const auto pole = evaluate<double>(Vec3d(0, 0, 1), 6);
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 20; ++j) {
            const double theta = kPi * i / 9, phi = 2 * kPi * j / 20;
            const Vec3d direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
            const auto rotated = turn(rotationZ(phi) * rotationY(theta), 6, pole);
            EXPECT_LT(maxDifference(rotated, evaluate<double>(direction, 6)), kDoubleTolerance);
        }
    }
}

// x → −x: (−1)^m for m ≥ 0, (−1)^(|m|+1) for m < 0. y → −y: −1 for m < 0. z → −z: (−1)^(l+|m|).
TEST(RotateSh, MirrorsFlipSigns) {
    RandomStream random(15, 16);
    const auto source = randomCoefficients(random, kMaxBandCount);
    const auto x = turn(Mat3d(-1, 0, 0, 0, 1, 0, 0, 0, 1), kMaxBandCount, source);
    const auto y = turn(Mat3d(1, 0, 0, 0, -1, 0, 0, 0, 1), kMaxBandCount, source);
    const auto z = turn(Mat3d(1, 0, 0, 0, 1, 0, 0, 0, -1), kMaxBandCount, source);
    const auto parity = [](int exponent) { return exponent % 2 == 0 ? 1.0 : -1.0; };
    for (int l = 0; l < kMaxBandCount; ++l) {
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(shIndex(l, m));
            const int size = std::abs(m);
            EXPECT_NEAR(x[i], parity(m >= 0 ? m : size + 1) * source[i], kDoubleTolerance);
            EXPECT_NEAR(y[i], (m < 0 ? -1.0 : 1.0) * source[i], kDoubleTolerance);
            EXPECT_NEAR(z[i], parity(l + size) * source[i], kDoubleTolerance);
        }
    }
}

TEST(RotateSh, SwappingTheUpAxisIsARotation) {
    const Vec3d direction = Vec3d(1, 2, 3) / std::sqrt(14.0);
    const auto zUp = evaluate<double>(direction, 5);
    const auto yUp = turn(rotationX(-kPi / 2), 5, zUp);
    const Vec3d swapped(direction.x, direction.z, -direction.y);
    EXPECT_LT(maxDifference(yUp, evaluate<double>(swapped, 5)), kDoubleTolerance);
    EXPECT_LT(maxDifference(turn(rotationX(kPi / 2), 5, yUp), zUp), kDoubleTolerance);
}

TEST(RotateSh, RotatesEachChannelAndInPlace) {
    RandomStream random(15, 17);
    const Mat3d rotation = randomRotation(random);
    for (const int bandCount : {1, 5, 12}) {
        std::vector<double> channels, truth;
        for (int channel = 0; channel < 3; ++channel) {
            const auto source = randomCoefficients(random, bandCount);
            const auto rotated = turnByMatrix(rotation, bandCount, source);
            channels.insert(channels.end(), source.begin(), source.end());
            truth.insert(truth.end(), rotated.begin(), rotated.end());
        }
        std::vector<float> floats(channels.begin(), channels.end());
        rotateSh(rotation, bandCount, std::span<const double>(channels), channels);
        rotateSh(rotation, bandCount, std::span<const float>(floats), floats);
        EXPECT_LT(maxDifference(channels, truth), kDoubleTolerance);
        EXPECT_LT(maxDifference(floats, truth), kFloatTolerance);
    }
}

/// Rotates sixteen at once and compares with the matrix.
void expectBatchAgrees(const std::vector<Mat3d>& rotations, std::size_t first, int bandCount,
                       bool isShared) {
    RandomStream random(15, 18 + first);
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::array<float, 9 * kShBatchSize> matrices{};
    std::vector<float> source(isShared ? count : count * kShBatchSize);
    std::vector<float> rotated(count * kShBatchSize);
    std::vector<std::vector<double>> truths;
    std::vector<double> coefficients = randomCoefficients(random, bandCount);
    for (std::size_t j = 0; j < kShBatchSize; ++j) {
        const Mat3d& rotation = rotations[(first + j) % rotations.size()];
        if (!isShared) coefficients = randomCoefficients(random, bandCount);
        for (std::size_t entry = 0; entry < 9; ++entry) {
            matrices[kShBatchSize * entry + j] = static_cast<float>(rotation.getValue()[entry]);
        }
        for (std::size_t i = 0; i < count; ++i)
            source[isShared ? i : kShBatchSize * i + j] = static_cast<float>(coefficients[i]);
        truths.push_back(turnByMatrix(rotation, bandCount, coefficients));
    }
    rotateShBatch(matrices, bandCount, source, rotated);
    for (std::size_t j = 0; j < kShBatchSize; ++j) {
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_NEAR(rotated[kShBatchSize * i + j], truths[j][i], kFloatTolerance)
                << bandCount << " bands, rotation " << first + j;
        }
    }
}

// A15
TEST(RotateShBatch, AgreesWithTheMatrixForEveryBandCountAndOrthogonalMatrix) {
    const auto rotations = makeRotations();
    onEveryInstructionSet([&] {
        for (std::size_t first = 0; first < rotations.size(); first += kShBatchSize) {
            for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
                expectBatchAgrees(rotations, first, bandCount, false);
                expectBatchAgrees(rotations, first, bandCount, true);
            }
        }
    });
}

}  // namespace
}  // namespace prt
