#include "prt/light/lighting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/random.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kRounding = 1e-12;

Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients) {
        for (int channel = 0; channel < 3; ++channel) {
            coefficient[channel] = 2.0 * random.nextUnitDouble() - 1.0;
        }
    }
    return lighting;
}

void expectNear(const Vec3d& value, const Vec3d& truth) {
    EXPECT_NEAR((value - truth).length(), 0.0, kRounding);
}

TEST(Lighting, ReconstructionTreatsChannelsAlike) {
    const Lighting lighting = makeRandomLighting(4, 1);
    for (const auto& [direction, weight] : sphereQuadrature(4)) {
        const Vec3d radiance = reconstruct(lighting, direction);
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<double> coefficients;
            for (const Vec3d& coefficient : lighting.coefficients) {
                coefficients.push_back(coefficient[channel]);
            }
            EXPECT_NEAR(radiance[channel], reconstructSh(coefficients, 4, direction), kRounding);
        }
    }
}

TEST(Lighting, BasisLightingIsTheBasisFunction) {
    const Vec3d direction = Vec3d(2.0, -1.0, 2.0) / 3.0;
    std::vector<double> basis(16);
    evaluateSh(direction, 4, basis);
    for (int i = 0; i < 16; ++i)
        expectNear(reconstruct(makeBasisLighting(4, i), direction),
                   Vec3d(basis[static_cast<std::size_t>(i)]));
}

TEST(Lighting, RotatedLightingShowsAtTheRotatedDirectionWhatItShowedBefore) {
    const Lighting lighting = makeRandomLighting(6, 2);
    const Mat3d rotation = rotationAbout(Vec3d(2.0, -1.0, 2.0) / 3.0, 2.0);
    const Lighting rotated = rotate(lighting, rotation);
    for (const auto& [direction, weight] : sphereQuadrature(6)) {
        expectNear(reconstruct(rotated, rotation * direction), reconstruct(lighting, direction));
    }
}

TEST(Lighting, LightsAddAndScale) {
    const Lighting a = makeRandomLighting(3, 3), b = makeRandomLighting(3, 4);
    const Vec3d direction(0.6, 0.0, 0.8);
    expectNear(reconstruct(add(a, scale(b, -2.0)), direction),
               reconstruct(a, direction) - reconstruct(b, direction) * 2.0);
    EXPECT_EQ(reconstruct(Lighting(3), direction), Vec3d(0.0));
}

TEST(Lighting, InterpolationIsLinearBetweenItsEnds) {
    const Lighting a = makeRandomLighting(3, 7), b = makeRandomLighting(3, 8);
    const Vec3d direction(0.6, 0.0, 0.8);
    EXPECT_EQ(interpolate(a, b, 0.0).coefficients, a.coefficients);
    EXPECT_EQ(interpolate(a, b, 1.0).coefficients, b.coefficients);
    expectNear(reconstruct(interpolate(a, b, 0.25), direction),
               reconstruct(a, direction) * 0.75 + reconstruct(b, direction) * 0.25);
}

TEST(Lighting, WindowMultipliesEachBand) {
    const Lighting lighting = makeRandomLighting(3, 5);
    const Lighting windowed = applyWindow(lighting, std::vector<double>{1.0, 0.5, 0.25});
    EXPECT_EQ(windowed.coefficients[0], lighting.coefficients[0]);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_EQ(windowed.coefficients[i], lighting.coefficients[i] * 0.5);
    for (std::size_t i = 4; i < 9; ++i)
        EXPECT_EQ(windowed.coefficients[i], lighting.coefficients[i] * 0.25);
}

TEST(Lighting, TruncationKeepsTheFirstBands) {
    const Lighting lighting = makeRandomLighting(5, 6);
    const Lighting truncated = truncate(lighting, 2);
    EXPECT_EQ(truncated.bandCount, 2);
    ASSERT_EQ(truncated.coefficients.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(truncated.coefficients[i], lighting.coefficients[i]);
}

}  // namespace
}  // namespace prt
