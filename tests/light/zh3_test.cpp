#include "prt/light/zh3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/irradiance.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kRounding = 1e-12;
const Vec3d kOrange(1.0, 0.6, 0.1);
const Vec3d kDirections[] = {Vec3d(0, 0, 1), Vec3d(0, 0, -1), Vec3d(1, 0, 0), Vec3d(0, -1, 0),
                             Vec3d(2, -1, -2) / 3.0};

Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient =
            Vec3d(random.nextUnitDouble(), random.nextUnitDouble(), random.nextUnitDouble()) -
            Vec3d(0.5);
    lighting.coefficients[0] = Vec3d(1.0, 1.5, 0.7);
    return lighting;
}

void expectEqual(const Lighting& value, const Lighting& truth) {
    ASSERT_EQ(value.bandCount, truth.bandCount);
    for (std::size_t i = 0; i < truth.coefficients.size(); ++i)
        EXPECT_LT((value.coefficients[i] - truth.coefficients[i]).length(), kRounding)
            << "coefficient " << i;
}

double squaredDistance(const Lighting& a, const Lighting& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.coefficients.size(); ++i)
        sum += (a.coefficients[i] - b.coefficients[i]).length2();
    return sum;
}

TEST(Zh3, IsExactForLightsThatAreTheSameAboutOneAxis) {
    for (const Vec3d& direction : kDirections) {
        for (const double halfAngle : {0.1, 0.9, 2.0}) {
            const Lighting lighting = add(discLighting(direction, halfAngle, kOrange, 5),
                                          uniformLighting(Vec3d(0.1, 0.2, 0.3), 5));
            const Zh3 light = compressToZh3(lighting);
            EXPECT_LT((zonalAxis(light) - direction).length(), kRounding);
            expectEqual(expandZh3(light), truncate(lighting, 3));
        }
    }
    expectEqual(expandZh3(compressToZh3(uniformLighting(kOrange, 3))), uniformLighting(kOrange, 3));
}

TEST(Zh3, IrradianceIsThatOfTheBandsItStandsFor) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const Zh3 light = compressToZh3(makeRandomLighting(3, seed));
        for (const auto& [normal, weight] : sphereQuadrature(4))
            EXPECT_LT(
                (evaluateIrradiance(light, normal) - evaluateIrradiance(expandZh3(light), normal))
                    .length(),
                kRounding);
    }
}

TEST(Zh3, TurnsWithTheLight) {
    const Mat3d rotation = rotationAbout(Vec3d(2.0, -1.0, 2.0) / 3.0, 2.0);
    const Lighting lighting = makeRandomLighting(3, 4);
    expectEqual(expandZh3(compressToZh3(rotate(lighting, rotation))),
                rotate(expandZh3(compressToZh3(lighting)), rotation));
    expectEqual(expandZh3(hallucinateZh3(rotate(lighting, rotation))),
                rotate(expandZh3(hallucinateZh3(lighting)), rotation));
}

TEST(Zh3, LiesBetweenTwoBandsAndThreeWithTheLeastErrorOfItsAxis) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Lighting lighting = makeRandomLighting(3, seed);
        Lighting linear = lighting;
        for (std::size_t i = 4; i < 9; ++i)
            linear.coefficients[i] = Vec3d(0.0);
        const Zh3 light = compressToZh3(lighting);
        const double error = squaredDistance(expandZh3(light), lighting);
        EXPECT_LT(error, squaredDistance(linear, lighting));
        EXPECT_GT(error, 0.0);
        for (int channel = 0; channel < 3; ++channel) {
            for (const double change : {-1e-3, 1e-3}) {
                Zh3 other = light;
                other.zonal[channel] += change;
                EXPECT_NEAR(squaredDistance(expandZh3(other), lighting), error + change * change,
                            kRounding);
            }
        }
    }
}

// z = L_00 (0.08 r + 0.6 r²), where a directional light has r = √3.
TEST(Zh3, TheGuessIsThePublishedFit) {
    for (const Vec3d& direction : kDirections) {
        const Lighting sun = sunLighting(direction, 0.0, 2);
        const double mean = sun.coefficients[0].x;
        const Zh3 light = hallucinateZh3(sun);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(light.zonal[channel], mean * (0.08 * std::sqrt(3.0) + 0.6 * 3.0),
                        kRounding);
    }
    // Each channel along the axis of luminance, which here is +y.
    Lighting lighting = uniformLighting(Vec3d(1.0), 2);
    const double mean = lighting.coefficients[0].x;
    lighting.coefficients[1] = Vec3d(-0.5, -1.0, 0.25) * mean;
    lighting.coefficients[3] = Vec3d(0.7152, -0.2126, 0.0) * mean;  // of no luminance
    const Zh3 light = hallucinateZh3(lighting);
    EXPECT_NEAR(light.zonal.x, mean * (0.08 * 0.5 + 0.6 * 0.25), kRounding);
    EXPECT_NEAR(light.zonal.y, mean * (0.08 + 0.6), kRounding);
    EXPECT_NEAR(light.zonal.z, mean * (0.08 * 0.25 + 0.6 * 0.0625), kRounding);

    EXPECT_EQ(hallucinateZh3(Lighting(2)).zonal, Vec3d(0.0));
    EXPECT_EQ(hallucinateZh3(uniformLighting(kOrange, 2)).zonal, Vec3d(0.0));
}

// A sun before a sky, whose second degree the guess misses by less than it adds.
TEST(Zh3, TheGuessIsCloserThanTwoBandsAre) {
    for (const double sky : {0.0, 0.02, 0.1, 0.5, 2.0}) {
        const Lighting lighting =
            add(sunLighting(Vec3d(2, -1, -2) / 3.0, 0.2, 3), uniformLighting(Vec3d(sky), 3));
        const Lighting guess = expandZh3(hallucinateZh3(lighting));
        const Lighting exact = expandZh3(compressToZh3(lighting));
        Lighting linear = lighting;
        for (std::size_t i = 4; i < 9; ++i)
            linear.coefficients[i] = Vec3d(0.0);
        EXPECT_LT(squaredDistance(guess, exact), squaredDistance(linear, exact)) << sky;
    }
}

}  // namespace
}  // namespace prt
