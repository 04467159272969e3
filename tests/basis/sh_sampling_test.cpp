#include "prt/basis/sh_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> makeRandomCoefficients(int bandCount, double constant, std::uint64_t seed) {
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    RandomStream random(seed, 0);
    for (double& coefficient : coefficients)
        coefficient = random.nextUnitDouble() - 0.5;
    coefficients[0] = constant;
    return coefficients;
}

/// Light from a lobe about an axis, nearly without negative parts.
std::vector<double> makeLobe(const Vec3d& axis, int bandCount) {
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    rotateZonal(phongZonal(bandCount, 6.0), axis, coefficients);
    return coefficients;
}

Vec3d directionAt(double z, double phi) {
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

/// ∫ function over z in [z0, z1] and azimuth in [φ0, φ1] by plain quadrature.
template <class Function>
double integrateOverCell(double z0, double z1, double phi0, double phi1, const Function& function) {
    // In θ, where y_lm sin θ is smooth.
    static const std::vector<QuadratureNode> kRule = gaussLegendre(24);
    const double theta0 = std::acos(z1), theta1 = std::acos(z0);
    double sum = 0.0;
    for (const QuadratureNode& height : kRule)
        for (const QuadratureNode& width : kRule) {
            const double theta = 0.5 * (theta0 + theta1 + height.position * (theta1 - theta0));
            const double phi = 0.5 * (phi0 + phi1 + width.position * (phi1 - phi0));
            sum += height.weight * width.weight * std::sin(theta) *
                   function(directionAt(std::cos(theta), phi));
        }
    return 0.25 * (theta1 - theta0) * (phi1 - phi0) * sum;
}

/// The sum of values at the middles of many equal cells, times their solid angle.
template <class Function>
double integrateOverSphere(const Function& function) {
    constexpr int kRowCount = 256, kColumnCount = 512;
    double sum = 0.0;
    for (int row = 0; row < kRowCount; ++row)
        for (int column = 0; column < kColumnCount; ++column)
            sum += function(directionAt(2.0 * (row + 0.5) / kRowCount - 1.0,
                                        2.0 * kPi * (column + 0.5) / kColumnCount));
    return sum * 4.0 * kPi / (kRowCount * kColumnCount);
}

// One function at a time, over cells large enough for it to change its sign in them.
TEST(ShSampler, CellsHaveTheExactIntegralOfEveryFunction) {
    constexpr double kRounding = 1e-13;
    constexpr int kBandCount = 10, kDepth = 2;
    constexpr double kConstant = 8.0;  // keeps every cell positive
    const double total = kConstant * std::sqrt(4.0 * kPi);
    for (int i = 1; i < shCoefficientCount(kBandCount); ++i) {
        std::vector<double> coefficients(100, 0.0);
        coefficients[0] = kConstant;
        coefficients[static_cast<std::size_t>(i)] = 1.0;
        const ShSampler sampler(coefficients, kBandCount, {.depth = kDepth});
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 8; ++column) {
                const double z0 = 0.5 * row - 1.0, phi0 = 0.25 * kPi * column;
                const double integral = integrateOverCell(
                    z0, z0 + 0.5, phi0, phi0 + 0.25 * kPi,
                    [&](const Vec3d& d) { return reconstructSh(coefficients, kBandCount, d); });
                const double density = sampler.density(directionAt(z0 + 0.25, phi0 + 0.1));
                ASSERT_NEAR(density * 4.0 * kPi / 32.0, integral / total, kRounding)
                    << "function " << i << " cell " << row << ", " << column;
            }
    }
}

TEST(ShSampler, DensityIsTheClampedFunctionAndIntegratesToOne) {
    constexpr double kRounding = 1e-11;
    constexpr double kCellVariation = 0.015;  // over a cell of a sixteenth of a radian
    for (const int bandCount : {1, 2, 5, 10}) {
        const auto coefficients = makeRandomCoefficients(bandCount, 0.6, 31);
        const ShSampler sampler(coefficients, bandCount);
        const auto target = [&](const Vec3d& d) {
            return std::max(reconstructSh(coefficients, bandCount, d), 0.0);
        };
        const auto density = [&](const Vec3d& d) { return sampler.density(d); };
        EXPECT_NEAR(integrateOverSphere(density), 1.0, kRounding);
        const double scale = integrateOverSphere(target);
        RandomStream random(32, 0);
        for (int i = 0; i < 1000; ++i) {
            const Vec3d direction = directionAt(2.0 * random.nextUnitDouble() - 1.0,
                                                2.0 * kPi * random.nextUnitDouble());
            EXPECT_NEAR(density(direction), target(direction) / scale, kCellVariation * bandCount);
        }
    }
}

