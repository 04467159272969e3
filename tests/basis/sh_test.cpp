#include "prt/basis/sh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "prt/math/frame.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

// Values with Condon-Shortley phase at (1, 2, 3)/√14, printed with nine
// decimals (SciPy's definition).
constexpr std::array<double, 36> kPublishedValues = {
    0.282094792,  -0.261169028, 0.391753542,  -0.130584514, 0.156078347,  -0.468235042,
    0.292863596,  -0.234117521, -0.11705876,  0.022527969,  0.331092173,  -0.540952781,
    0.064115724,  -0.270476391, -0.24831913,  0.123903829,  -0.076632947, 0.054187677,
    0.473087348,  -0.430101349, -0.192680818, -0.215050675, -0.354815511, 0.298032221,
    -0.022351276, 0.034011063,  -0.203783543, 0.089393339,  0.509836094,  -0.164289043,
    -0.371726573, -0.082144522, -0.38237707,  0.491663362,  -0.059436867, -0.036696147};

const Vec3d kPublishedDirection = Vec3d(1.0, 2.0, 3.0) / std::sqrt(14.0);

std::vector<double> evaluate(const Vec3d& direction, int bandCount) {
    std::vector<double> values(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    evaluateSh(direction, bandCount, values);
    return values;
}

/// The textbook definition, with factorials: slow, and without trust in recurrences of ours.
double evaluateByDefinition(int l, int m, const Vec3d& direction) {
    const int size = std::abs(m);
    double factorialRatio = 1.0;
    for (int k = l - size + 1; k <= l + size; ++k)
        factorialRatio /= k;
    const double norm = std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi) * factorialRatio);
    const double legendre =
        std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(size), direction.z);
    const double phi = std::atan2(direction.y, direction.x);
    const double azimuthal = m > 0   ? std::numbers::sqrt2 * std::cos(m * phi)
                             : m < 0 ? std::numbers::sqrt2 * std::sin(size * phi)
                                     : 1.0;
    return (m % 2 == 0 ? 1.0 : -1.0) * norm * legendre * azimuthal;
}

TEST(Conventions, C2_ShCarryTheCondonShortleyPhaseAndAreOrthonormal) {
    constexpr double kRounding = 1e-15;
    const auto up = evaluate(Vec3d(0.0, 1.0, 0.0), 2);
    EXPECT_NEAR(up[1], -0.48860251190291992, kRounding);
    const auto right = evaluate(Vec3d(1.0, 0.0, 0.0), 2);
    EXPECT_NEAR(right[3], -0.48860251190291992, kRounding);
    const auto polar = evaluate(Vec3d(0.0, 0.0, 1.0), 2);
    EXPECT_NEAR(polar[2], 0.48860251190291992, kRounding);
}

TEST(Conventions, C3_CoefficientsAreOrderedByDegreeThenOrder) {
    EXPECT_EQ(shIndex(0, 0), 0);
    EXPECT_EQ(shIndex(1, -1), 1);
    EXPECT_EQ(shIndex(2, -2), 4);
    EXPECT_EQ(shIndex(4, 4), 24);
    EXPECT_EQ(shCoefficientCount(5), 25);
    for (int l = 0; l < 20; ++l) {
        for (int m = -l; m <= l; ++m)
            EXPECT_EQ(shDegree(shIndex(l, m)), l);
    }
}

TEST(Sh, ValuesAreThePublishedOnes) {
    constexpr double kPrintedPrecision = 1e-9;
    const auto values = evaluate(kPublishedDirection, 6);
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], kPublishedValues[i], kPrintedPrecision) << "function " << i;
    }
}

TEST(Sh, EveryBandCountFollowsTheDefinition) {
    constexpr double kTolerance = 1e-12;
    for (const int bandCount : {1, 2, 3, 5, 10, 11, 26}) {
        for (const SphereNode& node : sphereQuadrature(8)) {
            const auto values = evaluate(node.direction, bandCount);
            for (int i = 0; i < shCoefficientCount(bandCount); ++i) {
                const int l = shDegree(i);
                ASSERT_NEAR(values[static_cast<std::size_t>(i)],
                            evaluateByDefinition(l, i - shIndex(l, 0), node.direction), kTolerance)
                    << bandCount << " bands, function " << i;
            }
        }
    }
}

/// The largest deviation of ∫ y_i y_j from δ_ij.
double gramError(int bandCount) {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<double> gram(count * count, 0.0);
    for (const auto& [direction, weight] : sphereQuadrature(2 * (bandCount - 1))) {
        const auto values = evaluate(direction, bandCount);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j <= i; ++j)
                gram[i * count + j] += weight * values[i] * values[j];
        }
    }
    double error = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            error = std::max(error, std::abs(gram[i * count + j] - (i == j ? 1.0 : 0.0)));
        }
    }
    return error;
}

// T-6, A1
TEST(Sh, FunctionsAreOrthonormal) {
    constexpr double kTolerance = 1e-12;
    for (int bandCount = 1; bandCount <= 12; ++bandCount)
        EXPECT_LT(gramError(bandCount), kTolerance);
}

// A1
TEST(Sh, FloatFunctionsAreOrthonormal) {
    constexpr double kFloatTolerance = 1e-5;
    constexpr std::size_t kCount = shCoefficientCount(kMaxBandCount);
    std::vector<double> gram(kCount * kCount, 0.0);
    std::vector<float> values(kCount);
    for (const auto& [direction, weight] : sphereQuadrature(2 * (kMaxBandCount - 1))) {
        evaluateSh(Vec3f(direction), kMaxBandCount, values);
        for (std::size_t i = 0; i < kCount; ++i) {
            for (std::size_t j = 0; j < kCount; ++j)
                gram[i * kCount + j] += weight * values[i] * values[j];
        }
    }
    for (std::size_t i = 0; i < kCount; ++i) {
        for (std::size_t j = 0; j < kCount; ++j)
            ASSERT_NEAR(gram[i * kCount + j], i == j ? 1.0 : 0.0, kFloatTolerance) << i << " " << j;
    }
}

