#include "prt/basis/zonal_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/basis/sh_rotation.h"
#include "prt/basis/zonal.h"

namespace prt {
namespace {

constexpr double kRounding = 1e-12;

std::vector<double> makeRandomFunction(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    for (double& coefficient : coefficients)
        coefficient = 2.0 * random.nextUnitDouble() - 1.0;
    return coefficients;
}

ZonalLobe makeRandomLobe(int bandCount, RandomStream& random) {
    const double z = 2.0 * random.nextUnitDouble() - 1.0, radius = std::sqrt(1.0 - z * z);
    const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
    ZonalLobe lobe{Vec3d(radius * std::cos(phi), radius * std::sin(phi), z), {}};
    for (int l = 0; l < bandCount; ++l)
        lobe.zonal.push_back(2.0 * random.nextUnitDouble() - 1.0);
    lobe.zonal[1] = std::abs(lobe.zonal[1]);
    return lobe;
}

double norm(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value * value;
    return std::sqrt(sum);
}

std::vector<double> subtract(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] -= b[i];
    return a;
}

std::vector<double> expand(const ZonalFit& fit, std::size_t coefficientCount) {
    std::vector<double> coefficients(coefficientCount);
    expandZonalLobes(fit.lobes, coefficients);
    return coefficients;
}

/// What one lobe about the axis leaves: all of each band but its value there, f_l(a) √(4π/(2l+1)).
double errorAboutAxis(const std::vector<double>& coefficients, int bandCount, const Vec3d& axis) {
    double squaredError = std::pow(norm(coefficients), 2.0);
    for (int l = 0; l < bandCount; ++l) {
        std::vector<double> band = coefficients;
        for (int i = 0; i < shCoefficientCount(bandCount); ++i) {
            if (shDegree(i) != l) band[static_cast<std::size_t>(i)] = 0.0;
        }
        squaredError -= 4.0 * std::numbers::pi / (2 * l + 1) *
                        std::pow(reconstructSh(band, bandCount, axis), 2.0);
    }
    return std::sqrt(squaredError);
}

TEST(ZonalFit, GivesASumOfUpToThreeLobesBack) {
    constexpr double kRelativeTolerance = 1e-6;
    constexpr int kTrialCount = 5;
    for (const int bandCount : {4, 5, 6}) {
        for (int lobeCount = 1; lobeCount <= 3; ++lobeCount) {
            for (int trial = 0; trial < kTrialCount; ++trial) {
                RandomStream random(static_cast<std::uint64_t>(trial), 7);
                std::vector<ZonalLobe> lobes;
                for (int i = 0; i < lobeCount; ++i)
                    lobes.push_back(makeRandomLobe(bandCount, random));
                std::vector<double> sum(static_cast<std::size_t>(shCoefficientCount(bandCount)));
                expandZonalLobes(lobes, sum);
                const ZonalFit fit = fitZonalLobes(sum, {.lobeCount = lobeCount});
                ASSERT_EQ(fit.lobes.size(), static_cast<std::size_t>(lobeCount));
                EXPECT_LT(norm(subtract(expand(fit, sum.size()), sum)),
                          kRelativeTolerance * norm(sum))
                    << lobeCount << " lobes of " << bandCount << " bands, trial " << trial;
            }
        }
    }
}

TEST(ZonalFit, FindsTheAxisOfOneLobe) {
    constexpr double kAngle = 1e-6;
    for (int trial = 0; trial < 20; ++trial) {
        RandomStream random(static_cast<std::uint64_t>(trial), 8);
        const ZonalLobe lobe = makeRandomLobe(5, random);
        std::vector<double> sum(25);
        expandZonalLobes(std::vector{lobe}, sum);
        const ZonalFit fit = fitZonalLobes(sum);
        EXPECT_LT((fit.lobes[0].axis - lobe.axis).length(), kAngle);
        for (std::size_t l = 0; l < 5; ++l)
            EXPECT_NEAR(fit.lobes[0].zonal[l], lobe.zonal[l], kAngle);
    }
}

TEST(ZonalFit, OfOneLobeIsTheBestOfAllAxes) {
    constexpr int kAxisCount = 5000;
    constexpr double kBetweenAxes = 0.01;  // what the spiral misses
    for (const int bandCount : {3, 5, 8}) {
        const auto function = makeRandomFunction(bandCount, 1);
        double least = 1e300;
        for (int i = 0; i < kAxisCount; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kAxisCount, radius = std::sqrt(1.0 - z * z);
            const double phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const Vec3d axis(radius * std::cos(phi), radius * std::sin(phi), z);
            least = std::min(least, errorAboutAxis(function, bandCount, axis));
        }
        const double error = fitZonalLobes(function).relativeError * norm(function);
        EXPECT_LE(error, least);
        EXPECT_GT(error, (1.0 - kBetweenAxes) * least) << bandCount << " bands";
    }
}

TEST(ZonalFit, ReportsTheErrorOfWhatItGives) {
    for (const int lobeCount : {1, 2, 4}) {
        const auto function = makeRandomFunction(5, 2);
        const ZonalFit fit = fitZonalLobes(function, {.lobeCount = lobeCount});
        EXPECT_GT(fit.relativeError, 0.0);
        EXPECT_NEAR(fit.relativeError, norm(subtract(expand(fit, 25), function)) / norm(function),
                    kRounding);
    }
}

TEST(ZonalFit, IsNeverWorseWithALobeMore) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto function = makeRandomFunction(5, seed);
        double last = 1.0;
        for (int lobeCount = 1; lobeCount <= 5; ++lobeCount) {
            const double error =
                fitZonalLobes(function, {.lobeCount = lobeCount, .startCount = 0}).relativeError;
            EXPECT_LE(error, last + kRounding) << lobeCount << " lobes";
            last = error;
        }
        EXPECT_LT(last, 0.5);
    }
}

