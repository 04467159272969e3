#include "prt/basis/zonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;

/// 2π ∫ f(z) y_l0(z) dz over [low, 1], by a rule that is exact for the polynomials asked for.
template <class Function>
double integrateZonal(int l, double low, Function function) {
    double sum = 0.0;
    for (const auto& [position, weight] : gaussLegendre(40)) {
        const double z = low + (1.0 - low) * 0.5 * (position + 1.0);
        const double y =
            std::sqrt((2 * l + 1) / (4.0 * kPi)) * std::legendre(static_cast<unsigned>(l), z);
        sum += weight * 0.5 * (1.0 - low) * 2.0 * kPi * function(z) * y;
    }
    return sum;
}

// A2
TEST(ClampedCosineZonal, IsThePublishedTable) {
    constexpr double kPrintedPrecision = 1e-9;
    const double published[] = {0.886226925,  1.023326708, 0.495415912, 0,
                                -0.110778366, 0,           0.049927135};
    const double factors[] = {kPi,
                              2.0943951023931953,
                              0.7853981633974483,
                              0,
                              -0.1308996938995747,
                              0,
                              0.04908738521234052,
                              0,
                              -0.02454369260617026,
                              0,
                              0.014317154020265984};
    const auto zonal = clampedCosineZonal(11);
    for (std::size_t l = 0; l < 11; ++l) {
        EXPECT_NEAR(clampedCosineFactor(static_cast<int>(l)), factors[l], kRounding);
        EXPECT_NEAR(zonal[l] * std::sqrt(4.0 * kPi / (2.0 * static_cast<double>(l) + 1.0)),
                    factors[l], kRounding);
    }
    for (std::size_t l = 0; l < 7; ++l)
        EXPECT_NEAR(zonal[l], published[l], kPrintedPrecision);
}

TEST(ClampedCosineZonal, IsTheIntegralOfTheCosineLobe) {
    const auto zonal = clampedCosineZonal(20);
    for (int l = 0; l < 20; ++l) {
        EXPECT_NEAR(zonal[static_cast<std::size_t>(l)],
                    integrateZonal(l, 0.0, [](double z) { return z; }), kRounding);
    }
}

TEST(CapZonal, IsThePublishedTable) {
    constexpr double kPrintedPrecision = 1e-8;
    const struct {
        double degrees;
        std::array<double, 6> zonal;
    } table[] = {
        {10, {.02692756, .04628561, .05884667, .06803752, .07478492, .07948790}},
        {20, {.10689205, .17955973, .21783072, .23417589, .23242364, .21540916}},
        {40, {.41467543, .63422092, .62721856, .46843839, .23304738, .00244034}},
        {90, {1.77245385, 1.53499006, 0, -.58618401, 0, .36741027}},
    };
    for (const auto& [degrees, expected] : table) {
        const auto zonal = capZonal(6, degrees * kPi / 180.0);
        for (std::size_t l = 0; l < 6; ++l)
            EXPECT_NEAR(zonal[l], expected[l], kPrintedPrecision);
    }
}

TEST(CapZonal, IsTheIntegralOverTheCap) {
    for (const double halfAngle : {0.0, 1e-3, 0.3, 1.0, 1.9, 3.0, kPi}) {
        const auto zonal = capZonal(20, halfAngle);
        for (int l = 0; l < 20; ++l) {
            const double truth = integrateZonal(l, std::cos(halfAngle), [](double) { return 1.0; });
            EXPECT_NEAR(zonal[static_cast<std::size_t>(l)], truth, kRounding)
                << halfAngle << " " << l;
        }
    }
}

TEST(CapZonal, KeepsEveryDigitForADiscAsSmallAsTheSun) {
    // For a half angle α → 0 every band becomes π α² y_l0(z) (1 − l(l+1) α²/8 + …) · (1 + O(α²)).
    constexpr double kHalfAngle = 1e-6;
    constexpr double kRelativeTolerance = 1e-10;
    const auto zonal = capZonal(10, kHalfAngle);
    for (int l = 0; l < 10; ++l) {
        const double limit = kPi * kHalfAngle * kHalfAngle * std::sqrt((2 * l + 1) / (4.0 * kPi));
        EXPECT_NEAR(zonal[static_cast<std::size_t>(l)] / limit, 1.0, kRelativeTolerance);
    }
}

