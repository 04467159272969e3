#include "prt/basis/sh_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "prt/base/random.h"

namespace prt {
namespace {

// A1
constexpr double kTolerance = 1e-12;

std::vector<double> randomCoefficients(int bandCount) {
    RandomStream random(1, static_cast<std::uint64_t>(bandCount));
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    for (double& value : coefficients)
        value = 2.0 * random.nextUnitDouble() - 1.0;
    return coefficients;
}

TEST(ProjectSh, EachFunctionOfTheBasisProjectsOntoItselfAlone) {
    for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
        const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
        std::vector<double> values(count);
        for (std::size_t j = 0; j < count; ++j) {
            const auto function = [&](const Vec3d& direction) {
                evaluateSh(direction, bandCount, values);
                return values[j];
            };
            const auto coefficients = projectSh(function, bandCount, bandCount - 1);
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_NEAR(coefficients[i], i == j ? 1.0 : 0.0, kTolerance) << i << " " << j;
        }
    }
}

TEST(ProjectSh, ARandomFunctionOfSixtyFourBandsComesBack) {
    const auto truth = randomCoefficients(64);
    const auto coefficients = projectSh(
        [&](const Vec3d& direction) { return reconstructSh(truth, 64, direction); }, 64, 63);
    for (std::size_t i = 0; i < truth.size(); ++i)
        ASSERT_NEAR(coefficients[i], truth[i], kTolerance) << i;
}

TEST(ProjectSh, HigherBandsOfAPolynomialDoNotLeakIntoTheLower) {
    const auto truth = randomCoefficients(8);
    const auto coefficients =
        projectSh([&](const Vec3d& direction) { return reconstructSh(truth, 8, direction); }, 3, 7);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        EXPECT_NEAR(coefficients[i], truth[i], kTolerance) << i;
}

TEST(ProjectSh, MonomialsHaveTheirClosedForms) {
    // z² = ⅓ + ⅔ P_2(z) and xy = √(4π/15) y_2−2.
    const double pi = std::numbers::pi;
    const auto square = projectSh([](const Vec3d& d) { return d.z * d.z; }, 4, 2);
    const auto product = projectSh([](const Vec3d& d) { return d.x * d.y; }, 4, 2);
    for (std::size_t i = 0; i < square.size(); ++i) {
        const double squareTruth = i == 0   ? std::sqrt(4 * pi) / 3
                                   : i == 6 ? 2.0 / 3.0 * std::sqrt(4 * pi / 5)
                                            : 0.0;
        EXPECT_NEAR(square[i], squareTruth, kTolerance) << i;
        EXPECT_NEAR(product[i], i == 4 ? std::sqrt(4 * pi / 15) : 0.0, kTolerance) << i;
    }
}

TEST(ProjectSh, SmoothFunctionsConverge) {
    const double pi = std::numbers::pi;
    const auto exponential = [](const Vec3d& d) { return std::exp(d.z); };
    const auto coefficients = projectSh(exponential, 2, 20);
    EXPECT_NEAR(coefficients[0], 2 * std::sqrt(pi) * std::sinh(1.0), kTolerance);
    EXPECT_NEAR(coefficients[2], 2 * std::sqrt(3 * pi) / std::numbers::e, kTolerance);
    EXPECT_GT(std::abs(projectSh(exponential, 2, 2)[0] - coefficients[0]), 1e-4);
}

}  // namespace
}  // namespace prt