// T-32
TEST(ShSampler, HistogramsOfItsSamplesFollowTheFunction) {
    constexpr int kSampleCount = 200'000, kRowCount = 10, kColumnCount = 20;
    constexpr double kSigmas = 5.0;  // of χ², whose variance is twice its degrees of freedom
    for (const int bandCount : {1, 3, 6}) {
        // Positive everywhere, so that the cells hold the function itself.
        const auto coefficients = makeRandomCoefficients(bandCount, 2.5 * bandCount, 33);
        const ShSampler sampler(coefficients, bandCount);
        std::vector<int> histogram(kRowCount * kColumnCount, 0);
        RandomStream random(34, 0);
        for (int i = 0; i < kSampleCount; ++i) {
            const double u = random.nextUnitDouble();
            const Vec3d d = sampler.sample(u, random.nextUnitDouble()).direction;
            EXPECT_NEAR(d.length(), 1.0, 1e-15);
            const double turns = std::atan2(d.y, d.x) / (2.0 * kPi) + (d.y < 0.0 ? 1.0 : 0.0);
            const int row =
                std::min(static_cast<int>(0.5 * (d.z + 1.0) * kRowCount), kRowCount - 1);
            ++histogram[static_cast<std::size_t>(row * kColumnCount +
                                                 static_cast<int>(turns * kColumnCount))];
        }
        double chiSquare = 0.0;
        const double total = coefficients[0] * std::sqrt(4.0 * kPi);
        for (int row = 0; row < kRowCount; ++row)
            for (int column = 0; column < kColumnCount; ++column) {
                const double z0 = 2.0 * row / kRowCount - 1.0,
                             phi0 = 2.0 * kPi * column / kColumnCount;
                const double expected =
                    kSampleCount / total *
                    integrateOverCell(
                        z0, z0 + 2.0 / kRowCount, phi0, phi0 + 2.0 * kPi / kColumnCount,
                        [&](const Vec3d& d) { return reconstructSh(coefficients, bandCount, d); });
                ASSERT_GT(expected, 50.0);
                const double excess =
                    histogram[static_cast<std::size_t>(row * kColumnCount + column)] - expected;
                chiSquare += excess * excess / expected;
            }
        const double freedom = kRowCount * kColumnCount - 1;
        EXPECT_LT(chiSquare, freedom + kSigmas * std::sqrt(2.0 * freedom)) << bandCount;
    }
}

TEST(ShSampler, SamplesCarryTheDensityOfTheirDirectionAndAvoidNegativeLobes) {
    const auto coefficients = makeRandomCoefficients(5, 0.3, 35);
    const ShSampler sampler(coefficients, 5);
    RandomStream random(36, 0);
    double lowest = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const double u = random.nextUnitDouble();
        const ShSample sample = sampler.sample(u, random.nextUnitDouble());
        EXPECT_GT(sample.density, 0.0);
        EXPECT_EQ(sample.density, sampler.density(sample.direction));
        lowest = std::min(lowest, reconstructSh(coefficients, 5, sample.direction));
    }
    // Cells on the border of a lobe have a little of it.
    EXPECT_GT(lowest, -0.1);
    EXPECT_EQ(sampler.density(Vec3d(0.0, 0.0, 1.0)) > 0.0,
              reconstructSh(coefficients, 5, Vec3d(0.0, 0.0, 1.0)) > 0.0);
}

TEST(ShSampler, CornersOfTheUnitSquareAreDrawnToo) {
    const double almostOne = 1.0 - 0x1p-53;
    const ShSampler sampler(makeLobe(Vec3d(0.0, 0.6, 0.8), 4), 4);
    for (const double u : {0.0, almostOne})
        for (const double v : {0.0, almostOne})
            EXPECT_GT(sampler.sample(u, v).density, 0.0);
}