TEST(ZonalFit, IsExactForTheMeanAndWithThreeLobesForTheFirstDegree) {
    const auto function = makeRandomFunction(5, 6);
    for (const int lobeCount : {1, 2, 3}) {
        const auto expanded = expand(fitZonalLobes(function, {.lobeCount = lobeCount}), 25);
        for (std::size_t i = 0; i < (lobeCount == 3 ? 4u : 1u); ++i)
            EXPECT_NEAR(expanded[i], function[i], kRounding) << lobeCount << " lobes";
    }
    // Two bands are a lobe about their linear direction.
    const auto linear = makeRandomFunction(2, 7);
    const ZonalFit fit = fitZonalLobes(linear);
    EXPECT_LT(fit.relativeError, kRounding);
    EXPECT_GT(fit.lobes[0].axis.dot(
                  optimalLinearDirection(std::span<const double, 3>(linear.data() + 1, 3))),
              1.0 - kRounding);
}

TEST(ZonalFit, TurnsWithTheFunction) {
    constexpr double kRelativeTolerance = 1e-9;
    const auto function = makeRandomFunction(5, 8);
    std::vector<double> turned(25);
    const Mat3d rotation = rotationAbout(Vec3d(2.0, -1.0, 2.0) / 3.0, 2.0);
    ShRotation(rotation, 5).apply(function, turned);
    for (const int lobeCount : {1, 2}) {
        const ZonalFit fit = fitZonalLobes(function, {.lobeCount = lobeCount});
        const ZonalFit turnedFit = fitZonalLobes(turned, {.lobeCount = lobeCount});
        EXPECT_NEAR(turnedFit.relativeError, fit.relativeError, kRelativeTolerance);
    }
    EXPECT_LT(
        (fitZonalLobes(turned).lobes[0].axis - rotation * fitZonalLobes(function).lobes[0].axis)
            .length(),
        1e-5);
}

TEST(ZonalFit, OfTheUnshadowedTransferIsOneLobeAlongTheNormal) {
    constexpr double kFloatRounding = 1e-6;
    const Vec3f normal = Vec3f(1.0f, -3.0f, 2.0f).normalized();
    std::vector<float> transfer(25);
    unshadowedTransfer(normal, 5, transfer);
    const ZonalFit fit = fitZonalLobes(std::vector<double>(transfer.begin(), transfer.end()));
    EXPECT_LT(fit.relativeError, kFloatRounding);
    EXPECT_LT((fit.lobes[0].axis - Vec3d(normal)).length(), kFloatRounding);
}

TEST(ZonalFit, TakesFunctionsOfOneBandAndOfNothing) {
    const ZonalFit constant = fitZonalLobes(std::vector{2.0}, {.lobeCount = 2});
    EXPECT_LT(constant.relativeError, kRounding);
    const ZonalFit nothing = fitZonalLobes(std::vector<double>(9, 0.0), {.lobeCount = 2});
    EXPECT_EQ(nothing.relativeError, 0.0);
    ASSERT_EQ(nothing.lobes.size(), 2u);
    for (const double value : nothing.lobes[1].zonal)
        EXPECT_EQ(value, 0.0);
}

TEST(ZonalFit, WithTheSameSeedGivesTheSameBits) {
    const auto function = makeRandomFunction(5, 9);
    const ZonalFit a = fitZonalLobes(function, {.lobeCount = 3, .startCount = 3, .seed = 5});
    const ZonalFit b = fitZonalLobes(function, {.lobeCount = 3, .startCount = 3, .seed = 5});
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(a.lobes[i].axis, b.lobes[i].axis);
        EXPECT_EQ(a.lobes[i].zonal, b.lobes[i].zonal);
    }
}

}  // namespace
}  // namespace prt