TEST(Sh, StraightLineCodeIsTheRecurrenceUnrolled) {
    constexpr double kTolerance = 1e-13;
    for (const SphereNode& node : sphereQuadrature(30)) {
        const auto recurrence = evaluate(node.direction, kMaxBandCount + 1);
        for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
            const auto values = evaluate(node.direction, bandCount);
            for (std::size_t i = 0; i < values.size(); ++i)
                ASSERT_NEAR(values[i], recurrence[i], kTolerance) << bandCount << " " << i;
        }
    }
}

// T-8: the Laplacian by a seven-point difference of the function extended constantly along rays.
TEST(Sh, FunctionsAreEigenfunctionsOfTheLaplacian) {
    constexpr double kStep = 1e-3;
    constexpr double kDifferenceError = 1e-3;  // h²/12 times fourth derivatives, which grow as l⁴
    for (int i = 0; i < shCoefficientCount(6); ++i) {
        const int l = shDegree(i);
        const auto at = [&](const Vec3d& point) {
            return evaluate(point.normalized(), 6)[static_cast<std::size_t>(i)];
        };
        double laplacian = -6.0 * at(kPublishedDirection);
        for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}) {
            laplacian +=
                at(kPublishedDirection + axis * kStep) + at(kPublishedDirection - axis * kStep);
        }
        laplacian /= kStep * kStep;
        EXPECT_NEAR(laplacian, -l * (l + 1) * at(kPublishedDirection), kDifferenceError)
            << "function " << i;
    }
}

// T-9, with the band count at which factorials have long overflowed.
TEST(Sh, SquaresOfABandSumToAConstant) {
    constexpr double kRelativeTolerance = 1e-11;
    std::vector<Vec3d> directions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
    for (const double nearPole : {1e-2, 1e-5, 1e-8, 1e-30, 1e-160, 1e-300, 5e-324}) {
        directions.push_back(
            Vec3d(nearPole, -nearPole, std::sqrt(1.0 - 2.0 * nearPole * nearPole)));
        directions.push_back(-directions.back());
    }
    for (const SphereNode& node : sphereQuadrature(6))
        directions.push_back(node.direction);
    for (const int bandCount : {10, 64, 256}) {
        for (const Vec3d& direction : directions) {
            const auto values = evaluate(direction, bandCount);
            for (int l = 0; l < bandCount; ++l) {
                double sum = 0.0;
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                    sum +=
                        values[static_cast<std::size_t>(i)] * values[static_cast<std::size_t>(i)];
                }
                const double expected = (2 * l + 1) / (4.0 * std::numbers::pi);
                ASSERT_NEAR(sum / expected, 1.0, kRelativeTolerance)
                    << bandCount << " bands, degree " << l;
            }
        }
    }
}

TEST(Sh, FloatAndBatchValuesAreTheDoubleOnesRounded) {
    // A few roundings of values up to 1.5, amplified along nine steps of the recurrence.
    constexpr double kFloatTolerance = 5e-6;
    const auto nodes = sphereQuadrature(30);
    for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
        const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
        std::vector<float> single(count), batch(count * kShBatchSize);
        for (std::size_t first = 0; first + kShBatchSize <= nodes.size(); first += kShBatchSize) {
            std::array<float, kShBatchSize> x{}, y{}, z{};
            for (std::size_t j = 0; j < kShBatchSize; ++j) {
                const Vec3f direction(nodes[first + j].direction);
                std::tie(x[j], y[j], z[j]) = std::tuple(direction.x, direction.y, direction.z);
            }
            evaluateShBatch(x, y, z, bandCount, batch);
            for (std::size_t j = 0; j < kShBatchSize; ++j) {
                const Vec3f direction(x[j], y[j], z[j]);
                const auto truth = evaluate(Vec3d(direction), bandCount);
                evaluateSh(direction, bandCount, single);
                for (std::size_t i = 0; i < count; ++i) {
                    ASSERT_NEAR(batch[kShBatchSize * i + j], truth[i], kFloatTolerance);
                    ASSERT_NEAR(single[i], truth[i], kFloatTolerance);
                }
            }
        }
    }
}

TEST(Sh, FloatValuesBeyondTheStraightLineCodeAreRoundedOnce) {
    std::vector<float> values(static_cast<std::size_t>(shCoefficientCount(64)));
    const Vec3f direction(0.6f, 0.0f, 0.8f);
    evaluateSh(direction, 64, values);
    const auto truth = evaluate(Vec3d(direction), 64);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i], static_cast<float>(truth[i]));
}

TEST(Sh, ReconstructionIsTheSumOfCoefficientsTimesValues) {
    constexpr double kRounding = 1e-14;
    const auto values = evaluate(kPublishedDirection, 6);
    std::vector<double> coefficients(36, 0.0);
    coefficients[0] = 1.0;
    coefficients[17] = -2.0;
    coefficients[35] = 3.0;
    EXPECT_NEAR(reconstructSh(coefficients, 6, kPublishedDirection),
                values[0] - 2.0 * values[17] + 3.0 * values[35], kRounding);
}

}  // namespace
}  // namespace prt