TEST(RotateZonal, TurnsTheAxisOfTheFunction) {
    const std::array<double, 5> zonal = {0.3, -1.0, 2.0, 0.5, -0.7};
    for (const auto& [axis, axisWeight] : sphereQuadrature(4)) {
        std::array<double, 25> coefficients{};
        rotateZonal(zonal, axis, coefficients);
        for (const auto& [direction, directionWeight] : sphereQuadrature(5)) {
            double expected = 0.0;
            for (unsigned l = 0; l < 5; ++l) {
                expected += zonal[l] * std::sqrt((2.0 * l + 1.0) / (4.0 * kPi)) *
                            std::legendre(l, std::clamp(axis.dot(direction), -1.0, 1.0));
            }
            ASSERT_NEAR(reconstructSh(coefficients, 5, direction), expected, kRounding);
        }
    }
}

// T-14
TEST(UnshadowedTransfer, OfANormalAlongZIsThePublishedVector) {
    constexpr float kFloatRounding = 1e-7f;
    std::array<float, 25> transfer{};
    unshadowedTransfer(Vec3f(0, 0, 1), 5, transfer);
    const float zonal[] = {0.282094792f, 0.325735008f, 0.157695783f, 0.0f, -0.035261849f};
    for (int i = 0; i < 25; ++i) {
        const int l = shDegree(i);
        const float expected = i == shIndex(l, 0) ? zonal[l] : 0.0f;
        EXPECT_NEAR(transfer[static_cast<std::size_t>(i)], expected, kFloatRounding)
            << "function " << i;
    }
}

// T-14: exact under rotation.
TEST(UnshadowedTransfer, OfAnyNormalIsTheProjectedCosine) {
    constexpr double kFloatTolerance = 2e-6;
    for (const auto& [axis, axisWeight] : sphereQuadrature(4)) {
        const Vec3f normal(axis);
        std::array<float, 100> transfer{};
        unshadowedTransfer(normal, 10, transfer);
        std::array<double, 100> truth{};
        auto zonal = clampedCosineZonal(10);
        for (double& value : zonal)
            value /= kPi;
        rotateZonal(zonal, Vec3d(normal).normalized(), truth);
        for (std::size_t i = 0; i < 100; ++i)
            ASSERT_NEAR(transfer[i], truth[i], kFloatTolerance);
    }
}

TEST(PhongZonal, IsTheIntegralOfTheLobe) {
    for (const double exponent : {0.0, 1.0, 2.5, 10.0, 50.0}) {
        const auto lobe = [&](double z) {
            return (exponent + 1.0) / (2.0 * kPi) * std::pow(z, exponent);
        };
        const auto zonal = phongZonal(12, exponent);
        for (int l = 0; l < 12; ++l)
            EXPECT_NEAR(zonal[static_cast<std::size_t>(l)], integrateZonal(l, 0.0, lobe), 1e-8)
                << "exponent " << exponent << ", degree " << l;
    }
    const auto cosine = clampedCosineZonal(10);
    const auto phong = phongZonal(10, 1.0);
    for (std::size_t l = 0; l < 10; ++l)
        EXPECT_NEAR(phong[l], cosine[l] / kPi, kRounding);
}

TEST(GaussianZonal, IsTheIntegralOfTheLobe) {
    for (const double sharpness : {1e-9, 0.1, 1.0, 5.0, 20.0}) {
        const auto lobe = [&](double z) {
            return sharpness / (2.0 * kPi * -std::expm1(-2.0 * sharpness)) *
                   std::exp(sharpness * (z - 1.0));
        };
        const auto zonal = gaussianZonal(12, sharpness);
        for (int l = 0; l < 12; ++l)
            EXPECT_NEAR(zonal[static_cast<std::size_t>(l)], integrateZonal(l, -1.0, lobe),
                        kRounding)
                << "sharpness " << sharpness << ", degree " << l;
    }
}

