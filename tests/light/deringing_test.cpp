#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/lighting.h"

namespace prt {
namespace {

/// λ from the factor 1 / (1 + 4 λ) of degree 1.
double lambdaOf(const std::vector<double>& factors) {
    return (1.0 / factors[1] - 1.0) / 4.0;
}

/// The least channel over a Fibonacci spiral.
double findLowestRadiance(const Lighting& lighting) {
    constexpr int kDirectionCount = 20000;
    double lowest = 1e300;
    for (int i = 0; i < kDirectionCount; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kDirectionCount;
        const double radius = std::sqrt(1.0 - z * z),
                     phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const Vec3d radiance =
            reconstruct(lighting, Vec3d(radius * std::cos(phi), radius * std::sin(phi), z));
        lowest = std::min({lowest, radiance.x, radiance.y, radiance.z});
    }
    return lowest;
}

TEST(Deringing, ADirectionalLightNeedsThePublishedLambda) {
    constexpr double kPublishedPrecision = 1e-3;
    const struct {
        int bandCount;
        double lambda;
    } table[] = {{2, .5}, {3, .25}, {5, .31668}, {6, .34263}};
    for (const auto& [bandCount, lambda] : table) {
        for (const Vec3d& direction : {Vec3d(0, 0, 1), Vec3d(0, 1, 0), Vec3d(2, -1, -2) / 3.0}) {
            EXPECT_NEAR(lambdaOf(deringingFactors(sunLighting(direction, 0.0, bandCount))), lambda,
                        kPublishedPrecision)
                << bandCount << " bands";
        }
    }
}

TEST(Deringing, LeavesLightingWithoutNegativeLobesAlone) {
    const std::vector<double> identity(5, 1.0);
    EXPECT_EQ(deringingFactors(uniformLighting(Vec3d(1.0, 2.0, 0.0), 5)), identity);
    EXPECT_EQ(deringingFactors(Lighting(5)), identity);
    Lighting slope = uniformLighting(Vec3d(1.0), 5);
    slope.coefficients[1].x = 0.5;
    EXPECT_EQ(deringingFactors(slope), identity);
}

TEST(Deringing, MakesEveryChannelNonNegativeAndNoMoreThanThat) {
    RandomStream random(17, 0);
    for (const int bandCount : {2, 4, 5, 7, 10}) {
        Lighting lighting = uniformLighting(Vec3d(0.02), bandCount);
        for (int i = 0; i < 4; ++i) {
            const double z = 2.0 * random.nextUnitDouble() - 1.0;
            const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
            const double radius = std::sqrt(1.0 - z * z);
            Lighting sun = sunLighting(Vec3d(radius * std::cos(phi), radius * std::sin(phi), z),
                                       0.1, bandCount);
            const Vec3d color(random.nextUnitDouble(), random.nextUnitDouble(),
                              random.nextUnitDouble());
            for (Vec3d& coefficient : sun.coefficients)
                coefficient *= color;
            lighting = add(lighting, sun);
        }
        const double mean = lighting.coefficients[0].x / std::sqrt(4.0 * std::numbers::pi);
        ASSERT_LT(findLowestRadiance(lighting), -0.01 * mean);

        const auto factors = deringingFactors(lighting);
        EXPECT_GT(findLowestRadiance(applyWindow(lighting, factors)), -1e-9 * mean)
            << bandCount << " bands";
        // A hundredth less smoothing rings again; the spiral misses the lowest point by a little.
        const auto weaker = laplacianFactors(0.99 * lambdaOf(factors), bandCount);
        EXPECT_LT(findLowestRadiance(applyWindow(lighting, weaker)), 0.0) << bandCount << " bands";
    }
}

TEST(Deringing, AChannelThatIsNegativeOnTheWholeIsLeftOut) {
    Lighting lighting = sunLighting(Vec3d(0, 1, 0), 0.0, 3);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient.z = -coefficient.z;
    EXPECT_NEAR(lambdaOf(deringingFactors(lighting)), 0.25, 1e-3);
}

}  // namespace
}  // namespace prt