TEST(ShSampler, WithoutAPositivePartItDrawsEvenly) {
    constexpr double kRounding = 1e-15;
    for (const double constant : {0.0, -1.0}) {
        const std::vector<double> coefficients = {constant, 0.0, 0.0, 0.0};
        const ShSampler sampler(coefficients, 2);
        for (const double u : {0.1, 0.9}) {
            const ShSample sample = sampler.sample(u, 0.3);
            EXPECT_NEAR(sample.density, 0.25 / kPi, kRounding);
            EXPECT_NEAR(sample.direction.z, 2.0 * 0.3 - 1.0, kRounding);
        }
    }
}

TEST(ShSampler, AnEvenShareLeavesNoDirectionOut) {
    constexpr double kRounding = 1e-12;
    const ShSampler sampler(makeRandomCoefficients(5, 0.1, 37), 5, {.uniformShare = 0.2});
    double least = 1.0;
    const double integral = integrateOverSphere([&](const Vec3d& d) {
        least = std::min(least, sampler.density(d));
        return sampler.density(d);
    });
    EXPECT_NEAR(integral, 1.0, kRounding);
    EXPECT_NEAR(least, 0.2 * 0.25 / kPi, kRounding);
}

/// The variance of estimates of ∫ f, for samples as sample(u, v) draws them.
template <class Sample, class Function>
double measureVariance(const Sample& sample, const Function& function, double truth) {
    constexpr int kSampleCount = 50'000;
    RandomStream random(38, 0);
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < kSampleCount; ++i) {
        const double u = random.nextUnitDouble();
        const ShSample drawn = sample(u, random.nextUnitDouble());
        const double value = function(drawn.direction) / drawn.density;
        mean += value / kSampleCount;
        squares += value * value / kSampleCount;
    }
    const double variance = squares - mean * mean;
    EXPECT_NEAR(mean, truth, 5.0 * std::sqrt(variance / kSampleCount) + 1e-9);
    return variance;
}

// T-32: irradiance from a lobe 50° from the normal, by light alone and by light times cosine.
TEST(ShSampler, LowersTheVarianceOfIrradiance) {
    const Vec3d normal = directionAt(0.3, 1.0);
    const Vec3d toLight = (normal + Vec3d(0.0, 0.0, 1.0)).normalized();
    std::vector<double> light = makeLobe(toLight, 5), cosine(25);
    light[0] += 0.05;
    rotateZonal(clampedCosineZonal(5), normal, cosine);
    const auto function = [&](const Vec3d& d) {
        return reconstructSh(light, 5, d) * std::max(normal.dot(d), 0.0);
    };
    const double truth = integrateOverSphere(function);

    const double even = measureVariance(
        [](double u, double v) {
            return ShSample{directionAt(2.0 * v - 1.0, 2.0 * kPi * u), 0.25 / kPi};
        },
        function, truth);
    const ShSampler byLight(light, 5, {.uniformShare = 0.05});
    const ShSampler byProduct =
        makeShProductSampler(ShTripling(5), light, cosine, {.uniformShare = 0.05});
    const auto varianceOf = [&](const ShSampler& sampler) {
        return measureVariance([&](double u, double v) { return sampler.sample(u, v); }, function,
                               truth);
    };
    EXPECT_LT(varianceOf(byLight), 0.1 * even);
    EXPECT_LT(varianceOf(byProduct), 0.04 * even);
}

TEST(ShSampler, OfAProductIsThatOfTheMultipliedFunction) {
    constexpr double kRounding = 1e-9;
    // Three bands times three are five: nothing is lost.
    std::vector<double> a = makeRandomCoefficients(3, 4.0, 39),
                        b = makeRandomCoefficients(3, 4.0, 40);
    a.resize(25);
    b.resize(25);
    const ShSampler sampler = makeShProductSampler(ShTripling(5), a, b, {.depth = 3});
    const auto product = [&](const Vec3d& d) {
        return reconstructSh(a, 5, d) * reconstructSh(b, 5, d);
    };
    double total = 0.0;
    for (std::size_t i = 0; i < 25; ++i)
        total += a[i] * b[i];
    for (int row = 0; row < 8; ++row) {
        const double z0 = 0.25 * row - 1.0;
        const double integral = integrateOverCell(z0, z0 + 0.25, 0.0, kPi / 8.0, product);
        ASSERT_GT(integral, 0.0);
        EXPECT_NEAR(sampler.density(directionAt(z0 + 0.1, 0.2)) * 4.0 * kPi / 128.0,
                    integral / total, kRounding);
    }
}

}  // namespace
}  // namespace prt