TEST(GaussianZonal, HasTheClosedFormOfItsFirstDegrees) {
    for (const double sharpness : {0.3, 2.0, 30.0, 300.0, 1e3, 1e4, 1e5, 1e6, 1e9}) {
        // i_1/i_0 = coth λ − 1/λ, and i_2/i_0 = 1 − 3 (i_1/i_0)/λ.
        const double first = 1.0 / std::tanh(sharpness) - 1.0 / sharpness;
        const double second = 1.0 - 3.0 * first / sharpness;
        const auto zonal = gaussianZonal(3, sharpness);
        EXPECT_NEAR(zonal[0], std::sqrt(1.0 / (4.0 * kPi)), kRounding);
        EXPECT_NEAR(zonal[1], std::sqrt(3.0 / (4.0 * kPi)) * first, kRounding) << sharpness;
        EXPECT_NEAR(zonal[2], std::sqrt(5.0 / (4.0 * kPi)) * second, kRounding) << sharpness;
    }
}

// λ = 0 is a constant, and λ → ∞ a directional light: 1 − l(l+1)/(2λ) of its zonal peak.
TEST(GaussianZonal, RunsFromTheConstantToTheDirectionWithoutOverflow) {
    const auto constant = gaussianZonal(6, 0.0);
    EXPECT_NEAR(constant[0], std::sqrt(1.0 / (4.0 * kPi)), kRounding);
    for (std::size_t l = 1; l < 6; ++l)
        EXPECT_EQ(constant[l], 0.0);
    for (const double sharpness : {1e8, 1e15, 1e100, 1e300}) {
        const double secondOrder = 1e4 / (sharpness * sharpness);
        const auto zonal = gaussianZonal(10, sharpness);
        for (int l = 0; l < 10; ++l)
            EXPECT_NEAR(zonal[static_cast<std::size_t>(l)] / std::sqrt((2 * l + 1) / (4.0 * kPi)),
                        1.0 - l * (l + 1.0) / (2.0 * sharpness), kRounding + secondOrder)
                << "sharpness " << sharpness << ", degree " << l;
    }
}

TEST(ProjectZonal, GivesLegendrePolynomialsBack) {
    const std::vector<double> expected = {0.3, -1.2, 0.7, 0.0, 2.5};
    const auto function = [&](double z) {
        double value = 0.0;
        for (unsigned l = 0; l < expected.size(); ++l)
            value += expected[l] * std::sqrt((2 * l + 1) / (4.0 * kPi)) * std::legendre(l, z);
        return value;
    };
    const auto zonal = projectZonal(function, 7, 7);
    for (std::size_t l = 0; l < zonal.size(); ++l)
        EXPECT_NEAR(zonal[l], l < expected.size() ? expected[l] : 0.0, kRounding);
}

// Irradiance of some radiance, gathered direction by direction.
TEST(ConvolveZonal, ByTheClampedCosineIsIrradiance) {
    constexpr int kBandCount = 4;
    std::vector<double> radiance(16);
    for (std::size_t i = 0; i < radiance.size(); ++i)
        radiance[i] = std::sin(3.0 * static_cast<double>(i) + 1.0);
    std::vector<double> irradiance(16);
    convolveZonal(clampedCosineZonal(kBandCount), radiance, irradiance);

    // The clamp has a kink at the horizon: many nodes, and a tolerance.
    const auto nodes = sphereQuadrature(600);
    for (const Vec3d& normal :
         {Vec3d(0.0, 0.0, 1.0), Vec3d(0.6, 0.0, -0.8), Vec3d(0.48, 0.6, 0.64)}) {
        double gathered = 0.0;
        for (const SphereNode& node : nodes)
            gathered += node.weight * std::max(normal.dot(node.direction), 0.0) *
                        reconstructSh(radiance, kBandCount, node.direction);
        EXPECT_NEAR(reconstructSh(irradiance, kBandCount, normal), gathered, 1e-4);
    }
}

}  // namespace
}  // namespace prt
